// Chapter 2, elastic: energies of points that something bends joins, one file each, in a table.
// Knows points only: no bodies, no time.
#pragma once

#include <array>
#include <span>
#include <string_view>
#include <variant>

#include "sim/math/vec.h"

namespace tumble {

/// The most points that an element joins; and the most that all but a few kinds do.
inline constexpr int kElementPoints = 8, kFewPoints = 4;

using ElementPlaces = std::array<Vec3, kElementPoints>;  ///< [m] world frame
using ElementVector = Eigen::Matrix<double, 3 * kElementPoints, 1>;
using ElementMatrix = Eigen::Matrix<double, 3 * kElementPoints, 3 * kElementPoints>;
using FewVector = Eigen::Matrix<double, 3 * kFewPoints, 1>;
using FewMatrix = Eigen::Matrix<double, 3 * kFewPoints, 3 * kFewPoints>;

/// What is asked of an element.
enum class ElementAsk {
  Energy,
  Forces,    ///< energy and gradient
  Matrices,  ///< these, the Hessian and the damping
  Projected  ///< the same with a Hessian that has no negative eigenvalue
};

/// What an energy E gives at the places x of its points; of what was not asked for nothing counts,
/// nor do entries of points past those that it joins.
struct ElementTerms {
  double energy = 0.0;                             ///< [J]
  ElementVector gradient = ElementVector::Zero();  ///< [N] ∂E/∂x: the force is −∂E/∂x
  ElementMatrix hessian = ElementMatrix::Zero();  ///< [N/m] ∂²E/∂x², or what is left projected
  ElementMatrix damping = ElementMatrix::Zero();  ///< [N s/m] D ≥ 0: the force is −D v

