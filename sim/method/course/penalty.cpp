// The penalty method: bodies may sink into each other, and are pushed out the harder the deeper.
#include <algorithm>

#include "sim/method/course/contact_model.h"
#include "sim/method/method.h"

namespace tumble {
namespace {

class PenaltyForces : public ContactForces {
 public:
  explicit PenaltyForces(const Model& model) : model_(model) {}

  // A stretch ends where another pair begins to overlap.
  void begin(std::span<const Contact> touching, std::span<const Limit>) override {
    pairs_.clear();
    for (const Contact& c : touching)
      if (pairs_.empty() || pairs_.back() != std::pair(c.b, c.a)) pairs_.emplace_back(c.b, c.a);
  }

  SolveReport apply(std::span<RigidBody> bodies) override {
    findOverlaps(bodies);
    for (Contact& c : contacts_) {
      RigidBody &a = bodies[c.a], &b = bodies[c.b];
      const double depth = -c.point.separation;
      const double push = model_.def.course.stiffness * depth -
                          model_.def.course.damping * approachVelocity(a, b, c.point);
      c.force = std::max(0.0, push) * c.point.n;
      c.energy = 0.5 * model_.def.course.stiffness * depth * depth;
      applyForce(a, c.point.p, c.force);
      applyForce(b, c.point.p, -c.force);
    }
    return {};
  }

  const std::vector<Contact>& contacts() const override { return contacts_; }
  const Bonds& bonds() const override { return none_; }

  double powerTaken(std::span<const RigidBody> bodies) const override {
    double taken = 0.0;
    for (const Contact& c : contacts_)
      taken -= c.force.dot(c.point.n) * approachVelocity(bodies[c.a], bodies[c.b], c.point);
    return taken;
  }

  Offers offers(const Offers& free) const override {
    const bool dampers = model_.def.course.damping > 0.0;
    return {.split = dampers && free.split != Split::None ? Split::Rough : free.split,
            .lie = free.lie};
  }

 private:
  void findOverlaps(std::span<const RigidBody> bodies) {
    contacts_.clear();
    for (const auto& pair : pairs_) findContacts(model_, bodies, pair, 0.0, contacts_);
    for (Contact& c : contacts_) c.lasting = true;
  }

  const Model& model_;
  std::vector<std::pair<int, int>> pairs_;  ///< (b, a), each once
  std::vector<Contact> contacts_;
  Bonds none_;
};

}  // namespace

std::unique_ptr<ContactForces> makePenaltyForces(const Model& model) {
  return std::make_unique<PenaltyForces>(model);
}

}  // namespace tumble
