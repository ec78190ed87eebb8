// MuJoCo: soft contacts by convex optimisation. It has no coefficient of restitution: a spring and
// a damper at each contact stand in.
#include <fmt/format.h>
#include <mujoco/mujoco.h>

#include <cmath>
#include <cstring>
#include <numbers>

#include "tests/peers/engine.h"

namespace tumble::peers {

namespace {

/// What of MuJoCo is set; these are its own defaults.
struct MujocoSetup {
  bool rungeKutta = false;
  double softness = 0.0;    ///< steps in the time constant of contacts; 0: 20 ms, whatever the step
  double halfPeriod = 0.0;  ///< steps of the spring that stands in for restitution; 0: none
  bool sweeps = false;      ///< 20 more against slip
};

// Damping ratio ζ of a contact that pushes and never pulls, from its restitution:
//   e = exp(−ζ (π − 2 asin ζ)/√(1 − ζ²))
double dampingRatio(double e) {
  double low = 0.0, high = 0.999;
  for (int k = 0; k < 100; ++k) {
    const double z = 0.5 * (low + high);
    const double made =
        std::exp(-z * (std::numbers::pi - 2.0 * std::asin(z)) / std::sqrt(1.0 - z * z));
    (made > e ? low : high) = z;
  }
  return low;
}

std::string numbers(const Vec3& v) {
  return fmt::format("{:.17g} {:.17g} {:.17g}", v.x(), v.y(), v.z());
}

// How contacts give way, as attributes of every geometry.
std::string contactText(const MujocoSetup& setup, const Surface& surface, double h) {
  if (setup.halfPeriod > 0.0) {
    const double w = std::numbers::pi / (setup.halfPeriod * h),
                 z = dampingRatio(surface.restitution);
    return fmt::format("solref=\"{:.17g} {:.17g}\" solimp=\"0.9999 0.9999 0.001\"", -w * w,
                       -2.0 * z * w - 1e-9);
  }
  if (setup.softness > 0.0)
    return fmt::format("solref=\"{:.17g} 1\" solimp=\"0.99 0.9999 0.001\"", setup.softness * h);
  return "";
}

std::string shapeText(const BodyDef& body, const Surface& surface, const std::string& contact) {
  const std::string rest =
      fmt::format("friction=\"{:.17g} 0.005 0.0001\" {}/>", surface.friction, contact);
  if (const auto* plane = std::get_if<HalfSpace>(&body.shape))
    return fmt::format("<geom type=\"plane\" size=\"0 0 1\" pos=\"{}\" zaxis=\"{}\" {}",
                       numbers(plane->d * plane->n), numbers(plane->n), rest);
  if (const auto* ball = std::get_if<Sphere>(&body.shape))
    return fmt::format("<geom type=\"sphere\" size=\"{:.17g}\" {}", ball->r, rest);
  return fmt::format("<geom type=\"box\" size=\"{}\" {}", numbers(std::get<Box>(body.shape).half),
                     rest);
}

std::string bodyText(const BodyDef& body, const std::string& shape) {
  if (std::holds_alternative<HalfSpace>(body.shape)) return shape + "\n";
  const Quat& q = body.orientation;
  std::string text = fmt::format("<body pos=\"{}\" quat=\"{:.17g} {:.17g} {:.17g} {:.17g}\">",
                                 numbers(body.position), q.w(), q.x(), q.y(), q.z());
  if (!body.fixed) {
    const MassProperties properties = massOf(body);
    text += fmt::format("<freejoint/><inertial pos=\"0 0 0\" mass=\"{:.17g}\" diaginertia=\"{}\"/>",
                        properties.mass, numbers(properties.inertia.diagonal()));
  }
  return text + shape + "</body>\n";
}

std::string modelText(const Scene& scene, double h, const MujocoSetup& setup) {
  const Surface surface = commonSurface(scene.world);
  const std::string contact = contactText(setup, surface, h);
  const bool hard = setup.softness > 0.0;
  std::string text = fmt::format(
      "<mujoco><option timestep=\"{:.17g}\" gravity=\"{}\" integrator=\"{}\" cone=\"{}\" "
      "impratio=\"{}\" noslip_iterations=\"{}\"/>\n",
      h, numbers(scene.world.gravity), setup.rungeKutta ? "RK4" : "Euler",
      hard ? "elliptic" : "pyramidal", hard ? 10 : 1, setup.sweeps ? 20 : 0);
  if (scene.world.bodies.size() > 50)
    text += fmt::format("<size njmax=\"{0}\" nconmax=\"{0}\"/>\n", 32 * scene.world.bodies.size());
  text += "<worldbody>\n";
  for (const BodyDef& body : scene.world.bodies)
    text += bodyText(body, shapeText(body, surface, contact));
  return text + "</worldbody></mujoco>\n";
}

class Mujoco : public Engine {
 public:
  Mujoco(const Scene& scene, double h, const MujocoSetup& setup) : scene_(scene.world) {
    const std::string text = modelText(scene, h, setup);
    const auto files = std::make_unique<mjVFS>();
    mj_defaultVFS(files.get());
    mj_makeEmptyFileVFS(files.get(), "scene.xml", static_cast<int>(text.size()));
    std::memcpy(files->filedata[0], text.data(), text.size());
    char error[500] = "";
    model_ = mj_loadXML("scene.xml", files.get(), error, sizeof error);
    mj_deleteVFS(files.get());
    if (!model_) throw CannotExpress(error);
    data_ = mj_makeData(model_);
    setVelocities();
  }
  ~Mujoco() override {
    mj_deleteData(data_);
    mj_deleteModel(model_);
  }

