// The claims behind the report's chapters on sliding, rolling and piles: true for true runs by
// every method, and broken by untrue ones.
#include <algorithm>
#include <stdexcept>

#include "app/claim/rows.h"
#include "app/file/data.h"
#include "tests/app/claims.h"
#include "tests/app/runs.h"

using namespace tumble;

namespace {

Scene chapter(const char* name, const std::vector<std::string>& overrides = {}) {
  return readScene(dataFolder("report") + "/" + name + ".toml", overrides);
}

// Sweeps of the course may leave the friction of a block that hardly moves unsolved; then they say
// so.
bool saysUnsolved(const Recording& recording) {
  const std::vector<std::string>& notes = recording.report.notes;
  return recording.method == "course" &&
         std::any_of(notes.begin(), notes.end(), [](const std::string& note) {
           return note.find("left unsolved") != std::string::npos;
         });
}

const ClaimRow& rowOf(const std::vector<ClaimRow>& rows, const std::string& text) {
  for (const ClaimRow& row : rows)
    if (row.label.find(text) != std::string::npos) return row;
  throw std::out_of_range("no row of " + text);
}

}  // namespace

// Oracle: by hand, g = 9.81. The block: 9.81 (0.6 − 0.4·0.8)/2 m in 1 s; with μ = 0.9 from 3 m/s it
// stops after 9/(2·9.81 (0.72 − 0.6)) m. The ball: 5 m/s from 14/(7·0.5·9.81) s on.
TEST_CASE("the claim of ways knows where blocks stop and when balls roll") {
  const Scene down = chapter("slopes");
  CHECK(rowOf(wayRows(down, runOf(down)), "place").exact == Approx(1.3734).epsilon(1e-12));

  const Scene stops = chapter("slopes", {"materials.wood.friction=0.9", "world.duration=4",
                                         "body.block.velocity=[2.4, -1.8, 0.0]"});
  const Recording stopped = runOf(stops);
  const std::vector<ClaimRow> rows = wayRows(stops, stopped);
  CHECK(rowOf(rows, "slip ends").exact == Approx(3.0 / (9.81 * 0.12)).epsilon(1e-12));
  const Vec3 way = stopped.samples.back().bodies[1].x - stopped.samples.front().bodies[1].x;
  CHECK(way.norm() == Approx(9.0 / (2.0 * 9.81 * 0.12)).epsilon(1e-12));

  const Scene ball = chapter("rolling");
  CHECK(rowOf(wayRows(ball, runOf(ball)), "slip ends").exact == Approx(4.0 / 9.81).epsilon(1e-12));
}

// Oracle: the closed forms of app/claim/way.cpp. Thrown up a slope a block stops and, with too
// little friction, comes back; a ball comes back rolling.
TEST_CASE("blocks and balls keep the claim of ways by each method, whichever way they are thrown") {
  for (const char* method : {"exact", "course", "stepping"})
    for (const char* mu : {"0.05", "0.5", "0.9"})
      for (const char* velocity : {"[2.4, -1.8, 0.0]", "[-2.4, 1.8, 0.0]", "[0.0, 0.0, 0.0]"}) {
        CAPTURE(method, mu, velocity);
        const std::string set = std::string("world.method=") + method;
        const Scene block = chapter("slopes", {set, std::string("materials.wood.friction=") + mu,
                                               std::string("body.block.velocity=") + velocity});
        const Recording recording = runOf(block);
        CHECK((holds("sliding-way", block, recording) || saysUnsolved(recording)));
        const Scene ball = chapter("rolling", {set, std::string("materials.rubber.friction=") + mu,
                                               "body.ground.shape={ plane = [0.6, 0.8, 0.0, 0.0] }",
                                               "body.ball.position=[0.096, 0.128, 0.0]",
                                               std::string("body.ball.velocity=") + velocity});
        CHECK(holds("sliding-way", ball, runOf(ball)));
      }
}

TEST_CASE("a wrong place, a wrong speed and a late end of the slip break the claim of ways") {
  const Scene scene = chapter("rolling");
  const Recording right = runOf(scene);
  REQUIRE(holds("sliding-way", scene, right));
  const auto broken = [&](const std::function<void(Recording&)>& breakIt) {
    CHECK_FALSE(holdsBroken("sliding-way", scene, right, breakIt));
  };
  broken([](Recording& r) { r.samples[3].bodies[1].x.x() += 2e-9; });
  broken([](Recording& r) { r.samples[15].bodies[1].v.x() -= 2e-8; });
  broken([](Recording& r) {
    for (Event& event : r.report.events)
      if (event.kind == EventKind::Stick) event.t += 1e-8;
  });
  broken([](Recording& r) {
    std::erase_if(r.report.events, [](const Event& e) { return e.kind == EventKind::Stick; });
  });
  const Scene flying = chapter("rolling", {"body.ball.position=[0.0, 3.0, 0.0]"});
  CHECK_FALSE(holds("sliding-way", flying, runOf(flying)));
}

// Oracle: definition. A pile keeps its books to the size of its steps, and a residual, an overlap
// or a balance beyond it breaks the claim.
TEST_CASE("the claim of books holds for a pile, and not for a wrong certificate") {
  const Scene scene = chapter("piles", {"stepping.step=0.004"});
  const Recording right = runOf(scene);
  CHECK(holds("books", scene, right));
  const auto broken = [&](double Certificate::*number, double wrong) {
    CHECK_FALSE(holdsBroken("books", scene, right,
                            [&](Recording& r) { r.report.certificate.*number = wrong; }));
  };
  broken(&Certificate::max_complementarity, 1e-5);
  broken(&Certificate::max_penetration, 0.1);
  broken(&Certificate::energy_balance_error, 0.1);
  broken(&Certificate::energy_balance_error, std::nan(""));

  // Without steps the books are tight.
  const Scene ball = chapter("rolling");
  const Recording exact = runOf(ball);
  CHECK(holds("books", ball, exact));
  CHECK_FALSE(holdsBroken("books", ball, exact,
                          [](Recording& r) { r.report.certificate.energy_balance_error = 1e-8; }));
}
