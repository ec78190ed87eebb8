// OpenGL by EGL on Mesa's surfaceless platform: needs neither X nor Wayland.
#define EGL_NO_X11
#define MESA_EGL_NO_X11_HEADERS
#include <EGL/egl.h>
#include <EGL/eglext.h>

#include <cstdio>

#include "render/context/kinds.h"

namespace tumble {
namespace {

std::string reason(const char* what) {
  char code[16];
  std::snprintf(code, sizeof code, "0x%04x", static_cast<unsigned>(eglGetError()));
  return std::string(what) + " failed (EGL error " + code +
         "); install libegl1 and libgl1-mesa-dri";
}

EGLDisplay openDisplay() {
  const auto open = reinterpret_cast<PFNEGLGETPLATFORMDISPLAYEXTPROC>(
      eglGetProcAddress("eglGetPlatformDisplayEXT"));
  if (!open) throw NoContext(reason("finding eglGetPlatformDisplayEXT"));
  EGLDisplay display = open(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr);
  if (display == EGL_NO_DISPLAY || !eglInitialize(display, nullptr, nullptr))
    throw NoContext(reason("opening the surfaceless display"));
  return display;
}

EGLContext openContext(EGLDisplay display) {
  const EGLint wanted[] = {EGL_RENDERABLE_TYPE, EGL_OPENGL_BIT, EGL_SURFACE_TYPE, 0, EGL_NONE};
  EGLConfig config = nullptr;
  EGLint count = 0;
  if (!eglBindAPI(EGL_OPENGL_API) || !eglChooseConfig(display, wanted, &config, 1, &count) ||
      count == 0)
    throw NoContext(reason("choosing a configuration for OpenGL"));
  const EGLint attributes[] = {EGL_CONTEXT_MAJOR_VERSION,
                               3,
                               EGL_CONTEXT_MINOR_VERSION,
                               3,
                               EGL_CONTEXT_OPENGL_PROFILE_MASK,
                               EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
                               EGL_NONE};
  EGLContext context = eglCreateContext(display, config, EGL_NO_CONTEXT, attributes);
  if (context == EGL_NO_CONTEXT) throw NoContext(reason("making an OpenGL 3.3 core context"));
  return context;
}

/// The display is shared by the process and stays open until it ends.
class EglContext final : public Context {
 public:
  EglContext() {
    chooseRasteriser();
    display_ = openDisplay();
    context_ = openContext(display_);
    try {
      makeCurrent();
    } catch (...) {
      eglDestroyContext(display_, context_);
      throw;
    }
  }
  ~EglContext() override {
    forgetFunctions(*this);
    eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
    eglDestroyContext(display_, context_);
  }
  std::string_view name() const override { return "egl"; }

  void makeCurrent() override {
    if (!eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, context_))
      throw NoContext(reason("making the context current"));
    loadFunctions(*this, eglGetProcAddress);
  }

 private:
  EGLDisplay display_ = EGL_NO_DISPLAY;
  EGLContext context_ = EGL_NO_CONTEXT;
};

}  // namespace

std::unique_ptr<Context> makeEglContext() {
  return std::make_unique<EglContext>();
}

}  // namespace tumble
