// Simbody: compliant contacts, integrated with an error that is controlled. It knows no contact of
// boxes with each other.
#include <algorithm>
#include <cmath>

#include "tests/peers/engine.h"
#include "tests/peers/simbody_world.h"

namespace tumble::peers {

namespace {

bool still(const BodyDef& body) {
  return body.fixed || std::holds_alternative<HalfSpace>(body.shape);
}

void copy(const Vec3& from, double to[3]) {
  for (int i = 0; i < 3; ++i) to[i] = from[i];
}

SimbodyBody bodyOf(const BodyDef& body) {
  SimbodyBody made;
  const auto* ball = std::get_if<Sphere>(&body.shape);
  made.ball = ball;
  if (ball)
    made.radius = ball->r;
  else
    copy(std::get<Box>(body.shape).half, made.half);
  const MassProperties mass = massOf(body);
  made.mass = mass.mass;
  copy(mass.inertia.diagonal(), made.inertia);
  copy(body.position, made.x);
  copy(body.velocity, made.v);
  copy(body.angularVelocity, made.omega);
  const Quat& q = body.orientation;
  made.q[0] = q.w(), made.q[1] = q.x(), made.q[2] = q.y(), made.q[3] = q.z();
  return made;
}

// The body that moves; the only one.
const BodyDef& movingBody(const WorldDef& world) {
  const BodyDef* moving = nullptr;
  for (const BodyDef& body : world.bodies) {
    const auto* plane = std::get_if<HalfSpace>(&body.shape);
    if (plane ? plane->n != Vec3::UnitY() || plane->d != 0.0 : body.fixed)
      throw CannotExpress("fixed boxes, or another ground than y = 0");
    if (!plane && moving) throw CannotExpress("boxes that touch boxes");
    if (!plane) moving = &body;
  }
  return *moving;
}

class Simbody : public Engine {
 public:
  Simbody(const Scene& scene, double h, double accuracy) : scene_(scene.world), h_(h) {
    const Surface surface = commonSurface(scene_);
    const BodyDef& body = movingBody(scene_);
    // A first impact at the speed v has restitution e with the dissipation (1 − e)/v.
    const double fallen = std::max(0.0, body.position.y());
    const double v = std::sqrt(2.0 * scene_.gravity.norm() * fallen) + 1e-3;
    SimbodyContact contact;
    contact.ground = scene_.bodies.size() > 1;
    contact.friction = surface.friction;
    contact.dissipation = (1.0 - surface.restitution) / v;
    world_ =
        std::make_unique<SimbodyWorld>(bodyOf(body), contact, scene_.gravity.data(), h, accuracy);
  }

  void step() override { world_->advance(++steps_ * h_); }

  void read(std::vector<BodySample>& bodies) const override {
    SimbodyBody now;
    world_->read(now);
    bodies.resize(scene_.bodies.size());
    for (std::size_t i = 0; i < bodies.size(); ++i)
      bodies[i] = still(scene_.bodies[i])
                      ? BodySample{scene_.bodies[i].position, scene_.bodies[i].orientation}
                      : BodySample{Vec3(now.x), Quat(now.q[0], now.q[1], now.q[2], now.q[3]),
                                   Vec3(now.v), Vec3(now.omega)};
  }

 private:
  WorldDef scene_;
  std::unique_ptr<SimbodyWorld> world_;
  double h_;
  long steps_ = 0;
};

EngineSetup row(const std::string& name, const std::string& why, double accuracy) {
  return {.engine = "Simbody",
          .name = name,
          .why = why,
          .asItComes = name == "default",
          .meant = Meant::OneMoves,
          .stepless = accuracy > 0.0,
          .make = [accuracy](const Scene& scene, double h) {
            return std::make_unique<Simbody>(scene, h, accuracy);
          }};
}

}  // namespace

std::vector<EngineSetup> simbodySetups() {
  return {row("default", "Runge, Kutta and Merson to its own accuracy of 1e-3", 1e-3),
          row("1e-5", "the same to 1e-5", 1e-5), row("1e-7", "the same to 1e-7", 1e-7),
          row("fixed", "one step of theirs for each step asked for", 0.0)};
}

}  // namespace tumble::peers
