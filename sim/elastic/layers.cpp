#include "sim/elastic/layers.h"

#include <algorithm>
#include <cmath>

namespace tumble {
namespace {

/// Thicknesses along a cloth from which on it is told apart from itself.
constexpr double kApart = 2.0;
/// Edges meet a little later than points, of thickness: where cloth lies flat on cloth points alone
/// carry it, and not each crossing of edges beside them.
constexpr double kEdges = 0.9;
/// Of thickness: what is nearer than that has come as near.
constexpr double kNear = 1e-3;

using Stretch = Eigen::Matrix<double, 3, 2>;

bool meet(const Aabb& a, const Aabb& b, double within) {
  return (a.lo.array() <= b.hi.array() + within).all() &&
         (b.lo.array() <= a.hi.array() + within).all();
}

ClothGap nearestOf(bool edges, const std::array<Vec3, 4>& x) {
  return edges ? nearestOfEdges(x) : nearestOnTriangle(x);
}

/// Whether no two points of a patch that are told apart have come near: none are nearer to each
/// other than half of how far they are apart along it, and a little. With R the turn in the mean of
/// F = ∂x/∂(u, v), and the patch convex when flat,
///   |x(q) − x(p)| ≥ e·Rᵀ(x(q) − x(p)) = ∫ e·RᵀF e ds ≥ |q − p| (least eigenvalue of RᵀF).
bool liesFlat(const Stretch& mean, double stray) {
  const Eigen::Matrix2d S = mean.transpose() * mean;
  const double half = 0.5 * S.trace(), off = std::hypot(0.5 * (S(0, 0) - S(1, 1)), S(0, 1));
  return std::sqrt(std::max(0.0, half - off)) - stray >= (1.0 + kNear) / kApart;
}

}  // namespace

double LayerPair::energy() const {
  const double pressed = std::max(0.0, thickness - distance);
  return 0.5 * stiffness * pressed * pressed;
}

Layers::Layers(std::span<const std::shared_ptr<const ElasticBody>> bodies) {
  for (const auto& body : bodies)
    if (body->sheet.thickness > 0.0 && body->sheet.stiffness > 0.0) addCloth(*body);
}

void Layers::addCloth(const ElasticBody& body) {
  const Sheet& sheet = body.sheet;
  const int firstPoint = static_cast<int>(points_.size());
  firsts_.push_back(firstPoint);
  points_.insert(points_.end(), body.bodies.begin(), body.bodies.end());
  clothOf_.resize(points_.size(), static_cast<int>(cloths_.size()));
  for (const Eigen::Vector2d& p : sheet.flat) flat_.emplace_back(p.x(), p.y(), 0.0);
  const auto numberOf = [&](int i) {
    const auto at = std::lower_bound(body.bodies.begin(), body.bodies.end(), i);
    return firstPoint + static_cast<int>(at - body.bodies.begin());
  };
  Cloth cloth{.firstTriangle = static_cast<int>(triangles_.size()),
              .firstPatch = patches_,
              .tree = {},
              .thickness = sheet.thickness,
              .stiffness = sheet.stiffness};
  std::vector<Aabb> boxes;
  std::vector<char> hasPoint(body.bodies.size(), false);
  std::vector<std::pair<int, int>> edges;
  for (const std::array<int, 3>& corners : sheet.triangles) {
    Triangle triangle;
    for (int k = 0; k < 3; ++k) triangle.points[k] = numberOf(corners[k]);
    const auto [a, b, c] = triangle.points;
    Eigen::Matrix2d sides;
    sides << (flat_[b] - flat_[a]).head<2>(), (flat_[c] - flat_[a]).head<2>();
    triangle.unwoven = sides.inverse();
    boxes.push_back({flat_[a].cwiseMin(flat_[b]).cwiseMin(flat_[c]),
                     flat_[a].cwiseMax(flat_[b]).cwiseMax(flat_[c])});
    for (int k = 0; k < 3; ++k) {
      char& known = hasPoint[triangle.points[k] - firstPoint];
      triangle.ownsPoint[k] = !known;
      known = true;
      edges.emplace_back(std::minmax(triangle.points[k], triangle.points[(k + 1) % 3]));
    }
    triangles_.push_back(triangle);
  }
  // An edge is its first triangle's.
  std::vector<std::pair<std::pair<int, int>, int>> sorted;
  for (std::size_t e = 0; e < edges.size(); ++e) sorted.emplace_back(edges[e], static_cast<int>(e));
  std::sort(sorted.begin(), sorted.end());
  for (std::size_t e = 0; e < sorted.size(); ++e)
    if (e == 0 || sorted[e].first != sorted[e - 1].first)
      triangles_[cloth.firstTriangle + sorted[e].second / 3].ownsEdge[sorted[e].second % 3] = true;
  cloth.tree = BoxTree(boxes);
  patches_ += static_cast<int>(cloth.tree.nodes().size());
  cloths_.push_back(std::move(cloth));
}

/// One look: down the trees of cloths, where patches are not flat and boxes meet.
class Layers::Search {
 public:
  Search(const Layers& layers, std::span<const Vec3> x, std::span<const Vec3> way, Look& look)
      : layers_(layers), x_(x), way_(way), look_(look) {}

