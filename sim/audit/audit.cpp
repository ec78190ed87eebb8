#include "sim/audit/audit.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace tumble {
namespace {

/// What moves less than this part of what its loads would make of it is at rest.
constexpr double kStill = 1e-6;
/// Flying bodies up to which all of them are looked at whenever the flight of one changes.
constexpr std::size_t kFew = 32;
/// Steps after which all bodies are looked at again, and one more.
constexpr double kSoon = 9.0;
/// Looks at cloths in a run.
constexpr double kClothLooks = 32.0;
/// What audit and certificate may differ by: energy, of the largest kinetic; momentum, of the
/// largest; overlaps and gaps, of the smallest body.
constexpr double kEnergyShare = 1e-2, kMomentumShare = 1e-2, kOverlapShare = 1e-4;

/// How far [m] a body was moved beyond the way that its speed makes, if farther than its own
/// radius: what is lifted out of another goes less far.
double astrayOf(const Recorded& from, const Recorded& to, double way, double radius) {
  const double beyond = (to.x - from.x).norm() - way;
  return beyond > radius ? beyond : 0.0;
}

}  // namespace

Audit::Audit(const Model& model, std::span<const RigidBody> start)
    : model_(model),
      bodies_(start.begin(), start.end()),
      nearness_(model, bodies_),
      cloths_(model) {
  const std::size_t n = bodies_.size();
  for (const RigidBody& body : bodies_) last_.push_back(recordedOf(body));
  now_ = last_;
  for (std::size_t k = 0; k < model.joints.size(); ++k) bonds_.emplace_back(model, k, last_);
  for (const Pivot& pivot : model.pivots) bonds_.emplace_back(pivot);
  joined_.assign(n, false);
  for (const Bond& bond : bonds_)
    for (const int i : {bond.a, bond.b})
      if (i != kNoBody) joined_[i] = true;
  for (std::size_t i = 0; i < n; ++i) family_.push_back(static_cast<int>(i));
  root_ = family_;
  families_.resize(n);
  carried_.resize(n);
  blown_.resize(n);
  driftP_.assign(n, Vec3::Zero());
  driftL_ = driftP_;
  const bool stepping = model.runs == "stepping";
  struck_ = stepping;
  soon_ = kSoon * (stepping ? model.def.stepping.step : model.def.course.step);
  coarse_ = model.runs == "exact" && model.joints.empty() && n > kFew;
  findBearers();
  addMotions();
  countCrossings();
  energyLast_ = energyNow_;
  energyStart_ = std::accumulate(energyNow_.begin(), energyNow_.end(), 0.0);
  turns_ = !model.bending.empty() &&
           std::any_of(bodies_.begin(), bodies_.end(), [](const RigidBody& body) {
             return body.fixed() && !body.omega.isZero(0.0);
           });
  for (const int i : model.solid)
    skins_ = skins_ || (moves(i) && bodies_[i].particle && !model.bends(i) &&
                        model.def.bodies[i].friction > 0.0);
  for (const Force& force : model.def.forces) {
    const Spring* spring = std::get_if<Spring>(&force);
    const bool led = spring && ((spring->b != kNoBody && !still(spring->b) && !moves(spring->b)) ||
                                (!moves(spring->a) && !still(spring->a)));
    winds_ = winds_ && std::holds_alternative<UniformWind>(force);
    stored_ = stored_ && !dependsOnVelocity(force) && !led && !turns_;
  }

  std::vector<PathPoint> points;
  for (const RigidBody& body : bodies_) points.push_back({body.x, body.q, body.v, body.omega});
  loads_.sum(model.def.forces, bodies_, points);
  for (std::size_t i = 0; i < n; ++i) {
    if (!moves(i)) continue;
    const Vec3 force = bodies_[i].M * model.def.gravity + loads_.force[i];
    load_ += force.norm();
    loadPower_ += bodies_[i].invM * force.squaredNorm();
    size_ = std::max(size_, nearness_.radius(i));
  }
}

