// Green's theorem twice against the same integrals in whole-number fractions.
#include "sim/body/mass_surface.h"

#include <boost/multiprecision/cpp_int.hpp>

#include "sim/body/mass_properties.h"
#include "tests/body/solids.h"
#include "tests/catch.h"

using namespace tumble;

namespace {

using Q = boost::multiprecision::cpp_rational;

struct Exact {
  double volume;
  Vec3 centre;
  Mat3 inertia;
};

/// The integrals over a polyhedron as a sum of tetrahedra with a corner at the origin, in exact
/// fractions of the points as they are stored:
///   ∫ 1 = D/6,  ∫ x = D/24 Σ x,  ∫ x y = D/120 (Σ x Σ y + Σ x y),  D = det(a b c).
/// Faces are cut as fans from their first corner; for a flat face every cut has the same sum.
Exact exactIntegrals(const std::vector<Vec3>& points, const std::vector<std::vector<int>>& faces) {
  Q volume = 0, first[3] = {0, 0, 0}, second[3][3] = {};
  const auto coordinates = [&](int i) {
    const Vec3& p = points[static_cast<std::size_t>(i)];
    return std::array<Q, 3>{Q(p.x()), Q(p.y()), Q(p.z())};
  };
  for (const std::vector<int>& face : faces)
    for (std::size_t k = 1; k + 1 < face.size(); ++k) {
      const std::array<Q, 3> a = coordinates(face[0]), b = coordinates(face[k]),
                             c = coordinates(face[k + 1]);
      const Q D = a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) +
                  a[2] * (b[0] * c[1] - b[1] * c[0]);
      volume += D / 6;
      for (int i = 0; i < 3; ++i) {
        first[i] += D / 24 * (a[i] + b[i] + c[i]);
        for (int j = 0; j < 3; ++j)
          second[i][j] += D / 120 *
                          ((a[i] + b[i] + c[i]) * (a[j] + b[j] + c[j]) + a[i] * a[j] + b[i] * b[j] +
                           c[i] * c[j]);
      }
    }
  Exact exact;
  exact.volume = volume.convert_to<double>();
  Q about[3][3];
  for (int i = 0; i < 3; ++i) {
    exact.centre[i] = Q(first[i] / volume).convert_to<double>();
    for (int j = 0; j < 3; ++j) about[i][j] = second[i][j] - first[i] * first[j] / volume;
  }
  const Q trace = about[0][0] + about[1][1] + about[2][2];
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      exact.inertia(i, j) = Q((i == j ? trace : Q(0)) - about[i][j]).convert_to<double>();
  return exact;
}

/// Largest error of volume, centre and inertia, relative to volume, size and inertia.
double errorOf(const solids::Raw& raw) {
  const Polyhedron solid = raw.made();
  const VolumeIntegrals found = integrate(solid);
  const Exact exact = exactIntegrals(raw.points, solid.faces);
  double size = 0.0;
  for (const Vec3& p : solid.points) size = std::max(size, p.norm());
  const Vec3 centre = exactIntegrals(solid.points, solid.faces).centre;
  return std::max({std::abs(found.volume / exact.volume - 1.0),
                   (found.centre - centre).norm() / size,
                   (found.inertia - exact.inertia).norm() / exact.inertia.norm()});
}

struct Named {
  const char* name;
  solids::Raw raw;
};

std::vector<Named> all() {
  const Quat tilt(Eigen::AngleAxisd(0.7, Vec3(1.0, 2.0, -0.5).normalized()));
  return {{"cube", solids::box(Vec3::Zero(), Vec3::Ones())},
          {"tetrahedron", solids::tetrahedron()},
          {"L of three cubes", solids::ell()},
          {"dumbbell", solids::dumbbell()},
          {"dumbbell, tilted", solids::turned(solids::dumbbell(), tilt)},
          {"torus, 48 x 24", solids::torus(1.0, 0.3, 48, 24)}};
}

}  // namespace

// Oracle: exact rationals on the stored points. Allowed 1e-13; measured below.
TEST_CASE("mass properties of polyhedra are exact, wherever their points stand", "[figures]") {
  for (const auto& [name, raw] : all()) {
    const double here = errorOf(raw);
    const double far = errorOf(solids::moved(raw, Vec3(1e6, -1e6, 1e6)));
    WARN(name << ": error of volume, centre and inertia " << here << "; moved by 1e6 m " << far);
    CHECK(here < 1e-13);
    CHECK(far < 1e-13);
  }
}
