#include "sim/method/stepping/bending.h"

#include <algorithm>
#include <numeric>
#include <utility>

#include "sim/problem/problem.h"

namespace tumble {
namespace {

/// Calls act(i, j) for every pair of the points of an element.
template <class Act>
void forPairs(const Element& element, Act act) {
  for (int j = 1; j < element.count; ++j)
    for (int i = 0; i < j; ++i) act(i, j);
}

void findEdges(const std::vector<int>& pointOf, BendingPart& part) {
  const auto edgeOf = [&](const Element& element, int i, int j) {
    return BlockEdge(std::minmax(pointOf[element.points[i]], pointOf[element.points[j]]));
  };
  for (const Element* element : part.elements)
    forPairs(*element, [&](int i, int j) { part.edges.push_back(edgeOf(*element, i, j)); });
  std::sort(part.edges.begin(), part.edges.end());
  part.edges.erase(std::unique(part.edges.begin(), part.edges.end()), part.edges.end());
  for (const Element* element : part.elements)
    forPairs(*element, [&](int i, int j) {
      const auto at =
          std::lower_bound(part.edges.begin(), part.edges.end(), edgeOf(*element, i, j));
      part.edgesOf.push_back(static_cast<int>(at - part.edges.begin()));
    });
}

/// The graph of the points that move.
void findStructure(BendingPart& part) {
  std::vector<BlockEdge> moving;
  for (std::size_t e = 0; e < part.edges.size(); ++e) {
    const int i = part.mover[part.edges[e].first], j = part.mover[part.edges[e].second];
    if (i < 0 || j < 0) continue;
    part.movingEdges.emplace_back(static_cast<int>(e), static_cast<int>(moving.size()));
    moving.emplace_back(i, j);
  }
  part.structure = std::make_unique<BlockStructure>(static_cast<int>(part.moving.size()), moving);
  // There and back, a sweep multiplies every block off the diagonal four times by a vector.
  constexpr double kSweeps = 10.0, kBlockByVector = 1.0 / 3.0;
  part.costly = part.structure->products() >
                kSweeps * 4.0 * kBlockByVector * static_cast<double>(moving.size());
}

/// Reads the points of a part, whose bodies and elements are known.
void readPart(const Model& model, std::vector<int>& pointOf, BendingPart& part) {
  for (const int i : part.bodies) {
    const int point = static_cast<int>(part.mover.size());
    pointOf[i] = point;
    part.mover.push_back(model.fixed(i) ? -1 : static_cast<int>(part.moving.size()));
    if (!model.fixed(i)) part.moving.push_back(point);
  }
  for (const Joint& joint : model.joints)
    for (const int i : {joint.a, joint.b})
      part.joined = part.joined || std::binary_search(part.bodies.begin(), part.bodies.end(), i);
  findEdges(pointOf, part);
  findStructure(part);
  part.woven = part.edges.size();
  part.wovenMoving = part.movingEdges.size();
  part.own.resize(part.bodies.size());
  part.off.resize(part.edges.size());
  part.constant.resize(part.bodies.size());
  part.about.assign(part.bodies.size(), Vec3::Zero());
  part.star.resize(part.bodies.size());
  part.swept.resize(part.bodies.size());
}

/// Deals the points of elastic bodies out to parts, in the order of their first points: those that
/// elements join, or cloths.
class Dealer {
 public:
  Dealer(const Model& model, Bendings& bendings)
      : model_(model), bendings_(bendings), root_(model.count()) {
    std::iota(root_.begin(), root_.end(), 0);
  }

