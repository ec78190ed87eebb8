// Polygons with holes as triangles: holes are tied to what is around them, then ears are cut
// (Meisters 1975; the ties as in Eberly, "Triangulation by Ear Clipping", 2002).
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "sim/shape/cut.h"

namespace tumble::cut {
namespace {

using Loop = std::vector<int>;

class Filler {
 public:
  Filler(const Points& points, const std::vector<std::array<int, 2>>& edges, const Vec3& n,
         bool exact)
      : points_(points), exact_(exact) {
    double far = 0.0;
    for (const auto& [from, to] : edges)
      far = std::max(far, points.at[static_cast<std::size_t>(from)].lpNorm<1>());
    sure_ = exact ? std::numeric_limits<double>::infinity() : mostNoise(far);
    n.cwiseAbs().maxCoeff(&axis_);
    u_ = (axis_ + 1) % 3, v_ = (axis_ + 2) % 3;
    side_ = n[axis_] < 0.0 ? -1.0 : 1.0;
  }

  std::vector<Loop> loopsOf(const std::vector<std::array<int, 2>>& edges) const {
    std::map<int, std::vector<int>> after;
    for (const auto& [from, to] : edges) after[from].push_back(to);
    std::vector<Loop> loops;
    for (auto& [first, list] : after)
      while (!list.empty()) {
        // Closed only when the way on is that of the beginning: a hole may touch what is around it.
        const int second = list.back();
        Loop loop;
        int last = first, here = second;
        list.pop_back();
        while (here >= 0) {
          loop.push_back(here);
          std::vector<int>& ways = after[here];
          if (here == first) ways.push_back(second);
          const int next = takeNext(last, here, ways);
          if (here == first && next == second) break;
          if (here == first) ways.erase(std::find(ways.begin(), ways.end(), second));
          last = here;
          here = next;
        }
        if (loop.size() > 2) loops.push_back(loop);
      }
    return loops;
  }

  void run(std::vector<Loop> loops, Surface& out) const {
    std::vector<Loop> outer, holes, alone;
    for (Loop& loop : loops) (areaOf(loop) > 0.0 ? outer : holes).push_back(std::move(loop));
    // What reaches farthest is tied first, so that no later tie crosses it.
    std::sort(holes.begin(), holes.end(), [&](const Loop& p, const Loop& q) {
      return farthest(p) != farthest(q) ? farthest(p) > farthest(q) : p < q;
    });
    for (const Loop& hole : holes) {
      Loop* around = nullptr;
      for (Loop& loop : outer)
        if (holds(loop, hole) && (!around || areaOf(loop) < areaOf(*around))) around = &loop;
      if (around)
        tie(hole, holes, *around);
      else
        alone.push_back(hole);
    }
    for (Loop& loop : outer) cutEars(loop, out);
    // A loop that none is around is no hole: its area is too small for its sign to be known.
    for (Loop& loop : alone) cutEars(loop, out);
  }

 private:
  double u(int p) const { return points_.at[static_cast<std::size_t>(p)][u_]; }
  double v(int p) const { return points_.at[static_cast<std::size_t>(p)][v_]; }
  double turn(int a, int b, int c) const {
    const double left = (u(b) - u(a)) * (v(c) - v(a)), right = (v(b) - v(a)) * (u(c) - u(a));
    if (std::abs(left - right) > sure_) return side_ * (left - right);
    return side_ * cut::turn(points_, a, b, c, axis_, exact_);
  }
  static int at(const Loop& loop, std::size_t k) { return loop[k % loop.size()]; }

  double areaOf(const Loop& loop) const {
    double sum = 0.0;
    for (std::size_t k = 1; k + 1 < loop.size(); ++k) {
      const int a = loop[0], b = loop[k], c = loop[k + 1];
      sum += side_ * ((u(b) - u(a)) * (v(c) - v(a)) - (v(b) - v(a)) * (u(c) - u(a)));
    }
    return sum;
  }

  double farthest(const Loop& loop) const {
    double far = u(loop[0]);
    for (const int p : loop) far = std::max(far, u(p));
    return far;
  }

