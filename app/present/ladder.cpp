// The ladder of contact forces beside a tower.
#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <numeric>
#include <set>
#include <utility>

#include "app/present/arrows.h"
#include "app/present/digits.h"
#include "app/present/palette.h"
#include "app/record/bodies.h"
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

// Keeps the levels of the group of touching moving bodies that has most of them, if they are levels
// of a tower: in a wall or heap pairs that touch outnumber the bodies.
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
  std::set<int> stacked;
  for (const Level& level : levels)
    for (const int body : {level.a, level.b})
      if (moves(bodies[body])) stacked.insert(body);
  if (levels.size() > stacked.size() + 1) levels.clear();
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

constexpr double kSpacing = 20.0, kLength = 220.0, kShortest = 90.0;  // [px] of rows and bars
constexpr double kGap = 0.1015625;  // of the page, between the bodies and the bars
constexpr double kText = 80.0, kTop = 90.0, kBottom = 40.0, kEdge = 16.0;  // [px] left free
constexpr double kCaption = 44.0;  // [px] from the first row up

// Every second, fifth, tenth … level from below, so that rows fit on a page of that height. Returns
// which.
int thin(double height, std::vector<Rung>& rungs) {
  const double rows = std::max(2.0, std::floor((height - kTop - kBottom) / kSpacing));
  int every = 1;
  for (const int step : {1, 2, 5, 10, 20, 50, 100})
    if (static_cast<double>(rungs.size()) / (every = step) <= rows) break;
  std::vector<Rung> kept;
  for (std::size_t k = (rungs.size() - 1) % every; k < rungs.size(); k += every)
    kept.push_back(rungs[k]);
  rungs = std::move(kept);
  return every;
}

// Rows keep apart where levels lie close together, and stay on the page.
std::vector<double> rowsOf(const std::vector<Rung>& rungs, double height) {
  std::vector<double> rows;
  for (const Rung& rung : rungs)
    rows.push_back(rows.empty() ? std::max(rung.place.y(), kTop)
                                : std::max(rung.place.y(), rows.back() + kSpacing));
  double below = height - kBottom + kSpacing;
  for (std::size_t k = rows.size(); k-- > 0;) rows[k] = below = std::min(rows[k], below - kSpacing);
  return rows;
}

// Where bars that would stand at the left of a place begin, so that they stand on the way of no
// body but those of their own levels.
double besideOthers(const std::vector<Level>& levels, std::span<const Eigen::AlignedBox3d> ways,
                    const Projection& projection, Eigen::AlignedBox2d bars) {
  std::vector<Eigen::AlignedBox2d> others;
  for (std::size_t i = 0; i < ways.size(); ++i) {
    const auto own = [&](const Level& level) {
      return level.a == static_cast<int>(i) || level.b == static_cast<int>(i);
    };
    if (ways[i].isEmpty() || std::any_of(levels.begin(), levels.end(), own)) continue;
    Eigen::AlignedBox2d& way = others.emplace_back();
    for (int corner = 0; corner < 8; ++corner)
      if (const auto place = projection.project(
              ways[i].corner(static_cast<Eigen::AlignedBox3d::CornerType>(corner))))
        way.extend(place->head<2>());
  }
  std::sort(others.begin(), others.end(),
            [](const auto& a, const auto& b) { return a.min().x() < b.min().x(); });
  const double wide = kShortest + kText;
  for (const Eigen::AlignedBox2d& way : others) {
    const Eigen::AlignedBox2d least(bars.min(),
                                    Eigen::Vector2d(bars.min().x() + wide, bars.max().y()));
    if (way.intersects(least)) bars.min().x() = way.max().x() + kEdge;
  }
  return bars.min().x();
}

void addCaption(double x, double y, int every, double width, Picture& picture) {
  Label caption;
  caption.text = every == 1 ? "sum over the points of a level"
                            : fmt::format("sum over a level's points, every {} levels", every);
  const double needed = every == 1 ? 180.0 : 250.0;
  caption.offset = {std::min(x, width - kEdge - needed), y};
  caption.size = 13.0f;
  caption.italic = true;
  caption.colour = colour::kQuiet;
  picture.labels.push_back(caption);
}

}  // namespace

bool showsForceLadder(const ShowFlags& show) {
  return show.contact_forces && show.ladder && !show.joint_forces && !show.matrix;
}

bool hasForceLadder(const Scene& scene, const Recording& recording) {
  if (!showsForceLadder(scene.show)) return false;
  return std::any_of(recording.samples.begin(), recording.samples.end(), [&](const Sample& sample) {
    return tallestGroup(scene, levelsOf(sample)).size() > 1;
  });
}

void addForceLadder(const Scene& scene, const Sample& sample, const Eigen::Vector2d& page,
                    std::span<const Eigen::AlignedBox3d> ways, Picture& picture) {
  const Projection projection(picture.camera, page.x(), page.y());
  const std::vector<Level> levels = tallestGroup(scene, levelsOf(sample));
  std::vector<Rung> rungs = rungsOf(levels, projection);
  std::erase_if(rungs, [&](const Rung& rung) {
    return rung.place.x() < 0.0 || rung.place.x() > page.x() || rung.place.y() < kTop / 2 ||
           rung.place.y() > page.y();
  });
  if (rungs.size() < 2) return;
  const int every = thin(page.y(), rungs);

  double largest = 0.0, right = 0.0;
  for (const Rung& rung : rungs) {
    largest = std::max(largest, rung.force);
    right = std::max(right, rung.place.x());
  }
  const double end = page.x() - kEdge - kText;
  const std::vector<double> rows = rowsOf(rungs, page.y());
  const Eigen::AlignedBox2d bars(Eigen::Vector2d(right + kGap * page.x(), rows.front() - kCaption),
                                 Eigen::Vector2d(end, rows.back()));
  const double x = std::min(besideOthers(levels, ways, projection, bars), end - kShortest);
  const double length = std::min(kLength, end - x);
  for (std::size_t k = 0; k < rungs.size(); ++k)
    picture.pageBars.push_back({rungs[k].leader,
                                {x, rows[k]},
                                length * rungs[k].force / largest,
                                fourDigits(rungs[k].force) + " N",
                                colour::kForce});
  addCaption(x, std::max(rows.front() - kCaption, 20.0), every, page.x(), picture);
}

}  // namespace tumble
