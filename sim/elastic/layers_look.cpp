// Where cloths come as near to themselves and each other as they are thick; long, for one look
// passes all its stages the same lists.
#include <algorithm>
#include <cmath>

#include "sim/elastic/layers.h"

namespace tumble {
namespace {

/// Thicknesses along a cloth from which on it is told apart from itself.
constexpr double kApart = 2.0;
/// Edges meet a little later than points, of thickness: where cloth lies flat on cloth points alone
/// carry it, and not each crossing of edges beside them.
constexpr double kEdges = 0.9;
/// Of thickness: what is nearer than that has come as near.
constexpr double kNear = 1e-3;
/// Thicknesses around a patch within which it is asked together with it whether cloth lies flat.
constexpr double kAround = 2.0;

constexpr int kNone = -1;

using Stretch = Eigen::Matrix<double, 3, 2>;

Aabb boxOf(const Aabb& a, const Aabb& b) {
  return {a.lo.cwiseMin(b.lo), a.hi.cwiseMax(b.hi)};
}

Aabb boxOf(const Vec3& a, const Vec3& b) {
  return {a.cwiseMin(b), a.cwiseMax(b)};
}

Aabb grown(const Aabb& box, double by) {
  return {(box.lo.array() - by).matrix(), (box.hi.array() + by).matrix()};
}

bool holds(const Aabb& box, const Aabb& other) {
  return (box.lo.array() <= other.lo.array()).all() && (other.hi.array() <= box.hi.array()).all();
}

/// Whether what goes straight from one box to another may meet what does so beside it: not if a
/// side that parts them at the start parts them at the end.
bool overlap(const std::array<Aabb, 2>& a, const std::array<Aabb, 2>& b, double within) {
  for (int k = 0; k < 3; ++k)
    if ((a[0].lo[k] > b[0].hi[k] + within && a[1].lo[k] > b[1].hi[k] + within) ||
        (b[0].lo[k] > a[0].hi[k] + within && b[1].lo[k] > a[1].hi[k] + within))
      return false;
  return true;
}

/// The square of how far any two points of two boxes are apart at most [m²].
double farthest(const Aabb& a, const Aabb& b) {
  return (a.hi - b.lo).cwiseMax(b.hi - a.lo).squaredNorm();
}

ClothGap nearestOf(bool edges, const std::array<Vec3, 4>& x) {
  return edges ? nearestOfEdges(x) : nearestOnTriangle(x);
}

/// Of stretches: where no less is left cloth keeps apart what is told apart.
constexpr double kLeast = (1.0 + kNear) / kApart;

/// R of F = R S, with S symmetric: how cloth is turned. @return false if S is less than that
bool turnOf(const Stretch& F, Stretch& R) {
  const Eigen::Matrix2d C = F.transpose() * F;
  const double det = C.determinant(), trace = C.trace();
  if (!(2.0 * det > kLeast * kLeast * trace)) return false;
  // S = (C + √det C 1)/√(tr C + 2 √det C)
  Eigen::Matrix2d S = C;
  S.diagonal().array() += std::sqrt(det);
  R = F * (S.inverse() * std::sqrt(trace + 2.0 * std::sqrt(det)));
  return true;
}

/// Whether the least eigenvalue of the symmetric part of RᵀF is no less.
bool keepsApart(const Stretch& R, const Stretch& F) {
  const double u = R.col(0).dot(F.col(0)) - kLeast, v = R.col(1).dot(F.col(1)) - kLeast,
               w = 0.5 * (R.col(0).dot(F.col(1)) + R.col(1).dot(F.col(0)));
  return u >= 0.0 && v >= 0.0 && u * v >= w * w;
}

}  // namespace

/// As near as boxes must be to hold what has come near [m]: what is found does not hang on them.
double Layers::nearOf(const Cloth& a, const Cloth& b) {
  return (1.0 + kNear) * 0.5 * (a.thickness + b.thickness);
}

/// One look: down the trees of cloths, where patches are not flat and boxes meet.
class Layers::Search {
 public:
  Search(const Layers& layers, std::span<const Vec3> x, std::span<const Vec3> way, Look& look)
      : layers_(layers), x_(x), way_(way), look_(look) {}

