#include "app/present/present.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "app/claim/free_body.h"
#include "app/present/bent.h"
#include "app/present/bodies.h"
#include "app/present/boxes.h"
#include "app/present/camera_keys.h"
#include "app/present/diagram.h"
#include "app/present/digits.h"
#include "app/present/facets.h"
#include "app/present/inertia.h"
#include "app/present/insets.h"
#include "app/present/joints.h"
#include "app/present/labels.h"
#include "app/present/marks.h"
#include "app/present/missteps.h"
#include "app/present/motion.h"
#include "app/present/palette.h"
#include "app/present/paths.h"
#include "app/present/planes.h"
#include "app/present/samples.h"
#include "app/present/touch.h"
#include "render/axis.h"
#include "sim/math/rotation.h"

namespace tumble {

namespace {

// From 0 to that.
ColourBar barTo(const std::string& caption, std::span<const Colour> stops, double top) {
  ColourBar bar{caption, {stops.begin(), stops.end()}, 0.0, top, {}};
  const double values[] = {0.0, top};
  const Scale scale({"", false}, values, 0.0, 220.0, 40.0);
  for (const Tick& tick : scale.ticks())
    if (tick.value <= top) bar.ticks.push_back(tick.value);
  return bar;
}

// Which bodies turn in the run at all: by an angle α with 1 − |cos α/2| ≈ α²/8.
std::vector<bool> turning(const Recording& recording) {
  constexpr double kSeen = 1e-3;  // [rad]
  const std::vector<BodySample>& start = recording.samples.front().bodies;
  std::vector<bool> turns(start.size(), false);
  for (const Sample& sample : recording.samples)
    for (std::size_t i = 0; i < start.size(); ++i)
      if (1.0 - std::abs(sample.bodies[i].q.dot(start[i].q)) > kSeen * kSeen / 8.0) turns[i] = true;
  return turns;
}

// The upper face of a slab by its edges: one that would hide all that moves is seen by these alone.
Polyline outlineOf(const Instance& slab) {
  constexpr double kCorners[][2] = {{1, 1}, {1, -1}, {-1, -1}, {-1, 1}, {1, 1}};
  Polyline outline;
  outline.colour = colour::kQuiet;
  for (const auto& [x, z] : kCorners)
    outline.points.push_back(slab.position +
                             slab.orientation * slab.scale.cwiseProduct(Vec3(x, 1.0, z)));
  return outline;
}

}  // namespace

Presenter::Presenter(const Scene& scene, const Recording& recording)
    : Presenter(scene, recording, framingOf(scene, {{SeenRun{scene, recording}}})) {}

Presenter::Presenter(const Scene& scene, const Recording& recording, const Framing& framing)
    : scene_(scene),
      recording_(recording),
      colours_(bodyColours(scene)),
      turns_(turning(recording)),
      inSurface_(partsOfSurfaces(scene)),
      framing_(framing) {
  facets_ = facetsOfBodies(scene.world.bodies);
  fastest_ = framing.fastest > 0.0 ? framing.fastest : fastestOf(scene, recording);
  if (scene.show.strain)
    strained_ = framing.strained > 0.0 ? framing.strained : usualStrain(scene, recording);
  expectations_ = expectationsOf(scene, recording);
  arrows_ = arrowScale(scene, recording, fastest_, framing.radius);
  measureWays();
  gatherWords();
  follow();
  if (scene.camera.ahead) ahead_ = camerasAhead({scene, recording}, framing);
  if (!scene.show.theory) return;
  for (const std::string& name : scene.checks) {
    const Check* check = findCheck(name);
    if (!check || !check->expected) continue;
    for (Curve& curve : check->expected(scene, recording)) theory_.push_back(std::move(curve));
  }
}

// Where what is drawn is in the course of the run: one measure for all its pictures.
void Presenter::measureWays() {
  ways_.resize(scene_.world.bodies.size());
  for (std::size_t i = 0; i < ways_.size(); ++i) {
    const BodyDef& def = scene_.world.bodies[i];
    if (isFloor(def) || hides(def, framing_.camera.eye)) continue;
    const double reach = inSurface_[i] ? 0.0 : reachOf(body(recording_.samples.front(), i));
    for (const Sample& sample : recording_.samples)
      ways_[i].extend(boxAround(sample.bodies[i].x, std::min(reach, framing_.radius)));
    extent_.extend(ways_[i]);
  }
}

// What the ruler makes room for: were it what an image says, the ruler would jump in a film.
void Presenter::gatherWords() {
  if (!scene_.show.ruler) return;
  words_.camera = framing_.camera;
  for (const int k : {0, count() / 2, count() - 1}) {
    const Sample& sample = recording_.samples[static_cast<std::size_t>(k)];
    addLabels(scene_, sample, words_);
    addTexts(scene_, sample, words_);
    words_.marks.clear();  // the last has them all
    addAnnotations(sample, words_);
  }
}

// The camera that follows a body keeps the distance that shows the room about it.
void Presenter::follow() {
  const std::vector<BodyDef>& bodies = scene_.world.bodies;
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    if (bodies[i].name != scene_.camera.follow) continue;
    followed_ = static_cast<int>(i);
    following_ = framingOf(scene_, pointsAround(bodies[i], recording_.samples.front().bodies[i]));
  }
}

