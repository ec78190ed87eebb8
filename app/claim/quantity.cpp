#include "app/claim/quantity.h"

#include <algorithm>
#include <limits>

#include "app/claim/free_body.h"
#include "app/scene/findings.h"

namespace tumble {

namespace {

const BodySample& bodyOf(const Instant& at) {
  return at.sample.bodies[static_cast<std::size_t>(at.body)];
}

template <int axis>
double place(const Instant& at) {
  return bodyOf(at).x[axis];
}

template <int axis>
double velocity(const Instant& at) {
  return bodyOf(at).v[axis];
}

template <int axis>
double spin(const Instant& at) {
  return bodyOf(at).omega[axis];
}

template <int axis>
double momentum(const Instant& at) {
  return bodyMass(at.scene.world.bodies[static_cast<std::size_t>(at.body)]) * bodyOf(at).v[axis];
}

template <int axis>
double turning(const Instant& at) {
  return angularMomentum(at.inertia, bodyOf(at).q, bodyOf(at).omega)[axis];
}

Vec3 contactForce(const Instant& at) {
  Vec3 sum = Vec3::Zero();
  for (const ContactSample& contact : at.sample.contacts) {
    if (contact.a == at.body) sum += contact.force;
    if (contact.b == at.body) sum -= contact.force;
  }
  return sum;
}

template <int axis>
double force(const Instant& at) {
  return contactForce(at)[axis];
}

template <int axis>
double jointForce(const Instant& at) {
  double sum = 0.0;
  for (const JointForce& joint : at.sample.joints) {
    if (joint.a == at.body) sum += joint.force[axis];
    if (joint.b == at.body) sum -= joint.force[axis];
  }
  return sum;
}

double least(const Instant& at) {
  double separation = std::numeric_limits<double>::infinity();
  for (const ContactSample& contact : at.sample.contacts)
    separation = std::min(separation, contact.separation);
  return separation;
}

std::vector<std::string> namesOf(const std::vector<Quantity>& quantities) {
  std::vector<std::string> names;
  for (const Quantity& quantity : quantities) names.emplace_back(quantity.name);
  return names;
}

const Quantity* find(const std::vector<Quantity>& quantities, const std::string& name) {
  const auto row = std::find_if(quantities.begin(), quantities.end(),
                                [&](const Quantity& quantity) { return quantity.name == name; });
  return row == quantities.end() ? nullptr : &*row;
}

}  // namespace

const std::vector<Quantity>& bodyQuantities() {
  static const std::vector<Quantity> table = {
      {"x", "m", "centre of mass", place<0>},
      {"y", "m", "upward", place<1>},
      {"z", "m", "", place<2>},
      {"vx", "m/s", "its velocity", velocity<0>},
      {"vy", "m/s", "upward", velocity<1>},
      {"vz", "m/s", "", velocity<2>},
      {"speed", "m/s", "size of the velocity",
       [](const Instant& at) { return bodyOf(at).v.norm(); }},
      {"wx", "rad/s", "angular velocity", spin<0>},
      {"wy", "rad/s", "", spin<1>},
      {"wz", "rad/s", "", spin<2>},
      {"spin", "rad/s", "size of the angular velocity",
       [](const Instant& at) { return bodyOf(at).omega.norm(); }},
      {"px", "N s", "linear momentum", momentum<0>},
      {"py", "N s", "upward", momentum<1>},
      {"pz", "N s", "", momentum<2>},
      {"lx", "N m s", "angular momentum about the centre of mass", turning<0>},
      {"ly", "N m s", "", turning<1>},
      {"lz", "N m s", "", turning<2>},
      {"fx", "N", "sum of the contact forces on it", force<0>},
      {"fy", "N", "upward", force<1>},
      {"fz", "N", "", force<2>},
      {"force", "N", "size of that sum", [](const Instant& at) { return contactForce(at).norm(); }},
      {"jx", "N", "sum of what joints exert on it", jointForce<0>},
      {"jy", "N", "upward", jointForce<1>},
      {"jz", "N", "", jointForce<2>},
  };
  return table;
}

const std::vector<Quantity>& runQuantities() {
  static const std::vector<Quantity> table = {
      {"t", "s", "time", [](const Instant& at) { return at.sample.t; }},
      {"kinetic", "J", "½ m v² + ½ ω·Iω of all",
       [](const Instant& at) { return at.sample.kinetic; }},
      {"potential", "J", "−m g·x and springs",
       [](const Instant& at) { return at.sample.potential; }},
      {"energy", "J", "both",
       [](const Instant& at) { return at.sample.kinetic + at.sample.potential; }},
      {"contacts", "", "points of contact",
       [](const Instant& at) { return static_cast<double>(at.sample.contacts.size()); }},
      {"separation", "m", "the least of them, ∞ without one", least},
  };
  return table;
}

std::optional<Gauge> Gauge::named(const Scene& scene, const std::string& name) {
  Gauge gauge;
  gauge.scene_ = &scene;
  gauge.quantity_ = find(runQuantities(), name);
  if (gauge.quantity_) return gauge;
  const std::size_t dot = name.rfind('.');
  if (dot == std::string::npos) return {};
  gauge.quantity_ = find(bodyQuantities(), name.substr(dot + 1));
  const std::vector<BodyDef>& bodies = scene.world.bodies;
  const auto body = std::find_if(bodies.begin(), bodies.end(), [&](const BodyDef& one) {
    return one.name == name.substr(0, dot);
  });
  if (!gauge.quantity_ || body == bodies.end()) return {};
  gauge.body_ = static_cast<int>(body - bodies.begin());
  const bool turns = moves(*body) && !std::holds_alternative<Particle>(body->shape);
  if (turns) gauge.inertia_ = massOf(*body).inertia;
  return gauge;
}

double Gauge::operator()(const Sample& sample) const {
  return quantity_->of({*scene_, sample, body_.value_or(0), inertia_});
}

std::string hintOfQuantity(const Scene& scene, const std::string& name) {
  const std::size_t dot = name.rfind('.');
  std::vector<std::string> bodies;
  for (const BodyDef& body : scene.world.bodies) bodies.push_back(body.name);
  if (dot == std::string::npos) {
    std::vector<std::string> names = namesOf(runQuantities());
    return hint(name, names) + ", or NAME.y of a body";
  }
  const std::string body = name.substr(0, dot);
  if (std::find(bodies.begin(), bodies.end(), body) == bodies.end())
    return ": there is no body '" + body + "'" + hint(body, bodies);
  return hint(name.substr(dot + 1), namesOf(bodyQuantities()));
}

}  // namespace tumble
