// Cuts a solid into convex pieces; one class and long, for all that a piece is asked, in order,
// shares its corners and the work that may be done.
#include "sim/shape/decompose.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <optional>
#include <set>

#include "sim/math/orientation.h"
#include "sim/shape/coarse_cuts.h"
#include "sim/shape/convex_hull.h"
#include "sim/shape/excess.h"
#include "sim/shape/flat_faces.h"
#include "sim/shape/join.h"
#include "sim/shape/notches.h"

namespace tumble {
namespace {

using cut::CutPlane;
using cut::kRounding;
using cut::Notch;
using cut::Notches;
using cut::Surface;
using cut::Triangle;

constexpr long kHullWork = 250;         // triangles that cost as much as a corner of a hull
constexpr long kStirredWork = 50;       // as much as one of a hull of stirred corners
constexpr long kLooks = 8;              // looks at planes or boxes that cost as much as a triangle
constexpr long kInRow = 8;              // planes one after the other, as much as a look at one
constexpr std::size_t kMostSeeds = 48;  // notches of a piece from which planes are drawn
constexpr double kThin = 1e-9;          // of size × area: a piece that may be flat
constexpr std::size_t kMostExact = 4;   // cuts through notches that are tried beside those

/// The convex hull of a piece, and how far it reaches out of the mesh.
struct Wrapping {
  Polyhedron hull;
  double excess = 0.0;  ///< [m]
};

class Decomposer {
 public:
  Decomposer(const Polyhedron& solid, double tolerance, const Means& means)
      : given_(static_cast<int>(solid.points.size())),
        tolerance_(tolerance),
        most_(means.work),
        mostPieces_(means.most) {
    points_.at = solid.points;
    points_.exact.resize(solid.points.size());
    size_ = sizeOf(solid);
    const FlatFaces flat =
        tolerance > 0.0 ? flatFacesOf(solid, kRounding * size_) : allFacesOf(solid);
    for (std::size_t f = 0; f < flat.faces.size(); ++f) {
      std::vector<std::array<int, 3>> triangles;
      cutIntoTriangles(solid, flat.faces[f], triangles);
      for (const auto& corner : triangles) {
        whole_.push_back({corner, static_cast<int>(whole_.size())});
        faceOf_.push_back(flat.first[f]);
      }
    }
    snap_ = std::min(tolerance, means.snap);
    notches_.emplace(points_, whole_, faceOf_, cut::OnPlane{.slack = slack(), .snap = snap_});
    if (means.anywhere) distance_.emplace(solid);
  }

  Pieces good() {
    std::vector<Surface> open = cut::pieces(points_, whole_);
    std::vector<Polyhedron> done;
    while (!open.empty()) {
      Surface piece = std::move(open.back());
      open.pop_back();
      work_ += static_cast<long>(piece.size());
      const std::vector<Notch> notches = notches_->of(piece);
      const std::optional<Polyhedron> hull = hullToAsk(piece, notches);
      if (std::optional<Wrapping> whole = wrapped(piece, notches, hull)) {
        excess_ = std::max(excess_, whole->excess);
        lookForCrossing(piece, whole->hull);
        done.push_back(std::move(whole->hull));
      } else if (std::vector<Surface> parts = parted(piece, notches, hull); !parts.empty()) {
        std::move(parts.begin(), parts.end(), std::back_inserter(open));
      } else if (std::optional<Polyhedron> within = shaved(piece, notches, hull)) {
        done.push_back(*std::move(within));
      } else if (!leftOut(piece)) {
        if (notches.empty())
          refuseCrossing("no plane parts it where it is not convex", outerOf(piece));
        refuse<NoPieces>("no plane parts the mesh", piece, notches);
      }
      if (spent())
        refuse<TooIntricate>("the mesh is too intricate to be taken apart exactly", piece, notches);
      if (done.size() + open.size() > mostPieces_)
        refuse<TooIntricate>(
            "the mesh needs more than " + std::to_string(mostPieces_) + " convex pieces", piece,
            notches);
    }
    std::reverse(done.begin(), done.end());
    constexpr double kGrain = 1e-15;  // of the size: rounding of a corner
    constexpr double kConvex = 0.02;  // of what a cut takes for on it
    const double joined = joinConvex(done, {.thin = std::max(kConvex * snap_, kGrain * size_),
                                            .slack = std::max(snap_, kRounding * size_),
                                            .reach = std::max(0.0, slack() - excess_)});
    if (tolerance_ > 0.0) excess_ += joined;
    checkVolume(done);
    // Hulls of what a plane parts stay on their sides of it, however much they stand out elsewhere.
    Pieces pieces{{}, excess_, 2.0 * (points_.snapped + shaved_) + gape_};
    for (Polyhedron& hull : done)
      pieces.hulls.push_back({std::make_shared<const Polyhedron>(std::move(hull))});
    return pieces;
  }

