// Contacts as constraints: the forces that keep what lasts from giving way.
#include <limits>

#include "sim/contact/rest.h"
#include "sim/method/course/contact_model.h"

namespace tumble {
namespace {

/// Time constant of the pull that keeps lasting contacts at zero, in steps.
constexpr double kPullSteps = 4.0;
constexpr double kNoPull = std::numeric_limits<double>::infinity();

class ConstraintForces : public ContactForces {
 public:
  explicit ConstraintForces(const Model& model) : joints_(model.joints), tau_(pullTime(model)) {}

  void begin(std::span<const Contact> lasting, std::span<const Limit> limits) override {
    contacts_.assign(lasting.begin(), lasting.end());
    limits_.assign(limits.begin(), limits.end());
    rest_ = RestForces();
    pulls_.clear();
  }

  SolveReport apply(std::span<RigidBody> bodies) override {
    for (Contact& c : contacts_) {
      // Between its stages an integrator leaves the sphere of attitudes; points and normals do not.
      for (const int i : {c.a, c.b}) bodies[i].q.normalize();
      follow(bodies[c.a], bodies[c.b], c);
    }
    followJoints(bodies);
    return rest_.apply(bodies, contacts_, &bonds_);
  }

  const std::vector<Contact>& contacts() const override { return contacts_; }
  const Bonds& bonds() const override { return bonds_; }

  double powerTaken(std::span<const RigidBody> bodies) const override {
    double taken = 0.0;
    for (const Contact& c : contacts_)
      if (c.friction > 0.0) taken -= c.force.dot(slipVelocity(bodies[c.a], bodies[c.b], c.point));
    return taken;
  }

  Offers offers(const Offers& free) const override {
    return contacts_.empty() && joints_.empty() ? free : Offers{.split = Split::Rough, .lie = true};
  }

 private:
  // Rows move with the bodies; the pull towards zero stays what it was when the stretch began, as
  // that of contacts does. Between stages an integrator leaves joints by O(h²), so that a pull that
  // followed, with τ ∝ h, would answer by O(1) and leave order 2 of any integrator.
  void followJoints(std::span<const RigidBody> bodies) {
    const bool first = pulls_.empty();
    if (first) {
      restBonds(bodies, joints_, limits_, tau_, bonds_);
      for (const Row& row : bonds_.rows) pulls_.push_back(row.bias);
    }
    restBonds(bodies, joints_, limits_, kNoPull, bonds_);
    for (std::size_t k = 0; k < pulls_.size(); ++k) {
      if (first) pulls_[k] -= bonds_.rows[k].bias;
      bonds_.rows[k].bias += pulls_[k];
    }
  }

  std::vector<Joint> joints_;
  double tau_;
  RestForces rest_;
  std::vector<Contact> contacts_;
  std::vector<Limit> limits_;
  Bonds bonds_;
  std::vector<double> pulls_;  // [m/s²], per row of the joints
};

}  // namespace

double pullTime(const Model& model) {
  return kPullSteps * model.def.course.step;
}

std::unique_ptr<ContactForces> makeConstraintForces(const Model& model) {
  return std::make_unique<ConstraintForces>(model);
}

}  // namespace tumble