  void readPatches() {
    look_.ends.clear();
    for (std::size_t p = 0; p < x_.size(); ++p)
      look_.ends.push_back(way_.empty() ? x_[p] : Vec3(x_[p] + way_[p]));
    look_.patches.resize(layers_.patches_);
    look_.boxes.resize(layers_.patches_);
    look_.flatIn.resize(layers_.patches_);
    for (const Cloth& cloth : layers_.cloths_) {
      const BoxTree::Nodes& nodes = cloth.tree.nodes();
      Look::Patch* patches = &look_.patches[cloth.firstPatch];
      std::array<Aabb, 2>* boxes = &look_.boxes[cloth.firstPatch];
      for (std::size_t k = nodes.size(); k-- > 0;) {
        const auto [first, last] = std::pair(nodes[k].first, nodes[k].last);
        if (nodes[k].item >= 0) {
          readTriangle(layers_.triangles_[cloth.firstTriangle + nodes[k].item], patches[k],
                       boxes[k]);
          continue;
        }
        patches[k].area = patches[first].area + patches[last].area;
        const double share = patches[first].area / patches[k].area;
        for (int e = 0; e < (way_.empty() ? 1 : 2); ++e)
          patches[k].stretch[e] =
              share * patches[first].stretch[e] + (1.0 - share) * patches[last].stretch[e];
        for (int e = 0; e < 2; ++e) boxes[k][e] = tumble::boxOf(boxes[first][e], boxes[last][e]);
      }
    }
  }

  /// Finds the patches about which cloth lies flat, from the largest on. What creased cloth about
  /// the patch around it, a leaf, is asked first.
  void findFlat(const Cloth& cloth, int k = 0, int creased = 0) {
    const BoxTree::Node& node = cloth.tree.nodes()[k];
    int* flatIn = &look_.flatIn[cloth.firstPatch];
    flatIn[k] = kNone;
    if (node.item >= 0) return;
    creased = creaseAbout(cloth, k, creased);
    if (creased == kNone) return std::fill(flatIn + k, flatIn + node.past, k);
    findFlat(cloth, node.first, creased);
    findFlat(cloth, node.last, creased);
  }

  void inCloth(const Cloth& cloth, int k) {
    const BoxTree::Node& node = cloth.tree.nodes()[k];
    if (node.item >= 0 || look_.flatIn[cloth.firstPatch + k] >= 0) return;
    inCloth(cloth, node.first);
    inCloth(cloth, node.last);
    between(cloth, node.first, cloth, node.last);
  }

