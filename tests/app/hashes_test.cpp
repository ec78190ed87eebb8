// The bits of a run in a few numbers, and the file of them.
#include "app/file/file.h"
#include "tests/app/run_hashes.h"
#include "tests/catch.h"

using namespace tumble;

namespace {

constexpr const char* kThree = R"(
[world]
duration = 0.5
[[body]]
name = "floor"
shape = { plane = [0, 1, 0, 0] }
[[body]]
name = "low"
shape = { sphere = 0.1 }
mass = 1.0
position = [0.0, 0.1, 0.0]
[[body]]
name = "high"
shape = { sphere = 0.1 }
mass = 1.0
position = [1.0, 0.3, 0.0]
)";

// What reading the text says, after the name of the file.
std::string hashesRefusal(const std::string& text, const Scene& scene) {
  try {
    readHashes(text, "h", scene);
  } catch (const FileError& error) {
    return error.what();
  }
  return "";
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  return text.replace(text.find(from), from.size(), to);
}

}  // namespace

// Oracle: FNV-1a from its published constants over Python's struct.pack("<13d", …).
TEST_CASE("a state's hash is that of its little-endian numbers, for -0 as for 0 and -q as for q") {
  Sample alone;
  alone.bodies.resize(1);
  alone.bodies[0].x = {1.0, 2.0, -3.0};
  CHECK(hashOf(alone).state == 0xf7bff79af5b71d2du);
  CHECK(hashOf(alone).place == 0xf7bff79af5b71d2du);

  const Scene scene = parseScene(kThree, "three");
  Sample sample = makeWorld(scene).sample(0.0);
  const SampleHash before = hashOf(sample);

  Sample same = sample;
  same.bodies[2].v.x() = -0.0;
  same.bodies[2].q.coeffs() = -same.bodies[2].q.coeffs();
  CHECK(hashOf(same).state == before.state);

  // Every number counts, to its last bit.
  for (int part = 0; part < 13; ++part) {  // x, v, ω, q
    Sample other = sample;
    BodySample& body = other.bodies[2];
    double& number = part < 3    ? body.x[part]
                     : part < 6  ? body.v[part - 3]
                     : part < 9  ? body.omega[part - 6]
                     : part < 12 ? body.q.coeffs()[part - 9]
                                 : body.q.w();
    number = std::nextafter(number, 7.0);
    CAPTURE(part);
    CHECK(hashOf(other).state != before.state);
  }
  // Two bodies that change places are told apart.
  std::swap(sample.bodies[1], sample.bodies[2]);
  CHECK(hashOf(sample).place != before.place);
}

TEST_CASE("two runs part where their bits first do: time, and the body if it is one alone") {
  Scene scene = parseScene(kThree, "three");
  const RunHashes expected = test::hashesOf(scene);
  CHECK_FALSE(firstDifference(expected, test::hashesOf(scene), scene));

  // Only "high" is pushed by the last bit of its velocity; it lands on the floor at 0.2 s.
  Scene other = scene;
  other.world.bodies[2].velocity.z() = 1e-16;
  CHECK(firstDifference(expected, test::hashesOf(other), scene) ==
        "t = 0 s: 'high' is in another state, and it alone");
  other.world.bodies[1].velocity.x() = 1e-16;
  CHECK(firstDifference(expected, test::hashesOf(other), scene) ==
        "t = 0 s: several bodies are in other states");

  RunHashes later = expected;
  later.samples[3].forces ^= 1;
  CHECK(firstDifference(expected, later, scene)->starts_with("t = 0.3 s: contacts or forces"));
  later = expected;
  later.events ^= 1;
  CHECK(firstDifference(expected, later, scene)->starts_with("samples are the same"));
  later = expected;
  later.samples.pop_back();
  CHECK(firstDifference(expected, later, scene) == "the run has 5 samples, expected 6");
}

TEST_CASE("a file of hashes comes back as it was written, at a rate that no decimal hits") {
  Scene scene = parseScene(kThree, "a name with spaces");
  const RunHashes hashes = test::hashesOf(scene, 7.0 / 3.0);
  const RunHashes back = readHashes(hashText(hashes), "h", scene);
  CHECK_FALSE(firstDifference(hashes, back, scene));
  CHECK(hashText(back) == hashText(hashes));
}

TEST_CASE("a file of hashes that is none is refused with line, column and what was expected") {
  const Scene scene = parseScene(kThree, "three");
  const std::string good = hashText(test::hashesOf(scene));
  REQUIRE(hashesRefusal(good, scene).empty());
  const std::string head = good.substr(0, good.find('\n') + 1);
  const std::size_t sample = good.find("\n0.1 ") + 1;

  CHECK(
      hashesRefusal("", scene).starts_with("h:1:1: no file of hashes: expected 'tumble hashes 1'"));
  CHECK(hashesRefusal("t,body,x\n", scene).starts_with("h:1:1: no file of hashes"));
  CHECK(hashesRefusal(replaced(good, "hashes 1", "hashes 2"), scene)
            .starts_with("h:1:1: hashes of another version"));
  CHECK(hashesRefusal(head, scene).starts_with("h:1:1: the file ends before"));
  CHECK(hashesRefusal(replaced(good, "rate 10", "rate ten"), scene)
            .starts_with("h:2:6: expected a rate [1/s], found 'ten'"));
  CHECK(hashesRefusal(replaced(good, "rate 10", "rate nan"), scene).starts_with("h:2:"));
  CHECK(
      hashesRefusal(replaced(good, "bodies 3", "bodies 4"), scene).find("'three' with 4 bodies") !=
      std::string::npos);
  CHECK(hashesRefusal(replaced(good, "\n0.1 ", "\n0.2 "), scene)
            .starts_with("h:4:1: expected the sample at t = 0.1 s, found '0.2'"));
  CHECK(hashesRefusal(replaced(good, "\n0.1 ", "\n0.1 x"), scene)
            .starts_with("h:4:5: expected a hash of 16 hexadecimal digits"));
  CHECK(hashesRefusal(good.substr(0, sample + 10), scene).starts_with("h:4:5: "));
  CHECK(hashesRefusal(good.substr(0, sample + 3), scene).starts_with("h:4:5: the line ends"));
  CHECK(hashesRefusal(good.substr(0, sample), scene).starts_with("h:3:"));
  CHECK(hashesRefusal(replaced(good, "events", "0.6 0 0 0\nevents"), scene)
            .starts_with("h:9:1: expected the line of events"));
  CHECK(hashesRefusal(good + "more\n", scene).starts_with("h:10:1: expected the end of the file"));

  Scene other = scene;
  other.world.bodies[2].name = "higher";
  CHECK(hashesRefusal(good, other).starts_with("h:2:"));
}