  void step() override { mj_step(model_, data_); }

  void read(std::vector<BodySample>& bodies) const override {
    bodies.resize(scene_.bodies.size());
    const mjtNum *x = data_->qpos, *v = data_->qvel;
    for (std::size_t i = 0; i < bodies.size(); ++i) {
      if (still(scene_.bodies[i])) {
        bodies[i] = {scene_.bodies[i].position, scene_.bodies[i].orientation};
        continue;
      }
      const Quat q(x[3], x[4], x[5], x[6]);
      bodies[i] = {Vec3(x[0], x[1], x[2]), q, Vec3(v[0], v[1], v[2]), q * Vec3(v[3], v[4], v[5])};
      x += 7;
      v += 6;
    }
  }

 private:
  static bool still(const BodyDef& body) {
    return body.fixed || std::holds_alternative<HalfSpace>(body.shape);
  }

  // Linear in the world frame, angular in the body's.
  void setVelocities() {
    mjtNum* v = data_->qvel;
    for (const BodyDef& body : scene_.bodies) {
      if (still(body)) continue;
      const Vec3 w = body.orientation.conjugate() * body.angularVelocity;
      for (int i = 0; i < 3; ++i) {
        v[i] = body.velocity[i];
        v[3 + i] = w[i];
      }
      v += 6;
    }
  }

  WorldDef scene_;
  mjModel* model_ = nullptr;
  mjData* data_ = nullptr;
};

EngineSetup row(const std::string& name, const std::string& why, const MujocoSetup& setup,
                Meant meant = Meant::Always) {
  return {.engine = "MuJoCo",
          .name = name,
          .why = why,
          .asItComes = name == "default",
          .meant = meant,
          .make = [setup](const Scene& scene, double h) -> std::unique_ptr<Engine> {
            if (setup.halfPeriod > 0.0 && commonSurface(scene.world).restitution == 0.0)
              throw CannotExpress("a spring where nothing rebounds");
            return std::make_unique<Mujoco>(scene, h, setup);
          }};
}

}  // namespace

std::vector<EngineSetup> mujocoSetups() {
  return {
      row("default", "as it comes; nothing rebounds", {}),
      row("RK4", "of fourth order in free flight", {.rungeKutta = true}, Meant::OneMoves),
      row("stiff", "time constant of contacts two steps, round cones", {.softness = 2.0}),
      row("stiff 5", "the same with five steps, which stacks need", {.softness = 5.0},
          Meant::ManyMove),
      row("stiff, no slip", "stiff, and 20 sweeps against creep", {.softness = 2.0, .sweeps = true},
          Meant::OneMoves),
      row("spring 20", "a spring of 20 steps at each contact, damped as the restitution wants",
          {.rungeKutta = true, .halfPeriod = 20.0}, Meant::OneMoves),
  };
}

}  // namespace tumble::peers
