// Chapter 6, problem: the augmented Lagrangian of a contact problem, its gradient and its Newton
// steps. Used by newton.cpp alone.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "sim/problem/block_cholesky.h"
#include "sim/problem/problem.h"

namespace tumble {

using Mat63 = Eigen::Matrix<double, 6, 3>;

/// Which smooth piece of Π_K a multiplier lies on.
enum class Piece : signed char { Zero, Whole, Edge };

/// A cone between the bodies that move, with all that belongs to it.
struct Point {
  ConeKind kind = ConeKind::Push;
  int rows = 1;
  int a = -1, b = -1;  ///< of the moving bodies; −1: does not move
  int edge = -1;       ///< if both move: their block off the diagonal
  double mu = 0.0;
  double muTrue = 0.0;  ///< what mu is but in narrowed cones
  double length = 1.0;  ///< what the rows of a turn are multiplied with, to be in m/s
  double mobility = 0.0;
  Mat63 Ja = Mat63::Zero(), Jb = Mat63::Zero();  ///< u = Jaᵀ va + Jbᵀ vb + bias
  Vec3 bias = Vec3::Zero();
  Vec3 lambda = Vec3::Zero();  ///< of the last stage
  double saxce = 0.0;          ///< mu |u_t| of the last stage
  Vec3 u = Vec3::Zero(), du = Vec3::Zero();
  Vec3 force = Vec3::Zero();  ///< Π_K(λ − ρ(u + s))
  Piece piece = Piece::Zero, factored = Piece::Zero;
};

/// Bodies that move.
struct Mover {
  int body = 0;
  bool moves = true, turns = true;
  double mass = 1.0;                                               ///< [kg]
  Mat3 inertia = Mat3::Identity(), inertiaInv = Mat3::Identity();  ///< [kg m²] and its inverse
  Vec6 star, v, gradient, step;
};

/// Φ of solvers.h (solveNewton) at the velocities that its movers carry, for the λ, s and ρ of a
/// stage.
class NewtonSystem {
 public:
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
  /// Friction cones narrower than they are, until `widen`: forces that stick come to lie inside the
  /// true ones wherever others can take what that leaves, and none on the edge between two pieces.
  void narrow();
  /// True cones for all that slips at this speed [m/s] or faster.
  /// @return whether any was narrow
  bool widen(double slip);
  /// One stage more by the last factor alone, forces on the pieces that it was made for. False
  /// where there is no factor for this ρ.
  bool stageMore();
  void loosen(double f);
  /// λ becomes the forces; and s = mu |u_t|, if asked for.
  void nextStage(bool renewSlip);
  /// s = mu |u_t| at v (de Saxcé).
  void takeSlip();
  /// λ and v as a stage began with.
  void goBack(const std::vector<Point>& points, const std::vector<Mover>& movers);

  double residual() const;  ///< as naturalResidual
  double balance();         ///< as SolveReport::balance

  double weight = 1.0;  ///< [kg] what ρ is measured by: a quarter of all masses
  double rho = 1.0;     ///< [kg]
  double scale = 1.0;   ///< [m/s] velocityScale
  int factorizations = 0;
  std::vector<Mover> movers;
  std::vector<Point> points;

 private:
  void addMovers(const Problem& problem);
  void addPoints(const Problem& problem);
  void linkBodies();
  const BlockStructure& structureFor(int rows, std::span<const BlockEdge> edges);

  void project(Point& point, const Vec3& z) const;
  template <class Find>
  void gather(const Find& find);
  void evaluate();
  template <class Factor>
  void beginMasses(Factor& factor);
  Piece guess(const Point& point) const;
  bool factorFits() const;
  void assemble();
  void assembleLive();
  template <class Factor>
  double direction(Factor& factor);
  double slopeAt(double alpha);
  double slopeHere() const;
  void move(double alpha);
  bool searchLine();
  double merit() const;
  void shorten();

  std::vector<int> moverOf_;
  std::vector<BlockEdge> edges_;
  std::vector<std::unique_ptr<BlockStructure>> structures_;
  const BlockStructure* structure_ = nullptr;
  BlockCholesky H_;
  BlockLU live_;
  std::vector<Vec6> work_;
  double factoredRho_ = 0.0;
  bool guess_ = false;  ///< the first step of all goes by what contacts are expected to do
};

}  // namespace tumble
