// What a scene claims by formulas.
#include "app/claim/expect.h"

#include <fmt/format.h>

#include <cmath>

#include "app/claim/formula.h"
#include "app/claim/quantity.h"
#include "app/claim/verdict.h"
#include "app/present/present.h"
#include "tests/catch.h"

using namespace tumble;

namespace {

// Thrown upward at 3 m/s from 1 m: the apex is 9/(2 g) above that, at 3/g.
const std::string kThrow = R"([world]
gravity = [0, -10, 0]
duration = 0.5
[[body]]
name = "ball.3"
shape = { sphere = 0.1 }
mass = 2.0
position = [0, 1, 0]
velocity = [1, 3, 0]
[image]
rate = 20
)";

ClaimRow expectRow(const std::string& expect) {
  const Scene scene = parseScene(kThrow + "[[expect]]\n" + expect, "throw");
  requireKnownChecks(scene);
  const Verdict verdict = judge(scene, record(scene, scene.image.rate));
  REQUIRE(verdict.rows.size() == 1);
  return verdict.rows.front();
}

std::string expectRefusal(const std::string& expect) {
  try {
    requireKnownChecks(parseScene(kThrow + "[[expect]]\n" + expect, "throw"));
  } catch (const SceneError& error) {
    std::string all;
    for (const Diagnostic& diagnostic : error.diagnostics()) all += format(diagnostic) + "\n";
    return all;
  }
  return "";
}

}  // namespace

TEST_CASE("a formula that gives no number says so without a sign") {
  const ClaimRow row = expectRow("value = \"sqrt(0 - 1 - t)\"\nequals = 1\nwithin = 1");
  CHECK_FALSE(row.holds());
  CHECK(std::isnan(row.measured));
  CHECK_FALSE(std::signbit(row.measured));
}

// Oracle: closed form. Measured 4e-16, allowed 1e-12.
TEST_CASE("a formula is measured at an instant, at the ends and where it is largest or least") {
  CHECK(expectRow("value = \"ball.3.y\"\nat = 0.3\nequals = 1.45\nwithin = 1e-12").holds());
  CHECK(expectRow("value = \"ball.3.y\"\nover = \"max\"\nequals = 1.45\nwithin = 1e-12").holds());
  CHECK(expectRow("value = \"ball.3.vy + 10 * t\"\nover = \"min\"\nequals = 3\nwithin = 1e-12")
            .holds());
  CHECK(expectRow("value = \"energy\"\nequals = 30\nwithin = 1e-11").holds());
  CHECK(expectRow("value = \"energy\"\nover = \"start\"\nequals = 30\nwithin = 1e-12").holds());
  CHECK(expectRow("value = \"sqrt(ball.3.px^2) / 2\"\nequals = 1\nwithin = 1e-12").holds());
  const ClaimRow off = expectRow("value = \"ball.3.y\"\nat = 0.3\nequals = 1.5\nwithin = 0.04");
  CHECK_FALSE(off.holds());
  CHECK(off.error == Approx(0.05).epsilon(1e-9));
}

TEST_CASE("no claim holds of what has no end") {
  CHECK_FALSE(expectRow("value = \"ball.3.y / 0\"\nat_least = 0").holds());
  CHECK_FALSE(expectRow("value = \"ball.3.y\"\nat_most = \"1 / ball.3.z\"").holds());
}

// Oracle: closed form, 3²/(2 g) above the start, whatever --set or a sweep puts there.
// Measured 2e-16, allowed 1e-12.
TEST_CASE("a formula reads numbers of the scene by their keys, as a sweep has changed them") {
  const std::string apex =
      "[[expect]]\nover = \"max\"\nwithin = 1e-12\nvalue = \"ball.3.y\"\nequals = "
      "\"body.ball.3.position.1 - body.ball.3.velocity.1^2 / (2 * world.gravity.1)\"\n";
  for (const double g : {10.0, 20.0}) {
    Variant variant;
    variant.set.push_back({fmt::format("world.gravity=[0, {}, 0]", -g), {}});
    const Scene swept = parseScene(kThrow + apex, "throw", {}, &variant);
    requireKnownChecks(swept);
    const ClaimRow row = judge(swept, record(swept, swept.image.rate)).rows.front();
    CHECK(row.exact == Approx(1.0 + 4.5 / g).epsilon(1e-14));
    CHECK(row.holds());
  }
  CHECK(expectRefusal("value = \"world.gravty.1\"\nequals = 0").find("world.gravity.1") !=
        std::string::npos);
  CHECK(expectRefusal("value = \"t\"\nequals = \"bal.3.x\"").find("throw:14:11:") !=
        std::string::npos);
}

