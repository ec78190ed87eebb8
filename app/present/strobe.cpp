// The whole motion on one picture.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "app/claim/free_body.h"
#include "app/present/bent.h"
#include "app/present/bodies.h"
#include "app/present/joints.h"
#include "app/present/labels.h"
#include "app/present/palette.h"
#include "app/present/paths.h"
#include "app/present/planes.h"
#include "app/present/present.h"

namespace tumble {

Picture Presenter::strobe() const {
  const Sample& last = recording_.samples.back();
  Picture picture = blank(framing_);
  const bool byTime =
      movingCount(scene_) == 1 && !anyBack(scene_) && !scene_.show.speed && strained_ == 0.0;
  addGhosts(byTime, picture);
  const int top = static_cast<int>(ghosts().size()) + 1;
  addBodies(last, byTime, top, picture);
  const auto bodies = static_cast<std::ptrdiff_t>(picture.instances.size());
  addJoints(scene_, last, framing_.radius, picture);
  std::for_each(picture.instances.begin() + bodies, picture.instances.end(),
                [&](Instance& part) { part.layer = top; });
  if (scene_.show.path) addPaths(scene_, recording_, colours_, count() - 1, picture);
  if (scene_.show.planes) addPlanes(scene_, recording_, count() - 1, picture);
  addTheory(picture);
  addLabels(scene_, last, picture);
  addTexts(scene_, last, picture);
  addAnnotations(last, picture);
  // Ghosts of the start alone are no strobe.
  const std::string what =
      scene_.show.strobe < last.t
          ? fmt::format("Strobe every {:g} s over {:g} s.", scene_.show.strobe, last.t)
          : fmt::format("Start, and end after {:g} s.", last.t);
  picture.subtitle += (picture.subtitle.empty() ? "" : "  ") + what;
  finish(picture);
  return picture;
}

// The samples that a strobe shows besides the last.
std::vector<std::size_t> Presenter::ghosts() const {
  const long every = std::max(1L, std::lround(scene_.show.strobe * recording_.rate));
  std::vector<std::size_t> shown;
  for (std::size_t k = 0; k + 1 < recording_.samples.size(); k += static_cast<std::size_t>(every))
    shown.push_back(k);
  return shown;
}

// Whether a body is where it is at the end all along: what is fixed, but for what is led.
bool Presenter::standsStill(std::size_t body) const {
  const BodySample& end = recording_.samples.back().bodies[body];
  return !moves(scene_.world.bodies[body]) && end.v.isZero(0.0) && end.omega.isZero(0.0);
}

// Bodies are coloured by time, or keep their colours; all are paler the longer ago, and behind what
// came later.
void Presenter::addGhosts(bool byTime, Picture& picture) const {
  const bool single = movingCount(scene_) == 1;
  const double end = recording_.samples.back().t;
  const std::vector<std::size_t> shown = ghosts();
  for (std::size_t n = 0; n < shown.size(); ++n) {
    const Sample& sample = recording_.samples[shown[n]];
    const double u = end > 0.0 ? sample.t / end : 1.0;
    const int layer = static_cast<int>(n) + 1;
    for (std::size_t i = 0; i < sample.bodies.size(); ++i) {
      const BodyDef& body = scene_.world.bodies[i];
      if (standsStill(i) || inSurface_[i]) continue;
      const Colour colour = byTime ? ramp(timeStops(), u) : colourOf(sample, i);
      Instance ghost =
          instanceOf(body, sample.bodies[i].x, sample.bodies[i].q, colour, framing_.centre,
                     3.0 * framing_.radius, surfaceOf(i, sample.bodies[i]));
      ghost.back = backOf(scene_, i);
      ghost.banded = turns_[i];
      ghost.finish = Finish::Ghost;
      ghost.layer = layer;
      ghost.alpha = static_cast<float>(single ? 0.55 + 0.35 * u : 0.22 + 0.48 * u);
      picture.instances.push_back(ghost);
    }
    for (Instance& surface : bentSurfaces(scene_, sample, colours_, strained_)) {
      surface.finish = Finish::Ghost;
      surface.layer = layer;
      surface.alpha = static_cast<float>(0.22 + 0.48 * u);
      picture.instances.push_back(std::move(surface));
    }
    if (scene_.show.forces && n % 5 == 0) addForces(scene_, sample, arrows_.longest, picture);
  }
  if (!byTime) return;
  ColourBar bar{"time / s", {timeStops().begin(), timeStops().end()}, 0.0, end, {}};
  const double decade = decadeOf(end, 0.5);
  const double part = end / decade;
  const double tick = decade * (part > 20.0 ? 10.0 : part > 8.0 ? 2.0 : part > 1.5 ? 1.0 : 0.2);
  for (int n = 0; n * tick <= end; ++n) bar.ticks.push_back(n * tick);
  picture.bar = bar;
}

}  // namespace tumble
