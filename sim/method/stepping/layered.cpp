// Cloth that presses on cloth, in a step: which pairs do, and what they make of what bends.
#include <algorithm>
#include <tuple>

#include "sim/method/stepping/stepping.h"

namespace tumble {
namespace {

/// Of the thickness: what comes together, or is held, by less counts as it was.
constexpr double kSame = 1e-3;

bool comesBefore(const LayerPair& a, const LayerPair& b) {
  return std::tie(a.edges, a.points) < std::tie(b.edges, b.points);
}

}  // namespace

/// Cloths that met become one part, with what was remembered of theirs; those that parted, several.
void Stepping::regroup() {
  const Bendings& before = *memory_.bendings;
  auto after = std::make_shared<Bendings>(bendingsOf(model_, before.look.met));
  std::vector<Unswept> unswept(after->parts.size());
  std::vector<char> chords(after->parts.size(), 0);
  for (std::size_t k = 0; k < after->parts.size(); ++k)
    for (const int i : after->parts[k].bodies) {
      const std::size_t from = before.partOf[i];
      if (from >= memory_.unswept.size()) continue;
      unswept[k].left = std::max(unswept[k].left, memory_.unswept[from].left);
      unswept[k].next = std::max(unswept[k].next, memory_.unswept[from].next);
      chords[k] = chords[k] || memory_.chords[from];
    }
  after->look = before.look;
  memory_.bendings = after;
  memory_.unswept = unswept;
  memory_.chords = chords;
}

/// The pairs that press on each other as points go on under their forces.
void Stepping::findPressed(double h) {
  if (!memory_.bendings->layers) return;
  std::vector<Vec3>&places = memory_.bendings->places, &ways = memory_.bendings->ways;
  places.clear();
  ways.clear();
  for (const int i : memory_.bendings->layers->points()) {
    const RigidBody& body = state_.bodies[i];
    places.push_back(body.x);
    ways.push_back(h * (body.v + h * body.invM * body.force));
  }
  memory_.bendings->layers->look(places, ways, memory_.bendings->look);
  if (memory_.bendings->look.met != memory_.bendings->met) regroup();
  Bendings& bendings = *memory_.bendings;
  std::vector<std::vector<LayerPair>> pairs(bendings.parts.size());
  for (BendingPart& part : bendings.parts) part.pressed = 0.0;
  for (LayerPair& pair : bendings.look.pairs) {
    const int part = partOfPair(pair);
    bendings.parts[part].pressed += pair.energy();
    pairs[part].push_back(pair);
  }
  for (std::size_t k = 0; k < pairs.size(); ++k)
    if (!pairs[k].empty() || !bendings.parts[k].pairs.empty())
      bendings.parts[k].press(std::move(pairs[k]));
}

/// The part of a pair, whose points become those of that part.
int Stepping::partOfPair(LayerPair& pair) const {
  const Bendings& bendings = *memory_.bendings;
  const std::vector<int>& bodies = bendings.layers->points();
  const int part = bendings.partOf[bodies[pair.points[0]]];
  for (int& p : pair.points) p = bendings.pointOf[bodies[p]];
  return part;
}

/// Where they touch at the end, if they are still on the side that they were on: weights and
/// direction of the end tell better what they push than those of the touch.
void Stepping::turnPressed(const LayerPair& end, LayerPair& pair) const {
  if (end.n.dot(pair.n) <= 0.0) return;
  pair.weight = end.weight;
  pair.n = end.n;
  pair.gap = 0.0;
  for (int k = 0; k < 4; ++k)
    pair.gap += end.weight[k] * end.n.dot(memory_.bendings->places[end.points[k]]);
}

/// How far apart a pair is along its direction where the velocities found lead [m].
double Stepping::gapAtEnd(const BendingPart& part, const LayerPair& pair) const {
  double gap = pair.gap;
  for (int p = 0; p < 4; ++p) {
    const int i = pair.points[p];
    gap += pair.weight[p] * pair.n.dot(part.reachedAt[i] - state_.bodies[part.bodies[i]].x);
  }
  return gap;
}

/// Pairs that come together although they were not to, push; those that part are let go.
bool Stepping::flipPressed(BendingPart& part) const {
  bool any = false;
  for (LayerPair& pair : part.pairs) {
    const double open = gapAtEnd(part, pair) / pair.thickness - 1.0;
    const bool flips = pair.closes ? open > kSame : open < -kSame;
    pair.closes = pair.closes != flips;
    any = any || flips;
  }
  return any;
}

/// Takes the pairs as points go where the velocities found lead, which were just seen. @return
/// whether others are met
bool Stepping::seePressed() {
  Bendings& bendings = *memory_.bendings;
  std::vector<LayerPair> ends = bendings.look.ahead;
  std::sort(ends.begin(), ends.end(), comesBefore);
  std::vector<std::vector<LayerPair>> pairs(bendings.parts.size());
  for (LayerPair pair : bendings.look.pairs) {
    const auto end = std::lower_bound(ends.begin(), ends.end(), pair, comesBefore);
    if (end != ends.end() && !comesBefore(pair, *end)) turnPressed(*end, pair);
    pairs[partOfPair(pair)].push_back(pair);
  }
  bool any = false;
  for (std::size_t k = 0; k < pairs.size(); ++k) {
    BendingPart& part = bendings.parts[k];
    std::sort(part.pairs.begin(), part.pairs.end(), comesBefore);
    std::sort(pairs[k].begin(), pairs[k].end(), comesBefore);
    std::vector<LayerPair> all;
    for (LayerPair& pair : pairs[k]) {
      const auto old = std::lower_bound(part.pairs.begin(), part.pairs.end(), pair, comesBefore);
      const bool known = old != part.pairs.end() && !comesBefore(pair, *old);
      const double gap = gapAtEnd(part, pair);
      any = any || (gap < (1.0 - kSame) * pair.thickness &&
                    (!known || std::abs(gapAtEnd(part, *old) - gap) > kSame * pair.thickness));
      pair.closes = known ? old->closes || gap < pair.thickness : gap < pair.thickness;
      all.push_back(pair);
    }
    for (const LayerPair& pair : part.pairs)
      if (!std::binary_search(pairs[k].begin(), pairs[k].end(), pair, comesBefore))
        all.push_back(pair);
    part.press(std::move(all));
  }
  return any;
}

/// @return whether the step is to be solved anew, for pairs came together, or parted.
bool Stepping::flips(double h) {
  if (!memory_.bendings->layers) return false;
  reachBent(h);
  bool any = false;
  for (BendingPart& part : memory_.bendings->parts) {
    if (!flipPressed(part)) continue;
    any = true;
    part.press(std::vector<LayerPair>(part.pairs));
    repress(part, h);
    begin(part, h);
  }
  return any;
}

/// Whether the first answers of sweeps only have to tell which pairs press.
bool Stepping::mayGuess() const {
  const std::vector<BendingPart>& parts = memory_.bendings->parts;
  return std::any_of(parts.begin(), parts.end(),
                     [](const BendingPart& part) { return part.sweeps && !part.pairs.empty(); });
}

/// Which pairs press is known well enough. @return whether the step is to be solved anew for that
bool Stepping::endGuess() {
  if (!guesses_) return false;
  guesses_ = false;
  for (BendingPart& part : memory_.bendings->parts)
    if (part.sweeps) part.anew = part.fresh = true;
  return true;
}

/// @return whether the step is to be solved anew: pairs met that were not foreseen, or it gains by
/// where they press on each other.
bool Stepping::pressesFurther(double h, bool gains, int& looks) {
  constexpr int kLooks = 2;
  if (!memory_.bendings->layers || looks >= kLooks) return false;
  ++looks;
  if (!seePressed() && !gains) return false;
  const auto closes = [](const LayerPair& pair) { return pair.closes; };
  bool any = false;
  for (BendingPart& part : memory_.bendings->parts) {
    if (std::none_of(part.pairs.begin(), part.pairs.end(), closes)) continue;
    any = true;
    repress(part, h);
    begin(part, h);
  }
  return any;
}

/// Where a point goes at the velocities found last.
const Vec3& Stepping::reachedBy(int body) const {
  const Bendings& bendings = *memory_.bendings;
  return bendings.parts[bendings.partOf[body]].reachedAt[bendings.pointOf[body]];
}

/// Adds what is pressed where the velocities of parts that are fresh lead.
void Stepping::reachPressed() {
  Bendings& bendings = *memory_.bendings;
  const auto isFresh = [](const BendingPart& part) { return part.fresh; };
  if (!bendings.layers || std::none_of(bendings.parts.begin(), bendings.parts.end(), isFresh))
    return;
  std::vector<Vec3>&places = bendings.places, &ways = bendings.ways;
  places.clear();
  ways.clear();
  for (const int i : bendings.layers->points()) {
    places.push_back(state_.bodies[i].x);
    ways.push_back(reachedBy(i) - state_.bodies[i].x);
  }
  bendings.layers->look(places, ways, bendings.look);
  for (LayerPair pair : bendings.look.ahead) {
    BendingPart& part = bendings.parts[partOfPair(pair)];
    if (part.fresh) part.reached += pair.energy();
  }
}

}  // namespace tumble