  void readPatches() {
    look_.patches.resize(layers_.patches_);
    for (const Cloth& cloth : layers_.cloths_) {
      const BoxTree::Nodes& nodes = cloth.tree.nodes();
      Look::Patch* patches = &look_.patches[cloth.firstPatch];
      for (std::size_t k = nodes.size(); k-- > 0;)
        if (nodes[k].item >= 0)
          readTriangle(layers_.triangles_[cloth.firstTriangle + nodes[k].item], patches[k]);
        else
          join(patches[nodes[k].first], patches[nodes[k].last], patches[k]);
    }
  }

  void inCloth(const Cloth& cloth, int k) {
    const BoxTree::Node& node = cloth.tree.nodes()[k];
    const Look::Patch& patch = patchOf(cloth, k);
    const bool flat = liesFlat(patch.stretch[0], patch.stray[0]) &&
                      (way_.empty() || liesFlat(patch.stretch[1], patch.stray[1]));
    if (node.item >= 0 || flat) return;
    inCloth(cloth, node.first);
    inCloth(cloth, node.last);
    between(cloth, node.first, cloth, node.last);
  }

  /// As near as boxes must be to hold what has come near [m]: what is found does not hang on them.
  double nearOf(const Cloth& a, const Cloth& b) const {
    return (1.0 + kNear) * 0.5 * (a.thickness + b.thickness);
  }

  void between(const Cloth& a, int i, const Cloth& b, int j) {
    const BoxTree::Node &p = a.tree.nodes()[i], &q = b.tree.nodes()[j];
    if (!meet(patchOf(a, i).box, patchOf(b, j).box, nearOf(a, b))) return;
    if (p.item >= 0 && q.item >= 0) return triangles(a, p.item, b, q.item);
    if (opensFirst(p, q)) {
      between(a, p.first, b, j);
      between(a, p.last, b, j);
    } else {
      between(a, i, b, q.first);
      between(a, i, b, q.last);
    }
  }

 private:
  const Look::Patch& patchOf(const Cloth& cloth, int k) const {
    return look_.patches[cloth.firstPatch + k];
  }

  void readTriangle(const Triangle& triangle, Look::Patch& patch) const {
    const auto [a, b, c] = triangle.points;
    patch.box = {x_[a].cwiseMin(x_[b]).cwiseMin(x_[c]), x_[a].cwiseMax(x_[b]).cwiseMax(x_[c])};
    Stretch sides;
    sides << x_[b] - x_[a], x_[c] - x_[a];
    patch.stretch[0] = sides * triangle.unwoven;
    patch.stray[0] = patch.stray[1] = 0.0;
    patch.area = 1.0;
    if (way_.empty()) return;
    for (const int p : triangle.points) {
      const Vec3 ahead = x_[p] + way_[p];
      patch.box = {patch.box.lo.cwiseMin(ahead), patch.box.hi.cwiseMax(ahead)};
    }
    sides.col(0) += way_[b] - way_[a];
    sides.col(1) += way_[c] - way_[a];
    patch.stretch[1] = sides * triangle.unwoven;
  }

  void join(const Look::Patch& a, const Look::Patch& b, Look::Patch& patch) const {
    patch.box = {a.box.lo.cwiseMin(b.box.lo), a.box.hi.cwiseMax(b.box.hi)};
    patch.area = a.area + b.area;
    const double share = a.area / patch.area;
    for (int k = 0; k < (way_.empty() ? 1 : 2); ++k) {
      patch.stretch[k] = share * a.stretch[k] + (1.0 - share) * b.stretch[k];
      patch.stray[k] = std::max(a.stray[k] + (a.stretch[k] - patch.stretch[k]).norm(),
                                b.stray[k] + (b.stretch[k] - patch.stretch[k]).norm());
    }
  }