 private:
  long work() const { return work_ + points_.looks + looks_ / kLooks; }
  bool spent() const { return work() > most_; }
  const Vec3& at(int p) const { return points_.at[static_cast<std::size_t>(p)]; }
  double slack() const { return std::max(tolerance_, kRounding * size_); }

  std::vector<Vec3> cornersOf(const Surface& piece) const { return cut::cornersOf(points_, piece); }

  /// The hull of a piece; none if it is flatter than numbers can tell, or no matter.
  std::optional<Polyhedron> hullToAsk(const Surface& piece, const std::vector<Notch>& notches) {
    if (tolerance_ == 0.0 && !notches.empty()) return {};
    const std::vector<Vec3> corners = cornersOf(piece);
    work_ += kHullWork * static_cast<long>(corners.size());
    try {
      return hullInFrame(corners);
    } catch (const NotASolid&) {
      return {};
    }
  }

  /// The hull of a piece that stands out of the mesh by no more than the tolerance.
  std::optional<Wrapping> wrapped(const Surface& piece, const std::vector<Notch>& notches,
                                  const std::optional<Polyhedron>& hull) {
    Wrapping whole;
    if (tolerance_ == 0.0 && !notches.empty())
      return cut::isThin(points_, piece, kThin) && leftOut(piece) ? std::optional(whole)
                                                                  : std::nullopt;
    if (!hull) return leftOut(piece) ? std::optional(whole) : std::nullopt;
    whole.hull = *hull;
    if (tolerance_ == 0.0) return whole;
    whole.excess = reachOf(piece, whole.hull);
    if (whole.excess <= (distance_ ? snap_ : slack())) return whole;
    if (!distance_) return {};
    const Excess out = excessOf(whole.hull, *distance_, tolerance_, kLooks * (most_ - work()));
    looks_ += out.looks;
    over_ = out.where;
    whole.excess = out.bound;
    return out.bound <= tolerance_ ? std::optional(whole) : std::nullopt;
  }

  /// Whether a piece is flatter than numbers can tell: it is none, and its neighbours gape by it.
  bool leftOut(const Surface& piece) {
    const std::vector<Vec3> corners = cornersOf(piece);
    try {
      hullInFrame(corners);
      return false;
    } catch (const NotASolid&) {
    }
    Vec3 n = Vec3::Zero();
    for (const auto& [corner, face] : piece)
      if (const Vec3 area = twiceArea(at(corner[0]), at(corner[1]), at(corner[2]));
          area.squaredNorm() > n.squaredNorm())
        n = area;
    n.normalize();
    const auto [lo, hi] =
        std::minmax_element(corners.begin(), corners.end(),
                            [&](const Vec3& p, const Vec3& q) { return n.dot(p) < n.dot(q); });
    gape_ += n.dot(*hi - *lo);
    flat_ += cut::sixfoldVolume(points_, piece) / 6.0;
    return true;
  }

