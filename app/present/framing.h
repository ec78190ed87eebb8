// From where a run is seen, such that its pictures hold what they show.
#pragma once

#include <span>
#include <vector>

#include "app/record/recording.h"
#include "render/camera.h"
#include "render/picture.h"

namespace tumble {

/// What is to be seen, and from where.
struct Framing {
  Camera camera;
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();  ///< [m]
  double radius = 1.0;                               ///< [m] of all motion about the centre
  Eigen::Vector2d page = {1280.0, 720.0};            ///< [px] that text and flat shapes stand on
  double floor = 0.0;     ///< [m] that the grid of the floor is made for; 0: the radius
  double strained = 0.0;  ///< of the last colour; 0: of the run
  double fastest = 0.0;   ///< [m/s] of the longest velocity and the last colour; 0: of the run
};

/// A run to be seen.
struct SeenRun {
  const Scene& scene;
  const Recording& recording;
};

/// Points [m] that a picture has to hold to show all bodies and arrows of the run.
std::vector<Eigen::Vector3d> shownPoints(const SeenRun& run, const Framing& framing);

/// The largest speed [m/s] of the run; 1 if nothing moves.
double fastestOf(const Scene& scene, const Recording& recording);

/// Width over height of the scene's images.
double aspectOf(const Scene& scene);

/// What title, subtitle and the lines of [[expect]] take from the top of a page 720 px high [px].
double titleHeight(const Scene& scene);

/// The scene's own camera, or one that the points of the motion fill.
Framing framingOf(const Scene& scene, std::span<const Eigen::Vector3d> points);

/// The same for all bodies and arrows of runs, with room for a ladder of forces where one stands.
Framing framingOf(const Scene& scene, std::span<const SeenRun> runs);

/// For each sample the nearest camera of the framing's direction that holds what moves from then
/// on, and what stands.
std::vector<Camera> camerasAhead(const SeenRun& run, const Framing& framing);

}  // namespace tumble
