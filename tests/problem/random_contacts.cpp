#include "tests/problem/random_contacts.h"

#include <algorithm>
#include <cmath>

#include "sim/math/rotation.h"
#include "tests/problem/problems.h"

namespace tumble::test {
namespace {

constexpr int kMostContacts = 24;
constexpr double kLongStep = 1.0 / 60.0;  // s

/// What all contacts of one problem have in common.
struct Scenery {
  bool extreme = false;  ///< masses and edges of very different sizes
  bool impact = false;   ///< restitution, normals upwards, no joints; else v = 0 is allowed
  bool gaps = false;     ///< the bias of some contacts is a gap over the step
  double restitution = 0.0;
  double speed = 1.0;  ///< [m/s] of the random part of vStar
  double mu = -1.0;    ///< of all contacts; < 0: each has its own
};

class Scene {
 public:
  Scene(std::uint64_t seed, Rubbing rubbing) : draw_(seed), rubbing_(rubbing) {}
  Problem make();

 private:
  bool chance(double share) { return draw_(0.0, 1.0) < share; }
  double logUniform(double lo, double hi) { return std::exp(draw_(std::log(lo), std::log(hi))); }
  Vec3 inCube(double size);
  Vec3 direction();
  Vec3 normal();
  void addBody(bool fixed);
  void addFace();
  void addJoint();
  void touch(int a, int b, const Vec3& ra, const Vec3& rb, const Vec3& n, double mu, double gap);
  void rebound(std::size_t firstRow);

