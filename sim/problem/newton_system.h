// Chapter 6, problem: the augmented Lagrangian of a contact problem, its gradient and its Newton
// steps. Used by newton.cpp alone.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "sim/problem/block_cholesky.h"
#include "sim/problem/problem.h"

namespace tumble {

/// Which smooth piece of Π_K a multiplier lies on.
enum class Piece : signed char { Zero, Whole, Edge };

/// Φ of solvers.h (solveNewton) at the velocities that its movers carry, for the λ, s and ρ of a
/// stage. N is 6, or 3 where no row turns a body: then twists are linear velocities alone.
template <int N>
class NewtonSystem {
 public:
  using Twist = Eigen::Matrix<double, N, 1>;
  using Rows = Eigen::Matrix<double, N, 3>;
  using Block = Eigen::Matrix<double, N, N>;

  /// A cone.
  struct Point {
    ConeKind kind = ConeKind::Push;
    Piece piece = Piece::Zero, factored = Piece::Zero, pressed = Piece::Zero;
    int rows = 1;
    double mu = 0.0;
    double muTrue = 0.0;  ///< what mu is but in narrowed cones
    double length = 1.0;  ///< what the rows of a turn are multiplied with, to be in m/s
    double mobility = 0.0;
    double compliance = 0.0;                          ///< [1/kg] of an Equality
    double saxce = 0.0;                               ///< mu |u_t| of the last stage
    Rows J = Rows::Zero();                            ///< of body a of its patch
    Vec3 bias = Vec3::Zero(), lambda = Vec3::Zero();  ///< λ of the last stage
    Vec3 u = Vec3::Zero(), du = Vec3::Zero();         ///< without what compliance adds
    Vec3 force = Vec3::Zero();                        ///< Π_K(λ − ρ(u + s))
    Vec3 sum = Vec3::Zero();                          ///< −Σ ρ u of the stages that are over
    double slip = 0.0;         ///< [m/s] of the stage before, under the law of springs
    Vec3 pull = Vec3::Zero();  ///< z under the law of springs, as it was or is expected to be
  };

  /// Body that moves.
  struct Mover {
    int body = 0;
    bool moves = true, turns = true;
    double mass = 1.0;                                               ///< [kg]
    Mat3 inertia = Mat3::Identity(), inertiaInv = Mat3::Identity();  ///< [kg m²] and its inverse
    Twist origin;  ///< what star and v are measured from: vStar where bodies are coupled, else 0
    Twist star, v, gradient, step;

    /// M times a twist.
    Twist momentum(const Twist& twist) const;
  };

  /// Reads the problem. λ = 0, v = vStar.
  void prepare(const Problem& problem);
  /// λ = 0, v as in `start`, s = mu |u_t| at v.
  void restart(const Solution& start);
  void write(const Problem& problem, Solution& solution) const;

  /// u, forces and gradient at v; with `slipFollows` s follows u.
  void look(bool slipFollows = false);
  /// Minimises Φ by at most that many steps, until one changes no row by more than `accuracy`
  /// [m/s].
  bool minimise(double accuracy, int most);
  /// The same where s = mu |u_t| follows v, so that there is no Φ, only its gradient to bring to 0.
  bool followSlip(double accuracy, int most);
  /// v becomes what the forces give, v* + A⁻¹ Jᵀ λ: one factor of A.
  void obey();
  /// The factor of A + ρ JᵀJ, where no cone cuts a force.
  void factorUncut();
  /// v where A (v − vStar) = Jᵀ (λ − ρ (u + s)), forces that no cone cuts, by factorUncut's factor.
  void goUncut();
  /// One stage more by the last factor alone, forces on the pieces that it was made for. False
  /// where there is no factor for this ρ.
  bool stageMore();

  // newton_springs.cpp: of many λ, those of springs; see solveNewton.
  /// Whether the forces are those of springs, under whatever motion.
  bool areOfSprings() const;
  /// v, and forces as they are in `answer`.
  void take(const Problem& problem, const Solution& answer);
  /// Where forces of springs are expected: as Solution::pull. NaN: not known.
  void expect(const Problem& problem, std::span<const double> pull);
  /// Looks for the forces of springs, at first near those of now. @return the residual
  double findSprings(double tolerance);
  /// The same near those that are expected, if any are, and nowhere else. @return the residual or ∞
  double expectSprings(double tolerance);

