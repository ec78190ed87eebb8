#include "render/context/context.h"

#include <glad/gl.h>

#include <array>
#include <cstdlib>
#include <cstring>

#include "render/context/kinds.h"

namespace tumble {
namespace {

constexpr std::array<ContextKind, 2> kKinds = {{
    {"osmesa", "Mesa's own memory, no window system", makeOsmesaContext},
    {"egl", "EGL without a surface or display server", makeEglContext},
}};

/// Whose functions glad holds. Two drivers in one process have different ones.
const Context* loadedBy = nullptr;

std::string glString(GLenum name) {
  const GLubyte* text = glGetString(name);
  return text ? reinterpret_cast<const char*>(text) : "unknown";
}

std::string namesOfKinds() {
  std::string names;
  for (const ContextKind& kind : kKinds)
    names += (names.empty() ? "" : ", ") + std::string(kind.name);
  return names;
}

}  // namespace

std::string Context::renderer() const {
  return glString(GL_RENDERER);
}
std::string Context::version() const {
  return glString(GL_VERSION);
}

std::span<const ContextKind> contextKinds() {
  return kKinds;
}

std::unique_ptr<Context> makeContext(std::string_view kind) {
  if (kind.empty()) {
    if (const char* wish = std::getenv("TUMBLE_GL")) kind = wish;
  }
  std::string failures;
  for (const ContextKind& row : kKinds) {
    if (!kind.empty() && kind != row.name) continue;
    try {
      return row.make();
    } catch (const NoContext& reason) {
      failures += std::string("\n  ") + std::string(row.name) + ": " + reason.what();
    }
  }
  if (failures.empty())
    throw NoContext("no OpenGL context of kind \"" + std::string(kind) + "\"; there is " +
                    namesOfKinds());
  throw NoContext("no OpenGL 3.3 context could be made:" + failures);
}

void chooseRasteriser() {
  setenv("GALLIUM_DRIVER", "llvmpipe", 0);
  const char* width = std::getenv("LP_NATIVE_VECTOR_WIDTH");
  if (width && std::strcmp(width, "512") == 0) setenv("LP_NATIVE_VECTOR_WIDTH", "256", 1);
}

void loadFunctions(const Context& owner, FindFunction find) {
  if (loadedBy == &owner) return;
  loadedBy = nullptr;
  const int version = gladLoadGL(reinterpret_cast<GLADloadfunc>(find));
  if (version < GLAD_MAKE_VERSION(3, 3)) throw NoContext("the driver offers less than OpenGL 3.3");
  loadedBy = &owner;
}

void forgetFunctions(const Context& owner) {
  if (loadedBy == &owner) loadedBy = nullptr;
}

}  // namespace tumble
