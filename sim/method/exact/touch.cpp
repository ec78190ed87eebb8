// When bodies first touch: the queue of touches to come.
#include <algorithm>
#include <cmath>
#include <tuple>

#include "sim/collide/approach.h"
#include "sim/collide/collide.h"
#include "sim/collide/parts.h"
#include "sim/math/frames.h"
#include "sim/method/exact/exact.h"

namespace tumble {
namespace {

/// The later of two touches; of touches at one instant, the one of later bodies.
bool later(const ExactMemory::Touch& p, const ExactMemory::Touch& q) {
  return std::tie(p.t, p.a, p.b) > std::tie(q.t, q.a, q.b);
}

/// Pairs of parts that rest on each other, in order.
using PairsOfParts = std::vector<std::pair<int, int>>;

void findResting(const Shape& a, const Pose& poseA, const Shape& b, const Pose& poseB, double touch,
                 PairsOfParts& resting) {
  if (!std::holds_alternative<Compound>(a) && !std::holds_alternative<Compound>(b)) {
    if (separation(a, poseA, b, poseB) <= touch) resting.emplace_back(0, 0);
    return;
  }
  const PartView ofA(a, poseA), ofB(b, poseB);
  forNearParts(ofA, ofB, 2.0 * touch, [&](int i, int j) {
    if (separation(ofA.solid(i), ofA.poseOf(i), ofB.solid(j), ofB.poseOf(j)) <= touch)
      resting.emplace_back(i, j);
  });
  std::sort(resting.begin(), resting.end());
}

}  // namespace

void Exact::lookFor(Pair pair, double t) {
  const auto [first, second] = std::minmax(pair.first, pair.second);
  const int b = first, a = second;
  if (bothFixed(a, b)) return;
  // Parts that rest on each other stay so until something happens.
  thread_local PairsOfParts resting;
  resting.clear();
  if (lasts(a, b)) {
    bringTo(t, a);
    bringTo(t, b);
    findResting(model_.shapes[a], state_.bodies[a].pose(), model_.shapes[b],
                state_.bodies[b].pose(), tolerance_.touch, resting);
  }
  double when[2] = {std::nan(""), std::nan("")};
  const auto flyer = [&](int i, const Convex& part, double& at) {
    Flyer flyer{&state_.exact.flights[i].back(), &part, &state_.bodies[i], &at};
    for (std::size_t k = 0; k < state_.exact.tops.size(); ++k)
      if (model_.pivots[k].body == i) flyer.top = &state_.exact.tops[k];
    return flyer;
  };
  double t1 = state_.exact.window.t1;
  bool found = false;
  const std::vector<Convex>&ofA = state_.exact.parts[a], &ofB = state_.exact.parts[b];
  for (int i = 0; i < static_cast<int>(ofA.size()); ++i) {
    for (int j = 0; j < static_cast<int>(ofB.size()); ++j) {
      if (std::binary_search(resting.begin(), resting.end(), std::pair(i, j))) continue;
      Approach approach(flyer(a, ofA[static_cast<std::size_t>(i)], when[0]),
                        flyer(b, ofB[static_cast<std::size_t>(j)], when[1]), tolerance_.touch);
      if (const auto touch = approach.firstTouch(t, t1, true)) {
        t1 = *touch;
        found = true;
      }
    }
  }
  if (found) push(t1, a, b);
}

void Exact::push(double t, int a, int b) {
  state_.exact.queue.push_back({t, a, b, state_.exact.flightCount[a], state_.exact.flightCount[b]});
  std::push_heap(state_.exact.queue.begin(), state_.exact.queue.end(), later);
}

void Exact::lookAround(int body, double t) {
  ExactMemory::Window& w = state_.exact.window;
  if (state_.exact.parts[body].empty()) return;
  w.swept[body] = sweptBox(body, t);
  for (const int plane : w.planes) lookFor({plane, body}, t);
  for (const int other : w.finite)
    if (other != body && w.swept[body].overlaps(w.swept[other])) lookFor({body, other}, t);
}

void Exact::dropStale() {
  std::vector<ExactMemory::Touch>& queue = state_.exact.queue;
  while (!queue.empty() && (queue.front().flightA != state_.exact.flightCount[queue.front().a] ||
                            queue.front().flightB != state_.exact.flightCount[queue.front().b])) {
    std::pop_heap(queue.begin(), queue.end(), later);
    queue.pop_back();
  }
}

}  // namespace tumble
