#include "app/present/framing.h"

#include <algorithm>
#include <vector>

#include "app/present/arrows.h"
#include "app/present/bodies.h"
#include "app/present/diagram.h"
#include "app/present/insets.h"
#include "app/present/labels.h"
#include "app/record/bodies.h"
#include "render/silhouette.h"

namespace tumble {

namespace {

// Room for the title above, and for what stands beside and below the bodies.
Margins marginsOf(const Scene& scene, bool ladder) {
  bool named = false;
  for (int i = 0; i < static_cast<int>(scene.world.bodies.size()); ++i)
    named = named || !labelOf(scene, i).empty();
  Margins margins{.left = 0.06, .right = named ? 0.10 : 0.06, .top = 0.14, .bottom = 0.14};
  if (scene.show.joint_forces)
    margins.left = 0.13;  // their numbers
  else if (ladder)
    margins = {.left = 0.08, .right = 0.40, .top = 0.12, .bottom = 0.08};
  const Eigen::Vector2d page(720.0 * aspectOf(scene), 720.0);
  if (scene.show.matrix) margins.right = (matrixSide(page) + 90.0) / page.x();
  if (scene.show.tensors) margins.right = 0.32;
  if (scene.show.gel > 0.0) margins.bottom = 0.26;
  margins.top = std::max(margins.top, titleHeight(scene) / 720.0);
  margins.bottom += diagramShare(scene, page);
  return margins;
}

// The camera that sees the points, but for what the scene says of it.
Camera cameraOf(const Scene& scene, std::span<const Eigen::Vector3d> points, bool ladder) {
  const CameraView& view = scene.camera;
  Camera camera = frame(points, view.azimuth, view.elevation, view.fov, aspectOf(scene),
                        marginsOf(scene, ladder));
  if (view.eye) camera.eye = *view.eye;
  if (view.target) camera.target = *view.target;
  return camera;
}

// Both ends of all arrows of samples, but for those that a scale of the scene's own takes far away.
void addArrowEnds(const SeenRun& run, const Framing& framing, std::span<const Sample> samples,
                  std::vector<Eigen::Vector3d>& ends) {
  constexpr double kFar = 2.5;  // in radii of the motion
  const double fastest =
      framing.fastest > 0.0 ? framing.fastest : fastestOf(run.scene, run.recording);
  const ArrowScale scale = arrowScale(run.scene, run.recording, fastest, framing.radius);
  for (const Sample& sample : samples) {
    Picture picture;
    picture.camera = framing.camera;
    addArrows(run.scene, sample, scale, picture);
    for (const Arrow& arrow : picture.arrows)
      for (const Eigen::Vector3d& end : {arrow.base, arrow.tip})
        if ((end - framing.centre).norm() < kFar * framing.radius) ends.push_back(end);
  }
}

}  // namespace

std::vector<Eigen::Vector3d> shownPoints(const SeenRun& run, const Framing& framing) {
  std::vector<Eigen::Vector3d> points = motionPoints(run.scene, run.recording);
  addArrowEnds(run, framing, run.recording.samples, points);
  return points;
}

double aspectOf(const Scene& scene) {
  return static_cast<double>(scene.image.width) / static_cast<double>(scene.image.height);
}

double titleHeight(const Scene& scene) {
  constexpr double kPlain = 80.0, kClaims = 111.0, kLine = 19.0;  // [px]
  if (!scene.show.title) return 0.0;
  return scene.expects.empty() ? kPlain
                               : kClaims + kLine * static_cast<double>(scene.expects.size());
}

double fastestOf(const Scene& scene, const Recording& recording) {
  double fastest = 0.0;
  for (const Sample& sample : recording.samples)
    for (std::size_t i = 0; i < sample.bodies.size(); ++i)
      if (moves(scene.world.bodies[i])) fastest = std::max(fastest, sample.bodies[i].v.norm());
  return fastest > 0.0 ? fastest : 1.0;
}

Framing framingOf(const Scene& scene, std::span<const Eigen::Vector3d> points) {
  Framing framing;
  framing.camera = cameraOf(scene, points, false);
  Eigen::Vector3d low = points.front(), high = points.front();
  for (const Eigen::Vector3d& point : points) {
    low = low.cwiseMin(point);
    high = high.cwiseMax(point);
  }
  framing.centre = 0.5 * (low + high);
  framing.radius = 0.5 * (high - low).norm();
  framing.page.x() = aspectOf(scene) * framing.page.y();
  return framing;
}

Framing framingOf(const Scene& scene, std::span<const SeenRun> runs) {
  std::vector<Eigen::Vector3d> points;
  for (const SeenRun& run : runs)
    for (const Eigen::Vector3d& point : motionPoints(run.scene, run.recording))
      points.push_back(point);
  Framing framing = framingOf(scene, points);
  if (runs.size() > 1)
    for (const SeenRun& run : runs)
      framing.fastest = std::max(framing.fastest, fastestOf(run.scene, run.recording));
  if (scene.camera.eye && scene.camera.target) return framing;

  // How long arrows are hangs on the size of the motion alone.
  for (const SeenRun& run : runs) addArrowEnds(run, framing, run.recording.samples, points);
  const bool ladder = std::any_of(runs.begin(), runs.end(), [](const SeenRun& run) {
    return hasForceLadder(run.scene, run.recording);
  });
  framing.camera = cameraOf(scene, points, ladder);
  return framing;
}

std::vector<Camera> camerasAhead(const SeenRun& run, const Framing& framing) {
  const std::vector<Sample>& samples = run.recording.samples;
  std::vector<Eigen::Vector3d> motion;
  for (const Sample& sample : samples) addMovingPoints(run.scene, sample, motion);
  std::vector<Eigen::Vector3d> points = standingPoints(run.scene, motion);
  const bool ladder = hasForceLadder(run.scene, run.recording);
  std::vector<Camera> cameras(samples.size());
  for (std::size_t k = samples.size(); k-- > 0;) {
    addMovingPoints(run.scene, samples[k], points);
    addArrowEnds(run, framing, std::span(samples).subspan(k, 1), points);
    points = outermost(points, framing.camera);
    cameras[k] = cameraOf(run.scene, points, ladder);
  }
  return cameras;
}

}  // namespace tumble