  /// The planes of a piece's faces that are the mesh's. What is in front of none of them sees all
  /// its surface from within, and so is in the piece.
  std::vector<HalfSpace> planesOf(const Surface& piece) const {
    std::vector<HalfSpace> planes;
    std::set<int> faces;
    for (const Triangle& t : piece)
      if (t.face >= 0 && faces.insert(t.face).second) {
        const CutPlane plane = notches_->planeOf(t.face);
        planes.push_back({plane.n, plane.d});
      }
    return planes;
  }

  /// How far a hull reaches out of the mesh at most.
  double reachOf(const Surface& piece, const Polyhedron& hull) {
    return reachOver(hull, planesOf(piece), &looks_);
  }

  /// What of the hull of a piece without notches is below its faces, if that is all but a layer no
  /// thicker than the tolerance: where they meet in an edge of a small angle, corners a little over
  /// one of them are far from what is below both.
  std::optional<Polyhedron> shaved(const Surface& piece, const std::vector<Notch>& notches,
                                   const std::optional<Polyhedron>& hull) {
    if (!notches.empty() || !hull) return {};
    const std::vector<HalfSpace> planes = planesOf(piece);
    const double thick = heightOver(planes, hull->points);
    looks_ += static_cast<long>(planes.size() * hull->points.size()) / kInRow;
    if (thick > slack()) return {};
    std::optional<Polyhedron> within = below(*hull, planes, kRounding * size_);
    const double volume = cut::sixfoldVolume(points_, piece) / 6.0;
    if (!within || std::abs(volumeOf(*within) - volume) > 2.0 * slack() * areaOf(*hull)) return {};
    shaved_ = std::max(shaved_, thick);
    return within;
  }

  /// A plane and what it is worth.
  struct Cut {
    CutPlane plane;
    int fewer = 0;    ///< notches after it than before
    int crossed = 0;  ///< edges
  };

  bool isBetter(const Cut& a, const Cut& b) const {
    return a.fewer != b.fewer ? a.fewer > b.fewer : a.crossed < b.crossed;
  }

  /// The parts that the best cut leaves; none if there is no cut.
  std::vector<Surface> parted(const Surface& piece, const std::vector<Notch>& notches,
                              const std::optional<Polyhedron>& hull) {
    std::vector<Cut> cuts = cutsOf(piece, hull ? deepest(*hull, notches) : notches);
    std::stable_sort(cuts.begin(), cuts.end(),
                     [&](const Cut& a, const Cut& b) { return isBetter(a, b); });
    if (distance_ && hull) cuts = tightest(piece, cuts);
    for (const Cut& best : cuts) {
      work_ += static_cast<long>(piece.size());
      cut::Halves halves = cut::halve(points_, piece, best.plane, snap_);
      if (halves.below.empty() || halves.above.empty()) continue;
      std::vector<Surface> parts = cut::pieces(points_, halves.below);
      for (Surface& part : cut::pieces(points_, halves.above)) parts.push_back(std::move(part));
      return parts;
    }
    return {};
  }

  /// Cuts through notches and elsewhere, those first whose parts fill their hulls best.
  std::vector<Cut> tightest(const Surface& piece, std::vector<Cut> cuts) {
    if (cuts.size() > kMostExact) cuts.resize(kMostExact);
    for (const CutPlane& plane : cut::planesInto(over_, distance_->nearest(over_), size_))
      cuts.push_back({plane});
    for (const CutPlane& plane : cut::planesAcross(cornersOf(piece))) cuts.push_back({plane});
    std::vector<std::pair<double, std::size_t>> order;
    for (std::size_t k = 0; k < cuts.size(); ++k)
      order.emplace_back(hollowBeside(piece, cuts[k].plane), k);
    std::sort(order.begin(), order.end());
    std::vector<Cut> sorted;
    for (const auto& [hollow, k] : order) sorted.push_back(cuts[k]);
    return sorted;
  }

