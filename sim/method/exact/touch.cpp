// When bodies first touch: the queue of touches to come.
#include <algorithm>
#include <tuple>

#include "sim/collide/approach.h"
#include "sim/collide/collide.h"
#include "sim/math/frames.h"
#include "sim/method/exact/exact.h"

namespace tumble {
namespace {

/// The later of two touches; of touches at one instant, the one of later bodies.
bool later(const ExactMemory::Touch& p, const ExactMemory::Touch& q) {
  return std::tie(p.t, p.a, p.b) > std::tie(q.t, q.a, q.b);
}

}  // namespace

void Exact::lookFor(Pair pair, double t) {
  const auto [first, second] = std::minmax(pair.first, pair.second);
  const int b = first, a = second;
  if (bothFixed(a, b)) return;
  const auto flyer = [&](int i, const Convex& part) {
    Flyer flyer{&state_.exact.flights[i].back(), &part, &state_.bodies[i]};
    for (std::size_t k = 0; k < state_.exact.tops.size(); ++k)
      if (model_.pivots[k].body == i) flyer.top = &state_.exact.tops[k];
    return flyer;
  };
  const bool held = lasts(a, b);
  double t1 = state_.exact.window.t1;
  bool found = false;
  for (const Convex& partA : state_.exact.parts[a]) {
    for (const Convex& partB : state_.exact.parts[b]) {
      if (held) {  // parts that rest on each other stay so until something happens
        bringTo(t, a);
        bringTo(t, b);
        if (separation(partA.shape, toWorld(state_.bodies[a].pose(), partA.pose), partB.shape,
                       toWorld(state_.bodies[b].pose(), partB.pose)) <= tolerance_.touch)
          continue;
      }
      Approach approach(flyer(a, partA), flyer(b, partB), tolerance_.touch);
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
