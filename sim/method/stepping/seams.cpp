// Seams: a body that slides from one body onto another whose face is flush with the first meets no
// obstacle, though the nearest features, two edges, have a normal that would stop it.
#include <algorithm>
#include <cmath>

#include "sim/collide/witness.h"
#include "sim/method/stepping/stepping.h"

namespace tumble {

bool Stepping::closed(const Touch& touch) const {
  return touch.contact.point.separation <= tolerance_.touch;
}

/// Takes away the points of pairs that a contact with a third body keeps apart already. Pairs are
/// asked once after each look; those with a face on another, or with a half-space, which has no
/// edge, are not.
void Stepping::leaveSeams() {
  constexpr int kFace = 3;  // closed points
  const auto isClosed = [&](const Touch& touch) { return closed(touch); };
  const auto isPlane = [&](int i) { return std::holds_alternative<HalfSpace>(model_.shapes[i]); };
  work_.crossing.clear();
  for (int k = 0; k < static_cast<int>(memory_.pairs.size()); ++k) {
    PairMemory& pair = memory_.pairs[k];
    const std::vector<Touch>& touches = pair.touches;
    if (pair.asked == pair.look) continue;
    pair.asked = pair.look;
    if (touches.empty()) continue;
    if (isPlane(state_.near[k].first) || isPlane(state_.near[k].second)) continue;
    if (std::count_if(touches.begin(), touches.end(), isClosed) < kFace)
      work_.crossing.push_back(k);
  }
  if (work_.crossing.empty()) return;

  work_.holders.resize(state_.bodies.size());
  for (const auto& [b, a] : state_.near) {
    work_.holders[b].clear();
    work_.holders[a].clear();
  }
  for (int k = 0; k < static_cast<int>(memory_.pairs.size()); ++k) {
    const std::vector<Touch>& touches = memory_.pairs[k].touches;
    if (std::none_of(touches.begin(), touches.end(), isClosed)) continue;
    for (const int i : {state_.near[k].first, state_.near[k].second})
      if (!model_.fixed(i)) work_.holders[i].push_back(k);
  }
  for (const int k : work_.crossing)
    if (keptApart(k, state_.near[k].first) || keptApart(k, state_.near[k].second)) {
      memory_.pairs[k].touches.clear();
      memory_.pairs[k].seamed = true;
    }
}

/// Whether a point of what bends goes its own way beside another body: it is no face that goes on
/// in that one, as in points of its own cloth.
bool Stepping::passesThrough(int point, int other) const {
  const std::vector<int>& partOf = memory_.bendings->partOf;
  return model_.bends(point) && partOf[point] != partOf[other];
}

/// Whether one of the contacts that hold `body` has a plane that parts the two bodies of a pair.
bool Stepping::keptApart(int pair, int body) const {
  constexpr double kAlike = 1.0 - 1e-12;  // cosine of normals of faces that are flush
  const auto [b, a] = state_.near[pair];
  const int other = a == body ? b : a;
  const Vec3& n = memory_.pairs[pair].touches.front().contact.point.n;
  return std::any_of(work_.holders[body].begin(), work_.holders[body].end(), [&](int k) {
    const std::vector<Touch>& touches = memory_.pairs[k].touches;
    if (k == pair || touches.empty()) return false;
    const auto [kb, ka] = state_.near[k];
    if (passesThrough(ka == body ? kb : ka, other)) return false;
    const Vec3 m = state_.near[k].second == body ? touches.front().contact.point.n
                                                 : Vec3(-touches.front().contact.point.n);
    if (std::abs(m.dot(n)) > kAlike) return false;
    const Pose pose = state_.bodies[body].pose(), poseOther = state_.bodies[other].pose();
    const Witness plane{
        .known = true, .tie = NormalTie::FaceOfB, .n_B = poseOther.q.conjugate() * m};
    return gapAlong(plane, model_.shapes[body], pose, model_.shapes[other], poseOther) >=
           -tolerance_.touch;
  });
}

}  // namespace tumble
