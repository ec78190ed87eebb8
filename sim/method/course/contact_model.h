// How bodies that touch push each other in `course`: by constraints, or by springs.
#pragma once

#include <memory>
#include <span>
#include <string_view>
#include <vector>

#include "sim/contact/contact.h"
#include "sim/joint/joint_bonds.h"
#include "sim/method/model.h"
#include "sim/ode/system.h"
#include "sim/problem/problem.h"

namespace tumble {

/// The forces between bodies that touch, as a part of Y' = f(t, Y).
class ContactForces {
 public:
  virtual ~ContactForces() = default;

  /// Begins a stretch of motion in which these contacts last, or these pairs overlap, and these
  /// limits of joints hold.
  virtual void begin(std::span<const Contact> lasting, std::span<const Limit> limits) = 0;
  /// Finds the forces [N] of this moment and adds them to the bodies, which carry their outer
  /// forces.
  virtual SolveReport apply(std::span<RigidBody> bodies) = 0;
  /// The contacts of the last `apply`, with their forces.
  virtual const std::vector<Contact>& contacts() const = 0;
  /// Rows of joints with the λ of the last `apply`.
  virtual const Bonds& bonds() const = 0;
  /// Power [W] that contacts took from the bodies at the last `apply`, be it stored or lost.
  virtual double powerTaken(std::span<const RigidBody> bodies) const = 0;
  /// What is left of what the bodies offer in free flight.
  virtual Offers offers(const Offers& free) const = 0;
};

/// A row of the table of contact models.
struct ContactModel {
  std::string_view name, summary;
  /// Whether collisions are instants with impulses; if not, forces alone act, while bodies overlap.
  bool impulses;
  std::unique_ptr<ContactForces> (*make)(const Model&);
};

/// All contact models. To add one: write sim/method/course/<name>.cpp and its row in
/// contact_model.cpp.
std::span<const ContactModel> contactModels();
const ContactModel* findContactModel(std::string_view name);

/// Constraints: no contact that lasts may give way, n·p″ ≥ 0 (slides SD47–SD57).
std::unique_ptr<ContactForces> makeConstraintForces(const Model&);

/// Springs and dampers at every point of contact (slide SH10):
///   F = max(0, k d − c vrel) n  on a, −F on b;   d = −separation > 0,  vrel = n·(ṗa − ṗb)
/// with k = course.stiffness [N/m] and c = course.damping [N s/m]. Contacts push only: a damper
/// cannot pull. They store ½ k d² and do not rub. Between two boxes points come, go and wander over
/// the faces, so that the forces have no potential: what they make or take is in the books.
std::unique_ptr<ContactForces> makePenaltyForces(const Model&);

/// Time constant [s] of the pull that keeps lasting contacts at zero: a few steps.
double pullTime(const Model& model);

}  // namespace tumble
