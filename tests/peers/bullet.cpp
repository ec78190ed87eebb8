// Bullet 3: sequential impulses. Double precision where the package has it.
#include <btBulletDynamicsCommon.h>

#include <BulletDynamics/MLCPSolvers/btDantzigSolver.h>
#include <BulletDynamics/MLCPSolvers/btMLCPSolver.h>

#include <cmath>

#include "tests/peers/engine.h"

namespace tumble::peers {

namespace {

/// What of Bullet is set; these are its own defaults.
struct BulletSetup {
  int iterations = 10;
  double restitutionFrom = 0.2;  ///< [m/s] slower approaches do not rebound
  bool twoDirections = false;    ///< of friction, not one along the slip
  /// Contacts at a distance > 0 are left out, and overlaps of every depth are pushed out by
  /// velocities of their own: without both, contacts made up to 2 cm ahead take part of the
  /// approach speed, and pushes out stay in the velocity.
  bool onlyTouching = false;
  bool dantzig = false;
  bool worldGyro = false;  ///< gyroscopic term solved in the world frame
};

btVector3 toBullet(const Vec3& v) {
  return {btScalar(v.x()), btScalar(v.y()), btScalar(v.z())};
}
btTransform toBullet(const Vec3& x, const Quat& q) {
  return btTransform(
      btQuaternion(btScalar(q.x()), btScalar(q.y()), btScalar(q.z()), btScalar(q.w())),
      toBullet(x));
}
Vec3 fromBullet(const btVector3& v) {
  return {v.x(), v.y(), v.z()};
}

class Bullet : public Engine {
 public:
  Bullet(const Scene& scene, double h, const BulletSetup& setup)
      : dispatcher_(&configuration_), setup_(setup), h_(btScalar(h)) {
    if (setup.dantzig) {
      solver_ = std::make_unique<btMLCPSolver>(&pivoting_);
    } else {
      solver_ = std::make_unique<btSequentialImpulseConstraintSolver>();
    }
    world_ = std::make_unique<btDiscreteDynamicsWorld>(&dispatcher_, &broadPhase_, solver_.get(),
                                                       &configuration_);
    world_->setGravity(toBullet(scene.world.gravity));
    btContactSolverInfo& info = world_->getSolverInfo();
    info.m_numIterations = setup.iterations;
    info.m_restitutionVelocityThreshold = btScalar(setup.restitutionFrom);
    if (setup.twoDirections) info.m_solverMode |= SOLVER_USE_2_FRICTION_DIRECTIONS;
    if (setup.onlyTouching) info.m_splitImpulsePenetrationThreshold = 0;
    const Surface surface = commonSurface(scene.world);
    for (const BodyDef& body : scene.world.bodies) add(body, scene.world, surface);
  }
  ~Bullet() override {
    for (const auto& body : bodies_) world_->removeRigidBody(body.get());
  }

  void step() override { world_->stepSimulation(h_, 0, h_); }

  void read(std::vector<BodySample>& bodies) const override {
    bodies.resize(bodies_.size());
    for (std::size_t i = 0; i < bodies_.size(); ++i) {
      const btTransform& pose = bodies_[i]->getWorldTransform();
      const btQuaternion q = pose.getRotation();
      bodies[i].x = fromBullet(pose.getOrigin()) - origin_[i];
      bodies[i].q = Quat(q.w(), q.x(), q.y(), q.z());
      bodies[i].v = fromBullet(bodies_[i]->getLinearVelocity());
      bodies[i].omega = fromBullet(bodies_[i]->getAngularVelocity());
    }
  }

 private:
  // A plane serves balls best; boxes meet a large box at up to four points of a face.
  std::unique_ptr<btCollisionShape> ground(const HalfSpace& plane, bool boxes) {
    if (!boxes || plane.n != Vec3::UnitY() || plane.d != 0.0)
      return std::make_unique<btStaticPlaneShape>(toBullet(plane.n), btScalar(plane.d));
    origin_.back() = Vec3(0.0, -kGround, 0.0);
    return std::make_unique<btBoxShape>(btVector3(kGround, kGround, kGround));
  }

