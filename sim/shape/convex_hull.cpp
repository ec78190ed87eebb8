#include "sim/shape/convex_hull.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>

#include "sim/math/orientation.h"
#include "sim/shape/flat_faces.h"

namespace tumble {
namespace {

constexpr double kThin = 1e-9;      // of the size: thinner, a solid has no inside to speak of
constexpr double kFlat = 1e-12;     // of the size: what rounding may bend a face by
constexpr double kNothing = 1e-40;  // of the size: a coordinate this small is 0

/// A triangle of the hull as it grows, counter-clockwise seen from outside.
struct Facet {
  std::array<int, 3> corner = {};
  std::array<int, 3> beyond = {-1, -1, -1};  ///< facet over the edge from corner k to corner k + 1
  std::vector<int> outside = {};             ///< points that see it; each point in one facet's list
  bool gone = false, seen = false;
};

/// An edge of what stays, as the facet beyond it runs through it backwards.
struct HorizonEdge {
  int from, to, beyond;
};

class Quickhull {
 public:
  explicit Quickhull(const std::vector<Vec3>& points) : p_(points) {}

  void begin(const std::array<int, 4>& tetrahedron);
  /// Adds points until no facet is seen by any.
  void grow();
  /// What was found of the same points, in units of theirs.
  Polyhedron surface(const std::vector<Vec3>& points) const;

 private:
  const Vec3& at(int i) const { return p_[static_cast<std::size_t>(i)]; }
  Facet& facet(int f) { return facets_[static_cast<std::size_t>(f)]; }
  bool sees(int point, const Facet& f) const {
    return orientation(at(f.corner[0]), at(f.corner[1]), at(f.corner[2]), at(point)) > 0;
  }
  int farthest(const Facet& f) const;
  void findHorizon(int point, int first);
  void replaceSeen(int point);

