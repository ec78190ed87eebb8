// Whatever bytes stand in a mesh file: a closed solid or a complaint, no third way.
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <string>

#include "app/scene/mesh_file.h"
#include "sim/body/mass_surface.h"

using namespace tumble;

namespace {

void need(bool holds) {
  if (!holds) std::abort();
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  try {
    const auto solid = parseMesh(std::string(data, data + size), "fuzz.obj");
    need(solid && solid->points.size() >= 4 && solid->faces.size() >= 4);
    for (const Vec3& point : solid->points) need(point.allFinite());
    for (const auto& face : solid->faces)
      for (const int corner : face)
        need(corner >= 0 && static_cast<std::size_t>(corner) < solid->points.size());
    need(integrate(*solid).volume > 0.0);
  } catch (const MeshError&) {
  }
  return 0;
}
