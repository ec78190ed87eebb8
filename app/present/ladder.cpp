// The ladder of contact forces beside a tower.
#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <numeric>
#include <utility>

#include "app/claim/free_body.h"
#include "app/present/arrows.h"
#include "app/present/palette.h"
#include "render/camera.h"

namespace tumble {

namespace {

/// What two bodies exert on each other.
struct Level {
  int a = 0, b = 0;
  Vec3 force = Vec3::Zero();            ///< [N] on a
  std::vector<Eigen::Vector3d> points;  ///< [m]
};

std::vector<Level> levelsOf(const Sample& sample) {
  std::map<std::pair<int, int>, Level> levels;
  for (const ContactSample& contact : sample.contacts) {
    Level& level = levels[{contact.a, contact.b}];
    level.a = contact.a;
    level.b = contact.b;
    level.force += contact.force;
    level.points.push_back(contact.p);
  }
  std::vector<Level> list;
  for (auto& [pair, level] : levels) list.push_back(std::move(level));
  return list;
}

// Keeps the levels of the group of touching moving bodies that has most of them.
std::vector<Level> tallestGroup(const Scene& scene, std::vector<Level> levels) {
  const std::vector<BodyDef>& bodies = scene.world.bodies;
  std::vector<int> group(bodies.size());
  std::iota(group.begin(), group.end(), 0);
  for (const Level& level : levels)
    if (moves(bodies[level.a]) && moves(bodies[level.b]))
      std::replace(group.begin(), group.end(), int(group[level.a]), int(group[level.b]));
  const auto groupOf = [&](const Level& level) {
    return group[moves(bodies[level.a]) ? level.a : level.b];
  };
  std::vector<int> sizes(bodies.size(), 0);
  for (const Level& level : levels) ++sizes[groupOf(level)];
  const auto tallest = std::max_element(sizes.begin(), sizes.end()) - sizes.begin();
  std::erase_if(levels, [&](const Level& level) { return groupOf(level) != tallest; });
  return levels;
}

/// A level on the page: the point that its leader starts from, and its place in pixels.
struct Rung {
  Eigen::Vector3d leader;
  Eigen::Vector2d place;
  double force;  ///< [N]
};

std::vector<Rung> rungsOf(const std::vector<Level>& levels, const Projection& projection) {
  std::vector<Rung> rungs;
  for (const Level& level : levels) {
    Rung rung{level.points.front(), Eigen::Vector2d::Constant(-1e9), level.force.norm()};
    for (const Eigen::Vector3d& point : level.points) {
      const std::optional<Eigen::Vector3d> pixel = projection.project(point);
      if (!pixel || pixel->x() < rung.place.x()) continue;
      rung.leader = point;
      rung.place = pixel->head<2>();
    }
    rungs.push_back(rung);
  }
  std::stable_sort(rungs.begin(), rungs.end(),
                   [](const Rung& a, const Rung& b) { return a.place.y() < b.place.y(); });
  return rungs;
}

}  // namespace

void addForceLadder(const Scene& scene, const Sample& sample, double aspect, Picture& picture) {
  constexpr double kPage = 720.0, kSpacing = 20.0, kGap = 130.0, kLength = 220.0;  // [px]
  const Projection projection(picture.camera, kPage * aspect, kPage);
  const std::vector<Rung> rungs = rungsOf(tallestGroup(scene, levelsOf(sample)), projection);
  if (rungs.size() < 2) return;

  double largest = 0.0, right = 0.0, above = -1e9;
  for (const Rung& rung : rungs) {
    largest = std::max(largest, rung.force);
    right = std::max(right, rung.place.x());
  }
  const double x = right + kGap;
  for (const Rung& rung : rungs) {
    // Rows keep apart where levels lie close together.
    const double y = std::max(rung.place.y(), above + kSpacing);
    picture.pageArrows.push_back({rung.leader,
                                  {x, y},
                                  kLength * rung.force / largest,
                                  fmt::format("{:.4g} N", rung.force),
                                  colour::kForce});
    above = y;
  }
  Label caption;
  caption.offset = {x, picture.pageArrows.front().base.y() - 44.0};
  caption.text = "sum over the points of a level";
  caption.size = 13.0f;
  caption.italic = true;
  caption.colour = colour::kQuiet;
  picture.labels.push_back(caption);
}

}  // namespace tumble
