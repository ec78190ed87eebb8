#include "app/present/marks.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "app/present/digits.h"
#include "app/present/palette.h"
#include "render/camera.h"

namespace tumble {

void addImpacts(const Scene& scene, const Recording& recording, double t, double aspect,
                Picture& picture) {
  constexpr double kPage = 720.0, kWidth = 96.0, kHeight = 72.0;  // [px] that a mark needs
  constexpr double kSmall = 0.02;  // of the largest: not worth a mark
  std::vector<Event> hits;
  for (const Event& event : recording.report.events)
    if (event.kind == EventKind::Impact && event.t <= t) hits.push_back(event);
  std::stable_sort(hits.begin(), hits.end(),
                   [](const Event& a, const Event& b) { return a.j > b.j; });

  const Projection projection(picture.camera, kPage * aspect, kPage);
  std::vector<Eigen::Vector2d> taken;
  for (const Event& hit : hits) {
    if (hit.j < kSmall * hits.front().j) break;
    const std::optional<Eigen::Vector3d> pixel = projection.project(hit.p);
    if (!pixel) continue;
    const Eigen::Vector2d place = pixel->head<2>();
    const bool room = std::none_of(taken.begin(), taken.end(), [&](const Eigen::Vector2d& other) {
      return std::abs(other.x() - place.x()) < kWidth && std::abs(other.y() - place.y()) < kHeight;
    });
    if (!room) continue;
    taken.push_back(place);
    picture.marks.push_back({hit.p,
                             {fmt::format("t = {} s", instant(hit.t, scene.world.duration, 1)),
                              "j = " + fourDigits(hit.j) + " N·s"},
                             colour::kForce});
  }
}

}  // namespace tumble