  void between(const Cloth& a, int i, const Cloth& b, int j) {
    const BoxTree::Node &p = a.tree.nodes()[i], &q = b.tree.nodes()[j];
    if (!overlap(look_.boxes[a.firstPatch + i], look_.boxes[b.firstPatch + j], nearOf(a, b)))
      return;
    if (&a == &b &&
        (farthest(p.box, q.box) < surelyNear(a) || isFlatAbout(a, i, j) || isFlatAbout(a, j, i)))
      return;
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
  static Aabb boxOf(const Triangle& triangle, std::span<const Vec3> x) {
    const auto [a, b, c] = triangle.points;
    return {x[a].cwiseMin(x[b]).cwiseMin(x[c]), x[a].cwiseMax(x[b]).cwiseMax(x[c])};
  }

  void readTriangle(const Triangle& triangle, Look::Patch& patch, std::array<Aabb, 2>& box) const {
    const auto [a, b, c] = triangle.points;
    box[0] = boxOf(triangle, x_);
    box[1] = way_.empty() ? box[0] : boxOf(triangle, look_.ends);
    Stretch sides;
    sides << x_[b] - x_[a], x_[c] - x_[a];
    patch.stretch[0] = sides * triangle.unwoven;
    patch.area = 0.5 / std::abs(triangle.unwoven.determinant());
    if (way_.empty()) return;
    sides.col(0) += way_[b] - way_[a];
    sides.col(1) += way_[c] - way_[a];
    patch.stretch[1] = sides * triangle.unwoven;
  }

  /// Cloth about a patch, as it lies flat.
  static Aabb aboutOf(const Cloth& cloth, int k) {
    return grown(cloth.tree.nodes()[k].box, kAround * cloth.thickness);
  }

  /// A leaf in a patch or about it because of which something that is told apart may come near
  /// there, on all the way. With the turn R of F = ∂x/∂(u, v) in the mean, and what lies about the
  /// patch convex when flat,
  ///   |x(q) − x(p)| ≥ e·Rᵀ(x(q) − x(p)) = ∫ e·RᵀF e ds ≥ |q − p| (least eigenvalue of RᵀF).
  [[gnu::flatten]] int creaseAbout(const Cloth& cloth, int k, int guess) const {
    const BoxTree::Nodes& nodes = cloth.tree.nodes();
    const Look::Patch* patches = &look_.patches[cloth.firstPatch];
    const Aabb about = aboutOf(cloth, k);
    const auto meets = [&](int j) {
      const Aabb& box = nodes[j].box;
      return box.lo.x() <= about.hi.x() && box.lo.y() <= about.hi.y() &&
             about.lo.x() <= box.hi.x() && about.lo.y() <= box.hi.y();
    };
    Stretch R;
    if (!turnOf(way_.empty() ? patches[k].stretch[0]
                             : Stretch(patches[k].stretch[0] + patches[k].stretch[1]),
                R))
      return guess;
    const auto keeps = [&](int j) {
      return keepsApart(R, patches[j].stretch[0]) &&
             (way_.empty() || keepsApart(R, patches[j].stretch[1]));
    };
    if (nodes[guess].item >= 0 && meets(guess) && !keeps(guess)) return guess;
    for (int j = 0; j < static_cast<int>(nodes.size());) {
      const bool met = meets(j);
      if (met && nodes[j].item >= 0 && !keeps(j)) return j;
      j = met ? j + 1 : nodes[j].past;
    }
    return kNone;
  }

  /// Whether the second of two patches lies in what is flat about the first.
  bool isFlatAbout(const Cloth& cloth, int i, int j) const {
    const int flat = look_.flatIn[cloth.firstPatch + i];
    return flat >= 0 && holds(aboutOf(cloth, flat), cloth.tree.nodes()[j].box);
  }

  [[gnu::flatten]] void triangles(const Cloth& a, int i, const Cloth& b, int j) {
    const Triangle &p = layers_.triangles_[a.firstTriangle + i],
                   &q = layers_.triangles_[b.firstTriangle + j];
    if ((&a == &b && areNear(a, p, q)) || areParted(p, q, nearOf(a, b))) return;
    for (int k = 0; k < 3; ++k) {
      if (p.ownsPoint[k]) see(a, b, false, {p.points[k], q.points[0], q.points[1], q.points[2]});
      if (q.ownsPoint[k]) see(b, a, false, {q.points[k], p.points[0], p.points[1], p.points[2]});
      for (int l = 0; p.ownsEdge[k] && l < 3; ++l)
        if (q.ownsEdge[l])
          see(a, b, true, {p.points[k], p.points[(k + 1) % 3], q.points[l], q.points[(l + 1) % 3]});
    }
  }

  static std::array<Vec3, 4> at(const std::array<int, 4>& points, std::span<const Vec3> x) {
    return {x[points[0]], x[points[1]], x[points[2]], x[points[3]]};
  }

  /// The fastest that the two may come nearer to each other [m per step].
  double reachOf(const std::array<int, 4>& points, int first) const {
    double reach = 0.0;
    for (int i = 0; !way_.empty() && i < first; ++i)
      for (int j = first; j < 4; ++j)
        reach = std::max(reach, (way_[points[i]] - way_[points[j]]).squaredNorm());
    return std::sqrt(reach);
  }

  /// The square of how near along a cloth is too near to be told apart, less what rounds [m²].
  static double surelyNear(const Cloth& cloth) {
    return (1.0 - kNear) * std::pow(kApart * cloth.thickness, 2);
  }

  /// Whether all pieces of two triangles are too near along the cloth: corners are not further from
  /// the middle of the other one, nor middles of edges from each other, than that.
  static bool areNear(const Cloth& cloth, const Triangle& p, const Triangle& q) {
    const double round = std::max(p.radius, q.radius);
    const double left = kApart * cloth.thickness * (1.0 - kNear) - round;
    return left > 0.0 && (p.middle - q.middle).squaredNorm() < left * left;
  }

  /// Whether a plane between two triangles at the start parts them at the end, too.
  bool areParted(const Triangle& p, const Triangle& q, double within) const {
    Vec3 across = Vec3::Zero();
    for (int k = 0; k < 3; ++k)
      across +=
          x_[q.points[k]] - x_[p.points[k]] + look_.ends[q.points[k]] - look_.ends[p.points[k]];
    const double least = within * across.norm();
    const auto apart = [&](std::span<const Vec3> x) {
      const auto along = [&](int i) { return across.dot(x[i]); };
      const auto [a, b, c] = p.points;
      const auto [d, e, f] = q.points;
      return std::min({along(d), along(e), along(f)}) - std::max({along(a), along(b), along(c)}) >
             least;
    };
    return apart(x_) && (way_.empty() || apart(look_.ends));
  }

  /// Whether any corner of the one is too near along the cloth to one of the other.
  bool cornersAreNear(const Cloth& cloth, const std::array<int, 4>& points, int first) const {
    const double near = surelyNear(cloth);
    for (int i = 0; i < first; ++i)
      for (int j = first; j < 4; ++j)
        if (const Vec3& p = layers_.flat_[points[i]], &q = layers_.flat_[points[j]];
            (p - q).head<2>().squaredNorm() < near)
          return true;
    return false;
  }

  /// Whether boxes about the two come so near: not if a side that parts them at the start parts
  /// them at the end.
  template <int first>
  bool boxesMeet(const std::array<int, 4>& points, double within) const {
    struct Sides {
      double lo[2], hi[2];
    };
    const auto sidesOf = [&](std::span<const Vec3> x, int d) {
      const double p = x[points[0]][d], q = x[points[1]][d], r = x[points[2]][d],
                   s = x[points[3]][d];
      const auto [lo, hi] = std::pair(std::min(r, s), std::max(r, s));
      if (first == 1) return Sides{{p, std::min(q, lo)}, {p, std::max(q, hi)}};
      return Sides{{std::min(p, q), lo}, {std::max(p, q), hi}};
    };
    for (int d = 0; d < 3; ++d) {
      const Sides start = sidesOf(x_, d);
      for (const int k : {0, 1}) {
        if (!(start.lo[k] > start.hi[1 - k] + within)) continue;
        const Sides end = sidesOf(look_.ends, d);
        if (end.lo[k] > end.hi[1 - k] + within) return false;
      }
    }
    return true;
  }

  void see(const Cloth& a, const Cloth& b, bool edges, const std::array<int, 4>& points) {
    const int first = edges ? 2 : 1;
    const double t = (edges ? kEdges : 1.0) * 0.5 * (a.thickness + b.thickness);
    if ((&a == &b && cornersAreNear(a, points, first)) ||
        !(edges ? boxesMeet<2>(points, (1.0 + kNear) * t)
                : boxesMeet<1>(points, (1.0 + kNear) * t)))
      return;
    LayerPair pair{.points = points, .edges = edges, .thickness = t};
    pair.stiffness = 2.0 * a.stiffness * b.stiffness / (a.stiffness + b.stiffness);
    const ClothGap start = nearestOf(edges, at(points, x_));
    const double distance = start.span.norm(), reach = reachOf(points, first);
    const bool mayMeet = distance < t + reach && distance > 0.0;
    ClothGap end;
    if (!way_.empty()) end = nearestOf(edges, at(points, look_.ends));
    const double left = end.span.norm();
    const bool isNear = !way_.empty() && left < t && left > 0.0;
    if ((!mayMeet && !isNear) || areNeighbours(a, b, edges, points)) return;
    if (isNear) add(pair, end, left, left, look_.ends, {}, look_.ahead);
    if (mayMeet) meetOnWay(pair, start, distance, reach);
  }

  /// On straight ways they are not nearer than t before the bound of their approach is.
  void meetOnWay(const LayerPair& pair, const ClothGap& start, double distance, double reach) {
    constexpr int kMost = 50;
    ClothGap nearest = start;
    double d = distance, share = 0.0;
    for (int k = 0; d > (1.0 + kNear) * pair.thickness; ++k) {
      share += (d - pair.thickness) / reach;
      if (share >= 1.0 || k == kMost) return;
      std::array<Vec3, 4> x = at(pair.points, x_);
      for (int p = 0; p < 4; ++p) x[p] += share * way_[pair.points[p]];
      nearest = nearestOf(pair.edges, x);
      d = nearest.span.norm();
    }
    if (d > 0.0) add(pair, nearest, d, distance, x_, way_, look_.pairs);
  }

  /// Adds a pair that touches where it is `d` apart [m], and is from x to x + way.
  static void add(LayerPair pair, const ClothGap& touch, double d, double distance,
                  std::span<const Vec3> x, std::span<const Vec3> way,
                  std::vector<LayerPair>& pairs) {
    pair.distance = distance;
    pair.weight = touch.weight;
    pair.n = touch.span / d;
    double ahead = 0.0;
    for (int k = 0; k < 4; ++k) {
      pair.gap += pair.weight[k] * pair.n.dot(x[pair.points[k]]);
      if (!way.empty()) ahead += pair.weight[k] * pair.n.dot(way[pair.points[k]]);
    }
    pair.closes = pair.gap + ahead < pair.thickness;
    pairs.push_back(pair);
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

void Layers::meet(std::span<const Vec3> x, std::span<const Vec3> way, Look& look) const {
  std::vector<Aabb> boxes;
  for (std::size_t a = 0; a < cloths_.size(); ++a) {
    const std::size_t end = a + 1 < firsts_.size() ? firsts_[a + 1] : points_.size();
    Aabb& box = boxes.emplace_back(Aabb{x[firsts_[a]], x[firsts_[a]]});
    for (std::size_t p = firsts_[a]; p < end; ++p)
      box = boxOf(box, way.empty() ? Aabb{x[p], x[p]} : boxOf(x[p], x[p] + way[p]));
  }
  look.met.clear();
  for (std::size_t a = 0; a < cloths_.size(); ++a)
    for (std::size_t b = a + 1; b < cloths_.size(); ++b)
      if (boxes[a].overlaps(grown(boxes[b], nearOf(cloths_[a], cloths_[b]))))
        look.met.emplace_back(static_cast<int>(a), static_cast<int>(b));
}

void Layers::look(std::span<const Vec3> x, std::span<const Vec3> way, Look& look) const {
  look.pairs.clear();
  look.ahead.clear();
  meet(x, way, look);
  Search search(*this, x, way, look);
  search.readPatches();
  std::size_t next = 0;
  for (int a = 0; a < static_cast<int>(cloths_.size()); ++a) {
    search.findFlat(cloths_[a]);
    search.inCloth(cloths_[a], 0);
    for (; next < look.met.size() && look.met[next].first == a; ++next)
      search.between(cloths_[a], 0, cloths_[look.met[next].second], 0);
  }
}

}  // namespace tumble