  /// Volume [m³] of the hulls of what a plane leaves of a piece, outside of it.
  double hollowBeside(const Surface& piece, const CutPlane& plane) {
    const std::size_t known = points_.at.size();
    const double snapped = points_.snapped;
    const cut::Halves halves = cut::halve(points_, piece, plane, snap_);
    double hollow = 0.0;
    for (const Surface* half : {&halves.below, &halves.above})
      for (const Surface& part : cut::pieces(points_, *half)) try {
          const std::vector<Vec3> corners = cut::stirred(cornersOf(part), snap_);
          work_ += kStirredWork * static_cast<long>(corners.size());
          hollow += volumeOf(convexHull(corners)) - cut::sixfoldVolume(points_, part) / 6.0;
        } catch (const NotASolid&) {
        }
    points_.at.resize(known);
    points_.exact.resize(known);
    points_.snapped = snapped;
    return hollow;
  }

  /// Cuts by notches that matter, from all over the piece.
  std::vector<Cut> cutsOf(const Surface& piece, const std::vector<Notch>& deep) {
    std::vector<Cut> cuts;
    const std::size_t seeds = std::min(kMostSeeds, deep.size());
    for (std::size_t k = 0; k < seeds; ++k) {
      const Notch& notch = deep[tolerance_ > 0.0 ? k : k * deep.size() / seeds];
      for (const CutPlane& plane : notches_->planesAt(notch, deep)) cuts.push_back({plane});
    }
    const double on = std::max(snap_, kRounding * size_);
    const auto crosses = [&](const CutPlane& plane, int from, int to) {
      const double h = plane.height(at(from)), g = plane.height(at(to));
      return (h > on && g < -on) || (h < -on && g > on);
    };
    for (Cut& c : cuts) {
      work_ += static_cast<long>(deep.size());
      // A notch that is cut in two is one more; but where hairs are notches too, cuts that spare
      // them would leave pieces flatter than numbers can tell.
      for (const Notch& notch : deep) {
        if (notches_->resolves(c.plane, notch)) ++c.fewer;
        if (tolerance_ > 0.0 && crosses(c.plane, notch.from, notch.to)) --c.fewer;
      }
    }
    int most = std::numeric_limits<int>::min();
    for (const Cut& c : cuts) most = std::max(most, c.fewer);
    for (Cut& c : cuts) {
      if (c.fewer < most) continue;
      for (const auto& [corner, face] : piece)
        for (std::size_t k = 0; k < 3; ++k)
          c.crossed += crosses(c.plane, corner[k], corner[(k + 1) % 3]) ? 1 : 0;
    }
    return cuts;
  }

  /// Notches deeper than the tolerance under the hull, the deepest first.
  std::vector<Notch> deepest(const Polyhedron& hull, const std::vector<Notch>& notches) {
    looks_ += static_cast<long>(notches.size() * hull.faces.size()) / kInRow;
    std::vector<std::pair<double, std::size_t>> order;
    for (std::size_t k = 0; k < notches.size(); ++k) {
      const Vec3 p = 0.5 * (at(notches[k].from) + at(notches[k].to));
      double depth = std::numeric_limits<double>::infinity();
      for (std::size_t f = 0; f < hull.faces.size(); ++f)
        depth = std::min(depth, hull.normals[f].dot(
                                    hull.points[static_cast<std::size_t>(hull.faces[f][0])] - p));
      // Of depths that differ by less than the tolerance the first notch comes first.
      order.emplace_back(-std::floor(depth / tolerance_), k);
    }
    std::sort(order.begin(), order.end());
    std::vector<Notch> sorted;
    for (const auto& [depth, k] : order)
      if (depth < 0.0 || sorted.empty()) sorted.push_back(notches[k]);
    return sorted;
  }

  /// The pieces fill the mesh, to what the tolerance may add all over its surface and the cuts.
  void checkVolume(const std::vector<Polyhedron>& hulls) const {
    double sum = flat_, area = 0.0;
    for (const Polyhedron& hull : hulls) sum += volumeOf(hull), area += areaOf(hull);
    const double whole = cut::sixfoldVolume(points_, whole_) / 6.0;
    if (hulls.empty()) throw NoPieces("the mesh is flatter than its corners can tell", -1);
    if (std::abs(sum - whole) <= 2.0 * slack() * area) return;
    refuseCrossing("its pieces do not add up to its volume", crossing_);
  }

