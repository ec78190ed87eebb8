#include "render/lines.h"

#include <algorithm>
#include <cmath>

namespace tumble {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

/// A curve may be off by this much when points are left out [px].
constexpr double kFlatness = 0.08;

Vector2d flat(const Vector3d& point) {
  return point.head<2>();
}

double distanceToChord(const Vector3d& p, const Vector3d& a, const Vector3d& b) {
  const Vector2d chord = flat(b) - flat(a), away = flat(p) - flat(a);
  const double length2 = chord.squaredNorm();
  const double t = length2 > 0.0 ? std::clamp(away.dot(chord) / length2, 0.0, 1.0) : 0.0;
  return (away - t * chord).norm();
}

/// Ramer–Douglas–Peucker: keeps of points from `first` to `last` those the eye would miss.
void simplify(const std::vector<Vector3d>& points, std::size_t first, std::size_t last,
              std::vector<bool>& keep) {
  std::size_t farthest = first;
  double worst = kFlatness;
  for (std::size_t i = first + 1; i < last; ++i) {
    const double distance = distanceToChord(points[i], points[first], points[last]);
    if (distance > worst) worst = distance, farthest = i;
  }
  if (farthest == first) return;
  keep[farthest] = true;
  simplify(points, first, farthest, keep);
  simplify(points, farthest, last, keep);
}

std::vector<Vector3d> simplified(const std::vector<Vector3d>& points) {
  std::vector<bool> keep(points.size(), false);
  keep.front() = keep.back() = true;
  simplify(points, 0, points.size() - 1, keep);
  std::vector<Vector3d> kept;
  for (std::size_t i = 0; i < points.size(); ++i)
    if (keep[i] && (kept.empty() || (flat(points[i]) - flat(kept.back())).norm() > 1e-6))
      kept.push_back(points[i]);
  return kept;
}

/// Unit normal of the seam between two stretches: along the bisector of their directions.
Vector2d seam(const Vector3d& a, const Vector3d& b, const Vector3d& c) {
  const Vector2d in = (flat(b) - flat(a)).normalized(), out = (flat(c) - flat(b)).normalized();
  const Vector2d sum = in + out;
  return sum.norm() > 1e-6 ? sum.normalized().eval() : in;
}

}  // namespace

std::vector<std::vector<Vector3d>> projectLine(const std::vector<Vector3d>& points,
                                               const Projection& projection) {
  std::vector<std::vector<Vector3d>> pieces(1);
  std::optional<Vector3d> last;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const std::optional<Vector3d> here = projection.project(points[i]);
    // Where the line crosses the near plane it is cut just in front of it.
    if (i > 0 && here.has_value() != last.has_value()) {
      const auto depth = [&](const Vector3d& p) {
        return (p - projection.eye()).dot(projection.forward());
      };
      const double from = depth(points[i - 1]), to = depth(points[i]);
      const double t = (1.0001 * projection.near() - from) / (to - from);
      const auto cut = projection.project(points[i - 1] + t * (points[i] - points[i - 1]));
      if (cut) pieces.back().push_back(*cut);
      if (!here) pieces.emplace_back();
    }
    if (here) pieces.back().push_back(*here);
    last = here;
  }
  std::erase_if(pieces, [](const auto& piece) { return piece.size() < 2; });
  return pieces;
}

Lines::Lines(const std::string& shaders)
    : program_(shaders, "line.vert", "line.frag"), buffer_(gl::makeBuffer()) {}

void Lines::load(const std::vector<Polyline>& lines, const Stage& stage) {
  stretches_.clear();
  const double n = stage.projection.near(), f = stage.projection.far();
  const auto clipDepth = [&](double depth) {
    return (f + n) / (f - n) - 2.0 * f * n / ((f - n) * depth);
  };
  for (const Polyline& line : lines) {
    if (line.stroke != Stroke::Solid) continue;
    const auto halfWidth = static_cast<float>(0.5 * line.width * stage.scale);
    for (const std::vector<Vector3d>& piece : projectLine(line.points, stage.projection)) {
      const std::vector<Vector3d> p = simplified(piece);
      // A curve that ends where it starts is joined there too; other ends have no seam: a zero
      // normal.
      const std::size_t last = p.size() - 1;
      const bool closed = last > 2 && (flat(p[0]) - flat(p[last])).norm() < 1e-6;
      for (std::size_t i = 0; i < last; ++i) {
        const bool seamAtStart = i > 0 || closed, seamAtEnd = i + 1 < last || closed;
        const Vector2d s =
            seamAtStart ? seam(p[i > 0 ? i - 1 : last - 1], p[i], p[i + 1]) : Vector2d::Zero();
        const Vector2d e =
            seamAtEnd ? seam(p[i], p[i + 1], p[i + 1 < last ? i + 2 : 1]) : Vector2d::Zero();
        const auto up = [&](const Vector3d& q) { return static_cast<float>(stage.height - q.y()); };
        stretches_.push_back({{float(p[i].x()), up(p[i]), float(clipDepth(p[i].z()))},
                              {float(p[i + 1].x()), up(p[i + 1]), float(clipDepth(p[i + 1].z()))},
                              {float(s.x()), float(-s.y()), float(e.x()), float(-e.y())},
                              {line.colour[0], line.colour[1], line.colour[2]},
                              halfWidth});
      }
    }
  }
  gl::upload(GL_ARRAY_BUFFER, buffer_, stretches_);
}

void Lines::draw() const {
  if (stretches_.empty()) return;
  program_.use();
  glDepthMask(GL_FALSE);
  const std::pair<GLenum, float> passes[] = {{GL_LEQUAL, 1.0f}, {GL_GREATER, 0.45f}};
  for (const auto& [depth, opacity] : passes) {
    glDepthFunc(depth);
    program_.set("opacity", opacity);
    quad_.draw(buffer_, 14, {{1, 3, 0}, {2, 3, 3}, {3, 4, 6}, {4, 4, 10}}, 0,
               static_cast<int>(stretches_.size()));
  }
  glDepthFunc(GL_LESS);
  glDepthMask(GL_TRUE);
}

}  // namespace tumble