  Draw draw_;
  Rubbing rubbing_;
  Scenery scenery_;
  Problem problem_;
  std::vector<Vec3> edges_;  // per body [m]
  std::vector<Quat> turns_;
  int contacts_ = 0;
};

Vec3 Scene::inCube(double size) {
  const double x = draw_(-size, size), y = draw_(-size, size), z = draw_(-size, size);
  return {x, y, z};
}

Vec3 Scene::direction() {
  while (true) {
    const Vec3 v = inCube(1.0);
    if (v.norm() > 0.1 && v.norm() < 1.0) return v.normalized();
  }
}

/// Any direction, one of the axes, or one that is nearly up.
Vec3 Scene::normal() {
  if (chance(0.4)) return Vec3::UnitY();
  if (!scenery_.impact) return direction();
  const double tilt = draw_(0.0, 0.4), turn = draw_(0.0, 6.28);
  return {std::sin(tilt) * std::cos(turn), std::cos(tilt), std::sin(tilt) * std::sin(turn)};
}

/// A box with the inertia tensor of a uniform one.
void Scene::addBody(bool fixed) {
  Vec3 edges;
  for (double& edge : edges) edge = scenery_.extreme ? logUniform(1e-3, 1.0) : draw_(0.2, 1.0);
  const double mass =
      scenery_.extreme ? logUniform(std::pow(10.0, -4.5), std::pow(10.0, 4.5)) : draw_(0.5, 5.0);
  const Vec3 axis = direction();
  const Quat turn = chance(0.5) ? Quat::Identity() : fromAxisAngle(axis, draw_(0.0, 3.0));
  edges_.push_back(edges);
  turns_.push_back(turn);

  const Vec3 squares = edges.cwiseAbs2();
  const Vec3 inertia = mass / 12.0 * (Vec3::Constant(squares.sum()) - squares);
  const Mat3 R = turn.toRotationMatrix();
  const Mat3 Iinv = R * inertia.cwiseInverse().asDiagonal() * R.transpose();
  problem_.invM.push_back(fixed ? 0.0 : 1.0 / mass);
  problem_.Iinv.push_back(fixed ? Mat3(Mat3::Zero()) : Mat3(0.5 * (Iinv + Iinv.transpose())));

  Vec6 twist = Vec6::Zero();
  if (!fixed) {
    const Vec3 v = inCube(scenery_.speed), omega = inCube(3.0 * scenery_.speed);
    twist << v, omega;
    twist[1] -= kG * kLongStep;
  }
  problem_.vStar.push_back(twist);
}

/// One contact; without friction it is a single row, or now and then a cone with mu = 0.
void Scene::touch(int a, int b, const Vec3& ra, const Vec3& rb, const Vec3& n, double mu,
                  double gap) {
  const Vec3 other = std::abs(n.x()) < 0.7 ? Vec3::UnitX() : Vec3::UnitZ();
  const Vec3 t1 = (other - n.dot(other) * n).normalized();
  const std::size_t row = problem_.rows.size();
  if (mu > 0.0 || rubbing_ == Rubbing::None || chance(0.5)) {
    addContact(problem_, a, b, ra, rb, mu, n, t1);
  } else {
    addContact(problem_, a, b, ra, rb, 1.0, n, t1);
    problem_.cones.back().mu = 0.0;
  }
  problem_.rows[row].bias = gap / kLongStep;
  ++contacts_;
}

/// Newton's law: the normal velocity of before comes back times −e.
void Scene::rebound(std::size_t firstRow) {
  std::vector<double> u(problem_.rows.size());
  rowVelocities(problem_, problem_.vStar, u);
  problem_.rows[firstRow].bias = scenery_.restitution * std::min(u[firstRow], 0.0);
}

/// Points that two bodies share in one plane, spread over the smaller one of them.
void Scene::addFace() {
  const int bodies = static_cast<int>(problem_.invM.size());
  int a = draw_.below(bodies), b = draw_.below(bodies);
  if (a < b) std::swap(a, b);
  if (a == b || problem_.invM[a] + problem_.invM[b] == 0.0) return;
  const Vec3 n = normal();
  const double own = scenery_.mu >= 0.0 ? scenery_.mu : draw_(0.0, 2.0);
  const double mu = rubbing_ == Rubbing::None || chance(0.1) ? 0.0 : own;

  // Corners and other places of the smaller box, pressed flat along n; the centre of the larger
  // one stands on the other side, anywhere within its size.
  const bool upper = edges_[a].norm() <= edges_[b].norm();
  const int small = upper ? a : b, large = upper ? b : a;
  const Vec3 out = upper ? Vec3(-n) : n;  // of the small one
  const Vec3 centre = 0.5 * edges_[large].norm() * out + inCube(0.3 * edges_[large].norm());
  const int points = 1 + draw_.below(8);
  for (int k = 0; k < points && contacts_ < kMostContacts; ++k) {
    Vec3 corner;
    for (int axis = 0; axis < 3; ++axis)
      corner[axis] = chance(0.8) ? (chance(0.5) ? 0.5 : -0.5) : draw_(-0.5, 0.5);
    const Vec3 p = turns_[small] * corner.cwiseProduct(edges_[small]);
    const Vec3 arm = p - n.dot(p) * n, near = arm + 0.5 * edges_[small].norm() * out;
    const Vec3 far = arm - centre;
    const double gap = scenery_.gaps && chance(0.5) ? draw_(0.0, 0.02) : 0.0;
    const int copies = chance(0.15) ? 2 : 1;
    for (int copy = 0; copy < copies && contacts_ < kMostContacts; ++copy) {
      const std::size_t row = problem_.rows.size();
      touch(a, b, upper ? near : far, upper ? far : near, n, mu, gap);
      if (scenery_.impact) rebound(row);
    }
  }
}

/// A ball joint or a weld between two bodies, now and then twice over.
void Scene::addJoint() {
  const int bodies = static_cast<int>(problem_.invM.size());
  const int a = draw_.below(bodies), b = draw_.below(bodies);
  if (a == b || problem_.invM[a] + problem_.invM[b] == 0.0) return;
  const Vec3 ra = inCube(0.5 * edges_[a].norm()), rb = inCube(0.5 * edges_[b].norm());
  const bool weld = chance(0.2);
  const int copies = chance(0.1) ? 2 : 1;
  for (int copy = 0; copy < copies; ++copy) {
    for (int k = 0; k < (weld ? 6 : 3); ++k) {
      const Vec3 d = Vec3::Unit(k % 3);
      problem_.cones.push_back({ConeKind::Equality, static_cast<int>(problem_.rows.size()), 0.0});
      problem_.rows.push_back(k < 3 ? pointRow(a, b, ra, rb, d)
                                    : Row{a, b, Vec3::Zero(), d, -d, 0.0});
    }
  }
}

Problem Scene::make() {
  scenery_.extreme = chance(1.0 / 3.0);
  scenery_.impact = chance(0.25);
  scenery_.gaps = chance(0.3);
  if (scenery_.impact) scenery_.restitution = draw_(0.0, 1.0);
  const double speed = draw_(0.0, 1.0);
  scenery_.speed = speed < 0.15 ? 0.0 : logUniform(1e-3, 10.0);
  const double mu = draw_(0.0, 1.0);
  if (mu < 0.4) scenery_.mu = mu < 0.1 ? 0.0 : mu < 0.2 ? 2.0 : draw_(0.05, 1.0);

  // The first body is the ground or hangs free; of the others some are immovable as well.
  const int bodies = 2 + draw_.below(7);
  for (int k = 0; k < bodies; ++k) {
    const bool fixed = chance(k == 0 ? 0.8 : 0.1);
    addBody(fixed && k < bodies - 1 && (k == 0 || !scenery_.impact));
  }
  const int faces = 1 + draw_.below(10);
  for (int k = 0; k < faces || contacts_ == 0; ++k) addFace();
  if (!scenery_.impact && chance(0.4))
    for (int k = 1 + draw_.below(3); k > 0; --k) addJoint();
  return problem_;
}

}  // namespace

Problem randomContacts(std::uint64_t seed, Rubbing rubbing) {
  return Scene(seed, rubbing).make();
}

}  // namespace tumble::test