Framing Presenter::framingAt(int k) const {
  const Sample& sample = recording_.samples[static_cast<std::size_t>(k)];
  if (!ahead_.empty()) {
    Framing framing = framing_;
    framing.camera = ahead_[static_cast<std::size_t>(k)];
    return framing;
  }
  if (!scene_.camera.keys.empty()) {
    Framing framing = framing_;
    framing.camera = cameraAt(scene_.camera.keys, sample.t);
    return framing;
  }
  if (!followed_) return framing_;
  const std::size_t body = static_cast<std::size_t>(*followed_);
  const Vec3 way = sample.bodies[body].x - recording_.samples.front().bodies[body].x;
  Framing framing = following_;
  framing.camera.eye += way;
  framing.camera.target += way;
  framing.centre += way;
  return framing;
}

int Presenter::count() const {
  return static_cast<int>(recording_.samples.size());
}

Picture Presenter::image(int k) const {
  const Sample& sample = recording_.samples[static_cast<std::size_t>(k)];
  Picture picture = blank(framingAt(k));
  addBodies(sample, false, 0, picture);
  addJoints(scene_, sample, framing_.radius, picture);
  if (scene_.show.path) addPaths(scene_, recording_, colours_, k, picture);
  addTheory(picture);
  if (scene_.show.planes) addPlanes(scene_, recording_, k, picture);
  addLabels(scene_, sample, picture);
  addTexts(scene_, sample, picture);
  addAnnotations(sample, picture);
  picture.subtitle += fmt::format("{}t = {} s", picture.subtitle.empty() ? "" : "   ",
                                  instant(sample.t, scene_.world.duration));
  if (scene_.show.energy)
    picture.subtitle += "   energy " + fourDigits(sample.kinetic + sample.potential) + " J";
  finish(picture);
  return picture;
}

Picture Presenter::bodiesAlone(int k) const {
  const Sample& sample = recording_.samples[static_cast<std::size_t>(k)];
  Picture picture = blank(framingAt(k));
  picture.instances.clear();
  addBodies(sample, false, 0, picture);
  return picture;
}

int Presenter::sampleAt(double t) const {
  return static_cast<int>(std::clamp<long>(std::lround(t * recording_.rate), 0, count() - 1));
}

Picture Presenter::still(double t) const {
  return image(sampleAt(t));
}

// Page, floor and camera, without anything on them.
Picture Presenter::blank(const Framing& framing) const {
  Picture picture;
  picture.camera = framing.camera;
  picture.centre = framing.centre;
  picture.radius = framing.radius;
  picture.title = scene_.title;
  picture.subtitle = scene_.subtitle;
  picture.floor.visible = false;
  picture.floor.rule = scene_.show.ruler;
  picture.floor.motion = extent_;
  for (const Eigen::AlignedBox3d& way : ways_)
    if (!way.isEmpty()) picture.floor.ways.push_back(way);
  picture.floor.labels = words_.labels;
  picture.floor.marks = words_.marks;
  for (const BodyDef& body : scene_.world.bodies) {
    if (!scene_.show.floor || !isFloor(body) || picture.floor.visible) continue;
    if (scene_.show.gel > 0.0) {
      addGel(std::get<HalfSpace>(body.shape).d, scene_.show.gel, framing.centre, framing.radius,
             picture);
      break;
    }
    picture.floor.visible = true;
    picture.floor.height = std::get<HalfSpace>(body.shape).d;
  }
  if (scene_.show.speed) picture.bar = barTo("speed / m/s", cividisStops(), fastest_);
  if (strained_ > 0.0) picture.bar = barTo("strain / %", strainStops(), 100.0 * strained_);
  const double reach = framing.floor > 0.0 ? framing.floor : framing.radius;
  const double decade = decadeOf(reach, 0.08), size = reach / decade;
  picture.floor.grid = decade * (size < 0.8 ? 0.1 : size < 15.0 ? 1.0 : 10.0);
  picture.floor.fineGrid = 0.2 * picture.floor.grid;
  return picture;
}

