// What bends in the colours of its strain.
#include <numeric>

#include "app/present/bands.h"
#include "app/present/bent.h"
#include "app/present/present.h"
#include "tests/catch.h"

using namespace tumble;

namespace {

double areaOf(const Facets& facets) {
  double area = 0.0;
  for (std::size_t n = 0; n + 2 < facets.corners.size(); n += 3) {
    const auto at = [&](std::size_t k) { return facets.corners[n + k].position; };
    area += 0.5 * (at(1) - at(0)).cross(at(2) - at(0)).norm();
  }
  return area;
}

const std::string kStrip =
    "[world]\ngravity = [0, 0, 0]\nduration = 0.1\n[show]\nstrain = true\n"
    "[[cloth]]\nname = \"c\"\ncolumns = 3\nrows = 2\nsize = [0.2, 0.1]\npins = [[0, 0], [0, 1]]\n";

}  // namespace

// Oracle: closed form: of a triangle, the part where a linear quantity is below a share u of its
// way from one corner to the side opposite is 1 − (1 − u)². In single precision: allowed 1e-6.
TEST_CASE("a surface is cut where a quantity passes from one band to the next") {
  Facets triangle;
  for (const Eigen::Vector3f& p :
       {Eigen::Vector3f(0, 0, 0), Eigen::Vector3f(2, 0, 0), Eigen::Vector3f(0, 1, 0)})
    triangle.corners.push_back({p, Eigen::Vector3f::UnitZ(), Eigen::Vector3f::Constant(1e9f)});
  const std::vector<double> values = {1.0, 0.0, 1.0};
  const std::vector<Facets> bands = inBands(triangle, values, 1.0, 4);
  REQUIRE(bands.size() == 4);
  for (int k = 0; k < 4; ++k) {
    const double low = 0.25 * k, high = 0.25 * (k + 1);
    CHECK(areaOf(bands[k]) == Approx(high * high - low * low).epsilon(1e-6));
    for (const Facets::Corner& corner : bands[k].corners) {
      CHECK(1.0 - 0.5 * corner.position.x() >= low - 1e-6);
      CHECK(1.0 - 0.5 * corner.position.x() <= high + 1e-6);
    }
  }
  // What is beyond the scale has its last colour.
  const std::vector<double> beyond = {3.0, 3.0, 3.0};
  CHECK(inBands(triangle, beyond, 1.0, 4)[3].corners.size() == 3);
}

// Oracle: the definition, l/l₀ − 1, of one row of threads that is 20 % longer.
TEST_CASE("points of a cloth have the strain of their threads, and a legend says what is shown") {
  const Scene scene = parseScene(kStrip, "s.toml");
  Recording recording = record(scene, 60.0);
  Sample& last = recording.samples.back();
  for (const int p : {2, 5}) last.bodies[p].x.x() += 0.02;
  const std::vector<double> strains = strainsAt(scene, scene.bent[0], last);
  const double expected[] = {0.0, 0.2, 0.2, 0.0, 0.2, 0.2};
  for (int p = 0; p < 6; ++p) CHECK(strains[p] == Approx(expected[p]).margin(1e-12));
  const Presenter presenter(scene, recording);
  const Picture picture = presenter.image(presenter.count() - 1);
  REQUIRE(picture.bar);
  CHECK(picture.bar->caption == "strain / %");
  CHECK(picture.bar->to == Approx(20.0));
  CHECK(picture.instances.size() > 2);
}

TEST_CASE("a scene in which nothing strains has no legend of strain") {
  const Scene scene = parseScene(kStrip, "s.toml");
  const Recording recording = record(scene, 60.0);
  CHECK_FALSE(Presenter(scene, recording).image(0).bar);
}
