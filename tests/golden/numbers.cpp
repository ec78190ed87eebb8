// Tables of numbers: what counts as the same.
#include "app/golden/numbers.h"

#include "tests/catch.h"

using tumble::compareNumbers;

TEST_CASE(
    "equal bytes are exact, and a number off by half of what is allowed passes without being "
    "exact") {
  const std::string expected = "t,x\n0,2\n1,-4\n";
  CHECK(compareNumbers(expected, expected).exact);
  const auto near = compareNumbers(expected, "t,x\n0,2.000000001\n1,-4\n");
  CHECK_FALSE(near.exact);
  CHECK(near.passes());
  CHECK(near.worst == Approx(0.5).epsilon(1e-3));  // 1e-9 off, 2e-9 + 1e-12 allowed
}

TEST_CASE(
    "a number off by more than 1e-9 of itself fails and is named by line, instant, body and "
    "column") {
  const auto far = compareNumbers("t,x\n0,2\n1,-4\n", "t,x\n0,2\n1,-4.00000001\n");
  CHECK_FALSE(far.passes());
  CHECK(far.where == "line 3 (t = 1), x: -4.00000001, expected -4");
  CHECK(compareNumbers("t,body,x\n1,ball,-4\n", "t,body,x\n1,ball,4\n").where ==
        "line 2 (t = 1, body = ball), x: 4, expected -4");
}

TEST_CASE("near zero the absolute part decides") {
  CHECK(compareNumbers("x\n0\n", "x\n1e-13\n").passes());
  CHECK_FALSE(compareNumbers("x\n0\n", "x\n1e-11\n").passes());
}

TEST_CASE("another shape, another word or no number at all never passes") {
  const std::string expected = "t,body\n0,ball\n";
  for (const std::string actual :
       {"", "t,body\n", "t,body\n0\n", "t,body\n0,box\n", "t,x\n0,ball\n", "t,body\nnan,ball\n",
        "t,body\n0,ball\n0,ball\n"}) {
    CAPTURE(actual);
    CHECK_FALSE(compareNumbers(expected, actual).passes());
  }
}

TEST_CASE("the worst line and column are told, and their curve is that of one body against time") {
  const std::string expected = "t,body,x,y\n0,a,1,5\n0,b,2,6\n1,a,3,7\n1,b,4,8\n";
  const std::string actual = "t,body,x,y\n0,a,1,5\n0,b,2,6\n1,a,3,7\n1,b,4,9\n";
  const auto difference = compareNumbers(expected, actual);
  CHECK(difference.line == 5);
  CHECK(difference.column == 4);
  const auto curve = tumble::columnOf(actual, difference.line, difference.column);
  CHECK(curve.x == std::vector<double>{0, 1});
  CHECK(curve.y == std::vector<double>{6, 9});
  CHECK(compareNumbers(expected, "t\n").line == 0);
  CHECK(tumble::columnOf(actual, 0, 0).x.empty());
}
