// What the commands leave in folders, and how they read their options.
#include <sys/stat.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <numeric>

#include "app/command/command.h"
#include "app/command/command_line.h"
#include "app/command/gallery_page.h"
#include "app/command/options.h"
#include "app/command/shoot.h"
#include "app/command/stamp.h"
#include "app/command/sweeping.h"
#include "app/command/video.h"
#include "app/file/file.h"
#include "tests/catch.h"
#include "tests/folder.h"

using namespace tumble;
using tumble::test::Folder;
namespace fs = std::filesystem;

namespace {

constexpr const char* kDrop = R"(
title = "Drop"
checks = ["bounce-apex"]
[world]
duration = 0.5
[materials.rubber]
density = 1000.0
restitution = 0.5
[[body]]
name = "floor"
shape = { plane = [0, 1, 0, 0] }
[[body]]
name = "ball"
shape = { sphere = 0.1 }
material = "rubber"
position = [0, 0.6, 0]
[image]
size = [64, 36]
rate = 8.0
[sweep]
parameter = "materials.rubber.restitution"
values = [0.1, 0.5, 0.9]
)";

std::vector<std::string> linesIn(const std::string& path) {
  std::vector<std::string> found;
  std::ifstream in(path);
  for (std::string line; std::getline(in, line);) found.push_back(line);
  return found;
}

}  // namespace

TEST_CASE("ranges, sizes and shards are read whole or refused with what is expected") {
  CHECK(parseFrames("0:60") == std::pair(0, 60));
  CHECK(parseSize("1280x720") == std::pair(1280, 720));
  CHECK(parseShard("2/8") == std::pair(2, 8));
  for (const char* text : {"9:3", "3:3", "-1:3", "3", "a:b", "1:2x", ":", "1:", "1:99999999999"})
    CHECK_THROWS_AS(parseFrames(text), UsageError);
  for (const char* text : {"1280", "1280x", "0x720", "15x720", "8193x720", "1280 x 720"})
    CHECK_THROWS_AS(parseSize(text), UsageError);
  for (const char* text : {"2/2", "-1/2", "1/0", "1:2"})
    CHECK_THROWS_AS(parseShard(text), UsageError);
}

