// Ground of gentle hills, closed into a solid, in few digits.
#include <cmath>

#include "sim/shape/join.h"
#include "sim/shape/pieces.h"
#include "tests/body/notched.h"
#include "tests/catch.h"

using namespace tumble;

namespace {

/// Hills over n by n squares of a side of 1 m, each two triangles, on a skirt of squares and a
/// bottom of one face.
solids::Raw hills(int n, double height) {
  solids::Raw raw;
  const auto above = [&](double x, double y) {
    return height * (std::sin(5 * x + 1) * std::cos(4 * y + 2) + 0.5 * std::sin(9 * x + 7 * y));
  };
  const auto at = [&](int i, int j) { return j * (n + 1) + i; };
  for (int j = 0; j <= n; ++j)
    for (int i = 0; i <= n; ++i) {
      const double x = static_cast<double>(i) / n, y = static_cast<double>(j) / n;
      raw.points.emplace_back(x, y, above(x, y));
    }
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i) {
      raw.faces.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
      raw.faces.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
    }
  std::vector<int> rim, bottom;
  for (int i = 0; i < n; ++i) rim.push_back(at(i, 0));
  for (int i = 0; i < n; ++i) rim.push_back(at(n, i));
  for (int i = n; i > 0; --i) rim.push_back(at(i, n));
  for (int i = n; i > 0; --i) rim.push_back(at(0, i));
  const int low = static_cast<int>(raw.points.size()), count = 4 * n;
  for (int k = 0; k < count; ++k) {
    const int l = (k + 1) % count, from = rim[static_cast<std::size_t>(k)],
              to = rim[static_cast<std::size_t>(l)];
    const Vec3 p = raw.points[static_cast<std::size_t>(from)];
    raw.points.emplace_back(p.x(), p.y(), -0.2);
    raw.faces.push_back({low + k, low + l, to, from});
    bottom.push_back(low + count - 1 - k);
  }
  raw.faces.push_back(bottom);
  return raw;
}

}  // namespace

// Oracle: volume of the mesh; by construction, a piece under each triangle or fewer. Hulls are off
// by no more than the tolerance or six of the last digit allow all over a surface of 2.8 m² and the
// cuts.
TEST_CASE("hills of few digits come apart, however they are turned", "[figures]") {
  const Quat ways[] = {Quat::Identity(), Quat(Eigen::AngleAxisd(0.7, Vec3(1, 2, 3).normalized())),
                       Quat(Eigen::AngleAxisd(2.1, Vec3(3, -1, 0.5).normalized()))};
  for (const double height : {0.005, 0.03})
    for (const Quat& way : ways)
      for (const double grain : {1e-4, 1e-5, 1e-6, 1e-8, 0.0}) {
        solids::Raw raw = turned(hills(9, height), way);
        if (grain > 0.0)
          for (Vec3& p : raw.points) p = grain * (p / grain).array().round().matrix();
        CAPTURE(height, way, grain);
        const Polyhedron solid = raw.made();
        constexpr double kTolerance = 7e-7;
        const Pieces pieces = piecesOf(solid, PieceKind::Good, kTolerance, grain);
        const double allowed = std::max(kTolerance, kRoughPieces * grain);
        CHECK(pieces.hulls.size() <= 162);
        CHECK(pieces.excess <= allowed);
        double volume = 0.0;
        for (const Hull& hull : pieces.hulls) volume += volumeOf(*hull.solid);
        CHECK(volume == Approx(volumeOf(solid)).margin(2.8 * allowed));
        if (&way == &ways[1])
          WARN("hills " << height << " m high, rounded to " << grain << " m: measured "
                        << pieces.hulls.size() << " pieces, " << pieces.excess << " m out, "
                        << volume - volumeOf(solid) << " m³ more");
      }
}