  /// Of several ways on, the one that turns most to the left.
  int takeNext(int last, int here, std::vector<int>& ways) const {
    if (ways.empty()) return -1;
    std::size_t best = 0;
    for (std::size_t k = 1; k < ways.size(); ++k)
      if (angle(last, here, ways[k]) > angle(last, here, ways[best])) best = k;
    const int next = ways[best];
    ways.erase(ways.begin() + static_cast<std::ptrdiff_t>(best));
    return next;
  }

  /// A number that grows with the angle by which the way a, b, c turns left.
  double angle(int a, int b, int c) const {
    const double x = u(b) - u(a), y = v(b) - v(a), s = u(c) - u(b), t = v(c) - v(b);
    const double size = std::sqrt((x * x + y * y) * (s * s + t * t));
    const double sine = side_ * (x * t - y * s) / size, cosine = (x * s + y * t) / size;
    return sine >= 0.0 ? 1.0 - cosine : cosine - 1.0;
  }

  bool holds(const Loop& loop, const Loop& inner) const {
    for (const int p : inner) {
      if (std::find(loop.begin(), loop.end(), p) != loop.end()) continue;
      bool odd = false;
      for (std::size_t k = 0; k < loop.size(); ++k) {
        const int a = loop[k], b = at(loop, k + 1);
        if ((v(a) > v(p)) == (v(b) > v(p))) continue;
        if (u(a) + (v(p) - v(a)) / (v(b) - v(a)) * (u(b) - u(a)) > u(p)) odd = !odd;
      }
      return odd;
    }
    return true;
  }

  bool cross(int a, int b, int c, int d) const {
    if (a == c || a == d || b == c || b == d) return false;
    const double ac = turn(a, b, c), ad = turn(a, b, d), ca = turn(c, d, a), cb = turn(c, d, b);
    const auto apart = [](double x, double y) {
      return (x > 0.0 && y > 0.0) || (x < 0.0 && y < 0.0);
    };
    if (ac == 0.0 && ad == 0.0) return false;
    return !apart(ac, ad) && !apart(ca, cb);
  }

  bool crossesAny(int a, int b, const Loop& loop) const {
    for (std::size_t k = 0; k < loop.size(); ++k)
      if (cross(a, b, loop[k], at(loop, k + 1))) return true;
    return false;
  }

  /// Whether p lies inside the angle of a loop at its corner k.
  bool inCorner(const Loop& loop, std::size_t k, int p) const {
    const int last = at(loop, k + loop.size() - 1), here = loop[k], next = at(loop, k + 1);
    const bool left = turn(last, here, p) > 0.0, right = turn(here, next, p) > 0.0;
    return turn(last, here, next) >= 0.0 ? left && right : left || right;
  }

  /// Joins a hole to the loop around it by the shortest tie that crosses nothing.
  void tie(const Loop& hole, const std::vector<Loop>& holes, Loop& loop) const {
    struct Tie {
      double length;  // squared
      std::size_t from, to;
    };
    std::vector<Tie> ties;
    for (std::size_t i = 0; i < hole.size(); ++i)
      for (std::size_t k = 0; k < loop.size(); ++k) {
        const double du = u(hole[i]) - u(loop[k]), dv = v(hole[i]) - v(loop[k]);
        ties.push_back({du * du + dv * dv, i, k});
      }
    std::stable_sort(ties.begin(), ties.end(),
                     [](const Tie& a, const Tie& b) { return a.length < b.length; });
    const auto free = std::find_if(ties.begin(), ties.end(), [&](const Tie& tie) {
      const int p = hole[tie.from], q = loop[tie.to];
      return inCorner(loop, tie.to, p) && !crossesAny(p, q, loop) &&
             std::none_of(holes.begin(), holes.end(),
                          [&](const Loop& other) { return crossesAny(p, q, other); });
    });
    const auto [from, to] = free == ties.end() ? std::pair<std::size_t, std::size_t>{0, 0}
                                               : std::pair{free->from, free->to};
    Loop joined(loop.begin(), loop.begin() + static_cast<std::ptrdiff_t>(to) + 1);
    for (std::size_t i = 0; i <= hole.size(); ++i) joined.push_back(at(hole, from + i));
    joined.insert(joined.end(), loop.begin() + static_cast<std::ptrdiff_t>(to), loop.end());
    loop = std::move(joined);
  }