TEST_CASE("a command line that makes no sense is refused in words of its own") {
  const auto refused = [](std::vector<std::string> words) {
    words.insert(words.begin(), "tumble draw");
    std::vector<char*> arguments;
    for (std::string& word : words) arguments.push_back(word.data());
    std::string scene, page;
    double still = 0.0;
    CommandLine line("draw", "Draws.", {"pile"});
    line.option("SCENE", scene, "a scene", {.required = true});
    line.option("--still", still, "an instant", {.type = "SECONDS"});
    line.option("--html", page, "a page", {.type = "FILE"});
    try {
      line.read(static_cast<int>(arguments.size()), arguments.data());
    } catch (const UsageError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  const std::string help = "; `tumble draw --help` shows how";
  CHECK(refused({"pile", "--still", "1"}).empty());
  CHECK(refused({"pile", "--stil", "1"}) ==
        "unknown option '--stil', did you mean '--still'?" + help);
  CHECK(refused({"pile", "--zzz"}) == "unknown option '--zzz'" + help);
  CHECK(refused({"pile", "heap"}) == "unexpected 'heap'" + help);
  CHECK(refused({"pile", "--html"}) == "--html: FILE is missing" + help);
  CHECK(refused({"pile", "--still", "x"}) == "--still: expected SECONDS, found 'x'" + help);
}

TEST_CASE("a finished image is kept, one of another scene, size or half-written is drawn anew") {
  const Folder folder;
  const std::string file = folder / "drop.toml";
  writeFile(file, kDrop);
  Studio studio;
  const auto draw = [&](const std::vector<std::string>& overrides, int width) {
    Scene scene = readScene(file, overrides);
    scene.image.width = width;
    Shoot shoot(scene, folder / "out", studio);
    std::vector<int> all(static_cast<std::size_t>(shoot.count()));
    std::iota(all.begin(), all.end(), 0);
    shoot.sequence(all);
    return shoot.recorded();
  };
  CHECK(draw({}, 64));
  CHECK(fs::exists(folder / "out/image-000000.png"));
  CHECK(fs::exists(folder / "out/image-000004.png"));
  CHECK_FALSE(fs::exists(folder / "out/image-000005.png"));
  // Everything is there: nothing is even simulated.
  CHECK_FALSE(draw({}, 64));
  // Another scene line, another size, another text in the file.
  CHECK(draw({"world.gravity=[0,-1.62,0]"}, 64));
  CHECK(draw({}, 64));
  CHECK(draw({}, 80));
  writeFile(file, std::string(kDrop) + "\n# a word more\n");
  CHECK(draw({}, 80));
  CHECK_FALSE(draw({}, 80));
  // An image that another build of the program drew.
  const std::string image = folder / "out/image-000003.png";
  const std::string bytes = readFile(image);
  Stamp foreign = readStamp(image);
  foreign.at("Program") = std::string(16, '0');
  writePng(image, readPng(image), foreign);
  CHECK(draw({}, 80));
  CHECK(readFile(image) == bytes);
  // An image that breaks off is not a finished one.
  std::ofstream(image, std::ios::binary) << bytes.substr(0, bytes.size() - 20);
  CHECK(readStamp(image).empty());
  CHECK(draw({}, 80));
  CHECK(readFile(image) == bytes);
}

TEST_CASE("an image carries version, scene line and what it shows") {
  const Folder folder;
  const Scene scene = parseScene(kDrop, "drop.toml", {"world.duration=0.25"});
  Studio studio;
  Shoot shoot(scene, folder / "out", studio);
  const Stamp stamp = readStamp(shoot.still(0.125));
  CHECK(stamp.at("Software").starts_with("tumble "));
  CHECK(stamp.at("Scene") == scene.line);
  CHECK(stamp.at("Scene").find("world.duration=0.25") != std::string::npos);
  CHECK(stamp.at("Image").find("64x36") != std::string::npos);
  CHECK(readStamp(folder / "none.png").empty());
}

TEST_CASE("the shards of a sweep write the rows of the whole") {
  const Folder folder;
  const std::string file = folder / "drop.toml";
  writeFile(file, kDrop);
  const SceneOptions options{file, {}};
  const Scene scene = load(options);
  Studio studio;
  const SweepResult whole = runSweep(scene, folder / "all", {0, 1}, studio);
  CHECK(whole.code == kOk);
  const std::vector<std::string> rows = linesIn(folder / "all/sweep.csv");
  REQUIRE(rows.size() == 4);
  CHECK(rows[2].starts_with("materials.rubber.restitution,0.5,"));
  const Image page = readPng(folder / "all/sweep.png");
  CHECK(page.width > 3 * 640);

  runSweep(scene, folder / "parts", {0, 2}, studio);
  runSweep(scene, folder / "parts", {1, 2}, studio);
  CHECK_FALSE(fs::exists(folder / "parts/sweep.png"));
  const std::vector<std::string> even = linesIn(folder / "parts/sweep-0-of-2.csv");
  const std::vector<std::string> odd = linesIn(folder / "parts/sweep-1-of-2.csv");
  REQUIRE(even.size() == 3);
  REQUIRE(odd.size() == 2);
  const auto value = [](const std::string& row) {
    return row.substr(0, row.find(",", row.find(",") + 1));
  };
  CHECK(value(even[1]) == value(rows[1]));
  CHECK(value(odd[1]) == value(rows[2]));
  CHECK(value(even[2]) == value(rows[3]));
  for (const int k : {0, 1, 2})
    CHECK(readPng(folder / ("parts/sweep-" + std::to_string(k) + "/strobe.png")) ==
          readPng(folder / ("all/sweep-" + std::to_string(k) + "/strobe.png")));
}

// Oracle: closed form, 0.6 − g t²/2 as it falls. Measured 2e-16, allowed 1e-12.
TEST_CASE("a sweep's table has what each claim of the scene's own measured and expected") {
  const Folder folder;
  writeFile(
      folder / "drop.toml",
      std::string(kDrop) +
          "[[expect]]\nvalue = \"2 * materials.rubber.restitution\"\nat_most = \"t\"\nwithin = 9\n"
          "[[expect]]\nlabel = \"height\"\nvalue = \"ball.y\"\nat = 0.125\nat_least = 0\n"
          "[[expect]]\nvalue = \"ball.z\"\nat = 0.25\nequals = 0\n");
  const Scene scene = readScene(folder / "drop.toml", {"world.duration=0.25", "image.rate=8"});
  Studio studio;
  runSweep(scene, folder / "all", {0, 1}, studio);
  const std::vector<std::string> rows = linesIn(folder / "all/sweep.csv");
  REQUIRE(rows.size() == 4);
  CHECK(
      rows[0].ends_with("worst_error_share,"
                        "\"2 * materials.rubber.restitution, at the end\","
                        "\"expected: 2 * materials.rubber.restitution, at the end\","
                        "\"height, at 0.125 s\",\"expected: height, at 0.125 s\","
                        "\"ball.z, at 0.25 s\",\"expected: ball.z, at 0.25 s\""));
  const double height = 0.6 - 0.5 * 9.81 * 0.125 * 0.125;
  for (std::size_t k = 0; k < 3; ++k) {
    std::istringstream cells(rows[k + 1]);
    std::vector<std::string> row;
    for (std::string cell; std::getline(cells, cell, ',');) row.push_back(cell);
    CAPTURE(rows[k + 1]);
    const std::size_t first = row.size() - 6;
    CHECK(std::stod(row[first]) == Approx(2.0 * std::vector{0.1, 0.5, 0.9}[k]));
    CHECK(std::stod(row[first + 1]) == 0.25);
    CHECK(std::stod(row[first + 2]) == Approx(height).epsilon(1e-12));
    CHECK(std::stod(row[first + 3]) == 0.0);
  }
}

// In place of ffmpeg a script that keeps its input, so that every byte handed over can be seen.
TEST_CASE("a film gets every pixel of its images, and is there only when it is complete") {
  const Folder folder;
  const std::string script = folder / "ffmpeg";
  writeFile(script,
            "#!/bin/sh\nfor last; do :; done\n[ -e \"$0.fails\" ] && exit 3\ncat > \"$last\"\n");
  ::chmod(script.c_str(), 0755);
  const std::string path = std::getenv("PATH");
  ::setenv("PATH", (folder.path.string() + ":" + path).c_str(), 1);

  Image image{4, 2, std::vector<std::uint8_t>(24)};
  for (std::size_t i = 0; i < 24; ++i) image.rgb[i] = static_cast<std::uint8_t>(7 * i);
  {
    Video video(folder / "film.mp4", 4, 2, 60.0);
    video.add(image);
    video.add(image);
    CHECK_FALSE(fs::exists(folder / "film.mp4"));
    video.finish();
  }
  const std::string once(image.rgb.begin(), image.rgb.end());
  CHECK(readFile(folder / "film.mp4") == once + once);

  // Left unfinished, or failed: nothing is left behind.
  { Video video(folder / "half.mp4", 4, 2, 60.0); }
  writeFile(script + ".fails", "");
  {
    Video video(folder / "broken.mp4", 4, 2, 60.0);
    CHECK_THROWS_AS(video.finish(), FileError);
  }
  ::setenv("PATH", (folder / "nowhere").c_str(), 1);
  CHECK_THROWS_AS(Video(folder / "none.mp4", 4, 2, 60.0), FileError);
  ::setenv("PATH", path.c_str(), 1);
  CHECK(std::distance(fs::directory_iterator(folder.path), {}) == 3);  // script, its switch, film
}

TEST_CASE("the gallery's page is one file that names every picture and escapes every text") {
  Exhibit exhibit;
  exhibit.scene.name = "drop";
  exhibit.scene.title = "a < b & \"c\"";
  exhibit.plates = {{"drop/strobe.png", "the whole motion"}, {"drop/panels.png", "panels", true}};
  exhibit.verdict.rows = {{"good", 1.0, 1.0, 0.0, 1e-6}, {"bad", 2.0, 1.0, 1.0, 1e-6}};
  exhibit.verdict.failed = 1;
  const std::string page = galleryPage({exhibit});
  CHECK(page.find("a &lt; b &amp; &quot;c&quot;") != std::string::npos);
  CHECK(page.find("<figure><button><img loading=\"lazy\" src=\"drop/strobe.png\"") !=
        std::string::npos);
  CHECK(page.find("<figure class=\"wide\"><button><img loading=\"lazy\" src=\"drop/panels.png\"") !=
        std::string::npos);
  CHECK(page.find("<tr class=\"failed\"><td>bad</td>") != std::string::npos);
  CHECK(page.find("<tr><td>good</td>") != std::string::npos);
  CHECK(page.find("http") == std::string::npos);
}

TEST_CASE("the gallery's page follows the lectures, links what it says and shows what is bounded") {
  Exhibit late, early;
  late.scene.name = "late";
  late.scene.chapter = "friction";
  early.scene.name = "early";
  early.scene.chapter = "collision";
  early.links = {{"early/page.html", "play it"}};
  early.scene.slides = {"Why so?", "SD10", "SD9"};
  late.scene.panels.resize(1);
  late.scene.panels[0].slides = {"SD9"};
  late.scene.panels[0].variant.title = "part";
  early.verdict.rows = {{"gap", 28.0, 5.0, 0.0, 0.0, false, Relation::AtLeast}};
  const std::string page = galleryPage({late, early});
  CHECK(page.find("<h2>collision</h2>") < page.find("<h2>friction</h2>"));
  CHECK(page.find("id=\"early\"") < page.find("id=\"late\""));
  CHECK(page.find("<a href=\"early/page.html\">play it</a>") != std::string::npos);
  CHECK(page.find("<td>≥ 5</td>") != std::string::npos);
  const std::size_t nine = page.find("<td>SD9</td>"), ten = page.find("<td>SD10</td>");
  CHECK((nine < ten && ten < page.find("<td>Why so?</td>")));
  CHECK(page.find("<a href=\"late/panels.png\">part</a>", nine) < ten);
  CHECK(page.find("<a href=\"early/still.png\">", ten) != std::string::npos);
}

TEST_CASE("a scene that asks for a check that is none is refused") {
  const Folder folder;
  writeFile(folder / "x.toml", kDrop);
  CHECK_THROWS_AS(load({folder / "x.toml", {"checks=[\"bounce-apexes\"]"}}), SceneError);
  CHECK_THROWS_AS(load({folder / "none.toml", {}}), FileError);
  CHECK_THROWS_AS(load({folder / "x.toml", {"no equals sign"}}), UsageError);
}
