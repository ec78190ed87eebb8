// OpenGL in plain memory: works without a display, a graphics card or rights to either.
#include <glad/gl.h>
// glad first: it stands in for the header that osmesa.h would include
#include <GL/osmesa.h>

#include <array>
#include <cstdint>

#include "render/context/kinds.h"

namespace tumble {
namespace {

class OsmesaContext final : public Context {
 public:
  OsmesaContext() {
    chooseRasteriser();
    const int attributes[] = {OSMESA_FORMAT,
                              OSMESA_RGBA,
                              OSMESA_PROFILE,
                              OSMESA_CORE_PROFILE,
                              OSMESA_CONTEXT_MAJOR_VERSION,
                              3,
                              OSMESA_CONTEXT_MINOR_VERSION,
                              3,
                              0};
    context_ = OSMesaCreateContextAttribs(attributes, nullptr);
    if (!context_)
      throw NoContext("Mesa makes no OpenGL 3.3 core context; install libosmesa6 17 or newer");
    try {
      makeCurrent();
    } catch (...) {
      OSMesaDestroyContext(context_);
      throw;
    }
  }
  ~OsmesaContext() override {
    forgetFunctions(*this);
    OSMesaDestroyContext(context_);
  }
  std::string_view name() const override { return "osmesa"; }

  void makeCurrent() override {
    if (!OSMesaMakeCurrent(context_, pixels_.data(), GL_UNSIGNED_BYTE, kSize, kSize))
      throw NoContext("Mesa refuses to make its context current");
    loadFunctions(*this, OSMesaGetProcAddress);
  }

 private:
  // Pictures are drawn into a framebuffer object; this one only has to exist.
  static constexpr int kSize = 16;
  std::array<std::uint8_t, kSize * kSize * 4> pixels_{};
  OSMesaContext context_ = nullptr;
};

}  // namespace

std::unique_ptr<Context> makeOsmesaContext() {
  return std::make_unique<OsmesaContext>();
}

}  // namespace tumble
