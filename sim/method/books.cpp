// The grid of steps, the trail of the motion, and the books behind the certificate.
#include <algorithm>
#include <cmath>
#include <string_view>
#include <tuple>
#include <variant>

#include "sim/body/force.h"
#include "sim/joint/joint_rows.h"
#include "sim/method/method.h"

namespace tumble {
namespace {

const Contact* ofSamePair(const std::vector<Contact>& list, const Contact& c) {
  const auto found = std::find_if(list.begin(), list.end(), [&](const Contact& other) {
    return other.a == c.a && other.b == c.b;
  });
  return found == list.end() ? nullptr : &*found;
}

Event eventAt(double t, EventKind kind, const Contact& c) {
  return {.t = t,
          .kind = kind,
          .a = c.a,
          .b = c.b,
          .p = c.point.p,
          .n = c.point.n,
          .vrel = 0.0,
          .j = 0.0};
}

/// What is open, by what the scene has; where it is at rest, by what it would have if nothing held
/// it.
double relative(double open, double has, double wouldHave) {
  constexpr double kAtRest = 1e-6;
  const double scale = has > kAtRest * wouldHave ? has : wouldHave;
  return open == 0.0 ? 0.0 : std::abs(open) / scale;
}

}  // namespace

void Certificate::add(const Certificate& part) {
  for (const auto& [key, number] : kCertificateFields) {
    const bool largest = std::string_view(key).starts_with("max_");
    std::visit(
        [&](auto field) {
          auto& own = this->*field;
          own = largest ? std::max(own, part.*field) : own + part.*field;
        },
        number);
  }
}

const char* eventName(EventKind kind) {
  switch (kind) {
    case EventKind::Impact:
      return "impact";
    case EventKind::Rest:
      return "rest";
    case EventKind::Separate:
      return "separate";
    case EventKind::Slip:
      return "slip";
    case EventKind::Stick:
      return "stick";
  }
  return "";
}

void Report::note(const char* text) {
  if (std::find(notes.begin(), notes.end(), text) == notes.end()) notes.emplace_back(text);
}

double gridTime(const Model& model, long k, double h) {
  const double next = static_cast<double>(k + 1) * h, end = model.def.duration;
  constexpr double kSliver = 1e-9;               // of a step
  return next > end - kSliver * h ? end : next;  // no sliver of a step is left before the end
}

std::string spentBy(const Model& model, const State& state) {
  const bool asked = model.def.method == "exact";
  return "the exact method takes too long where things move or touch as fast as here (" +
         std::to_string(state.effort.done) + " evaluations of forces so far)" +
         (asked ? "; set world.method = \"stepping\", or \"auto\", which goes on by it"
                : "; for steps throughout set world.method = \"stepping\", to wait for it "
                  "\"exact\"");
}

void trimTrail(State& state, double t) {
  constexpr std::size_t kSpare = 64;
  std::size_t kept = 0;
  for (Segment& segment : state.trail) {
    if (segment.t1 >= t)
      std::swap(state.trail[kept++], segment);
    else if (state.spareTrail.size() < kSpare)
      state.spareTrail.push_back(std::move(segment));
  }
  state.trail.resize(kept);
}

void account(const Model& model, State& state, Report& report) {
  account(model, state, report, potentialEnergy(model.def.gravity, model.def.forces, state.bodies));
}

void account(const Model& model, State& state, Report& report, double potential) {
  Certificate& books = report.certificate;
  Vec3 momentum = Vec3::Zero();
  double size = 0.0;
  for (const RigidBody& body : state.bodies) {
    if (body.fixed()) continue;
    momentum += body.P;
    size += body.P.norm();
  }
  const double kinetic = kineticEnergy(state.bodies);
  state.kineticMax = std::max(state.kineticMax, kinetic);
  state.momentumScale = std::max(state.momentumScale, size);

  for (Contact c : state.lasting) {
    follow(state.bodies[c.a], state.bodies[c.b], c);
    books.max_penetration = std::max(books.max_penetration, -c.point.separation);
  }
  books.max_joint_gap = std::max(books.max_joint_gap, largestJointGap(state.bodies, model.joints));
  books.events = static_cast<long>(report.events.size());
  books.energy_end = kinetic + potential + energyStored(state.lasting);
  // Contacts may take of this, but give nothing.
  const double own = books.energy_end - books.energy_added_repair - books.work_of_forces;
  books.max_energy_gain = std::max(books.max_energy_gain, own - state.energyLeast);
  state.energyLeast = std::min(state.energyLeast, own);
  const double open = own - books.energy_start + books.energy_lost_impact +
                      books.energy_lost_friction + books.energy_lost_bending;
  books.energy_balance_error =
      relative(open, state.kineticMax, 0.5 * state.loadPower * state.t * state.t);
  state.momentumDrift = std::max(state.momentumDrift,
                                 (momentum - state.momentumStart - state.externalImpulse).norm());
  books.momentum_error = relative(state.momentumDrift, state.momentumScale, state.load * state.t);
}

double energyStored(std::span<const Contact> contacts) {
  double sum = 0.0;
  for (const Contact& c : contacts) sum += c.energy;
  return sum;
}

void recordChanges(const std::vector<Contact>& before, const std::vector<Contact>& now,
                   std::span<const RigidBody> bodies, double t, Report& report) {
  for (const Contact& c : now) {
    if (ofSamePair(now, c) != &c) continue;
    const Contact* old = ofSamePair(before, c);
    if (!old) report.events.push_back(eventAt(t, EventKind::Rest, c));
    if (c.sliding != (old && old->sliding))
      report.events.push_back(eventAt(t, c.sliding ? EventKind::Slip : EventKind::Stick, c));
  }
  for (const Contact& c : before) {
    if (ofSamePair(before, c) != &c || ofSamePair(now, c)) continue;
    Contact parted = c;
    follow(bodies[c.a], bodies[c.b], parted);
    report.events.push_back(eventAt(t, EventKind::Separate, parted));
  }
}

void sortEvents(Report& report, std::size_t from) {
  std::stable_sort(report.events.begin() + static_cast<std::ptrdiff_t>(from), report.events.end(),
                   [](const Event& p, const Event& q) {
                     return std::tie(p.t, p.a, p.b) < std::tie(q.t, q.a, q.b);
                   });
}

}  // namespace tumble