  /// Friction cones narrower than they are, until `widen`: forces that stick come to lie inside the
  /// true ones wherever others can take what that leaves, and none on the edge between two pieces.
  void narrow();
  /// True cones for all that slips at this speed [m/s] or faster.
  /// @return whether any was narrow
  bool widen(double slip);
  /// λ becomes the forces, and s goes that part of the way to mu |u_t| at v (de Saxcé).
  void nextStage(double slipPart);
  /// λ and v as a stage began with.
  void goBack(const std::vector<Point>& points, const std::vector<Mover>& movers);

  bool rubs() const { return rubs_; }  ///< whether a contact has friction
  bool slides() const;                 ///< whether one of these slips, by more than a little
  bool couples() const {
    return !couplings_.empty();
  }                         ///< whether bodies are coupled by more than M
  double residual() const;  ///< as naturalResidual
  double balance();         ///< as SolveReport::balance

  double weight = 1.0;  ///< [kg] what ρ is measured by: a quarter of all masses
  double rho = 1.0;     ///< [kg]
  double scale = 1.0;   ///< [m/s] velocityScale
  int factorizations = 0;
  std::vector<Mover> movers;
  std::vector<Point> points;

 private:
  using Three = std::array<double, 3>;

  /// Points, one after the other, between the same two bodies. Where rows act on b as on a but for
  /// the arm, they share the relative twist  w = va − X vb  of the bodies at the centre of a, by
  /// which  u = Jᵀ w + bias.
  struct Patch {
    int a = -1, b = -1;  ///< movers; −1: does not move, b before a
    int begin = 0, end = 0;
    int edge = -1;  ///< if both move: their block off the diagonal
    bool aIsRow = true;
    bool shares = true;
    int other = 0;            ///< where not: place of the J of b of its point in `others_`
    Vec3 arm = Vec3::Zero();  ///< [m] from the centre of b to that of a
  };

  /// A block of K between two movers: row i, column j.
  struct Link {
    int i = 0, j = 0;
    int edge = -1;  ///< their block off the diagonal, if they are two
    bool iIsRow = true;
    Mat3 block;
  };

  // newton_system.cpp
  void addMovers(const Problem& problem);
  void addPoints(const Problem& problem);
  void addCouplings(const Problem& problem);
  double split(const Problem& problem, int body, Vec6& J, double& bias) const;
  double alongOrigin(int body, const Vec6& J) const;
  Rows readRows(const Problem& problem, const Cone& cone, Point& point) const;
  void place(int point, int a, int b, const Rows& ofB);
  void linkBodies();

  /// Gives `take` the movers i and j of every block of K, with what it makes of a motion of j:
  /// both ways, and once on the diagonal.
  template <class MotionOf, class Take>
  void forCoupled(const MotionOf& motionOf, const Take& take) const {
    for (const Link& link : couplings_) {
      take(link.i, Vec3(link.block * motionOf(link.j)));
      if (link.i != link.j) take(link.j, Vec3(link.block.transpose() * motionOf(link.i)));
    }
  }

  // newton_hessian.cpp
  template <class Factor>
  void beginMasses(Factor& factor);
  void guessPieces();
  void assemble();
  void assembleLive();
  Mat3 liveSlope(const Point& point) const;
  template <class Factor>
  void addAlone(Factor& factor, const Patch& patch, const Point& point, const Mat3& slope);

  // newton_step.cpp
  void takeSlip(double part);
  void takeRows();
  void project(Point& point, const Vec3& z) const;
  template <class Find>
  void gather(const Find& find);
  void evaluate();
  void evaluateAsIs();
  template <class Factor>
  double direction(Factor& factor);
  double slopeAt(double alpha);
  double slopeHere() const;
  void move(double alpha);
  bool searchLine();
  bool factorFits() const;
  double merit() const;
  bool shorten();

  // newton_springs.cpp
  Piece ofSpring(const Point& point, const Vec3& z, Vec3& force) const;
  Mat3 slopeOfSpring(const Point& point, const Vec3& z) const;
  void loosen();
  void startPressed();
  bool climb();
  bool press(int most);
  double pressOn(double tolerance);
  double endSprings(bool found, double tolerance);
  void nextPress();
  void closePress();
  void assemblePressed();
  bool springsFit() const;

