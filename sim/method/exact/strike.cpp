// What happens when bodies touch: the contacts of that instant, and their impulses.
#include <algorithm>
#include <cmath>
#include <limits>

#include "sim/collide/collide.h"
#include "sim/contact/impact.h"
#include "sim/math/frames.h"
#include "sim/method/crush.h"
#include "sim/method/exact/corners.h"
#include "sim/method/exact/exact.h"
#include "sim/method/impacts.h"

namespace tumble {
namespace {

/// [m] per size of the world: a bounce that would rise less than this is the last of its row. The
/// bounces left out would take  2 v/(a (1 − e)), after which the contact counts as at rest.
constexpr double kLowest = 1e-12;
/// Events that leave time where it is, in a row, before some are seen late.
constexpr int kStalled = 1000;

}  // namespace

void Exact::strike(double t, int a, int b) {
  state_.exact.stalled = t > state_.t ? 0 : state_.exact.stalled + 1;
  state_.t = t;
  // Where no force pushes together what loses no speed, hits part bodies in the end, however many
  // there are (Burago, Ferleger, Kononenko, Ann. Math. 147, 1998).
  const bool ends = model_.def.gravity.isZero(0.0) && model_.def.forces.empty() &&
                    model_.surface(a, b).restitution == 1.0;
  state_.exact.pace.see(t, ends ? 0 : 1);
  if (state_.exact.pace.lost()) return stop(crowdedAt(t));
  const long flightA = state_.exact.flightCount[a], flightB = state_.exact.flightCount[b];
  const auto held = [&](int i) { return model_.def.bodies[i].pivot_B.has_value(); };
  if (!canCollide(model_.shapes[a], model_.shapes[b]))
    return stop("\"" + nameOf(a) + "\" comes near \"" + nameOf(b) + "\" at t = " + digits(t) +
                " s, and there is no contact rule for " + std::string(shapeName(model_.shapes[a])) +
                " and " + std::string(shapeName(model_.shapes[b])) + "; keep them apart");
  if (held(a) || held(b))
    return stop("\"" + nameOf(a) + "\" touches \"" + nameOf(b) + "\" at t = " + digits(t) +
                " s; a body with a pivot has no contacts");
  if (state_.exact.stalled > kStalled) {  // hits without end, as between bodies that close in
    return sustain(t, {});
  }

  const std::size_t firstEvent = report_.events.size();
  ends_.clear();
  const int seeds[] = {a, b};
  Cluster cluster = gather(t, seeds);
  noteOverlaps(cluster);
  if (collides(cluster)) respond(t, cluster);
  if (!report_.stopped) hold(t, cluster);
  sortEvents(report_, firstEvent);
  // Whom nothing changed may still meet later.
  if (flightA == state_.exact.flightCount[a] && flightB == state_.exact.flightCount[b] &&
      !report_.stopped)
    state_.exact.flightCount[model_.fixed(a) ? b : a]++, lookAround(model_.fixed(a) ? b : a, t);
  if (state_.exact.sustained) keepBooks(t);
}

Cluster Exact::gather(double t, std::span<const int> seeds) {
  Cluster cluster;
  std::vector<int> open;
  const auto visit = [&](int body) {
    auto& list = cluster.bodies;
    if (std::find(list.begin(), list.end(), body) != list.end()) return;
    list.push_back(body);
    bringTo(t, body);
    if (!model_.fixed(body)) open.push_back(body);
  };
  std::vector<Pair> met;
  for (const int seed : seeds) visit(seed);
  for (std::size_t k = 0; k < open.size(); ++k) {
    const int i = open[k];
    const ExactMemory::Window& w = state_.exact.window;
    const auto meet = [&](int j) {
      const Pair pair = std::minmax(i, j);
      if (std::find(met.begin(), met.end(), pair) != met.end()) return;
      const double reach = boundingRadius(model_.shapes[i]) + boundingRadius(model_.shapes[j]);
      bringTo(t, j);
      // Fast bodies are as far apart as they go while t is rounded.
      const double rounding = 4.0 * std::numeric_limits<double>::epsilon() * t,
                   near = std::max(tolerance_.touch,
                                   rounding * (state_.bodies[i].v - state_.bodies[j].v).norm());
      if ((state_.bodies[i].x - state_.bodies[j].x).norm() > reach + near) return;
      const std::size_t before = cluster.contacts.size();
      findContacts(model_, state_.bodies, pair, near, cluster.contacts);
      if (cluster.contacts.size() == before) return;
      met.push_back(pair);
      visit(j);
    };
    for (const int plane : w.planes) meet(plane);
    for (const int j : w.finite)
      if (j != i && w.swept[i].overlaps(w.swept[j])) meet(j);
  }
  tieLeaning(state_, cluster.contacts);
  return cluster;
}

void Exact::noteOverlaps(const Cluster& cluster) {
  double& deepest = report_.certificate.max_penetration;
  for (const Contact& c : cluster.contacts) deepest = std::max(deepest, -c.point.separation);
}

bool Exact::collides(const Cluster& cluster) const {
  return std::any_of(cluster.contacts.begin(), cluster.contacts.end(), [&](const Contact& c) {
    return approachVelocity(state_.bodies[c.a], state_.bodies[c.b], c.point) < -tolerance_.rest;
  });
}

double Exact::lowest() const {
  return kLowest * state_.exact.pace.coarseness() * ContactTolerance::scaleOf(model_.size);
}

// Forces that a body would carry without the contacts of this pair.
void Exact::loadWithout(const Contact& pair, int i) {
  RigidBody& body = state_.bodies[i];
  body.force = state_.exact.outer[i];
  body.torque.setZero();
  for (const Contact& c : state_.lasting) {
    if ((c.a == pair.a && c.b == pair.b) || (c.a != i && c.b != i)) continue;
    applyForce(body, c.point.p, c.a == i ? c.force : Vec3(-c.force));
  }
}

/// How high [m] a contact would rise again under the forces of now, and when [s] the row of bounces
/// that this begins would be over; nothing if it is no row.
std::optional<Exact::Bounces> Exact::bouncesOf(double t, const Contact& c) {
  const RigidBody &a = state_.bodies[c.a], &b = state_.bodies[c.b];
  const double rebound = -c.restitution * approachVelocity(a, b, c.point);
  for (const int i : {c.a, c.b}) loadWithout(c, i);
  const double press = -normalAcceleration(a, b, c.point);
  if (!(press > 0.0)) return std::nullopt;
  const double rest = c.restitution < 1.0 ? 2.0 * rebound / (press * (1.0 - c.restitution)) : 0.0;
  return Bounces{0.5 * rebound * rebound / press, t + rest};
}

std::vector<double> Exact::restitutions(double t, const std::vector<Contact>& contacts) {
  std::vector<double> e;
  bool any = false, all = true;
  for (std::size_t i = 0; i < contacts.size();) {
    // The contacts of a pair bounce together, or come to rest together.
    const Contact& first = contacts[i];
    const bool lasting = lasts(first.a, first.b);
    double highest = 0.0, end = t;
    bool hits = false, closes = true, hard = false, leansOnly = true;
    const std::size_t begin = i;
    for (; i < contacts.size() && contacts[i].a == first.a && contacts[i].b == first.b; ++i) {
      const Contact& c = contacts[i];
      e.push_back(c.restitution);
      const double vrel = approachVelocity(state_.bodies[c.a], state_.bodies[c.b], c.point);
      if (vrel >= -tolerance_.rest) continue;
      const std::optional<Bounces> bounces = bouncesOf(t, c);
      hits = true;
      hard = hard || (c.restitution == 0.0 && vrel < -tolerance_.keep);
      const bool leans = lasting && -c.restitution * vrel < tolerance_.keep;
      closes = closes && (leans || (bounces && bounces->height < lowest()));
      leansOnly = leansOnly && leans;
      if (!bounces) continue;
      highest = std::max(highest, bounces->height);
      end = std::max(end, bounces->end);
    }
    all = all && closes && !hard;  // a hard blow goes on through others, though it does not rebound
    any = any || hits;
    if (!closes || !hits) continue;
    // What only leans rests beside another hit, and rebounds if that sends it in.
    if (!leansOnly) std::fill(e.begin() + static_cast<std::ptrdiff_t>(begin), e.end(), 0.0);
    ends_.push_back({{first.b, first.a}, end});
    report_.certificate.max_closed_height =
        std::max(report_.certificate.max_closed_height, highest);
  }
  // What they hand on to others ends with them.
  if (!any || !all) return e;
  std::fill(e.begin(), e.end(), 0.0);
  for (const Contact& c : contacts) {
    const Pair pair(c.b, c.a);
    const auto same = [&](const auto& end) { return end.first == pair; };
    if (std::none_of(ends_.begin(), ends_.end(), same)) ends_.push_back({pair, t});
  }
  return e;
}

void Exact::respond(double t, const Cluster& cluster) {
  // The bodies of the cluster alone, numbered anew.
  std::vector<RigidBody> bodies;
  std::vector<int> local(state_.bodies.size(), -1);
  for (const int i : cluster.bodies) {
    local[i] = static_cast<int>(bodies.size());
    bodies.push_back(state_.bodies[i]);
  }
  std::vector<Contact> contacts = cluster.contacts;
  const std::vector<double> restitution = restitutions(t, contacts);
  std::vector<double> vrel;
  for (Contact& c : contacts) {
    vrel.push_back(approachVelocity(state_.bodies[c.a], state_.bodies[c.b], c.point));
    c.lasting = lasts(c.a, c.b) && std::abs(vrel.back()) <= tolerance_.keep;
    c.a = local[c.a];
    c.b = local[c.b];
  }
  std::vector<Vec3> impulse(contacts.size(), Vec3::Zero());
  const ImpactReport impact = findImpactLaw(model_.def.impact)
                                  ->apply({.bodies = bodies,
                                           .contacts = contacts,
                                           .restitution = restitution,
                                           .impulse = impulse,
                                           .tolerance = tolerance_});
  double kinetic = 0.0;
  for (const int i : cluster.bodies) {
    kinetic += kineticEnergy(state_.bodies[i]);
    if (!model_.fixed(i)) state_.bodies[i] = bodies[local[i]];
  }
  state_.kineticMax = std::max(state_.kineticMax, kinetic);
  bookImpact(impact, report_);
  state_.effort.done += impact.rows / Effort::kRows;
  recordImpacts(t, cluster, vrel, impulse);
  const std::string locked =
      findLocked(model_, t, state_.bodies, cluster.contacts, impact.residual);
  if (!locked.empty()) stop(locked);
}

void Exact::recordImpacts(double t, const Cluster& cluster, std::span<const double> vrel,
                          std::span<const Vec3> impulse) {
  for (const Event& event : impactEvents(model_, state_, t, cluster.contacts, vrel, impulse))
    if (!lasts(event.a, event.b) || !leansOn(event, state_.bodies, tolerance_.keep))
      report_.events.push_back(event);
}

}  // namespace tumble