// Oracle: what is read. A name with a hyphen is asked for with '_'.
TEST_CASE("a pair of materials is read by its key") {
  const Scene scene = parseScene(
      kThrow +
          "[materials]\nice = { friction = 0.1 }\n[pairs]\nice-ice = { friction = 0.3 }\n"
          "[[expect]]\nvalue = \"pairs.ice_ice.friction / materials.ice.friction\"\n"
          "at_least = 3\nwithin = 1e-15\n",
      "throw");
  CHECK(judge(scene, record(scene, scene.image.rate)).rows.front().holds());
}

// Oracle: closed form, 1 + 3 t − 5 t². Measured 0, allowed 1e-12. Samples at 0 and 1/3 s.
TEST_CASE("the end is that of the run, though no sample lies there") {
  const Scene scene = parseScene(
      kThrow +
          "[[expect]]\nvalue = \"ball.3.y\"\nequals = \"1 + 3 * t - 5 * t^2\"\nwithin = 1e-12\n",
      "throw", {"image.rate=3"});
  const Recording recording = record(scene, scene.image.rate);
  CHECK(recording.samples.size() == 2);
  REQUIRE(recording.end.has_value());
  CHECK(recording.end->t == 0.5);
  const ClaimRow row = judge(scene, recording).rows.front();
  CHECK(row.exact == Approx(1.25).epsilon(1e-12));
  CHECK(row.holds());
  CHECK_FALSE(record(scene, 20.0).end.has_value());
}

TEST_CASE("at most and at least forgive what is on their side") {
  CHECK(expectRow("value = \"ball.3.y\"\nover = \"max\"\nat_most = 1.46").holds());
  CHECK(expectRow("value = \"ball.3.y\"\nover = \"max\"\nat_least = 1.4").holds());
  CHECK_FALSE(expectRow("value = \"ball.3.y\"\nover = \"max\"\nat_most = 1.4").holds());
  CHECK_FALSE(expectRow("value = \"ball.3.y\"\nover = \"max\"\nat_least = 1.5").holds());
  CHECK_FALSE(expectRow("value = \"0 / 0\"\nequals = 0\nwithin = 1").holds());
}

TEST_CASE("a formula that is none is refused where it goes wrong") {
  struct Slip {
    std::string expect;
    std::vector<std::string> says;
  };
  const Slip slip =
      GENERATE(Slip{"value = \"ball.3.w\"\nequals = 0", {"throw:13:10:", "ball.3.w"}},
               Slip{"value = \"2 * bal.3.x\"\nequals = 0", {"throw:13:14:", "ball.3"}},
               Slip{"value = \"enrgy\"\nequals = 0", {"throw:13:10:", "'energy'"}},
               Slip{"value = \"1 + * 2\"\nequals = 0", {"throw:13:14:", "for example"}},
               Slip{"value = \"1 + sine(t)\"\nequals = 0",
                    {"throw:13:14:", "value: unknown function 'sine', did you mean 'sin'?"}},
               Slip{"value = \"t\"\nequals = \"2e3 * (t) + qqqq (t)\"",
                    {"throw:14:23:", "equals: unknown function 'qqqq'; valid: ", "sqrt"}},
               Slip{"value = \"t * 1e5 + ball.3.y (2)\"\nequals = 0",
                    {"throw:13:20:", "unknown function 'ball.3.y'; valid: "}},
               Slip{"value = \"t + e\"\nequals = 0", {"throw:13:14:", "did you mean 'energy'?"}},
               Slip{"value = \"t + 3.x\"\nequals = 0", {"throw:13:14:", "'3.x' begins"}},
               Slip{"value = \"2t\"\nequals = 0", {"throw:13:10:", "'2t'", "*"}},
               Slip{"value = \"t2 + t23 + t\"\nequals = 0", {"throw:13:10:", "throw:13:15:"}},
               Slip{"value = \"a + ball.3.q\"\nequals = 0",
                    {"throw:13:10:", "'a'; valid: t", "throw:13:14:", "'ball.3.q'; valid: x"}},
               Slip{"value = \"body.ball.3.mss\"\nequals = 0",
                    {"throw:13:10:", "did you mean 'body.ball.3.mass'?"}},
               Slip{"value = \"t = 2\"\nequals = 0", {"throw:13:12:", "equals"}},
               Slip{"value = \"t\"", {"equals", "at_most"}},
               Slip{"value = \"t\"\nequals = 0\nat_most = 1", {"equals"}},
               Slip{"equals = 0", {"value", "formula"}},
               Slip{"value = \"t\"\nequals = 0\nat = 0.12", {"throw:15:", "0.1"}},
               Slip{"value = \"t\"\nequals = 0\nat = 9", {"throw:15:", "at"}},
               Slip{"value = \"t\"\nequals = 0\nat = 0.1\nover = \"max\"", {"over"}},
               Slip{"value = \"t\"\nequals = 0\nover = \"mox\"", {"'max'"}},
               Slip{"valu = \"t\"\nequals = 0", {"throw:13:1:", "'value'"}});
  CAPTURE(slip.expect);
  const std::string refusal = expectRefusal(slip.expect);
  CAPTURE(refusal);
  for (const std::string& text : slip.says) CHECK(refusal.find(text) != std::string::npos);
}