// The surface to draw a body by, if its shape alone does not say: one whose attitude is a matrix is
// drawn as the matrix has it.
std::shared_ptr<const Facets> Presenter::surfaceOf(std::size_t i, const BodySample& body) const {
  if (!body.R) return facets_[i];
  return facetsOf(scene_.world.bodies[i].shape, rotationMatrix(body.q).transpose() * *body.R);
}

Instance Presenter::body(const Sample& sample, std::size_t i) const {
  const BodyDef& def = scene_.world.bodies[i];
  Instance instance =
      instanceOf(def, sample.bodies[i].x, sample.bodies[i].q, colourOf(sample, i), framing_.centre,
                 3.0 * framing_.radius, surfaceOf(i, sample.bodies[i]));
  instance.back = backOf(scene_, i);
  instance.banded = turns_[i];
  // A half-space that is no floor is a pane: it reaches beyond all that moves on one side of it.
  const bool pane = std::holds_alternative<HalfSpace>(def.shape);
  if (pane || (scene_.show.glass && moves(def))) instance.finish = Finish::Glass;
  return instance;
}

// What moves stands in that layer.
void Presenter::addBodies(const Sample& sample, bool byTime, int layer, Picture& picture) const {
  for (std::size_t i = 0; i < sample.bodies.size(); ++i) {
    const BodyDef& def = scene_.world.bodies[i];
    if (isFloor(def) || inSurface_[i]) continue;
    if (hides(def, picture.camera.eye)) {
      picture.lines.push_back(outlineOf(body(sample, i)));
      continue;
    }
    Instance& drawn = picture.instances.emplace_back(body(sample, i));
    if (!moves(def)) continue;
    drawn.layer = layer;
    if (byTime) drawn.colour = timeStops().back();
  }
  for (Instance& surface : bentSurfaces(scene_, sample, colours_, strained_)) {
    surface.layer = layer;
    picture.instances.push_back(std::move(surface));
  }
}

Colour Presenter::colourOf(const Sample& sample, std::size_t i) const {
  if (!scene_.show.speed || !moves(scene_.world.bodies[i])) return colours_[i];
  return ramp(cividisStops(), sample.bodies[i].v.norm() / fastest_);
}

// What is the same on every picture of the run.
void Presenter::finish(Picture& picture) const {
  addExpectations(picture);
  addSpike(picture);
  const std::string dotted = legendOf(picture, picture.subtitle);
  if (!dotted.empty()) picture.subtitle += (picture.subtitle.empty() ? "" : "   ") + dotted;
  if (scene_.show.title) return;
  picture.title.clear();
  picture.subtitle.clear();
}

namespace {

// "1.02 ± 10⁻¹²"; a bound as far out as what is allowed lets it be: "≤ 10⁻⁹".
std::string expectedText(const ClaimRow& row) {
  if (row.relation == Relation::AtMost)
    return signOf(row.relation) + printed(row.exact + row.allowed, 6);
  if (row.relation == Relation::AtLeast)
    return signOf(row.relation) + printed(row.exact - row.allowed, 6);
  return printed(row.exact, 6) + (row.allowed > 0.0 ? " ± " + printed(row.allowed, 6) : "");
}

}  // namespace

// Below the title, if it is shown, a line for each: what was measured, and what it should be. A
// formula that is one coordinate gets a dotted line there, across or along the picture.
void Presenter::addExpectations(Picture& picture) const {
  for (const Expectation& one : expectations_) {
    if (one.place) picture.lines.push_back(expectedLine(one));
    if (!scene_.show.title) continue;
    // Beside 0, what is left is an error: its size tells, its digits do not.
    const std::string measured = printed(one.row.measured, one.row.exact == 0.0 ? 2 : 6);
    picture.remarks.push_back(
        {fmt::format("{}: {}, expected {}", one.row.label, measured, expectedText(one.row)),
         one.row.holds() ? colour::kQuiet : colour::kForce});
  }
}