void Audit::see(double t, std::span<const RigidBody> bodies, bool many,
                std::span<const ClusterPart> pieces) {
  const std::size_t n = bodies_.size();
  bool same = true;
  for (std::size_t i = 0; i < n; ++i) {
    if (moves(i))
      now_[i] = recordedOf(bodies[i]);
    else if (!still(i))
      now_[i] = recordedOf(fixedAt(i, t));
    const Recorded& r = now_[i];
    broken_ = broken_ || !std::isfinite(r.x.sum() + r.q.coeffs().sum() + r.P.sum() + r.L.sum());
    same = same && r == last_[i];
  }
  if (broken_ || (same && (quiet_ || t == t_))) {
    seen_ += t > t_ && !broken_;
    t_ = t;
    return;
  }
  h_ = t - t_;
  t_ = t;
  many_ = many;
  ++seen_;
  ways_.set(pieces);
  addWays();
  const Nearness::Part part{t_, h_, many, struck_, last_, now_, ways_, net_, way_, reach_};
  nearness_.see(part);
  addMotions();
  balance();
  while (isOpen() && passBlowsOn(part)) balance();
  settle();
  for (const Bond& bond : bonds_) jointGap_ = std::max(jointGap_, bond.gap(now_));
  countCrossings();
  last_.swap(now_);
  energyLast_.swap(energyNow_);
  for (std::size_t i = 0; i < n; ++i)
    if (!moves(i)) now_[i] = last_[i];
}

/// Of cloths, as many times in a run as its pictures tell apart, and at its end.
void Audit::countCrossings() {
  if (!cloths_.any() || (t_ < clothsNext_ && t_ < model_.def.duration)) return;
  crossings_ = std::max(crossings_, cloths_.count(now_));
  clothsNext_ = t_ + model_.def.duration / kClothLooks;
}

/// How far any point of each body went.
void Audit::addWays() {
  net_.assign(bodies_.size(), 0.0);
  way_.assign(bodies_.size(), 0.0);
  reach_.assign(bodies_.size(), 0.0);
  for (const int i : model_.solid) {
    const double r = nearness_.radius(i);
    if (r == 0.0 || (!moves(i) && still(i))) continue;
    double fastest = moves(i) ? 0.0 : bodies_[i].v.norm() + r * bodies_[i].omega.norm();
    const auto wayOf = [&](const Recorded& p, const Recorded& q, double h) {
      if (moves(i)) {
        const double speed = bodies_[i].invM * std::max(p.P.norm(), q.P.norm());
        const double spin = std::max(spinOf(bodies_[i], p).norm(), spinOf(bodies_[i], q).norm());
        fastest = std::max(fastest, speed + r * spin);
        if (struck_ && !many_) astray_ = std::max(astray_, astrayOf(p, q, h * speed, r));
      }
      return std::max(wayBetween(p.x, p.q, q.x, q.q, r), h * fastest);
    };
    net_[i] = wayBetween(last_[i].x, last_[i].q, now_[i].x, now_[i].q, r);
    const std::span<const Ways::Part> own = ways_.of(i);
    if (own.empty()) way_[i] = wayOf(last_[i], now_[i], h_);
    for (const Ways::Part& part : own) way_[i] += wayOf(part.start, part.end, part.t1 - part.t0);
    reach_[i] = soon_ * fastest;
  }
}

/// What is open, by what the scene has; where it is at rest, by what it would have if nothing held
/// it.
double Audit::relative(double open, double has, double wouldHave) const {
  return open == 0.0 ? 0.0 : std::abs(open) / (has > kStill * wouldHave ? has : wouldHave);
}

