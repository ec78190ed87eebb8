#include "sim/world.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "sim/audit/audit.h"
#include "sim/method/method.h"
#include "sim/neighbours.h"
#include "sim/origin.h"
#include "sim/shape/pieces.h"
#include "sim/world_parts.h"

namespace tumble {

namespace {

void stand(const BodySample& sample, RigidBody& body) {
  body.x = sample.x;
  body.q = sample.q.normalized();
  updateDerived(body);
  // A fixed body moves as its definition has it.
  if (!body.fixed()) setVelocity(body, sample.v, sample.omega);
}

}  // namespace

World::World(const WorldDef& def) : parts_(std::make_unique<Parts>()) {
  parts_->place(def);
  checkNeighbours(parts_->model, parts_->now->state.bodies);
  openBooks();
}

World::World(const WorldDef& def, const Sample& from) : parts_(std::make_unique<Parts>()) {
  parts_->place(def);
  std::vector<RigidBody>& bodies = parts_->now->state.bodies;
  if (from.bodies.size() != bodies.size())
    throw std::invalid_argument("a world goes on from a sample of its own bodies");
  const Sample here = parts_->here(from);
  for (std::size_t i = 0; i < bodies.size(); ++i) stand(here.bodies[i], bodies[i]);
  openBooks();
}

void World::lend(Workers workers) {
  parts_->model.workers = std::move(workers);
}

void World::countTime(std::function<double()> clock) {
  parts_->now->state.times.clock = std::move(clock);
}

const StageTimes& World::times() const {
  return parts_->now->state.times;
}

// What the certificate compares with later.
void World::openBooks() {
  const Model& model = parts_->model;
  const WorldDef& def = model.def;
  State& state = parts_->now->state;
  std::vector<RigidBody> loaded = state.bodies;
  sumForces(model.def.gravity, model.def.forces, loaded);
  for (const RigidBody& body : loaded) {
    if (body.fixed()) continue;
    state.load += body.force.norm();
    state.loadPower += body.invM * body.force.squaredNorm();
  }
  for (const RigidBody& body : state.bodies) state.momentumStart += body.P;
  Certificate& books = parts_->now->report.certificate;
  for (const BodyDef& body : def.bodies)
    if (const Mesh* mesh = std::get_if<Mesh>(&body.shape); mesh && mesh->pieces)
      books.mesh_excess = std::max(books.mesh_excess, mesh->pieces->excess);
  books.energy_start =
      kineticEnergy(state.bodies) + potentialEnergy(def.gravity, def.forces, state.bodies);
  account(model, state, parts_->now->report);
  parts_->now->audit.emplace(model, state.bodies);
}

World::~World() = default;
World::World(World&&) noexcept = default;
World& World::operator=(World&&) noexcept = default;

void World::advance(double t) {
  if (!std::isfinite(t)) throw std::invalid_argument("a world advances to an instant, in seconds");
  const Model& model = parts_->model;
  auto& [state, report, audit, lastAdvance] = *parts_->now;
  const double end = std::min(t, model.def.duration);
  if (state.times.clock) state.times.skip();
  const StageScope rest(state.times, StepStage::Rest);
  trimTrail(state, lastAdvance);
  parts_->method->advance(model, state, end, report);
  lastAdvance = end;
  const StageScope auditing(state.times, StepStage::Audit);
  audit->follow(state);
  audit->report(state, report);
  parts_->tellAnew();
}

SavedWorld World::save() const {
  SavedWorld saved;
  saved.held_ =
      std::make_shared<const SavedWorld::Held>(SavedWorld::Held{parts_->made, *parts_->now});
  return saved;
}

void World::restore(const SavedWorld& saved) {
  if (!saved.held_ || saved.held_->of != parts_->made)
    throw std::invalid_argument(
        "a world restores what it saved itself, not what another world saved");
  parts_->now = std::make_unique<Changing>(saved.held_->moment);
  parts_->tellAnew();
}

namespace {

Sample sampleOf(const Model& model, double t, std::span<const RigidBody> bodies,
                std::span<const Contact> contacts, std::span<const JointForce> joints = {}) {
  Sample sample;
  sample.t = t;
  sample.bodies.reserve(bodies.size());
  const WorldDef& def = model.def;
  const bool matrix = model.runs == "course" && def.course.attitude == "matrix";
  for (const RigidBody& body : bodies)
    sample.bodies.push_back({.x = body.x,
                             .q = body.q,
                             .v = body.v,
                             .omega = body.omega,
                             .R = matrix ? std::optional(body.R) : std::nullopt});
  for (const Contact& c : contacts)
    sample.contacts.push_back({c.a, c.b, c.point.p, c.point.n, c.point.separation, c.force});
  sample.joints.assign(joints.begin(), joints.end());
  sample.kinetic = kineticEnergy(bodies);
  sample.potential = potentialEnergy(def.gravity, def.forces, bodies) + energyStored(contacts);
  return sample;
}

}  // namespace

Sample World::sample(double t) const {
  std::vector<RigidBody>& bodies = parts_->seen;
  std::vector<Contact>& contacts = parts_->seenContacts;
  std::vector<JointForce>& joints = parts_->seenJoints;
  parts_->method->look(parts_->model, parts_->now->state, t, bodies, contacts, joints);
  return parts_->told(sampleOf(parts_->model, t, bodies, contacts, joints));
}

StartCheck World::checkStart(const WorldDef& def) {
  Parts parts;
  parts.place(def);
  std::vector<RigidBody> bodies = parts.now->state.bodies;
  std::vector<Contact> contacts = touchingContacts(parts.model, bodies);
  StartCheck check;
  check.faults = overlapping(parts.model, contacts);
  for (const StateFault& fault : approaching(parts.model, bodies, contacts))
    check.faults.push_back(fault);

  // Accelerations without contact forces, then with them.
  sumForces(def.gravity, parts.model.def.forces, bodies);
  for (const StateFault& fault : sinking(parts.model, bodies, contacts))
    check.unheld = std::min(check.unheld, fault.amount);
  addContactForces(parts.model, bodies, contacts);
  for (const StateFault& fault : sinking(parts.model, bodies, contacts))
    check.faults.push_back(fault);
  for (const Contact& c : contacts) check.resting += c.force.isZero(0.0) ? 0 : 1;
  check.sample = parts.told(sampleOf(parts.model, 0.0, bodies, contacts));
  return check;
}

const Model& World::model() const {
  return parts_->model;
}

std::string World::method() const {
  const Model& model = parts_->model;
  if (model.def.method != "auto") return model.def.method;
  return "auto: " + std::string(model.runs) + (parts_->now->state.before ? ", then stepping" : "");
}

std::string_view World::runs() const {
  return parts_->now->state.before ? "stepping" : parts_->model.runs;
}

const Vec3& World::origin() const {
  return parts_->origin;
}

const Report& World::report() const {
  if (parts_->origin.isZero(0.0)) return parts_->now->report;
  if (!parts_->seenReport) {
    parts_->seenReport.emplace();
    parts_->tellAnew();
  }
  return *parts_->seenReport;
}

std::vector<std::string> World::features(bool used) const {
  const Model& model = parts_->model;
  const auto anyBody = [&](auto&& test) {
    return std::any_of(model.def.bodies.begin(), model.def.bodies.end(), test);
  };
  std::vector<std::string> list;
  const auto add = [&](bool here, const char* name) {
    if (here == used) list.emplace_back(name);
  };
  add(!model.def.gravity.isZero(0.0), "gravity");
  const bool contact = model.solid.size() > 1 && parts_->method->contact;
  add(contact, "contact");
  const bool springs = model.runs == "course" && model.def.course.contact == "penalty";
  add(contact && springs, "penalty springs");
  add(contact && !springs && anyBody([](const BodyDef& b) { return b.restitution > 0.0; }),
      "restitution");
  add(contact && anyFriction(model), "friction");
  add(anyBody([](const BodyDef& b) {
        return b.fixed && !(b.velocity.isZero(0.0) && b.angularVelocity.isZero(0.0));
      }),
      "moving fixed bodies");
  add(!model.pivots.empty(), "pivots");
  add(!model.joints.empty(), "joints");
  const char* kForces[] = {"wind",      "drag", "point forces", "springs", "circular fields",
                           "what bends"};
  for (std::size_t kind = 0; kind < std::size(kForces); ++kind)
    add(std::any_of(model.def.forces.begin(), model.def.forces.end(),
                    [&](const Force& f) { return f.index() == kind; }),
        kForces[kind]);
  return list;
}

std::vector<MethodName> methodNames() {
  std::vector<MethodName> names;
  for (const Method& method : methods()) names.push_back({method.name, method.summary});
  return names;
}

}  // namespace tumble
