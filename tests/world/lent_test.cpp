// Islands that are solved side by side.
#include <thread>

#include "tests/catch.h"
#include "tests/world/scenes.h"

using namespace tumble;
using namespace tumble::scenes;

namespace {

/// Heaps of four bricks, each askew on the one below: an island each.
WorldDef heaps(int count) {
  WorldDef def = worldOf("stepping", 0.5, {ground(0.2, 0.5)});
  for (int k = 0; k < count; ++k)
    for (int level = 0; level < 4; ++level) {
      BodyDef brick =
          box("heap." + std::to_string(k) + "." + std::to_string(level), {0.3, 0.1, 0.2},
              {1.0 * k, 0.06 + 0.11 * level, 0.02 * level * (k % 3)}, 0.2, 0.5);
      brick.orientation = Quat(Eigen::AngleAxisd(0.3 * level + 0.1 * k, Vec3::UnitY()));
      def.bodies.push_back(brick);
    }
  return def;
}

using Act = std::function<void(int item, int worker)>;

struct LentRun {
  Sample end;
  int rounds = 0;
  long solved = 0;
};

LentRun runBy(Workers workers) {
  LentRun run;
  World world(heaps(12));
  world.lend({.count = workers.count, .forEach = [&](int items, const Act& act) {
                ++run.rounds;
                workers.forEach(items, act);
              }});
  world.advance(0.5);
  run.end = world.sample(0.5);
  run.solved = world.report().certificate.islands_solved;
  return run;
}

bool sameMotion(const Sample& p, const Sample& q) {
  for (std::size_t i = 0; i < p.bodies.size(); ++i)
    if (p.bodies[i].x != q.bodies[i].x || p.bodies[i].q.coeffs() != q.bodies[i].q.coeffs() ||
        p.bodies[i].v != q.bodies[i].v || p.bodies[i].omega != q.bodies[i].omega)
      return false;
  return true;
}

}  // namespace

TEST_CASE("whoever solves an island, in whatever order, it goes the same way to the bit") {
  const LentRun alone = runBy({});
  CHECK(alone.rounds == 0);
  const LentRun turned = runBy({.count = 3, .forEach = [](int items, const Act& act) {
                                  for (int i = items - 1; i >= 0; --i) act(i, i % 3);
                                }});
  const LentRun abreast = runBy({.count = 8, .forEach = [](int items, const Act& act) {
                                   std::vector<std::thread> threads;
                                   for (int k = 0; k < 8; ++k)
                                     threads.emplace_back([&, k] {
                                       for (int i = k; i < items; i += 8) act(i, k);
                                     });
                                   for (std::thread& thread : threads) thread.join();
                                 }});
  for (const LentRun* run : {&turned, &abreast}) {
    CHECK(run->rounds > 50);
    CHECK(run->solved == alone.solved);
    CHECK(sameMotion(run->end, alone.end));
  }
}
