// Clusters: bodies that may touch each other within a step. Where something hits, its cluster goes
// through the step by a clock of its own, divided by its own hits; all others take the step whole,
// and nothing that happens in one cluster changes a bit of another.
#include <algorithm>
#include <iterator>
#include <numeric>

#include "sim/body/force.h"
#include "sim/math/rotation.h"
#include "sim/method/stepping/stepping.h"

namespace tumble {
namespace {

/// Moves pair k from one list to the end of another.
void pass(NearPairs& from, std::size_t k, NearPairs& to) {
  to.near.push_back(from.near[k]);
  to.pairs.push_back(std::move(from.pairs[k]));
  to.witnesses.push_back(std::move(from.witnesses[k]));
}

void clear(NearPairs& known) {
  known.near.clear();
  known.pairs.clear();
  known.witnesses.clear();
  known.lasting.clear();
}

}  // namespace

void Stepping::findTied() {
  const auto tie = [&](int i) {
    if (i < model_.count() && !model_.fixed(i)) memory_.tied.push_back(i);
  };
  for (int i = 0; i < model_.count(); ++i)
    if (isDriven(i) || model_.bends(i)) tie(i);
  for (const Joint& joint : model_.joints)
    for (const int i : {joint.a, joint.b}) tie(i);
}

void Stepping::activateAll() {
  parted_ = false;
  work_.active.resize(state_.bodies.size());
  std::iota(work_.active.begin(), work_.active.end(), 0);
  work_.solids.clear();
  for (std::size_t k = 0; k < model_.solid.size(); ++k)
    if (!model_.fixed(model_.solid[k])) work_.solids.push_back(static_cast<int>(k));
}

bool Stepping::findClusters(double h) {
  const StageScope stage(state_.times, StepStage::Pairs);
  constexpr int kNone = -1, kCalm = -2, kCalmCrowd = -3;
  many_ = false;  // each cluster will say so of itself
  untilHit(0.0, h, tolerance_.keep);
  const auto hits = [&](std::size_t k) {
    const PairMemory& pair = memory_.pairs[k];
    if (!model_.def.stepping.divides && isOneOf(work_.crowded, k)) return false;
    const auto due = [&](const Touch& touch) { return touch.rebounds && touch.due < h; };
    return (pair.tumbles && pair.lasts < h) || landsHard(k) ||
           (pair.strikes && std::any_of(pair.touches.begin(), pair.touches.end(), due));
  };
  std::vector<std::size_t>& struck = work_.struck;
  struck.clear();
  for (std::size_t k = 0; k < memory_.pairs.size(); ++k)
    if (hits(k)) struck.push_back(k);
  if (struck.empty() && !mixed_) return false;
  joinNear(h);
  for (const auto& [b, a] : work_.met) joinBodies(a, b);
  for (const std::size_t k : struck) joinBodies(state_.near[k].second, state_.near[k].first);
  const std::vector<int>& tied = memory_.tied;
  for (const int i : tied) joinBodies(i, tied.front());
  const int n = model_.count();
  std::vector<int>& number = work_.island;  // per root
  number.assign(n, kCalm);
  for (int i = 0; i < n; ++i)
    if (work_.crowded[i]) number[islandRoot(work_.root, i)] = kCalmCrowd;
  for (const std::size_t k : struck) number[rootOf(k)] = kNone;
  if (!tied.empty() && number[islandRoot(work_.root, tied.front())] == kNone) return false;
  // Those that hit in the order of their first bodies, then what is left: as one what is no crowd,
  // as another what is.
  int count = 0;
  bool calm = false, calmCrowd = false;
  work_.cluster.assign(n, kNone);
  for (int i = 0; i < n; ++i) {
    if (model_.fixed(i)) continue;
    int& own = number[islandRoot(work_.root, i)];
    if (own == kNone) own = count++;
    work_.cluster[i] = own;
    calm = calm || own == kCalm;
    calmCrowd = calmCrowd || own == kCalmCrowd;
  }
  if (count + calm + calmCrowd < 2) return false;
  std::replace(work_.cluster.begin(), work_.cluster.end(), kCalm, count);
  std::replace(work_.cluster.begin(), work_.cluster.end(), kCalmCrowd, count + calm);
  work_.tiedCluster = tied.empty() ? kNone : work_.cluster[tied.front()];
  work_.clusters.bodies.resize(count + calm + calmCrowd);
  return true;
}

/// Gives every cluster the near pairs that are its own, in their order; strangers are kept apart.
template <class KnownOf>
void Stepping::dealPairs(const KnownOf& knownOf) {
  const auto clusterOf = [&](int a, int b) { return work_.cluster[model_.fixed(a) ? b : a]; };
  NearPairs all, &strangers = work_.clusters.strangers;
  exchange(all);
  clear(strangers);
  for (std::size_t k = 0; k < all.near.size(); ++k) {
    const auto [b, a] = all.near[k];
    pass(all, k, areStrangers(a, b) ? strangers : knownOf(clusterOf(a, b)));
  }
  for (const LastingPair& pair : all.lasting)
    knownOf(clusterOf(pair.a, pair.b)).lasting.push_back(pair);
}

/// What belongs to each cluster, and the fixed bodies that move to every one.
void Stepping::dealOut() {
  Clusters& clusters = work_.clusters;
  const std::size_t count = clusters.bodies.size();
  clusters.solids.resize(count);
  clusters.before.resize(count);
  clusters.after.resize(count);
  clusters.books.assign(count, {});
  work_.carriers.clear();
  for (int i = 0; i < model_.count(); ++i) {
    const RigidBody& body = state_.bodies[i];
    if (body.fixed() && !(body.v.isZero(0.0) && body.omega.isZero(0.0)))
      work_.carriers.push_back(i);
  }
  for (std::size_t c = 0; c < count; ++c) {
    clusters.bodies[c] = work_.carriers;
    clusters.solids[c].clear();
    clear(clusters.before[c]);
    clear(clusters.after[c]);
  }
  for (int i = 0; i < model_.count(); ++i)
    if (work_.cluster[i] >= 0) clusters.bodies[work_.cluster[i]].push_back(i);
  for (std::size_t k = 0; k < model_.solid.size(); ++k)
    if (const int c = work_.cluster[model_.solid[k]]; c >= 0)
      clusters.solids[c].push_back(static_cast<int>(k));
  dealPairs([&](int c) -> NearPairs& { return clusters.before[c]; });
}

void Stepping::exchange(NearPairs& own) {
  state_.near.swap(own.near);
  memory_.pairs.swap(own.pairs);
  state_.witnesses.swap(own.witnesses);
  memory_.lasting.swap(own.lasting);
}

void Stepping::exchange(ClusterBooks& own) {
  Segment& segment = state_.trail.back();
  std::swap(report_.certificate, own.certificate);
  std::swap(state_.externalImpulse, own.externalImpulse);
  report_.events.swap(own.events);
  segment.contacts.swap(own.contacts);
  segment.pieces.swap(own.pieces);
}

void Stepping::enter(int cluster) {
  cluster_ = cluster;
  exchange(work_.clusters.before[cluster]);
  exchange(work_.clusters.books[cluster]);
  work_.active.swap(work_.clusters.bodies[cluster]);
  work_.solids.swap(work_.clusters.solids[cluster]);
  state_.t = state_.trail.back().t0;
  for (const int i : work_.carriers) state_.bodies[i] = state_.trail.back().start[i];
  known_ = true;
}

void Stepping::leave() {
  exchange(work_.clusters.after[cluster_]);
  exchange(work_.clusters.books[cluster_]);
}

/// What is tied has more memory than that of islands and pairs: it goes again.
void Stepping::keepEnds() {
  Clusters& clusters = work_.clusters;
  std::vector<ClusterEnd>& ends = clusters.ends;
  ends.assign(clusters.books.size(), {});
  clusters.endOf = work_.cluster;
  for (int i = 0; i < model_.count(); ++i) {
    const int c = work_.cluster[i];
    if (c < 0 || c == work_.tiedCluster) continue;
    ends[c].bodies.push_back(i);
    ends[c].ends.push_back(state_.bodies[i]);
    ends[c].pushes.push_back(memory_.pushes[i]);
    ends[c].islands.push_back(std::move(memory_.islands[i]));
    ends[c].left.push_back(memory_.left[i]);
    ends[c].spins.push_back(memory_.spins[i]);
    ends[c].strayed.push_back(work_.strayed[i]);
    ends[c].turned.push_back(work_.turned[i]);
  }
  for (std::size_t c = 0; c < ends.size(); ++c) ends[c].books = std::move(clusters.books[c]);
  dealPairs([&](int c) -> NearPairs& { return ends[c].known; });
}

bool Stepping::recall(int cluster) {
  Clusters& clusters = work_.clusters;
  if (clusters.ends.empty()) return false;
  const auto own = std::span(clusters.bodies[cluster]).subspan(work_.carriers.size());
  ClusterEnd& end = clusters.ends[clusters.endOf[own.front()]];
  if (!std::equal(own.begin(), own.end(), end.bodies.begin(), end.bodies.end())) return false;
  for (std::size_t k = 0; k < own.size(); ++k) {
    const int i = own[k];
    state_.bodies[i] = end.ends[k];
    memory_.pushes[i] = end.pushes[k];
    std::swap(memory_.islands[i], end.islands[k]);
    memory_.left[i] = end.left[k];
    memory_.spins[i] = end.spins[k];
    work_.strayed[i] = end.strayed[k];
    work_.turned[i] = end.turned[k];
  }
  clusters.after[cluster] = std::move(end.known);
  clusters.books[cluster] = std::move(end.books);
  return true;
}

/// The books of the clusters, in their order, go to those of the step.
void Stepping::closeBooks() {
  Segment& segment = state_.trail.back();
  const auto move = [](auto& from, auto& to) {
    to.insert(to.end(), std::make_move_iterator(from.begin()), std::make_move_iterator(from.end()));
  };
  int parts = 0;
  for (ClusterBooks& books : work_.clusters.books) {
    report_.certificate.add(books.certificate);
    state_.externalImpulse += books.externalImpulse;
    move(books.events, report_.events);
    move(books.contacts, segment.contacts);
    move(books.pieces, segment.pieces);
    parts = std::max(parts, books.parts);
  }
  report_.certificate.steps += parts - 1;
  report_.certificate.evaluations += parts - 1;
  sortEvents(report_, work_.start.events);
}

/// Brings the near pairs of all clusters together, in order.
void Stepping::gather() {
  struct Place {
    std::pair<int, int> near;
    std::size_t cluster, k;
  };
  std::vector<Place> places;
  NearPairs all;
  const auto of = [&](std::size_t c) -> NearPairs& {
    Clusters& clusters = work_.clusters;
    return c < clusters.after.size() ? clusters.after[c] : clusters.strangers;
  };
  for (std::size_t c = 0; c <= work_.clusters.after.size(); ++c) {
    NearPairs& own = of(c);
    for (std::size_t k = 0; k < own.near.size(); ++k) places.push_back({own.near[k], c, k});
    all.lasting.insert(all.lasting.end(), own.lasting.begin(), own.lasting.end());
  }
  std::sort(places.begin(), places.end(),
            [](const Place& p, const Place& q) { return p.near < q.near; });
  for (const Place& place : places) pass(of(place.cluster), place.k, all);
  std::sort(all.lasting.begin(), all.lasting.end(), [](const LastingPair& p, const LastingPair& q) {
    return std::pair(p.b, p.a) < std::pair(q.b, q.a);
  });
  exchange(all);
}

void Stepping::save() {
  StepStart& start = work_.start;
  start.known.near = state_.near;
  start.known.pairs = memory_.pairs;
  start.known.witnesses = state_.witnesses;
  start.known.lasting = memory_.lasting;
  start.islands = memory_.islands;
  start.pushes = memory_.pushes;
  start.chords = memory_.chords;
  start.left = memory_.left;
  start.spins = memory_.spins;
  start.certificate = report_.certificate;
  start.externalImpulse = state_.externalImpulse;
  start.events = report_.events.size();
}

/// Back to the start of the step.
void Stepping::restore() {
  const StepStart& start = work_.start;
  Segment& segment = state_.trail.back();
  state_.t = segment.t0;
  state_.bodies = segment.start;
  state_.near = start.known.near;
  memory_.pairs = start.known.pairs;
  state_.witnesses = start.known.witnesses;
  memory_.lasting = start.known.lasting;
  memory_.islands = start.islands;
  memory_.pushes = start.pushes;
  memory_.chords = start.chords;
  memory_.left = start.left;
  memory_.spins = start.spins;
  report_.certificate = start.certificate;
  state_.externalImpulse = start.externalImpulse;
  report_.events.resize(start.events);
  activateAll();
  segment.contacts.clear();
  segment.pieces.clear();
}

/// Fixed bodies go through the step as one.
void Stepping::moveCarriers(double h) {
  for (const int i : work_.carriers) {
    RigidBody& body = state_.bodies[i] = state_.trail.back().start[i];
    body.x += h * body.v;
    body.q = rotated(body.q, h * body.omega).normalized();
    updateDerived(body);
  }
}

void Stepping::stray(double t1) {
  const Segment& segment = state_.trail.back();
  for (const int i : work_.active) {
    const RigidBody &body = state_.bodies[i], &first = segment.start[i];
    if (body.fixed()) continue;
    const double off = (body.x - first.x - (t1 - segment.t0) * first.v).norm();
    work_.strayed[i] = std::max(work_.strayed[i], off);
    if (std::isfinite(model_.radius[i]))
      work_.turned[i] += (t1 - partStart_) * (body.omega - first.omega).norm() * model_.radius[i];
  }
}

/// Pairs are looked at where the step began, as far as their bodies may have come towards each
/// other.
bool Stepping::haveMet(double h) {
  const std::size_t known = work_.met.size();
  std::vector<RigidBody>& start = state_.trail.back().start;
  state_.bodies.swap(start);
  for (std::size_t k = 0; k < state_.near.size(); ++k) {
    const auto [b, a] = state_.near[k];
    if (!areStrangers(a, b)) continue;
    if (work_.dense[a] || work_.dense[b]) {
      work_.met.push_back(state_.near[k]);
      continue;
    }
    const double strays = work_.strayed[a] + work_.strayed[b] + work_.turned[a] + work_.turned[b];
    look(k, std::max(memory_.pairs[k].margin, marginOf(k, h) + strays));
    if (mayMeet(k, h, strays)) work_.met.push_back(state_.near[k]);
  }
  state_.bodies.swap(start);
  return work_.met.size() > known;
}

/// Where a hit leads bodies of two clusters towards each other, the step begins again: the two are
/// one cluster, and all others end as they did.
void Stepping::stepClusters(double t1, double h) {
  beginSegment(t1);
  save();
  work_.clusters.ends.clear();
  for (bool apart = true; apart;) {
    work_.strayed.assign(state_.bodies.size(), 0.0);
    work_.turned.assign(state_.bodies.size(), 0.0);
    dealOut();
    parted_ = true;
    const int count = static_cast<int>(work_.clusters.bodies.size());
    for (int c = 0; c < count && !halted(); ++c) {
      if (recall(c)) continue;
      enter(c);
      const int parts = go(t1, h);
      leave();
      work_.clusters.books[c].parts = parts;
    }
    const bool stopped = report_.stopped;
    if (!stopped && !misses_) {
      gather();
      activateAll();
      takePairs();
      if (!haveMet(h)) break;
      keepEnds();
    }
    restore();
    if (stopped || misses_) return state_.trail.pop_back();
    takePairs();
    lookAtAll(h);
    findCrowds();
    apart = findClusters(h);
    if (apart) continue;
    state_.trail.pop_back();
    known_ = true;
    go(t1, h);
    return;
  }
  moveCarriers(h);
  closeBooks();
  endSegment(t1);
}

}  // namespace tumble
