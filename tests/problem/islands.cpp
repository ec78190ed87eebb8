// Islands: what hangs together, and that it is solved as if it were alone.
#include "tests/catch.h"
#include "tests/problem/problems.h"

using namespace tumble;
using namespace tumble::test;

namespace {

/// Two problems side by side; body 0 of both is the same floor. Cones are dealt in turn.
Problem beside(const Problem& one, const Problem& other) {
  Problem both = one;
  const int shift = static_cast<int>(one.invM.size()) - 1;
  for (std::size_t i = 1; i < other.invM.size(); ++i) {
    both.invM.push_back(other.invM[i]);
    both.Iinv.push_back(other.Iinv[i]);
    both.vStar.push_back(other.vStar[i]);
  }
  const int rows = static_cast<int>(both.rows.size());
  for (Row row : other.rows) {
    if (row.a > 0) row.a += shift;
    if (row.b > 0) row.b += shift;
    both.rows.push_back(row);
  }
  both.cones.clear();
  for (std::size_t c = 0; c < std::max(one.cones.size(), other.cones.size()); ++c) {
    if (c < one.cones.size()) both.cones.push_back(one.cones[c]);
    if (c >= other.cones.size()) continue;
    both.cones.push_back(other.cones[c]);
    both.cones.back().row += rows;
  }
  return both;
}

}  // namespace

TEST_CASE("the floor does not join what stands on it") {
  const Problem both = beside(tower({1.0, 2.0}, 0.5), tower({3.0}, 0.5));
  const std::vector<std::vector<int>> expected = {{0, 2, 4, 6, 8, 9, 10, 11}, {1, 3, 5, 7}};
  CHECK(islands(both) == expected);
}

TEST_CASE("a contact belongs to the body that moves, whichever side of it the floor is on") {
  Problem both = beside(tower({1.0}, 0.0), tower({3.0}, 0.0));
  addContact(both, 0, 2, Vec3::Zero(), Vec3::Zero(), 0.0);
  addContact(both, 0, 0, Vec3::Zero(), Vec3::Zero(), 0.0);
  const std::vector<std::vector<int>> expected = {{0, 2, 4, 6}, {1, 3, 5, 7, 8}, {9}};
  CHECK(islands(both) == expected);
}

TEST_CASE("a row between two towers makes one island of them") {
  Problem both = beside(tower({1.0, 2.0}, 0.0), tower({3.0}, 0.0));
  addContact(both, 3, 1, Vec3::Zero(), Vec3::Zero(), 0.0);
  REQUIRE(islands(both).size() == 1);
  CHECK(islands(both)[0].size() == both.cones.size());
}

// Oracle: bit-equal.
TEST_CASE("an island moves the same, to the last bit, whatever else there is") {
  Problem one = tower({1.0, 2.0, 0.7}, 0.4), other = tower({3.0, 1.0}, 0.4);
  one.vStar[2][0] = 6.0;
  other.vStar[1][2] = -2.0;
  const Problem both = beside(one, other);
  for (const Solver& solver : solvers()) {
    Solution alone, together;
    solveByIslands(solver, one, {}, alone);
    solveByIslands(solver, both, {}, together);
    CAPTURE(solver.name);
    for (std::size_t i = 0; i < one.invM.size(); ++i) CHECK(alone.v[i] == together.v[i]);
    for (std::size_t i = 0; i < one.rows.size(); ++i) CHECK(alone.lambda[i] == together.lambda[i]);
    solveByIslands(solver, other, {}, alone);
    for (std::size_t i = 1; i < other.invM.size(); ++i)
      CHECK(alone.v[i] == together.v[i + one.invM.size() - 1]);
  }
}

TEST_CASE("a body that nothing touches keeps its motion") {
  Problem problem = tower({1.0}, 0.0);
  addCube(problem, 5.0, 1.0, Vec3(1.0, 2.0, 3.0), Vec3(4.0, 5.0, 6.0));
  Solution solution;
  solveByIslands(solvers()[0], problem, {}, solution);
  CHECK(solution.v[2] == problem.vStar[2]);
}