void Audit::report(const State& state, Report& report) const {
  Certificate& books = report.certificate;
  const double would = 0.5 * loadPower_ * t_ * t_;
  books.audited_steps = seen_;
  books.audit_untold_steps = untold_;
  books.audit_energy_gain = gain_;
  const double lost = books.energy_lost_impact + books.energy_lost_friction +
                      books.energy_lost_bending - books.energy_added_repair;
  const double energy = std::accumulate(energyLast_.begin(), energyLast_.end(), 0.0);
  books.audit_energy_error =
      untold_ > 0 ? 0.0 : relative(energy - energyStart_ + lost - workDone_, kineticMax_, would);
  books.audit_momentum_error = relative(driftMaxP_, momentumMax_, load_ * t_);
  books.audit_spin_error = relative(driftMaxL_, spinMax_, load_ * t_ * size_);
  books.audit_max_penetration = nearness_.deepest();
  books.audit_penetration_between = nearness_.between();
  books.audit_joint_gap = jointGap_;
  books.cloth_crossings = crossings_;
  report.disagreements.clear();
  if (state.t < model_.def.duration && !report.stopped) return;
  findDisagreements(report);
}

/// What the audit found, what the certificate says, and how much more it may be.
void Audit::findDisagreements(Report& report) const {
  const Certificate& books = report.certificate;
  const auto hold = [&](const char* what, double found, double stated, double allowed) {
    if (found <= stated + allowed) return;
    report.disagreements.push_back({what, found, stated, allowed});
    report.note(("the audit finds " + std::string(what) + " " + shortNumber(found) +
                 ", where the certificate says " + shortNumber(stated))
                    .c_str());
  };
  const double would = 0.5 * loadPower_ * t_ * t_;
  const double scale = std::max(kineticMax_, kStill * would);
  const double unsure = relative(unsure_, kineticMax_, would);
  hold("energy that nothing gave / J", gain_,
       std::max(books.energy_added_repair, books.max_energy_gain), kEnergyShare * scale);
  hold("balance of energy, relative", books.audit_energy_error, books.energy_balance_error,
       kEnergyShare + unsure);
  hold("momentum that nothing gave, relative", books.audit_momentum_error, books.momentum_error,
       kMomentumShare);
  const double spun = books.audit_spin_error,
               lifted = relative(books.spin_added_repair, spinMax_, load_ * t_ * size_);
  hold("spin that nothing gave, relative", spun, lifted, kMomentumShare);
  hold("deepest overlap / m", books.audit_max_penetration, books.max_penetration,
       kOverlapShare * nearness_.least());
  hold("way that no speed makes / m", astray_, 0.0, 0.0);
  hold("gap of joints / m", books.audit_joint_gap, 2.0 * books.max_joint_gap,
       kOverlapShare * nearness_.least());
  if (const double open = books.audit_energy_error;
      open > books.energy_balance_error + kEnergyShare && open <= kEnergyShare + unsure)
    report.note(("the audit finds balance of energy, relative, " + shortNumber(open) +
                 ", and knows it to " + shortNumber(unsure) +
                 " only, by what is not known of forces within what bends: smaller steps tell more")
                    .c_str());
  if (spun > kMomentumShare && spun <= lifted + kMomentumShare)
    report.note(("bodies in flight were moved out of each other, which gave spin, relative, " +
                 shortNumber(spun) + ": smaller steps give less")
                    .c_str());
  tellWeakness(report);
}

/// What no disagreement shows: steps that the audit could not judge, and balances that are open.
void Audit::tellWeakness(Report& report) const {
  constexpr double kOpen = 0.01;
  const Certificate& books = report.certificate;
  if (crossings_ > 0)
    report.note(("cloth passes through cloth in up to " + std::to_string(crossings_) +
                 " places: it was hit or pressed too hard to be kept apart")
                    .c_str());
  if (2 * untold_ > seen_)
    report.note(("the audit could not judge the energy of " + std::to_string(untold_) + " of " +
                 std::to_string(seen_) + " steps")
                    .c_str());
  if (!(books.energy_balance_error <= kOpen))
    report.note(("the balance of energy is open by " + shortNumber(books.energy_balance_error) +
                 " of the largest kinetic energy: smaller steps would close it")
                    .c_str());
  if (!(books.momentum_error <= kOpen))
    report.note(("the balance of momentum is open by " + shortNumber(books.momentum_error) +
                 " of the largest: a finer preset would close it")
                    .c_str());
}

}  // namespace tumble