  /// A corner of what is left of a loop, and what is known of it.
  struct Corner {
    int point;
    std::size_t last, next;  ///< its neighbours
    bool known = false;      ///< whether it is an ear was asked since a neighbour went
    bool ear = false;
    std::size_t inside = kNone;  ///< a corner in its triangle, for which alone it is no ear
    bool cut = false;
  };
  static constexpr std::size_t kNone = static_cast<std::size_t>(-1);

  /// A corner stays what it is until a neighbour is cut off, or the corner inside its triangle.
  bool isEar(std::vector<Corner>& corners, std::size_t k) const {
    Corner& here = corners[k];
    if (here.known && (here.inside == kNone || !corners[here.inside].cut)) return here.ear;
    const int a = corners[here.last].point, b = here.point, c = corners[here.next].point;
    here.known = true;
    here.ear = turn(a, b, c) > 0.0;
    if (!here.ear) return false;
    // Of those before it each was found outside, or has been cut off.
    for (std::size_t m = here.inside == kNone ? 0 : here.inside; m < corners.size(); ++m) {
      const int p = corners[m].point;
      if (corners[m].cut || p == a || p == b || p == c) continue;
      if (turn(a, b, p) < 0.0 || turn(b, c, p) < 0.0 || turn(c, a, p) < 0.0) continue;
      here.inside = m;
      here.ear = false;
      return false;
    }
    here.inside = kNone;
    return true;
  }

  /// The ear that is cut next, the first of all. Where rounding leaves none, any corner that turns
  /// least.
  std::size_t earOf(std::vector<Corner>& corners) const {
    for (std::size_t k = 0; k < corners.size(); ++k)
      if (!corners[k].cut && isEar(corners, k)) return k;
    std::size_t flattest = kNone;
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t k = 0; k < corners.size(); ++k) {
      const Corner& here = corners[k];
      if (here.cut) continue;
      const double bend =
          std::abs(turn(corners[here.last].point, here.point, corners[here.next].point));
      if (flattest == kNone || bend < least) flattest = k, least = bend;
    }
    return flattest;
  }

  /// In steps by the square of the number of corners.
  void cutEars(const Loop& loop, Surface& out) const {
    const std::size_t n = loop.size();
    std::vector<Corner> corners;
    for (std::size_t k = 0; k < n; ++k)
      corners.push_back({.point = loop[k], .last = (k + n - 1) % n, .next = (k + 1) % n});
    for (std::size_t left = n; left > 2; --left) {
      const std::size_t k = earOf(corners);
      Corner& ear = corners[k];
      out.push_back({{corners[ear.last].point, ear.point, corners[ear.next].point}, -1});
      ear.cut = true;
      for (const std::size_t side : {ear.last, ear.next})
        corners[side].known = false, corners[side].inside = kNone;
      corners[ear.last].next = ear.next;
      corners[ear.next].last = ear.last;
    }
  }

  const Points& points_;
  int axis_ = 0, u_ = 1, v_ = 2;  // the one looked along, and the other two
  double side_ = 1.0;
  double sure_;  // [m²] what turns by more is no line
  bool exact_;
};

}  // namespace

Surface fill(const Points& points, const std::vector<std::array<int, 2>>& edges, const Vec3& n,
             bool exact) {
  constexpr long kEdges = 16;  // squared, that cost as much as a triangle
  points.looks += static_cast<long>(edges.size() * edges.size()) / kEdges;
  Surface filled;
  const Filler filler(points, edges, n, exact);
  filler.run(filler.loopsOf(edges), filled);
  return filled;
}

}  // namespace tumble::cut