// Where the longest arrow of joints is not that of the largest force: what this is, and when.
void Presenter::addSpike(Picture& picture) const {
  const ShowFlags& show = scene_.show;
  if (!show.title || !show.joint_forces || show.force_scale > 0.0) return;
  const double longest = arrows_.together(show);
  if (arrows_.joint.largest > longest)
    picture.remarks.push_back(
        {fmt::format("arrows of joints end at {} N; the largest is {} N, at {:.4g} s",
                     fourDigits(longest), fourDigits(arrows_.joint.largest), arrows_.joint.at),
         colour::kQuiet});
}

Polyline Presenter::expectedLine(const Expectation& one) const {
  const Vec3 along = one.axis == 1
                         ? Projection(framing_.camera, framing_.page.x(), framing_.page.y()).right()
                         : Vec3(Vec3::UnitY());
  const Vec3 half = 0.15 * framing_.radius * along;
  Polyline line;
  line.points = {*one.place - half, *one.place + half};
  line.colour = colour::kForce;
  line.stroke = Stroke::Dotted;
  return line;
}

void Presenter::addTheory(Picture& picture) const {
  for (const Curve& curve : theory_) {
    Polyline line;
    line.points.assign(curve.points.begin(), curve.points.end());
    line.colour = colour::kForce;
    line.stroke = Stroke::Dotted;
    picture.lines.push_back(std::move(line));
  }
}

void Presenter::addAnnotations(const Sample& sample, Picture& picture) const {
  const ShowFlags& show = scene_.show;
  addArrows(scene_, sample, arrows_, picture);
  if (showsForceLadder(show)) addForceLadder(scene_, sample, framing_.page, ways_, picture);
  if (show.matrix) addContactMatrix(scene_, sample, framing_.page, picture);
  if (show.either_or) addEitherOr(scene_, recording_, sample, framing_.page, picture);
  if (show.boxes) addBoundingBoxes(scene_, sample, picture);
  if (show.tree >= 0) addTreeBoxes(scene_, sample, show.tree, picture);
  if (show.samples) addSamplePoints(scene_, sample, picture);
  if (show.body_box) addBodyBoxes(scene_, sample, picture);
  if (show.ellipsoid) addInertiaEllipsoids(scene_, sample, picture);
  if (show.polhode) addPolhodes(scene_, recording_, sample, picture);
  if (show.momenta) addMomenta(scene_, recording_, sample, picture);
  if (show.missteps) addMissteps(scene_, recording_, sample.t, picture);
  addLessons(sample, picture);
  if (show.impacts) addImpacts(scene_, recording_, sample.t, aspectOf(scene_), picture);
}

// What the lectures draw to explain.
void Presenter::addLessons(const Sample& sample, Picture& picture) const {
  const ShowFlags& show = scene_.show;
  const double height = typicalHeight(scene_), length = 0.35 * framing_.radius;
  if (show.field) addFields(scene_, sample, picture);
  if (show.motion) addMotion(scene_, recording_, sample, length, picture);
  if (show.axes) addAxes(scene_, sample, length, picture);
  if (show.centres) addCentres(scene_, sample, 0.03 * framing_.radius, picture);
  if (show.contact_velocities) addContactVelocities(scene_, sample, height, picture);
  if (show.impulses) addImpulses(recording_, sample.t, 1.2 * height, picture);
  if (show.springs) addSprings(scene_, sample, height, picture);
  if (show.tensors) addTensors(scene_, sample, framing_.page, picture);
  if (show.diagram == "state") addStateDiagram(scene_, sample, framing_.page, picture);
  if (show.diagram == "solver") addSolverDiagram(scene_, framing_.page, picture);
  if (show.diagram == "flow") addFlowDiagram(recording_, sample, framing_.page, picture);
}

std::string legendOf(const Picture& picture, const std::string& words) {
  if (words.find("dot") != std::string::npos || words.find("Dot") != std::string::npos) return "";
  const bool dotted =
      std::any_of(picture.lines.begin(), picture.lines.end(),
                  [](const Polyline& line) { return line.stroke == Stroke::Dotted; });
  return dotted ? "dotted: what is expected" : "";
}

void stripForPanel(Picture& picture) {
  picture.title.clear();
  picture.subtitle.clear();
  picture.remarks.clear();
  picture.marks.clear();
  picture.labels.clear();
  picture.pageShapes.clear();
  picture.floor.rule = false;
}

}  // namespace tumble
