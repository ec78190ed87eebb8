// Diagrams of the lectures on the page below the bodies: the state, the solver, the flow chart.
#pragma once

#include <Eigen/Core>

#include "app/record/recording.h"
#include "render/picture.h"

namespace tumble {

/// Share of the height of a page that the scene's diagram takes, from below; 0 without one.
double diagramShare(const Scene& scene, const Eigen::Vector2d& page);

/// Y(t) of the first body that moves as slots with their numbers, and below it the derivative: of a
/// slot that the scene's `slots` call "?" neither is known.
/// Slots: "x", "v", "P", "L", and "R", shown by its quaternion.
void addStateDiagram(const Scene& scene, const Sample& sample, const Eigen::Vector2d& page,
                     Picture& picture);

/// The black box: what goes into a solver of differential equations, and what comes out.
void addSolverDiagram(const Scene& scene, const Eigen::Vector2d& page, Picture& picture);

/// The flow chart of a step with that part lit which the instant t [s] of the sample is about, and
/// a line of all events of the run, this instant marked.
void addFlowDiagram(const Recording& recording, const Sample& sample, const Eigen::Vector2d& page,
                    Picture& picture);

}  // namespace tumble
