#include "app/present/planes.h"

#include <algorithm>
#include <map>

#include "app/claim/parting.h"
#include "app/present/palette.h"
#include "sim/math/rotation.h"

namespace tumble {

namespace {

constexpr Colour kKept = hex(0x2E9E5B), kSought = hex(0xE0851B);
constexpr double kTouch = 1e-9;       // [m] nearer than this, two bodies touch
constexpr double kNear = 0.5;         // gap of a plane worth drawing, of the smaller part's radius
constexpr double kThickness = 0.004;  // of a disc, of its radius

double smallerRadius(const Parting& p) {
  return std::min(boundingRadius(p.a.solid), boundingRadius(p.b.solid));
}

// Half-way between the two surfaces, on the line through the parts' centres.
Vec3 middleOf(const Parting& p) {
  const auto top = [&](const PlacedPart& part, const Vec3& n) {
    double far = 0.0;
    for (const Vec3& corner : cornersOf(part.solid, part.pose))
      far = std::max(far, n.dot(corner - part.pose.x));
    return far > 0.0 ? far : boundingRadius(part.solid);
  };
  const Vec3 line = p.a.pose.x - p.b.pose.x;
  const double height = top(p.b, p.n) + 0.5 * p.gap;
  const double rise = p.n.dot(line);
  return rise > 1e-9 ? Vec3(p.b.pose.x + height / rise * line) : Vec3(p.b.pose.x + height * p.n);
}

Instance discOf(const Parting& p) {
  const double r = 0.9 * smallerRadius(p);
  Instance disc;
  disc.form = Form::Cylinder;
  disc.finish = Finish::Glass;
  disc.position = middleOf(p);
  disc.orientation = turnBetween(Vec3::UnitY(), p.n);
  disc.scale = {r, kThickness * r, r};
  disc.colour = p.gap <= kTouch ? colour::kInk : p.remembered ? kKept : kSought;
  return disc;
}

}  // namespace

void addPlanes(const Scene& scene, const Recording& recording, int k, Picture& picture) {
  Coherence coherence(scene);
  std::vector<Parting> now;
  for (int i = 0; i <= k; ++i) now = coherence.look(recording.samples[static_cast<std::size_t>(i)]);
  std::map<std::pair<int, int>, const Parting*> nearest;
  for (const Parting& p : now) {
    if (p.gap > kNear * smallerRadius(p)) continue;
    const Parting*& best = nearest[{p.b.body, p.a.body}];
    if (!best || p.gap < best->gap) best = &p;
  }
  for (const auto& [bodies, parting] : nearest) picture.instances.push_back(discOf(*parting));
}

}  // namespace tumble
