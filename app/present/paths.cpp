#include "app/present/paths.h"

#include <algorithm>

#include "app/claim/free_body.h"
#include "app/present/bent.h"
#include "app/present/bodies.h"
#include "app/present/palette.h"

namespace tumble {

namespace {

// Times [s] of the body's impacts, in order.
std::vector<double> hitTimes(const Recording& recording, int body) {
  std::vector<double> times;
  for (const Event& event : recording.report.events)
    if (event.kind == EventKind::Impact && (event.a == body || event.b == body))
      times.push_back(event.t);
  return times;
}

// Whether it touches something: then forces that no closed form has keep it from falling.
bool isHeld(const Sample& sample, int body) {
  return std::any_of(sample.contacts.begin(), sample.contacts.end(),
                     [&](const ContactSample& c) { return c.a == body || c.b == body; });
}

// Samples, and between two of them the place of the first hit: the corner that samples would cut.
std::vector<Eigen::Vector3d> pathOf(const Scene& scene, const Recording& recording, int body,
                                    int last) {
  const Vec3 acceleration = freeAcceleration(scene.world, body).value_or(scene.world.gravity);
  const std::vector<double> hits = hitTimes(recording, body);
  std::size_t hit = 0;
  std::vector<Eigen::Vector3d> points;
  for (int k = 0; k <= last; ++k) {
    const Sample& sample = recording.samples[static_cast<std::size_t>(k)];
    if (k > 0 && hit < hits.size() && hits[hit] <= sample.t) {
      const Sample& before = recording.samples[static_cast<std::size_t>(k) - 1];
      const BodySample& from = before.bodies[static_cast<std::size_t>(body)];
      const double s = hits[hit] - before.t;
      points.push_back(from.x + s * from.v);
      if (!isHeld(before, body)) points.back() += 0.5 * s * s * acceleration;
    }
    while (hit < hits.size() && hits[hit] <= sample.t) ++hit;
    points.push_back(sample.bodies[static_cast<std::size_t>(body)].x);
  }
  return points;
}

}  // namespace

void addPaths(const Scene& scene, const Recording& recording, std::span<const Colour> colours,
              int last, Picture& picture) {
  const bool single = movingCount(scene) == 1;
  for (int body = 0; body < static_cast<int>(scene.world.bodies.size()); ++body) {
    const std::size_t i = static_cast<std::size_t>(body);
    if (!moves(scene.world.bodies[i]) || isPoint(scene, body) || last < 1) continue;
    Polyline line;
    line.points = pathOf(scene, recording, body, last);
    line.colour = single ? colour::kInk : shade(colours[i], 0.8f);
    picture.lines.push_back(std::move(line));
  }
}

}  // namespace tumble
