// Chapter 2, elastic: cloths that lie on themselves and on each other, and where.
#pragma once

#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "sim/elastic/elastic_body.h"
#include "sim/shape/box_tree.h"

namespace tumble {

/// A point and a triangle, or two edges, of cloth that press on each other, or will. Numbers of
/// points are those of `Layers`.
struct LayerPair {
  std::array<int, 4> points = {};
  bool edges = false;
  double stiffness = 0.0, thickness = 0.0;  ///< as of ClothPoint
  double distance = 0.0;                    ///< [m] where the points are
  /// Where they come nearest, or touch: weights, the direction of their span, and how far apart
  /// they are along it at the start [m].
  Vec4 weight = Vec4::Zero();
  Vec3 n = Vec3::Zero();
  double gap = 0.0;
  bool closes = false;  ///< going on, they come nearer along it than they are thick

  double energy() const;  ///< [J]
};

/// All cloths that are not to pass through themselves and each other. Of one cloth, what lies
/// nearer than twice its thickness along it is not told apart: a fold that is as narrow as it is
/// thick is 1.6 of them round.
class Layers {
 public:
  explicit Layers(std::span<const std::shared_ptr<const ElasticBody>> bodies);

  bool empty() const { return points_.empty(); }
  /// Bodies of the world, by numbers of points here.
  const std::vector<int>& points() const { return points_; }
  /// The first of its points, of each cloth.
  const std::vector<int>& firsts() const { return firsts_; }

  /// What is remembered of one look.
  struct Look {
    struct Patch {
      Eigen::Matrix<double, 3, 2> stretch[2];  ///< ∂x/∂(u, v), in the mean, at the start and ahead
      double area = 0.0;                       ///< [m²] when flat
    };
    std::vector<Vec3> ends;  ///< [m] per point
    std::vector<Patch> patches;
    std::vector<std::array<Aabb, 2>> boxes;  ///< of patches, at the start and ahead
    std::vector<int> flatIn;  ///< per patch: one it is part of, about which cloth lies flat, or −1
    std::vector<LayerPair> pairs;
    std::vector<LayerPair> ahead;          ///< those that are as near at the end of the way
    std::vector<std::pair<int, int>> met;  ///< cloths whose boxes overlap
  };
  /// Finds the pairs that are nearer than their thickness at places x [m] or, if they go straight
  /// to x + way, come so near on it. In an order that hangs on the cloths alone.
  /// @param way  [m] per point; empty: none goes anywhere
  void look(std::span<const Vec3> x, std::span<const Vec3> way, Look& look) const;
  /// Finds only which cloths meet.
  void meet(std::span<const Vec3> x, std::span<const Vec3> way, Look& look) const;

  /// Energy [J] of all pairs at places of bodies.
  template <class PlaceOf>
  double energyAt(const PlaceOf& placeOf) const {
    thread_local std::vector<Vec3> x;  // keep their storage from call to call
    thread_local Look at;
    x.clear();
    for (const int body : points_) x.push_back(placeOf(body));
    look(x, {}, at);
    double sum = 0.0;
    for (const LayerPair& pair : at.pairs) sum += pair.energy();
    return sum;
  }

 private:
  struct Triangle {
    std::array<int, 3> points = {};
    Eigen::Matrix2d unwoven = {};                       ///< [1/m] takes its edges to ∂x/∂(u, v)
    std::array<bool, 3> ownsPoint = {}, ownsEdge = {};  ///< edge k: from corner k to the next
    Vec3 middle = Vec3::Zero();                         ///< [m] when flat,
    double radius = 0.0;                                ///< and how far from it corners are at most
  };
  struct Cloth {
    int firstTriangle = 0, firstPatch = 0;
    BoxTree tree;  ///< of triangles as they lie flat
    double thickness = 0.0, stiffness = 0.0;
  };
  class Search;

  void addCloth(const ElasticBody& body);
  static double nearOf(const Cloth& a, const Cloth& b);

  std::vector<int> points_, firsts_;
  std::vector<int> clothOf_;  ///< per point
  std::vector<Vec3> flat_;    ///< [m] per point, across z
  std::vector<Triangle> triangles_;
  std::vector<Cloth> cloths_;
  int patches_ = 0;
};

}  // namespace tumble