  void join(int a, int b) {
    const int p = islandRoot(root_, a), q = islandRoot(root_, b);
    root_[std::max(p, q)] = std::min(p, q);
  }
  void join(const ElasticBody& body) {
    for (const Element& element : body.elements)
      for (int k = 1; k < element.count; ++k) join(element.points[0], element.points[k]);
  }
  void deal(const ElasticBody& body) {
    for (const int i : body.bodies) {
      int& part = bendings_.partOf[islandRoot(root_, i)];
      if (part < 0) {
        part = static_cast<int>(bendings_.parts.size());
        bendings_.parts.emplace_back().body = &body;
      }
      bendings_.partOf[i] = part;
      BendingPart& own = bendings_.parts[part];
      own.several = own.several || own.body != &body;
      own.bodies.push_back(i);
    }
    for (const Element& element : body.elements)
      bendings_.parts[bendings_.partOf[element.points[0]]].elements.push_back(&element);
  }
  void finish() {
    for (BendingPart& part : bendings_.parts) {
      std::sort(part.bodies.begin(), part.bodies.end());
      readPart(model_, bendings_.pointOf, part);
    }
  }

 private:
  const Model& model_;
  Bendings& bendings_;
  std::vector<int> root_;
};

}  // namespace

void BendingPart::timesK(const std::vector<Vec3>& v, std::vector<Vec3>& out) const {
  out.resize(v.size());
  for (std::size_t p = 0; p < v.size(); ++p) out[p] = own[p] * v[p];
  for (std::size_t e = 0; e < edges.size(); ++e) {
    const auto [p, q] = edges[e];
    out[p] += off[e] * v[q];
    out[q] += off[e].transpose() * v[p];
  }
}

void BendingPart::press(std::vector<LayerPair> others) {
  pairs = std::move(others);
  edges.resize(woven);
  movingEdges.resize(wovenMoving);
  const auto wovenEnd = edges.begin() + static_cast<std::ptrdiff_t>(woven);
  std::vector<BlockEdge> more;
  for (const LayerPair& pair : pairs)
    for (int j = 1; j < 4; ++j)
      for (int i = 0; i < j; ++i) {
        const BlockEdge edge(std::minmax(pair.points[i], pair.points[j]));
        if (pair.closes && pair.weight[i] != 0.0 && pair.weight[j] != 0.0 &&
            !std::binary_search(edges.begin(), wovenEnd, edge))
          more.push_back(edge);
      }
  std::sort(more.begin(), more.end());
  more.erase(std::unique(more.begin(), more.end()), more.end());
  edges.insert(edges.end(), more.begin(), more.end());
  off.resize(edges.size());
  for (std::size_t e = woven; e < edges.size(); ++e)
    if (mover[edges[e].first] >= 0 && mover[edges[e].second] >= 0)
      movingEdges.emplace_back(static_cast<int>(e), static_cast<int>(movingEdges.size()));
}

const BlockStructure& BendingPart::structureNow() {
  if (movingEdges.size() == wovenMoving) return *structure;
  std::vector<BlockEdge> graph;
  for (const auto& [e, number] : movingEdges)
    graph.emplace_back(mover[edges[e].first], mover[edges[e].second]);
  if (!pressing || !pressing->isFor(static_cast<int>(moving.size()), graph))
    pressing = std::make_unique<BlockStructure>(static_cast<int>(moving.size()), graph);
  return *pressing;
}

Bendings bendingsOf(const Model& model, const std::vector<std::pair<int, int>>& met) {
  Bendings bendings;
  bendings.partOf.assign(model.count(), -1);
  bendings.pointOf.assign(model.count(), -1);
  bendings.met = met;
  Dealer dealer(model, bendings);
  for (const Force& force : model.def.forces)
    if (const Bending* bending = std::get_if<Bending>(&force))
      dealer.join(*bending->body);
    else if (const Layering* layering = std::get_if<Layering>(&force))
      bendings.layers = layering->layers;
    else
      bendings.others.push_back(force);
  if (const Layers* layers = bendings.layers.get()) {
    const std::vector<int>&points = layers->points(), &firsts = layers->firsts();
    for (std::size_t k = 0, cloth = 0; k < points.size(); ++k) {
      if (cloth + 1 < firsts.size() && static_cast<int>(k) == firsts[cloth + 1]) ++cloth;
      dealer.join(points[firsts[cloth]], points[k]);
    }
    for (const auto& [a, b] : met) dealer.join(points[firsts[a]], points[firsts[b]]);
  }
  for (const Force& force : model.def.forces)
    if (const Bending* bending = std::get_if<Bending>(&force)) dealer.deal(*bending->body);
  dealer.finish();
  return bendings;
}

namespace {

/// Adds −h ∂E/∂x + h² H (u − w) of an element to c.
void addMoved(BendingPart& part, std::span<const int> at, int count, double h,
              const ElementTerms& terms) {
  ElementVector u = ElementVector::Zero();
  for (int k = 0; k < count; ++k) {
    u.segment<3>(3 * k) = part.about[at[k]];
    if (part.movesOut()) u.segment<3>(3 * k) -= part.wayOut[at[k]];
  }
  const ElementVector c = h * (h * elementTimes(terms.hessian, u, count) - terms.gradient);
  for (int k = 0; k < count; ++k) part.constant[at[k]] += c.segment<3>(3 * k);
}

/// Adds what pairs of cloth push: as springs along n from where they are at the start, so that they
/// meet what is yet to come, and keep the side that they are on.
void addPressed(BendingPart& part, double h) {
  for (const LayerPair& pair : part.pairs) {
    if (!pair.closes) continue;
    const double k = pair.stiffness;
    const Vec3 push = h * k * (pair.thickness - pair.gap) * pair.n;
    const Mat3 outer = h * h * k * pair.n * pair.n.transpose();
    Vec3 out = Vec3::Zero();
    for (int i = 0; part.movesOut() && i < 4; ++i)
      out += pair.weight[i] * part.wayOut[pair.points[i]];
    for (int i = 0; i < 4; ++i) {
      const double w = pair.weight[i];
      if (w == 0.0) continue;
      part.constant[pair.points[i]] += w * (push - outer * out);
      part.own[pair.points[i]] += w * w * outer;
      for (int j = 0; j < i; ++j)
        if (pair.weight[j] != 0.0)
          part.off[part.edgeOf(pair.points[i], pair.points[j])] += w * pair.weight[j] * outer;
    }
  }
}

}  // namespace

int BendingPart::edgeOf(int p, int q) const {
  const BlockEdge edge(std::minmax(p, q));
  const auto middle = edges.begin() + static_cast<std::ptrdiff_t>(woven);
  auto at = std::lower_bound(edges.begin(), middle, edge);
  if (at == middle || *at != edge) at = std::lower_bound(middle, edges.end(), edge);
  return static_cast<int>(at - edges.begin());
}

double linearise(BendingPart& part, const std::vector<int>& pointOf,
                 std::span<const RigidBody> bodies, double h) {
  std::fill(part.own.begin(), part.own.end(), Mat3::Zero());
  std::fill(part.off.begin(), part.off.end(), Mat3::Zero());
  std::fill(part.constant.begin(), part.constant.end(), Vec3::Zero());
  // u is 0 the first time: then H u is.
  const auto isMotion = [](const Vec3& u) { return !u.isZero(0.0); };
  const bool moves = std::any_of(part.about.begin(), part.about.end(), isMotion) ||
                     std::any_of(part.wayOut.begin(), part.wayOut.end(), isMotion);
  double energy = 0.0;
  ElementTerms terms;
  ElementPlaces x;
  x.fill(Vec3::Zero());
  auto edge = part.edgesOf.begin();
  for (const Element* joined : part.elements) {
    const Element& element = *joined;
    std::array<int, kElementPoints> at = {};
    for (int k = 0; k < element.count; ++k) {
      at[k] = pointOf[element.points[k]];
      x[k] = bodies[element.points[k]].x + h * part.about[at[k]];
    }
    differentiate(element.energy, x, ElementAsk::Projected, terms);
    energy += terms.energy;
    if (moves) addMoved(part, at, element.count, h, terms);
    const bool resists = damps(element.energy);
    const auto K = [&](int i, int j) -> Mat3 {
      Mat3 block = h * terms.hessian.block<3, 3>(3 * i, 3 * j);
      if (resists) block += terms.damping.block<3, 3>(3 * i, 3 * j);
      return h * block;
    };
    for (int k = 0; k < element.count; ++k) {
      if (!moves) part.constant[at[k]] -= h * terms.gradient.segment<3>(3 * k);
      part.own[at[k]] += K(k, k);
    }
    forPairs(element,
             [&](int i, int j) { part.off[*edge++] += at[i] < at[j] ? K(i, j) : K(j, i); });
  }
  if (part.body->sheet.thickness > 0.0) {
    part.wovenOwn = part.own;
    part.wovenOff.assign(part.off.begin(),
                         part.off.begin() + static_cast<std::ptrdiff_t>(part.woven));
    part.wovenConstant = part.constant;
  }
  addPressed(part, h);
  return energy;
}

void repress(BendingPart& part, double h) {
  part.own = part.wovenOwn;
  part.constant = part.wovenConstant;
  std::copy(part.wovenOff.begin(), part.wovenOff.end(), part.off.begin());
  std::fill(part.off.begin() + static_cast<std::ptrdiff_t>(part.woven), part.off.end(),
            Mat3::Zero());
  addPressed(part, h);
}

void reach(BendingPart& part, std::span<const RigidBody> bodies, std::span<const Vec6> after,
           std::span<const Vec3> falls, double h) {
  part.reachedAt.resize(part.bodies.size());
  for (std::size_t p = 0; p < part.bodies.size(); ++p) {
    const int i = part.bodies[p];
    part.reachedAt[p] = bodies[i].x + h * (after[i].head<3>() - falls[i]);
    if (part.movesOut()) part.reachedAt[p] += h * part.wayOut[p];
  }
}

void storeReached(BendingPart& part, const std::vector<int>& pointOf) {
  part.reached = 0.0;
  ElementTerms terms;
  ElementPlaces x;
  x.fill(Vec3::Zero());
  for (const Element* element : part.elements) {
    for (int k = 0; k < element->count; ++k) x[k] = part.reachedAt[pointOf[element->points[k]]];
    differentiate(element->energy, x, ElementAsk::Energy, terms);
    part.reached += terms.energy;
  }
}

void setSide(BendingPart& part, std::span<const RigidBody> bodies, double h) {
  part.side.resize(part.moving.size());
  for (std::size_t p = 0; p < part.bodies.size(); ++p) {
    const RigidBody& body = bodies[part.bodies[p]];
    part.star[p] = body.v;
    if (part.mover[p] < 0) continue;
    part.star[p] += h * body.invM * body.force;
    part.side[part.mover[p]] = body.P + h * body.force + part.constant[p];
    if (!part.lean.empty()) part.side[part.mover[p]] += body.M * part.lean[p];
  }
  // Points that are led along have a velocity already.
  for (std::size_t e = 0; e < part.edges.size(); ++e) {
    const auto [p, q] = part.edges[e];
    if ((part.mover[p] < 0) == (part.mover[q] < 0)) continue;
    if (part.mover[q] < 0)
      part.side[part.mover[p]] -= part.off[e] * bodies[part.bodies[q]].v;
    else
      part.side[part.mover[q]] -= part.off[e].transpose() * bodies[part.bodies[p]].v;
  }
}

bool freeMotion(BendingPart& part, std::span<const RigidBody> bodies) {
  part.factor.begin(part.structureNow());
  for (std::size_t m = 0; m < part.moving.size(); ++m) {
    const int p = part.moving[m];
    Mat3& block = part.factor.diagonal(static_cast<int>(m));
    block = part.own[p];
    block.diagonal().array() += bodies[part.bodies[p]].M;
  }
  for (const auto& [e, number] : part.movingEdges) {
    const bool firstIsRow = part.factor.edgeRow(number) == part.mover[part.edges[e].first];
    part.factor.lower(number) = firstIsRow ? part.off[e] : Mat3(part.off[e].transpose());
  }
  if (!part.factor.factor()) return false;
  std::vector<Vec3> v = part.side;
  part.factor.solve(v);
  for (const int p : part.moving) part.star[p] = v[part.mover[p]];
  return true;
}

}  // namespace tumble
