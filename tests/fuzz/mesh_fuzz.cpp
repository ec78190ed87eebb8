// Whatever bytes stand in a mesh file: a closed solid or a complaint, no third way. Small solids
// are taken apart: into convex pieces that fill them, or not at all and with words.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <string>

#include "app/scene/mesh_file.h"
#include "sim/body/mass_surface.h"
#include "sim/shape/pieces.h"

using namespace tumble;

namespace {

void need(bool holds) {
  if (!holds) std::abort();
}

double areaOf(const Polyhedron& solid) {
  double area = 0.0;
  for (const auto& face : solid.faces) area += 0.5 * areaVector(solid, face).norm();
  return area;
}

// Each piece is convex, and together they are as large as the solid.
void needPieces(const Polyhedron& solid, const Pieces& pieces, double tolerance) {
  Vec3 lo = solid.points[0], hi = lo;
  for (const Vec3& p : solid.points) lo = lo.cwiseMin(p), hi = hi.cwiseMax(p);
  const double size = (hi - lo).norm(), slack = std::max(tolerance, 1e-9 * size);
  need(!pieces.hulls.empty() && pieces.hulls.size() <= kMostPieces);
  need(pieces.excess <= slack);
  double volume = 0.0, area = areaOf(solid);
  for (const Hull& hull : pieces.hulls) {
    const Polyhedron& piece = *hull.solid;
    for (std::size_t f = 0; f < piece.faces.size(); ++f)
      for (const Vec3& p : piece.points)
        need(piece.normals[f].dot(p - piece.points[static_cast<std::size_t>(piece.faces[f][0])]) <=
             1e-9 * size);
    volume += integrate(piece).volume;
    area += areaOf(piece);
  }
  need(std::abs(volume - integrate(solid).volume) <= 3.0 * slack * area);
}

// With a tolerance that the length of the text decides.
void takeApart(const Polyhedron& solid, std::size_t size) {
  constexpr std::size_t kFew = 60;  // faces; a hundred may take a minute under sanitizers
  if (solid.faces.size() > kFew) return;
  double reach = 0.0;
  for (const Vec3& p : solid.points) reach = std::max(reach, (p - solid.points[0]).norm());
  const double tolerance = reach * (size % 3 == 0 ? 0.0 : size % 3 == 1 ? 1e-6 : 0.03);
  try {
    needPieces(solid, piecesOf(solid, PieceKind::Good, tolerance), tolerance);
  } catch (const NoPieces& refusal) {
    need(!std::string(refusal.what()).empty());
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  try {
    const auto solid = parseMesh(std::string(data, data + size), "fuzz.obj").solid;
    need(solid && solid->points.size() >= 4 && solid->faces.size() >= 4);
    for (const Vec3& point : solid->points) need(point.allFinite());
    for (const auto& face : solid->faces)
      for (const int corner : face)
        need(corner >= 0 && static_cast<std::size_t>(corner) < solid->points.size());
    need(integrate(*solid).volume > 0.0);
    takeApart(*solid, size);
  } catch (const MeshError&) {
  }
  return 0;
}