  /// Where a piece does not fill its hull, though by its notches it should, the surface crosses
  /// itself.
  void lookForCrossing(const Surface& piece, const Polyhedron& hull) {
    if (hull.points.empty()) return;
    const double off = std::abs(volumeOf(hull) - cut::sixfoldVolume(points_, piece) / 6.0);
    if (off <= std::max(off_, 2.0 * slack() * areaOf(hull))) return;
    off_ = off;
    crossing_ = outerOf(piece);
  }

  /// A triangle of a piece that no cut made, if there is one.
  static Triangle outerOf(const Surface& piece) {
    const auto outer =
        std::find_if(piece.begin(), piece.end(), [](const Triangle& t) { return t.face >= 0; });
    return outer == piece.end() ? Triangle{{0, 0, 0}} : *outer;
  }

  [[noreturn]] void refuseCrossing(const std::string& why, const Triangle& near) const {
    const int face = near.face < 0 ? -1 : faceOf_[static_cast<std::size_t>(near.face)];
    const std::string bent =
        tolerance_ > 0.0 ? "; is it bent by more than pieces_tolerance, or " : "; ";
    throw NoPieces(why + bent + "does the surface touch or cross itself" +
                       (face < 0 ? "" : " near " + placeOf(near.corner[0])) +
                       "? Try another pieces_tolerance, closer or wider, or pieces = \"hull\"",
                   face);
  }

  std::string placeOf(int p) const {
    if (p < given_) return "point " + std::to_string(p + 1);
    char buffer[96];
    std::snprintf(buffer, sizeof buffer, "(%.6g, %.6g, %.6g) off point 1", at(p).x(), at(p).y(),
                  at(p).z());
    return buffer;
  }

  template <class Reason>
  [[noreturn]] void refuse(const std::string& why, const Surface& piece,
                           const std::vector<Notch>& notches) const {
    std::string where;
    int face = -1;
    if (notches.empty()) {
      const Triangle outer = outerOf(piece);
      if (outer.face >= 0) face = faceOf_[static_cast<std::size_t>(outer.face)];
      where = ", as near " + placeOf(outer.corner[0]);
    } else {
      const Notch& notch = notches[0];
      face = faceOf_[static_cast<std::size_t>(notch.left)];
      where = ", as at the notch from " + placeOf(notch.from) + " to " + placeOf(notch.to);
    }
    throw Reason(why + where + "; allow more by pieces_tolerance, or take pieces = \"hull\"", face);
  }

  cut::Points points_;
  int given_;  ///< points of the mesh, the first of all
  Surface whole_;
  std::vector<int> faceOf_;  ///< per triangle of `whole_`: the face of the polyhedron
  std::optional<Notches> notches_;
  std::optional<MeshDistance> distance_;  ///< where cuts may be anywhere
  Vec3 over_ = Vec3::Zero();              ///< a point over a dent of the piece that was looked at
  double tolerance_, snap_ = 0.0;         ///< [m] of a piece over the mesh; of corners on a cut
  double size_ = 0.0, excess_ = 0.0;
  double gape_ = 0.0, flat_ = 0.0, off_ = 0.0;  ///< [m], [m³] of pieces left out
  double shaved_ = 0.0;                         ///< [m] of layers left out
  Triangle crossing_ = {{0, 0, 0}};   ///< of the piece whose hull holds most too much: off_ [m³]
  long work_ = 0, looks_ = 0, most_;  ///< triangles, planes looked at
  std::size_t mostPieces_;
};

}  // namespace

Pieces decompose(const Polyhedron& solid, double tolerance, const Means& means) {
  return Decomposer(solid, tolerance, means).good();
}

}  // namespace tumble
