#include "sim/joint/swing.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "sim/joint/joint_bonds.h"

namespace tumble {
namespace {

/// K, and what moves against it. Twists are per body, the last one the world.
class Stiffness {
 public:
  Stiffness(std::span<const RigidBody> bodies, std::span<const Joint> joints,
            std::span<const JointForce> forces, SwingWork& work);

  /// [1/s²] No frequency's square is above this, whatever holds the bodies.
  double bound() const;
  /// M⁻¹ K v, into `force`.
  void pull(std::span<const Vec6> v, std::vector<Vec6>& force) const;
  /// vᵀ M v [J]
  double square(std::span<const Vec6> v) const;
  bool turns(std::size_t body) const { return !bodies_[body].fixed() && !bodies_[body].particle; }

 private:
  void add(int body, const Vec3& force, const Vec3& r);

  std::span<const RigidBody> bodies_;
  std::vector<Mat3>& turn_;
  std::vector<Tension>& tensions_;
};

Stiffness::Stiffness(std::span<const RigidBody> bodies, std::span<const Joint> joints,
                     std::span<const JointForce> forces, SwingWork& work)
    : bodies_(bodies), turn_(work.turn), tensions_(work.tensions) {
  turn_.assign(bodies.size(), Mat3::Zero());
  tensions_.clear();
  for (std::size_t k = 0; k < joints.size(); ++k) {
    const Joint& joint = joints[k];
    const Vec3& force = forces[k].force;
    const RigidBody &a = bodies[joint.a], &b = partner(bodies, joint.b);
    const Vec3 ra = a.R * joint.anchorA_B, rb = b.R * joint.anchorB_B;
    add(joint.a, force, ra);
    add(joint.b, -force, rb);
    if (joint.kind != JointKind::Distance) continue;
    const Vec3 rod = a.x + ra - b.x - rb;
    const double length = rod.norm();
    if (length == 0.0) continue;
    const Vec3 d = rod / length;
    const Mat3 across = Mat3::Identity() - d * d.transpose();
    tensions_.push_back({joint.a, joint.b, ra, rb, -force.dot(d) / length * across});
  }
}

void Stiffness::add(int body, const Vec3& force, const Vec3& r) {
  if (body >= static_cast<int>(bodies_.size())) return;
  const Mat3 mixed = force * r.transpose();
  turn_[body] += force.dot(r) * Mat3::Identity() - 0.5 * (mixed + mixed.transpose());
}

double Stiffness::bound() const {
  double most = 0.0, rods = 0.0;
  for (std::size_t i = 0; i < bodies_.size(); ++i)
    if (turns(i)) most = std::max(most, (bodies_[i].Iinv * turn_[i]).norm());
  for (const Tension& rod : tensions_) {
    double yield = 0.0;  // what a unit force at the ends moves, at most
    for (const auto& [i, r] : {std::pair(rod.a, rod.ra), std::pair(rod.b, rod.rb)}) {
      if (i >= static_cast<int>(bodies_.size()) || bodies_[i].fixed()) continue;
      yield += bodies_[i].invM + (turns(i) ? r.squaredNorm() * bodies_[i].Iinv.norm() : 0.0);
    }
    rods += rod.across.norm() * yield;
  }
  return most + rods;
}

void Stiffness::pull(std::span<const Vec6> v, std::vector<Vec6>& force) const {
  force.assign(v.size(), Vec6::Zero());
  for (std::size_t i = 0; i < bodies_.size(); ++i)
    if (turns(i)) force[i].tail<3>() = turn_[i] * v[i].tail<3>();
  for (const Tension& rod : tensions_) {
    const Vec3 slip = v[rod.a].head<3>() + v[rod.a].tail<3>().cross(rod.ra) - v[rod.b].head<3>() -
                      v[rod.b].tail<3>().cross(rod.rb);
    const Vec3 f = rod.across * slip;
    force[rod.a].head<3>() += f;
    force[rod.a].tail<3>() += rod.ra.cross(f);
    force[rod.b].head<3>() -= f;
    force[rod.b].tail<3>() -= rod.rb.cross(f);
  }
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    force[i].head<3>() *= bodies_[i].invM;
    force[i].tail<3>() = turns(i) ? Vec3(bodies_[i].Iinv * force[i].tail<3>()) : Vec3(Vec3::Zero());
  }
  force.back().setZero();
}

double Stiffness::square(std::span<const Vec6> v) const {
  double sum = 0.0;
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    const RigidBody& body = bodies_[i];
    if (body.fixed()) continue;
    sum += body.M * v[i].head<3>().squaredNorm();
    if (!body.particle) {
      const Vec3 omega_B = body.R.transpose() * v[i].tail<3>();
      sum += omega_B.dot(body.Ibody * omega_B);
    }
  }
  return sum;
}

/// ω² by power iteration: of M⁻¹ K v the part that all joints allow, in the metric of the masses.
double squareOfFastest(std::span<const RigidBody> bodies, std::span<const Joint> joints,
                       const Stiffness& K, const Solver& solver, SwingWork& work) {
  constexpr int kRounds = 8;
  constexpr double kTolerance = 1e-6;
  beginAllowedVelocities(bodies, joints, work.bonds, work.problem);
  work.v.assign(bodies.size() + 1, Vec6::Zero());
  for (std::size_t i = 0; i < bodies.size(); ++i)  // nothing that symmetry would leave out
    if (!bodies[i].fixed())
      for (int k = 0; k < 6; ++k) work.v[i][k] = std::sin(1.0 + static_cast<double>(6 * i + k));
  double square = 0.0;
  for (int round = 0; round < kRounds; ++round) {
    K.pull(work.v, work.problem.vStar);
    work.solution.lambda.clear();
    work.solution.v.clear();
    solveByIslands(solver, work.problem, {.tolerance = kTolerance, .maxIterations = 200},
                   work.solution);
    std::swap(work.v, work.solution.v);
    const double size = std::sqrt(K.square(work.v));
    if (!(size > 0.0)) return 0.0;
    if (round > 0) square = size;
    for (Vec6& part : work.v) part /= size;
  }
  return square;
}

}  // namespace

double fastestSwing(std::span<const RigidBody> bodies, std::span<const Joint> joints,
                    std::span<const JointForce> forces, const Solver& solver, double atLeast,
                    Swing& last, SwingWork& work) {
  constexpr double kChange = 1.25;
  const Stiffness K(bodies, joints, forces, work);
  const double bound = K.bound();
  if (bound < atLeast * atLeast) return 0.0;
  if (bound > kChange * last.bound || last.bound > kChange * bound)
    last = {bound, squareOfFastest(bodies, joints, K, solver, work)};
  return std::sqrt(last.square * bound / last.bound);
}

}  // namespace tumble
