// Chapter 3, body: how a body turns while nothing twists it, as a product of rotations.
#pragma once

#include "sim/math/vec.h"

namespace tumble {

/// The turn of a rigid body with constant angular momentum L, split in two that each have a closed
/// form:  ½ L·I⁻¹L  is the energy of a symmetric body, whose two nearest inverse moments are taken
/// for equal, and the rest ½ (1/I_j − 1/I_i) (e_j·L)², a rotation about one body axis.
///   rest h/2 · symmetric body h · rest h/2
/// Of second order, symplectic and symmetric in time; exact for a body with two equal moments
/// (Dullweber, Leimkuhler and McLachlan, Symplectic splitting methods for rigid body molecular
/// dynamics, 1997; Fassò, Comparison of splitting algorithms for the rigid body, 2003).
class FreeTurn {
 public:
  /// @param IbodyInv  [1/(kg m²)] inverse inertia tensor, body frame
  explicit FreeTurn(const Mat3& IbodyInv);

  /// The attitude after h [s], from q and the angular momentum L [kg m²/s], world frame.
  Quat operator()(const Quat& q, const Vec3& L, double h) const;

  /// True if two moments are equal to rounding, so that the turn is exact.
  bool exact() const { return rest_ == 0.0; }

 private:
  Quat axes_ = Quat::Identity();  ///< principal frame to body frame
  int restAxis_ = 0, topAxis_ = 0;
  double round_ = 0.0;  ///< [1/(kg m²)] inverse moment across the axis of the symmetric body
  double top_ = 0.0;    ///< [1/(kg m²)] what its axis has more than that
  double rest_ = 0.0;   ///< [1/(kg m²)] what the axis of the rest has more than that
};

}  // namespace tumble