  // What follows goes number by number: numbers that are written so and read in pairs, as vectors
  // are, would be waited for.

  /// Gives `take` each point with Jᵀ of the twists of its bodies.
  template <class Take>
  void forRows(Twist Mover::*twist, const Take& take) {
    for (const Patch& patch : patches_) {
      Twist w = Twist::Zero();
      if (patch.a >= 0) w = movers[patch.a].*twist;
      if (patch.b >= 0 && patch.shares) subtractAtCentreOfA(patch, movers[patch.b].*twist, w);
      for (int p = patch.begin; p < patch.end; ++p) {
        Three rows = timesRows(points[p], points[p].J, w);
        if (!patch.shares) {
          const Three more = timesRows(points[p], others_[patch.other], movers[patch.b].*twist);
          for (int k = 0; k < 3; ++k) rows[k] += more[k];
        }
        take(points[p], rows);
      }
    }
  }

  /// Part of λ − ρ u that a compliant row takes:  λ⁺ = (λ − ρ u)/(1 + ρ C).
  double yielding(const Point& point) const { return 1.0 / (1.0 + rho * point.compliance); }
  /// Jᵀ v.
  static Three timesRows(const Point& point, const Rows& J, const Twist& v) {
    const auto dot = [&](int k) {
      const double* row = J.data() + k * N;
      if constexpr (N == 3) return row[0] * v[0] + row[1] * v[1] + row[2] * v[2];
      return (row[0] * v[0] + (row[2] * v[2] + row[4] * v[4])) +
             (row[1] * v[1] + (row[3] * v[3] + row[5] * v[5]));
    };
    if (point.rows == 1) return {dot(0), 0.0, 0.0};
    return {dot(0), dot(1), dot(2)};
  }
  static void set(Vec3& force, double normal, double along, double across) {
    force[0] = normal;
    force[1] = along;
    force[2] = across;
  }
  /// J times the force.
  static Twist timesForce(const Point& point, const Rows& J) {
    if (point.rows == 1) return J.col(0) * point.force[0];
    return J.lazyProduct(point.force);
  }
  /// w −= X vb.
  static void subtractAtCentreOfA(const Patch& patch, const Twist& v, Twist& w) {
    if constexpr (N == 6) {
      const Vec3& arm = patch.arm;
      w[0] -= v[0] + (v[4] * arm[2] - v[5] * arm[1]);
      w[1] -= v[1] + (v[5] * arm[0] - v[3] * arm[2]);
      w[2] -= v[2] + (v[3] * arm[1] - v[4] * arm[0]);
      for (int i = 3; i < 6; ++i) w[i] -= v[i];
    } else {
      w -= v;
    }
  }
  /// sum += Xᵀ times a wrench at the centre of a, the same about the centre of b.
  static void addAtCentreOfB(const Patch& patch, const Twist& wrench, Twist& sum) {
    if constexpr (N == 6) {
      const Vec3& arm = patch.arm;
      for (int i = 0; i < 3; ++i) sum[i] += wrench[i];
      sum[3] += wrench[3] + (arm[1] * wrench[2] - arm[2] * wrench[1]);
      sum[4] += wrench[4] + (arm[2] * wrench[0] - arm[0] * wrench[2]);
      sum[5] += wrench[5] + (arm[0] * wrench[1] - arm[1] * wrench[0]);
    } else {
      sum += wrench;
    }
  }

  std::vector<int> moverOf_;
  std::vector<Patch> patches_;
  std::vector<Link> couplings_;
  std::vector<Rows> others_;
  std::vector<BlockEdge> edges_;
  BlockStructures structures_;
  const BlockStructure* structure_ = nullptr;
  BlockCholesky<N> H_;
  BlockLU<N> live_;
  std::vector<Twist> work_;
  double factoredRho_ = 0.0, pressedRho_ = 0.0;
  bool guess_ = false;  ///< the first step of all goes by what contacts are expected to do
  bool rubs_ = false;
  bool expects_ = false;  ///< pulls of some points are known
  bool pulled_ = false;   ///< pulls are those of the answer
  bool springs_ = false;  ///< the law of springs takes the place of Π_K
};

}  // namespace tumble
