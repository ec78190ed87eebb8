// DART: pivoting by Dantzig's method on a pyramid of friction, sweeps where that fails.
#include <dart/collision/dart/DARTCollisionDetector.hpp>
#include <dart/constraint/ConstraintSolver.hpp>
#include <dart/constraint/ContactConstraint.hpp>
#include <dart/dynamics/BodyNode.hpp>
#include <dart/dynamics/BoxShape.hpp>
#include <dart/dynamics/FreeJoint.hpp>
#include <dart/dynamics/Skeleton.hpp>
#include <dart/dynamics/SphereShape.hpp>
#include <dart/simulation/World.hpp>

#include <cmath>

#include "tests/peers/engine.h"

namespace tumble::peers {

namespace {

namespace dyn = dart::dynamics;

class Dart : public Engine {
 public:
  /// @param erp  share of an overlap that a step takes away; of all worlds at once
  Dart(const Scene& scene, double h, double erp) : scene_(scene.world) {
    dart::constraint::ContactConstraint::setErrorReductionParameter(erp);
    world_ = dart::simulation::World::create();
    world_->setGravity(scene.world.gravity);
    world_->setTimeStep(h);
    world_->getConstraintSolver()->setCollisionDetector(
        dart::collision::DARTCollisionDetector::create());
    const Surface surface = commonSurface(scene.world);
    for (const BodyDef& body : scene.world.bodies) add(body, surface);
  }

  void step() override { world_->step(); }

  void read(std::vector<BodySample>& bodies) const override {
    bodies.resize(bodies_.size());
    for (std::size_t i = 0; i < bodies_.size(); ++i) {
      const Eigen::Isometry3d& pose = bodies_[i]->getWorldTransform();
      bodies[i] = {pose.translation(), Quat(pose.linear()), bodies_[i]->getLinearVelocity(),
                   bodies_[i]->getAngularVelocity()};
      if (std::holds_alternative<HalfSpace>(scene_.bodies[i].shape))
        bodies[i] = {scene_.bodies[i].position, scene_.bodies[i].orientation};
    }
  }

 private:
  static constexpr double kGround = 50.0;  // [m] half edge of the box in place of a plane

  static dyn::ShapePtr shapeOf(const BodyDef& body) {
    if (const auto* ball = std::get_if<Sphere>(&body.shape))
      return std::make_shared<dyn::SphereShape>(ball->r);
    const auto* box = std::get_if<Box>(&body.shape);
    return std::make_shared<dyn::BoxShape>(box ? Vec3(2.0 * box->half)
                                               : Vec3(Vec3::Constant(2.0 * kGround)));
  }

  // Its detector knows no planes.
  static Eigen::Isometry3d poseOf(const BodyDef& body) {
    Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
    if (const auto* plane = std::get_if<HalfSpace>(&body.shape)) {
      if (plane->n != Vec3::UnitY()) throw CannotExpress("a plane that leans");
      pose.translation() = Vec3(0.0, plane->d - kGround, 0.0);
    } else {
      pose.linear() = body.orientation.toRotationMatrix();
      pose.translation() = body.position;
    }
    return pose;
  }

  void add(const BodyDef& body, const Surface& surface) {
    const auto skeleton = dyn::Skeleton::create("body" + std::to_string(bodies_.size()));
    const auto [joint, node] = skeleton->createJointAndBodyNodePair<dyn::FreeJoint>();
    auto* shape =
        node->createShapeNodeWith<dyn::CollisionAspect, dyn::DynamicsAspect>(shapeOf(body));
    // Of two it takes the smaller friction and multiplies restitutions.
    shape->getDynamicsAspect()->setFrictionCoeff(surface.friction);
    shape->getDynamicsAspect()->setRestitutionCoeff(std::sqrt(surface.restitution));
    joint->setPositions(dyn::FreeJoint::convertToPositions(poseOf(body)));
    if (body.fixed || std::holds_alternative<HalfSpace>(body.shape)) {
      skeleton->setMobile(false);
    } else {
      const MassProperties properties = massOf(body);
      node->setInertia(dyn::Inertia(properties.mass, Vec3::Zero(), properties.inertia));
      joint->setLinearVelocity(body.velocity);
      joint->setAngularVelocity(body.angularVelocity);
    }
    world_->addSkeleton(skeleton);
    bodies_.push_back(node);
  }

  WorldDef scene_;
  dart::simulation::WorldPtr world_;
  std::vector<dyn::BodyNode*> bodies_;
};

EngineSetup row(const std::string& name, const std::string& why, double erp) {
  return {.engine = "DART",
          .name = name,
          .why = why,
          .asItComes = name == "default",
          .make = [erp](const Scene& scene, double h) {
            return std::make_unique<Dart>(scene, h, erp);
          }};
}

}  // namespace

std::vector<EngineSetup> dartSetups() {
  return {row("default", "with its own detector, which finds faces of boxes", 0.01),
          row("erp 0.2", "overlaps go away faster", 0.2)};
}

}  // namespace tumble::peers