  const std::vector<Vec3>& p_;
  std::vector<Facet> facets_;
  std::vector<int> seen_, homeless_;
  std::vector<HorizonEdge> horizon_;
  std::vector<int> facetFrom_;  ///< the new facet whose edge of the horizon starts at a point
};

void Quickhull::begin(const std::array<int, 4>& corners) {
  auto [a, b, c, d] = corners;
  if (orientation(at(a), at(b), at(c), at(d)) > 0) std::swap(b, c);
  facets_ = {Facet{{a, b, c}}, Facet{{a, d, b}}, Facet{{b, d, c}}, Facet{{c, d, a}}};
  facets_[0].beyond = {1, 2, 3};
  facets_[1].beyond = {3, 2, 0};
  facets_[2].beyond = {1, 3, 0};
  facets_[3].beyond = {2, 1, 0};
  facetFrom_.resize(p_.size());
  for (int i = 0; i < static_cast<int>(p_.size()); ++i) {
    const auto home =
        std::find_if(facets_.begin(), facets_.end(), [&](const Facet& f) { return sees(i, f); });
    if (home != facets_.end()) home->outside.push_back(i);
  }
}

void Quickhull::grow() {
  for (int f = 0; f < static_cast<int>(facets_.size()); ++f) {
    if (facet(f).gone || facet(f).outside.empty()) continue;
    const int point = farthest(facet(f));
    findHorizon(point, f);
    replaceSeen(point);
  }
}

/// Any point outside would do; the farthest spares most of the others.
int Quickhull::farthest(const Facet& f) const {
  const Vec3 n = (at(f.corner[1]) - at(f.corner[0])).cross(at(f.corner[2]) - at(f.corner[0]));
  return *std::max_element(f.outside.begin(), f.outside.end(),
                           [&](int i, int j) { return n.dot(at(i)) < n.dot(at(j)); });
}

/// The facets that a point sees hang together, and one ring of edges bounds them.
void Quickhull::findHorizon(int point, int first) {
  seen_ = {first};
  horizon_.clear();
  facet(first).seen = true;
  for (std::size_t next = 0; next < seen_.size(); ++next) {
    const Facet& here = facet(seen_[next]);
    for (std::size_t k = 0; k < 3; ++k) {
      Facet& other = facet(here.beyond[k]);
      if (other.seen) continue;
      if (sees(point, other)) {
        other.seen = true;
        seen_.push_back(here.beyond[k]);
      } else {
        horizon_.push_back({here.corner[k], here.corner[(k + 1) % 3], here.beyond[k]});
      }
    }
  }
}

/// A facet from each edge of the horizon to the point; points outside the facets that go see one
/// of the new ones or are inside.
void Quickhull::replaceSeen(int point) {
  const std::size_t first = facets_.size();
  for (const HorizonEdge& edge : horizon_) {
    const int index = static_cast<int>(facets_.size());
    facets_.push_back(Facet{{edge.from, edge.to, point}});
    facets_.back().beyond[0] = edge.beyond;
    facetFrom_[static_cast<std::size_t>(edge.from)] = index;
    Facet& stays = facet(edge.beyond);
    for (std::size_t k = 0; k < 3; ++k)
      if (stays.corner[k] == edge.to && stays.corner[(k + 1) % 3] == edge.from)
        stays.beyond[k] = index;
  }
  for (std::size_t f = first; f < facets_.size(); ++f) {
    const int after = facetFrom_[static_cast<std::size_t>(facets_[f].corner[1])];
    facets_[f].beyond[1] = after;
    facet(after).beyond[2] = static_cast<int>(f);
  }
  for (const int f : seen_) {
    facet(f).gone = true;
    homeless_.swap(facet(f).outside);
    for (const int i : homeless_) {
      if (i == point) continue;  // in the plane of all of them, which takes long to tell
      const auto home = std::find_if(facets_.begin() + static_cast<std::ptrdiff_t>(first),
                                     facets_.end(), [&](const Facet& g) { return sees(i, g); });
      if (home != facets_.end()) home->outside.push_back(i);
    }
    homeless_.clear();
  }
}

/// The facets that stayed, with their corners in the order of the points.
Polyhedron Quickhull::surface(const std::vector<Vec3>& points) const {
  std::vector<int> number(p_.size(), -1);
  for (const Facet& f : facets_)
    for (const int i : f.corner)
      if (!f.gone) number[static_cast<std::size_t>(i)] = 0;
  Polyhedron solid;
  for (std::size_t i = 0; i < p_.size(); ++i) {
    if (number[i] < 0) continue;
    number[i] = static_cast<int>(solid.points.size());
    solid.points.push_back(points[i]);
  }
  for (const Facet& f : facets_) {
    if (f.gone) continue;
    std::vector<int> face;
    for (const int i : f.corner) face.push_back(number[static_cast<std::size_t>(i)]);
    solid.faces.push_back(face);
  }
  return solid;
}

/// The point for which `measure` is largest; refused if that is no more than `least`.
template <class Measure>
int outermost(const std::vector<Vec3>& p, double least, const char* refusal, Measure measure) {
  std::size_t best = 0;
  for (std::size_t i = 1; i < p.size(); ++i)
    if (measure(p[i]) > measure(p[best])) best = i;
  if (!(measure(p[best]) > least)) throw NotASolid(refusal, -1);
  return static_cast<int>(best);
}

/// Four of points of size 1 that span a volume: far from the first, from it, from both, from all
/// three.
std::array<int, 4> spanningFour(const std::vector<Vec3>& p) {
  const auto at = [&](int i) { return p[static_cast<std::size_t>(i)]; };
  const int a = outermost(p, 0.0, "the points are all in one place",
                          [&](const Vec3& q) { return (q - p[0]).norm(); });
  const int b = outermost(p, 0.0, "the points are all in one place",
                          [&](const Vec3& q) { return (q - at(a)).norm(); });
  const Vec3 along = (at(b) - at(a)).normalized();
  const int c = outermost(p, kThin, "the points are all on a line, and their hull has no volume",
                          [&](const Vec3& q) { return along.cross(q - at(a)).norm(); });
  const Vec3 n = (at(b) - at(a)).cross(at(c) - at(a)).normalized();
  const int d = outermost(p, kThin, "the points are all in a plane, and their hull has no volume",
                          [&](const Vec3& q) { return std::abs(n.dot(q - at(a))); });
  return {a, b, c, d};
}

void checkFinite(const std::vector<Vec3>& points) {
  for (std::size_t i = 0; i < points.size(); ++i)
    if (!points[i].allFinite())
      throw NotASolid("point " + std::to_string(i + 1) + " is not finite", -1);
}

/// The hull of points whose faces are flat to `bent` [m] at least.
Polyhedron hullOf(const std::vector<Vec3>& points, double bent) {
  if (points.size() < 4)
    throw NotASolid("a hull takes four points or more, found " + std::to_string(points.size()), -1);
  double size = 0.0;
  for (const Vec3& p : points) size = std::max(size, (p - points[0]).lpNorm<Eigen::Infinity>());
  if (!std::isfinite(size)) throw NotASolid("the points are too far apart", -1);

  // Grown in units in which the size is about 1, where exact products stay in the range of doubles.
  int exponent = 0;
  std::frexp(size, &exponent);
  const auto inUnits = [&](double x) {
    const double scaled = std::ldexp(x, -exponent);
    return std::abs(scaled) < kNothing ? 0.0 : scaled;
  };
  std::vector<Vec3> scaled;
  for (const Vec3& p : points) scaled.push_back(p.unaryExpr(inUnits));
  Quickhull hull(scaled);
  hull.begin(spanningFour(scaled));
  hull.grow();
  Polyhedron solid = withFlatFaces(hull.surface(points), std::max(kFlat * size, bent));
  findEdges(solid);
  return solid;
}

}  // namespace

Polyhedron convexHull(const std::vector<Vec3>& given) {
  checkFinite(given);
  std::vector<Vec3> points;
  double away = 0.0;
  for (const Vec3& p : given) {
    points.push_back(p - given[0]);
    away = std::max(away, p.lpNorm<Eigen::Infinity>());
  }
  return hullOf(points, 4.0 * std::numeric_limits<double>::epsilon() * away);
}

Polyhedron hullInFrame(const std::vector<Vec3>& points) {
  checkFinite(points);
  return hullOf(points, 0.0);
}

}  // namespace tumble
