// Planes remembered from step to step (slide SD40): they answer often, and change nothing.
#include <cstring>

#include "tests/catch.h"
#include "tests/world/scenes.h"

using namespace tumble;
using namespace tumble::scenes;

namespace {

/// Boxes and balls that fall past each other onto a ground and come to rest there.
WorldDef shower(const std::string& method, int count, double duration) {
  WorldDef def;
  def.method = method;
  def.duration = duration;
  def.bodies = {ground(0.3, 0.4)};
  for (int k = 0; k < count; ++k) {
    const Vec3 x(0.33 * (k % 3) + 0.02 * (k % 5), 0.6 + 0.42 * (k / 3), 0.3 * (k % 2));
    BodyDef body = k % 3 == 1 ? ball("ball" + std::to_string(k), 0.12, x, 0.3, 0.4)
                              : box("box" + std::to_string(k), {0.2, 0.3, 0.25}, x, 0.3, 0.4);
    body.angularVelocity = {0.7 * (k % 4), 1.0 - 0.4 * (k % 6), 0.5};
    body.velocity = {0.1 * (k % 2), 0.0, 0.1 * (k % 3)};
    def.bodies.push_back(body);
  }
  return def;
}

bool equalBits(double a, double b) {
  return std::memcmp(&a, &b, sizeof a) == 0;
}
bool equalBits(const Vec3& a, const Vec3& b) {
  return equalBits(a.x(), b.x()) && equalBits(a.y(), b.y()) && equalBits(a.z(), b.z());
}

void compare(const WorldDef& def, const char* name) {
  WorldDef forgetful = def;
  forgetful.rememberPlanes = false;
  World one(def), other(forgetful);
  const Sample end = run(one), again = run(other);
  REQUIRE_FALSE(one.report().stopped);
  REQUIRE(end.bodies.size() == again.bodies.size());
  for (std::size_t i = 0; i < end.bodies.size(); ++i) {
    CHECK(equalBits(end.bodies[i].x, again.bodies[i].x));
    CHECK(equalBits(end.bodies[i].v, again.bodies[i].v));
    CHECK(equalBits(end.bodies[i].omega, again.bodies[i].omega));
    CHECK(equalBits(end.bodies[i].q.w(), again.bodies[i].q.w()));
  }
  REQUIRE(end.contacts.size() == again.contacts.size());
  for (std::size_t k = 0; k < end.contacts.size(); ++k)
    CHECK(equalBits(end.contacts[k].force, again.contacts[k].force));
  REQUIRE(one.report().events.size() == other.report().events.size());
  for (std::size_t k = 0; k < one.report().events.size(); ++k) {
    CHECK(equalBits(one.report().events[k].t, other.report().events[k].t));
    CHECK(equalBits(one.report().events[k].j, other.report().events[k].j));
  }
  const Certificate& books = one.report().certificate;
  CHECK(other.report().certificate.plane_tests == 0);
  CHECK(books.plane_hits > 0);
  CHECK(books.plane_hits <= books.plane_tests);
  CHECK(equalBits(books.max_penetration, other.report().certificate.max_penetration));
  WARN("remembered planes, " << name << ": measured hits " << books.plane_hits << " of "
                             << books.plane_tests << " looks, events "
                             << one.report().events.size());
}

}  // namespace

// Oracle: two ways agree, bit by bit.
TEST_CASE("a world that remembers planes moves as one that searches every pair anew", "[figures]") {
  compare(shower("stepping", 12, 2.0), "stepping");
  compare(shower("course", 4, 0.45), "course");
}

TEST_CASE("a world that remembers planes moves as one that searches anew, until it rests",
          "[long]") {
  compare(shower("course", 4, 0.8), "course");
}