TEST_CASE(
    "a graph's formula is refused at its place, with the near name of what only graphs read") {
  const auto refusal = [](const std::string& value) {
    return expectRefusal(
        "value = \"t\"\nat_least = 0\n[[graph]]\nshows = \"values\"\n"
        "curves = [{ label = \"a\", value = \"" +
        value + "\" }]");
  };
  const std::string function = refusal("2 * sine(t)");
  CAPTURE(function);
  CHECK(
      function.starts_with("throw:17:39: error: graph.0.curves.0.value: unknown function "
                           "'sine', did you mean 'sin'?"));
  CHECK(refusal("evets").find("'evets', did you mean 'events'?") != std::string::npos);
}

TEST_CASE("every quantity of both tables has a value in a scene that has bodies and contacts") {
  const Scene scene = parseScene(kThrow, "throw");
  const Recording recording = record(scene, 20.0);
  for (const Quantity& quantity : bodyQuantities()) {
    CAPTURE(quantity.name);
    const auto gauge = Gauge::named(scene, std::string("ball.3.") + quantity.name);
    REQUIRE(gauge.has_value());
    CHECK(std::isfinite((*gauge)(recording.samples.back())));
  }
  for (const Quantity& quantity : runQuantities()) REQUIRE(Gauge::named(scene, quantity.name));
  CHECK_FALSE(Gauge::named(scene, "ball.y").has_value());
}

TEST_CASE("an expectation is written below the title, and drawn where it is one coordinate") {
  const std::string expect = "[[expect]]\nvalue = \"ball.3.y\"\nover = \"max\"\nequals = 1.45\n";
  const Scene scene = parseScene(kThrow + expect, "throw");
  const Recording recording = record(scene, 20.0);
  const Picture picture = Presenter(scene, recording).image(0);
  REQUIRE(picture.remarks.size() == 1);
  CHECK(picture.remarks[0].text == "ball.3.y, max: 1.45, expected 1.45");
  CHECK(picture.subtitle == "t = 0.00 s   dotted: what is expected");
  // What is allowed belongs to a bound.
  const auto written = [&](const std::string& bound) {
    const Scene one = parseScene(
        kThrow + "[[expect]]\nvalue = \"0\"\nwithin = 1e-9\n" + bound + " = 0.0\n", "throw");
    return Presenter(one, recording).image(0).remarks.at(0).text;
  };
  CHECK(written("at_most").ends_with("expected ≤ 10⁻⁹"));
  CHECK(written("at_least").ends_with("expected ≥ −10⁻⁹"));
  CHECK(written("equals").ends_with("expected 0 ± 10⁻⁹"));
  // Unless its own words say so.
  const Scene told = parseScene("subtitle = \"Dots: the apex.\"\n" + kThrow + expect, "throw");
  CHECK(Presenter(told, recording).image(0).subtitle == "Dots: the apex.   t = 0.00 s");
  REQUIRE(picture.lines.size() == 1);
  CHECK(picture.lines[0].stroke == Stroke::Dotted);
  CHECK(picture.lines[0].points[0].y() == 1.45);
}
