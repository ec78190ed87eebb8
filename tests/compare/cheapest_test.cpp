// The comparison with other engines, on points made up so that the answer is known.
#include "tests/peers/cheapest.h"

#include "tests/catch.h"
#include "tests/peers/table.h"

using namespace tumble;
using namespace tumble::peers;

namespace {

Point point(const std::string& engine, const std::string& setting, double rate, double error,
            double cost) {
  return {"slide", engine, setting, setting == "default" || setting == "auto",
          false,   rate,   error,   {cost, cost}};
}

}  // namespace

TEST_CASE("a step that is exact by luck counts with the error of the next finer one") {
  const std::vector<Point> points =
      settled({point("ODE", "a", 60, 1e-5, 1.0), point("ODE", "a", 120, 1e-3, 2.0),
               point("ODE", "a", 240, 5e-4, 4.0), point("ODE", "b", 480, 0.0, 8.0)});
  CHECK(points[0].error == 1e-3);
  CHECK(points[1].error == 1e-3);
  CHECK(points[2].error == 5e-4);
  CHECK(points[3].error == kRounding);
}

TEST_CASE("the front keeps what nothing cheaper is as exact as") {
  const std::vector<Point> kept =
      front(std::vector{point("A", "x", 60, 1e-1, 1.0), point("A", "x", 120, 1e-2, 2.0),
                        point("B", "x", 60, 1e-2, 3.0), point("B", "x", 120, 1e-3, 2.5)});
  REQUIRE(kept.size() == 3);
  CHECK(kept[0].error == 1e-1);
  CHECK(kept[1].engine == "A");
  CHECK(kept[2].error == 1e-3);
}

TEST_CASE("at each error of the peers' front the cheapest of ours meets it") {
  const std::vector<Point> points = {
      point("tumble", "auto", 60, 1e-6, 2.0),   point("tumble", "fast", 60, 1e-1, 0.5),
      point("Bullet", "default", 60, 0.2, 1.0), point("Bullet", "tuned", 60, 1e-2, 3.0),
      point("ODE", "default", 60, 1e-2, 6.0),   point("ODE", "hard", 60, 1e-9, 9.0)};
  const std::vector<Duel> all = duels(points);
  REQUIRE(all.size() == 3);
  CHECK(all[0].defaultRatio.middle == 0.5);  // 1 over 2
  CHECK(all[0].bestRatio.middle == 2.0);     // 1 over 0.5
  CHECK(all[0].atBest->setting == "fast");
  CHECK(all[1].peer.engine == "Bullet");
  CHECK(all[1].defaultRatio.middle == 1.5);
  CHECK(!all[2].byDefault);
  CHECK(verdict(all[0].byDefault, all[0].defaultRatio) == Verdict::Lost);
  CHECK(verdict(all[1].byDefault, all[1].defaultRatio) == Verdict::Won);
  CHECK(verdict(all[2].byDefault, all[2].defaultRatio) == Verdict::Lost);
}

// Oracle: of one repeat each the interval is a point; of two sets that lie apart it holds the ratio
// of any two.
TEST_CASE("an interval holds the ratio and stays within those of single repeats") {
  const std::vector<double> a = {4.0, 5.0, 6.0, 5.0, 4.5}, b = {1.0, 2.0, 1.5, 1.0, 1.2};
  const Ratio ratio = costRatio(a, b);
  CHECK(ratio.middle == 5.0 / 1.2);
  CHECK(ratio.low >= 2.0);
  CHECK(ratio.high <= 6.0);
  CHECK(ratio.low < ratio.high);
}

TEST_CASE("a ratio whose interval holds 1 is even") {
  const std::vector<double> noisy = {1.0, 2.0, 3.0, 2.0}, other = {2.0, 1.0, 3.0, 2.0};
  CHECK(verdict(point("tumble", "auto", 60, 1.0, 1.0), costRatio(noisy, other)) == Verdict::Even);
}

TEST_CASE("scenes that are lost stand first, recorded rows take no part") {
  std::vector<Point> points = {point("tumble", "auto", 60, 1e-6, 1.0),
                               point("ODE", "default", 60, 1e-3, 5.0)};
  Point recorded = point("Jolt", "tuned", 60, 1e-3, 0.1);
  recorded.recorded = true;
  points.push_back(recorded);
  for (Point lost :
       {point("tumble", "auto", 60, 1e-6, 9.0), point("ODE", "default", 60, 1e-3, 5.0)}) {
    lost.scene = "roll";
    points.push_back(lost);
  }
  const std::vector<Outcome> all = outcomes(points);
  REQUIRE(all.size() == 2);
  CHECK(all[0].scene == "roll");
  CHECK(all[0].lostByDefault == 1);
  CHECK(all[1].duels.front().peer.engine == "ODE");
  const auto rows = tableCells(all);
  CHECK(rows[1][0] == "roll");
  CHECK(rows[1][4] == "0.56 [0.56, 0.56] lost");
  CHECK(rows[2][4] == "5 [5, 5] won");
}

TEST_CASE("points come back from their file, but for recorded ones") {
  std::vector<Point> points = {point("tumble", "auto", 60, 1e-6, 1.5),
                               point("Bullet", "tuned, 200", 240, 2.5e-3, 0.25)};
  points.push_back(points.back());
  points.back().recorded = true;
  const std::vector<Point> back = readPoints(pointsCsv(points));
  REQUIRE(back.size() == 2);
  CHECK(back[0].asItComes);
  CHECK(back[1].setting == "tuned, 200");
  CHECK(back[1].rate == 240.0);
  CHECK(back[1].costs == std::vector{0.25, 0.25});
}