  /// What is asked for 0, of so many points.
  template <int Points = kFewPoints>
  void clear(ElementAsk ask) {
    constexpr int n = 3 * Points;
    energy = 0.0;
    if (ask == ElementAsk::Energy) return;
    gradient.head<n>().setZero();
    if (ask == ElementAsk::Forces) return;
    hessian.topLeftCorner<n, n>().setZero();
    damping.topLeftCorner<n, n>().setZero();
  }
};

/// A v, of as many points as an element joins.
ElementVector elementTimes(const ElementMatrix& A, const ElementVector& v, int points);

/// Two points on a spring of natural length l₀ [m]:
///   E = ½ k (l − l₀)²,   f = −c l̇ along it beside that.
struct StretchSpring {
  double stiffness = 0.0;  ///< [N/m] k
  double damping = 0.0;    ///< [N s/m] c
  double rest = 0.0;       ///< [m] l₀
};

/// A piece of cloth that was flat, with threads along u and v, and how its corners stretch it:
///   w_u = ∂x/∂u = Σ du_i x_i,   w_v = ∂x/∂v = Σ dv_i x_i.
struct Weave {
  Vec4 du = Vec4::Zero(), dv = Vec4::Zero();  ///< [1/m] per corner
  double area = 0.0;                          ///< [m²]
};

/// The weave of a triangle with corners at (u, v) [m] when flat.
/// @throws std::invalid_argument if it has no area or is turned over (clockwise).
Weave weaveOf(const Eigen::Vector2d& p0, const Eigen::Vector2d& p1, const Eigen::Vector2d& p2);

/// The middle of a rectangle a × b [m] with corners at (0, 0), (a, 0), (0, b), (a, b).
Weave weaveOf(double a, double b);

/// Threads that stretch (Baraff & Witkin, Large Steps in Cloth Simulation, 1998, §4.2):
///   E = ½ k A ((|w_u| − 1)² + (|w_v| − 1)²).
/// Departure: k is per area of strain, so that a strip of width b pulls with k b ε; the paper's is
/// multiplied by the area once more.
struct ClothStretch {
  Weave weave;
  double stiffness = 0.0;  ///< [N/m] k
  double damping = 0.0;    ///< [N s/m] of the rate of both strains
};

/// Threads that lean against each other (ibid., §4.3):  E = ½ k A (w_u·w_v)².
struct ClothShear {
  Weave weave;
  double stiffness = 0.0;  ///< [N/m]
  double damping = 0.0;    ///< [N s/m]
};

/// A second difference of places, which no rigid motion and no even stretch gives:
///   E = ½ k |Σ c_i x_i|²,   Σ c_i = 0.
/// On a grid of threads a and b apart it is bending: with c = (1, −2, 1) and k = κ b/a³ along a
/// thread, c = (1, −1, −1, 1) and k = 2 κ/(a b) of the twist of a cell, the sum is the energy of a
/// plate whose Poisson's ratio is 0,  ½ κ ∫ (|x_uu|² + 2 |x_uv|² + |x_vv|²) du dv. Its Hessian is
/// constant and has no negative eigenvalue (Bergou et al., A Quadratic Bending Model for
/// Inextensible Surfaces, 2006).
struct ClothBend {
  Vec4 difference = Vec4::Zero();  ///< [1] c
  double stiffness = 0.0;          ///< [N/m] k
};

/// The turn between two neighbouring pieces of a strand, with unit tangents t₀ and t₁:
///   E = (B/l) (1 − t₀·t₁) = ½ B/l |t₁ − t₀|²,
/// where |t₁ − t₀|/l is the discrete curvature (Bergou et al., Discrete Elastic Rods, 2008, §4.1,
/// whose 2 tan(φ/2) is 2 sin(φ/2) here: finite when the strand folds back). No twist.
struct StrandBend {
  double stiffness = 0.0;  ///< [N m²] B
  double length = 1.0;     ///< [m] l: half of both pieces when straight
};

/// A tetrahedron at rest: F = Σ x_i gradient_iᵀ is its deformation.
struct Cell {
  std::array<Vec3, 4> gradient = {};  ///< [1/m] of the shape functions
  double volume = 0.0;                ///< [m³]
};

/// @throws std::invalid_argument if it has no volume or is inside out.
Cell cellOf(const std::array<Vec3, 4>& corners);

/// An isotropic solid with Lamé's constants [Pa] and a viscosity [Pa s] that resists the rate of
/// Green's strain, ½ d(FᵀF)/dt.
struct Solidity {
  double mu = 0.0, lambda = 0.0;
  double viscosity = 0.0;
};

/// μ = E/2(1+ν), λ = Eν/(1+ν)(1−2ν).
/// @throws std::invalid_argument unless E > 0 and 0 ≤ ν < ½.
Solidity solidityOf(double young, double poisson, double viscosity = 0.0);

/// Corotational solid, with the rotation R of the polar decomposition F = R S:
///   Ψ = μ |F − R|² + ½ λ tr²(S − 1).
/// Linear in the stretches; finite, and resisting, when it is turned inside out.
struct Corotated {
  Cell cell;
  Solidity solid;
};

/// Neo-Hookean solid that may be turned inside out (Smith, de Goes & Kim, Stable Neo-Hookean Flesh
/// Simulation, 2018, (13), without the barrier):
///   Ψ = ½ μ (|F|² − 3) − μ (J − 1) + ½ (λ + μ) (J − 1)²,   J = det F.
struct NeoHookean {
  Cell cell;
  Solidity solid;
};

/// A cell of a box, whose corners are drawn to where its shape at rest, moved and turned, fits them
/// best (Müller et al., Meshless Deformations Based on Shape Matching, 2005), by a potential in
/// place of their velocities: with s the signs of the corners' places (±h₀, ±h₁, ±h₂) at rest,
///   E = min over R of  μ V |F − R|² + ½ Σ κ_m |x_m|²,   F = Σ x_i s_iᵀ/8h,
/// where x_m = ⅛ Σ s_m x_i are the four ways of the corners that F does not see, s_m products of
/// two or three signs, and κ_m = 2 μ V times the mean of 1/h² of these. Of a cube that is ½ k Σ
/// |x_i − c − R q_i|²  with k = 2 μ h and c the mean of the x_i. Departure: of cells that are no
/// cubes each way has its own k, so that E/2 = μ holds along all; forces in place of goals. A solid
/// whose Poisson's ratio is 0. Corners are numbered by bits: 1 along x, 2 along y, 4 along z.
struct ShapeMatch {
  Vec3 half = Vec3::Ones();  ///< [m] h: of the edges
  double mu = 0.0;           ///< [Pa] half of Young's modulus
  double viscosity = 0.0;    ///< [Pa s] of F, as of other solids; the four ways have none
};

/// Cloth that presses on cloth: a point on a triangle (points 1 to 3), d apart,
///   E = ½ k (t − d)²  for d < t, else 0,
/// d the least distance of the two. Projected, its Hessian is k ∇d ∇dᵀ, without what the turn of ∇d
/// gives.
struct ClothPoint {
  double stiffness = 0.0;  ///< [N/m] k
  double thickness = 0.0;  ///< [m] t: half of each cloth's
};

/// The same of two edges of cloth: points 0 and 1, 2 and 3.
struct ClothEdges {
  double stiffness = 0.0;  ///< [N/m]
  double thickness = 0.0;  ///< [m]
};

/// Where two pieces of cloth are nearest to each other: Σ w_i x_i leads from the second to the
/// first. The w_i of each add up to 1 and −1.
struct ClothGap {
  Vec4 weight = Vec4::Zero();  ///< w; exactly 0 of points that do not matter
  Vec3 span = Vec3::Zero();    ///< [m]
  /// How w changes where the two slide along each other: on an edge one way, on a triangle two.
  Eigen::Matrix<double, 4, 2> slide = Eigen::Matrix<double, 4, 2>::Zero();
  int ways = 0;
};

/// Of point 0 and the triangle of the others; of edges 0-1 and 2-3 (Ericson, Real-Time Collision
/// Detection, 2005, §5.1.5, §5.1.9). Of parallel edges it is one of many.
ClothGap nearestOnTriangle(const std::array<Vec3, 4>& x);
ClothGap nearestOfEdges(const std::array<Vec3, 4>& x);

using Energy = std::variant<StretchSpring, ClothStretch, ClothShear, ClothBend, StrandBend,
                            Corotated, NeoHookean, ShapeMatch, ClothPoint, ClothEdges>;

/// A row of the table of energies, in the order of the variant.
struct EnergyKind {
  std::string_view name;
  std::string_view summary;
};
std::span<const EnergyKind> energyKinds();

/// What the energy gives with its points at x; the terms are overwritten.
void differentiate(const StretchSpring&, const ElementPlaces& x, ElementAsk, ElementTerms&);
void differentiate(const ClothStretch&, const ElementPlaces& x, ElementAsk, ElementTerms&);
void differentiate(const ClothShear&, const ElementPlaces& x, ElementAsk, ElementTerms&);
void differentiate(const ClothBend&, const ElementPlaces& x, ElementAsk, ElementTerms&);
void differentiate(const StrandBend&, const ElementPlaces& x, ElementAsk, ElementTerms&);
void differentiate(const Corotated&, const ElementPlaces& x, ElementAsk, ElementTerms&);
void differentiate(const NeoHookean&, const ElementPlaces& x, ElementAsk, ElementTerms&);
void differentiate(const ShapeMatch&, const ElementPlaces& x, ElementAsk, ElementTerms&);
void differentiate(const ClothPoint&, const ElementPlaces& x, ElementAsk, ElementTerms&);
void differentiate(const ClothEdges&, const ElementPlaces& x, ElementAsk, ElementTerms&);
void differentiate(const Energy&, const ElementPlaces& x, ElementAsk, ElementTerms&);

}  // namespace tumble
