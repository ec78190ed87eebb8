// Contexts: what is refused, and that it does not matter which one draws.
#include <unistd.h>

#include <cstdio>
#include <cstdlib>

#include "tests/render/plates.h"
#include "tests/render/studio.h"

using namespace tumble;

namespace {

/// What a command prints, without the last line end.
std::string output(const std::string& command) {
  FILE* pipe = popen(command.c_str(), "r");
  REQUIRE(pipe != nullptr);
  std::string text;
  char block[256];
  while (std::fgets(block, sizeof block, pipe)) text += block;
  REQUIRE(pclose(pipe) == 0);
  return text.substr(0, text.rfind('\n'));
}

std::string thisProgram() {
  char path[4096];
  const ssize_t size = readlink("/proc/self/exe", path, sizeof path);
  REQUIRE(size > 0);
  return {path, static_cast<std::size_t>(size)};
}

/// FNV-1a over the pixels of every plate.
std::uint64_t fingerprint(Renderer& renderer) {
  std::uint64_t hash = 0xcbf29ce484222325u;
  for (const Picture& plate :
       {plates::pile(), plates::strobe(), plates::tower(), plates::fan(), plates::sunk()})
    for (const std::uint8_t byte : renderer.draw(plate, golden()).rgb)
      hash = (hash ^ byte) * 0x100000001b3u;
  return hash;
}

}  // namespace

TEST_CASE("a context of unknown kind is refused with the names of those there are") {
  CHECK_THROWS_WITH(makeContext("vulkan"), Catch::Matchers::Contains("vulkan") &&
                                               Catch::Matchers::Contains("osmesa") &&
                                               Catch::Matchers::Contains("egl"));
  setenv("TUMBLE_GL", "metal", 1);
  CHECK_THROWS_AS(makeContext(), NoContext);
  CHECK_NOTHROW(makeContext("osmesa"));  // a name wins over the environment
  unsetenv("TUMBLE_GL");
}

// Oracle: two window systems over one rasteriser agree to the bit, for every finish and every
// anti-aliasing.
TEST_CASE("OSMesa and EGL draw the same bytes") {
  std::vector<std::vector<Image>> images;
  for (const char* kind : {"osmesa", "egl"}) {
    const auto context = makeContext(kind);
    CHECK(context->name() == kind);
    Renderer renderer(*context, kShaders, kFonts);
    auto& of = images.emplace_back();
    for (const AntiAlias antialias : {AntiAlias::None, AntiAlias::Msaa4, AntiAlias::Ssaa2x2}) {
      RenderOptions options = golden();
      options.antialias = antialias;
      for (const Picture& plate :
           {plates::pile(), plates::strobe(), plates::tower(), plates::fan(), plates::sunk()})
        of.push_back(renderer.draw(plate, options));
    }
  }
  for (std::size_t i = 0; i < images[0].size(); ++i) CHECK(images[0][i] == images[1][i]);
}

TEST_CASE("print the fingerprint of all plates", "[.fingerprint]") {
  std::printf("%016llx\n", static_cast<unsigned long long>(fingerprint(studio())));
}

// Oracle: bit-equal rerun, in processes of their own.
TEST_CASE("one rasteriser thread and two draw the same bytes") {
  char here[32];
  std::snprintf(here, sizeof here, "%016llx",
                static_cast<unsigned long long>(fingerprint(studio())));
  for (const char* threads : {"1", "2"}) {
    const std::string text = output(std::string("LP_NUM_THREADS=") + threads + " '" +
                                    thisProgram() + "' '[.fingerprint]'");
    CHECK_THAT(text, Catch::Matchers::Contains(here));
  }
}

TEST_CASE("two contexts in turn do not disturb each other") {
  const auto first = makeContext("osmesa"), second = makeContext("egl");
  Renderer a(*first, kShaders, kFonts), b(*second, kShaders, kFonts);
  const Image before = a.draw(plates::sunk(), golden());
  CHECK(b.draw(plates::sunk(), golden()) == before);
  CHECK(a.draw(plates::sunk(), golden()) == before);
}

TEST_CASE("missing shaders and fonts are refused with their path") {
  const auto context = makeContext();
  CHECK_THROWS_WITH(Renderer(*context, "/nowhere", kFonts),
                    Catch::Matchers::Contains("/nowhere/body.vert"));
  CHECK_THROWS_WITH(Renderer(*context, kShaders, "/nowhere"),
                    Catch::Matchers::Contains("/nowhere/Lato-Regular.ttf") &&
                        Catch::Matchers::Contains("fonts-lato"));
}

TEST_CASE("an image without pixels, or with too many, is refused") {
  RenderOptions options;
  options.width = 0;
  CHECK_THROWS_AS(studio().draw(plates::sunk(), options), std::invalid_argument);
  options.width = 20000;
  CHECK_THROWS_AS(studio().draw(plates::sunk(), options), std::invalid_argument);
}