  void add(const BodyDef& body, const WorldDef& world, const Surface& surface) {
    origin_.push_back(Vec3::Zero());
    const bool boxes = std::holds_alternative<Box>(world.bodies.back().shape);
    if (const auto* plane = std::get_if<HalfSpace>(&body.shape)) {
      shapes_.push_back(ground(*plane, boxes));
    } else if (const auto* ball = std::get_if<Sphere>(&body.shape)) {
      shapes_.push_back(std::make_unique<btSphereShape>(btScalar(ball->r)));
    } else {
      shapes_.push_back(std::make_unique<btBoxShape>(toBullet(std::get<Box>(body.shape).half)));
    }
    const bool fixed = body.fixed || std::holds_alternative<HalfSpace>(body.shape);
    btScalar mass = 0;
    btVector3 inertia(0, 0, 0);
    if (!fixed) {
      const MassProperties properties = massOf(body);
      mass = btScalar(properties.mass);
      inertia = toBullet(Vec3(properties.inertia.diagonal()));
    }
    btRigidBody::btRigidBodyConstructionInfo info(mass, nullptr, shapes_.back().get(), inertia);
    info.m_startWorldTransform = toBullet(body.position + origin_.back(), body.orientation);
    // It multiplies the two surfaces' numbers.
    info.m_friction = btScalar(std::sqrt(surface.friction));
    info.m_restitution = btScalar(std::sqrt(surface.restitution));
    bodies_.push_back(std::make_unique<btRigidBody>(info));
    btRigidBody& made = *bodies_.back();
    made.setLinearVelocity(toBullet(body.velocity));
    made.setAngularVelocity(toBullet(body.angularVelocity));
    made.setActivationState(DISABLE_DEACTIVATION);
    if (setup_.onlyTouching) made.setContactProcessingThreshold(0);
    if (setup_.worldGyro) made.setFlags(BT_ENABLE_GYROSCOPIC_FORCE_IMPLICIT_WORLD);
    world_->addRigidBody(&made);
  }

  static constexpr double kGround = 50.0;  // [m] half edge of the box in place of a plane

  btDefaultCollisionConfiguration configuration_;
  btCollisionDispatcher dispatcher_;
  btDbvtBroadphase broadPhase_;
  btDantzigSolver pivoting_;
  std::unique_ptr<btConstraintSolver> solver_;
  std::unique_ptr<btDiscreteDynamicsWorld> world_;
  std::vector<std::unique_ptr<btCollisionShape>> shapes_;
  std::vector<std::unique_ptr<btRigidBody>> bodies_;
  std::vector<Vec3> origin_;  // [m] of the engine's body, from the scene's
  BulletSetup setup_;
  btScalar h_;
};

EngineSetup row(const std::string& name, const std::string& why, const BulletSetup& setup,
                Meant meant = Meant::Always) {
  return {.engine = "Bullet",
          .name = name,
          .why = why,
          .asItComes = name == "default",
          .meant = meant,
          .make = [setup](const Scene& scene, double h) {
            return std::make_unique<Bullet>(scene, h, setup);
          }};
}

}  // namespace

std::vector<EngineSetup> bulletSetups() {
  return {
      row("default", "as it comes, but for sleep, which is off", {}),
      row("tuned", "slow approaches rebound too, friction in two directions",
          {.restitutionFrom = 0.0, .twoDirections = true}),
      row("touching", "tuned, and contacts only where bodies touch: rebounds keep their height",
          {.restitutionFrom = 0.0, .twoDirections = true, .onlyTouching = true}),
      row("touching, 50", "the same with 50 iterations",
          {.iterations = 50, .restitutionFrom = 0.0, .twoDirections = true, .onlyTouching = true},
          Meant::ManyMove),
      row("tuned, 200", "tuned with 200 iterations, for unlike masses",
          {.iterations = 200, .restitutionFrom = 0.0, .twoDirections = true}, Meant::ManyMove),
      row("Dantzig", "its pivoting solver", {.restitutionFrom = 0.0, .dantzig = true},
          Meant::FewMove),
      row("gyro in world", "the gyroscopic term solved in the world frame", {.worldGyro = true},
          Meant::OneMoves),
  };
}

}  // namespace tumble::peers