  void triangles(const Cloth& a, int i, const Cloth& b, int j) {
    const Triangle &p = layers_.triangles_[a.firstTriangle + i],
                   &q = layers_.triangles_[b.firstTriangle + j];
    for (int k = 0; k < 3; ++k) {
      if (p.ownsPoint[k]) see(a, b, false, {p.points[k], q.points[0], q.points[1], q.points[2]});
      if (q.ownsPoint[k]) see(b, a, false, {q.points[k], p.points[0], p.points[1], p.points[2]});
      for (int l = 0; p.ownsEdge[k] && l < 3; ++l)
        if (q.ownsEdge[l])
          see(a, b, true, {p.points[k], p.points[(k + 1) % 3], q.points[l], q.points[(l + 1) % 3]});
    }
  }

  std::array<Vec3, 4> at(const std::array<int, 4>& points, double share) const {
    std::array<Vec3, 4> x;
    for (int k = 0; k < 4; ++k) {
      x[k] = x_[points[k]];
      if (share > 0.0) x[k] += share * way_[points[k]];
    }
    return x;
  }

  /// The fastest that the two may come nearer to each other [m per step].
  double reachOf(const std::array<int, 4>& points, int first) const {
    double reach = 0.0;
    for (int i = 0; !way_.empty() && i < first; ++i)
      for (int j = first; j < 4; ++j)
        reach = std::max(reach, (way_[points[i]] - way_[points[j]]).norm());
    return reach;
  }

  void see(const Cloth& a, const Cloth& b, bool edges, const std::array<int, 4>& points) {
    const int first = edges ? 2 : 1;
    LayerPair pair{.points = points, .edges = edges};
    pair.thickness = (edges ? kEdges : 1.0) * 0.5 * (a.thickness + b.thickness);
    for (int i = 0; i < first; ++i)
      for (int j = first; j < 4; ++j)
        if (points[i] == points[j]) return;
    const double t = pair.thickness, reach = reachOf(points, first);
    const ClothGap start = nearestOf(edges, at(points, 0.0));
    pair.distance = start.span.norm();
    if (pair.distance >= t + reach || pair.distance == 0.0 || areNeighbours(a, b, edges, points))
      return;
    // On straight ways they are not nearer than t before the bound of their approach is.
    constexpr int kMost = 50;
    ClothGap nearest = start;
    double d = pair.distance, share = 0.0;
    for (int k = 0; d > (1.0 + kNear) * t; ++k) {
      share += (d - t) / reach;
      if (share >= 1.0 || k == kMost) return;
      nearest = nearestOf(edges, at(points, share));
      d = nearest.span.norm();
    }
    if (d == 0.0) return;
    pair.weight = nearest.weight;
    pair.n = nearest.span / d;
    double ahead = 0.0;
    for (int k = 0; k < 4; ++k) {
      pair.gap += pair.weight[k] * pair.n.dot(x_[points[k]]);
      if (!way_.empty()) ahead += pair.weight[k] * pair.n.dot(way_[points[k]]);
    }
    pair.closes = pair.gap + ahead < t;
    pair.stiffness = 2.0 * a.stiffness * b.stiffness / (a.stiffness + b.stiffness);
    look_.pairs.push_back(pair);
  }

  /// Whether the two are too near along one cloth to be told apart.
  bool areNeighbours(const Cloth& a, const Cloth& b, bool edges,
                     const std::array<int, 4>& points) const {
    if (&a != &b) return false;
    const auto flat = [&](int k) { return layers_.flat_[points[k]]; };
    return nearestOf(edges, {flat(0), flat(1), flat(2), flat(3)}).span.norm() <
           kApart * a.thickness;
  }

  const Layers& layers_;
  std::span<const Vec3> x_, way_;
  Look& look_;
};

void Layers::look(std::span<const Vec3> x, std::span<const Vec3> way, Look& look) const {
  look.pairs.clear();
  look.met.clear();
  Search search(*this, x, way, look);
  search.readPatches();
  for (std::size_t a = 0; a < cloths_.size(); ++a) {
    search.inCloth(cloths_[a], 0);
    for (std::size_t b = a + 1; b < cloths_.size(); ++b) {
      if (!meet(look.patches[cloths_[a].firstPatch].box, look.patches[cloths_[b].firstPatch].box,
                search.nearOf(cloths_[a], cloths_[b])))
        continue;
      look.met.emplace_back(static_cast<int>(a), static_cast<int>(b));
      search.between(cloths_[a], 0, cloths_[b], 0);
    }
  }
}

}  // namespace tumble
