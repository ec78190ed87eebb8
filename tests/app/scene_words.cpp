// The nearest name to a word that was mistyped, and foreign text in messages.
#include "app/scene/findings.h"
#include "tests/catch.h"

using namespace tumble;

TEST_CASE("one slip of any kind is forgiven, a swap of neighbours too") {
  const std::vector<std::string> names = {"mass", "material", "friction", "colour"};
  CHECK(nearestName("mas", names) == "mass");
  CHECK(nearestName("masss", names) == "mass");
  CHECK(nearestName("mess", names) == "mass");
  CHECK(nearestName("msas", names) == "mass");
  CHECK(nearestName("color", names) == "colour");
  CHECK(nearestName("frcition", names) == "friction");
}

TEST_CASE("a word far from all names gets no advice, a beginning of one does") {
  const std::vector<std::string> names = {"stiffness", "damping", "rest"};
  CHECK(nearestName("qqqq", names).empty());
  CHECK(nearestName("", names).empty());
  CHECK(nearestName("sti", names) == "stiffness");
  CHECK(nearestName(std::string(100'000, 'x'), names).empty());
  CHECK(hint("qqqq", names) == "; valid: stiffness, damping, rest");
  CHECK(hint("dampin", names) == ", did you mean 'damping'? Valid: stiffness, damping, rest");
}

TEST_CASE("a single letter is near no other name, unless it begins just one") {
  CHECK(nearestName("q", {"x", "y", "vx"}).empty());
  CHECK(nearestName("", {"x"}).empty());
  CHECK(nearestName("x", {"y", "x"}) == "x");
  CHECK(nearestName("s", {"vx", "spin"}) == "spin");
  CHECK(nearestName("vq", {"x", "vx"}) == "vx");
}

TEST_CASE("the first of two equally near names is taken") {
  CHECK(nearestName("ba", {"bar", "bat"}) == "bar");
}

TEST_CASE("foreign text in a message is printable, whole in its letters and short") {
  CHECK(inQuotes("plain") == "'plain'");
  CHECK(inQuotes("a\x1b[31mb\n") == "'a?[31mb?'");
  CHECK(inQuotes("1 µm – π 😀") == "'1 µm – π 😀'");
  // No UTF-8: a byte alone, one cut off, too long, half a pair, beyond the last; a control as two.
  CHECK(inQuotes("\xff\xfe v") == "'?? v'");
  CHECK(inQuotes("a\xc3") == "'a?'");
  CHECK(inQuotes("\xe0\x80\x80\xc0\x80") == "'" + std::string(5, '?') + "'");
  CHECK(inQuotes("\xed\xa0\x80|\xf4\x90\x80\x80") == "'???|" + std::string(4, '?') + "'");
  CHECK(inQuotes("\xc2\x9b"
                 "31m") == "'??31m'");
  CHECK(inQuotes(std::string("\0\0", 2)) == "'" + std::string(2, '?') + "'");
  CHECK(inQuotes(std::string(100, 'x')) == "'" + std::string(60, 'x') + "…'");
  CHECK(inQuotes(std::string(59, 'x') + "é" + std::string(9, 'y')) ==
        "'" + std::string(59, 'x') + "…'");
}
