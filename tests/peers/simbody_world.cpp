#include "tests/peers/simbody_world.h"

#include <Simbody.h>

namespace tumble::peers {

namespace {

SimTK::Vec3 vector(const double v[3]) {
  return {v[0], v[1], v[2]};
}

void copy(const SimTK::Vec3& from, double to[3]) {
  for (int i = 0; i < 3; ++i) to[i] = from[i];
}

}  // namespace

struct SimbodyWorld::Parts {
  SimTK::MultibodySystem system;
  SimTK::SimbodyMatterSubsystem matter{system};
  SimTK::GeneralForceSubsystem forces{system};
  SimTK::ContactTrackerSubsystem tracker{system};
  SimTK::CompliantContactSubsystem contact{system, tracker};
  SimTK::RungeKuttaMersonIntegrator integrator{system};
  SimTK::MobilizedBody::Free body;
  std::unique_ptr<SimTK::TimeStepper> stepper;

  // Its half-space is solid along its x.
  void addGround(const SimTK::ContactMaterial& material) {
    const SimTK::Rotation down(-SimTK::Pi / 2, SimTK::ZAxis);
    matter.Ground().updBody().addContactSurface(
        SimTK::Transform(down, SimTK::Vec3(0)),
        SimTK::ContactSurface(SimTK::ContactGeometry::HalfSpace(), material));
  }

  void addBody(const SimbodyBody& from, const SimTK::ContactMaterial& material) {
    SimTK::Body::Rigid solid(
        SimTK::MassProperties(from.mass, SimTK::Vec3(0), SimTK::Inertia(vector(from.inertia))));
    if (from.ball)
      solid.addContactSurface(
          SimTK::Transform(),
          SimTK::ContactSurface(SimTK::ContactGeometry::Sphere(from.radius), material));
    else
      solid.addContactSurface(
          SimTK::Transform(),
          SimTK::ContactSurface(SimTK::ContactGeometry::Brick(vector(from.half)), material));
    body =
        SimTK::MobilizedBody::Free(matter.Ground(), SimTK::Transform(), solid, SimTK::Transform());
  }

  void start(const SimbodyBody& from) {
    SimTK::State state = system.realizeTopology();
    const double* q = from.q;
    const SimTK::Rotation turn(SimTK::Quaternion(q[0], q[1], q[2], q[3]));
    body.setQToFitTransform(state, SimTK::Transform(turn, vector(from.x)));
    body.setUToFitVelocity(state, SimTK::SpatialVec(vector(from.omega), vector(from.v)));
    stepper = std::make_unique<SimTK::TimeStepper>(system, integrator);
    stepper->initialize(state);
  }
};

SimbodyWorld::SimbodyWorld(const SimbodyBody& body, const SimbodyContact& contact,
                           const double gravity[3], double h, double accuracy)
    : parts_(std::make_unique<Parts>()) {
  constexpr double kTransition = 1e-3;  // [m/s] below which friction is not full
  parts_->contact.setTransitionVelocity(kTransition);
  SimTK::Force::UniformGravity(parts_->forces, parts_->matter, vector(gravity));
  const SimTK::ContactMaterial material(contact.stiffness, contact.dissipation, contact.friction,
                                        contact.friction, 0.0);
  if (contact.ground) parts_->addGround(material);
  parts_->addBody(body, material);
  if (accuracy > 0.0)
    parts_->integrator.setAccuracy(accuracy);
  else
    parts_->integrator.setFixedStepSize(h);
  parts_->start(body);
}

SimbodyWorld::~SimbodyWorld() = default;

void SimbodyWorld::advance(double t) {
  parts_->stepper->stepTo(t);
}

void SimbodyWorld::read(SimbodyBody& body) const {
  const SimTK::State& state = parts_->integrator.getState();
  parts_->system.realize(state, SimTK::Stage::Velocity);
  const SimTK::Transform& pose = parts_->body.getBodyTransform(state);
  const SimTK::Quaternion q = pose.R().convertRotationToQuaternion();
  const SimTK::SpatialVec& v = parts_->body.getBodyVelocity(state);
  copy(pose.p(), body.x);
  for (int i = 0; i < 4; ++i) body.q[i] = q[i];
  copy(v[1], body.v);
  copy(v[0], body.omega);
}

}  // namespace tumble::peers
