// Bodies as instances, and how large things are.
#pragma once

#include <vector>

#include "app/record/recording.h"
#include "render/picture.h"

namespace tumble {

/// How far what is drawn of a body's spin reaches from its centre, in bounding radii of the body.
inline constexpr double kPoinsotReach = 1.25, kMomentaReach = 1.6;

/// The body at a pose in a colour; a half-space becomes a slab around `near`, `extent` [m] wide,
/// a particle without a radius a dot of a small share of it.
/// @param facets  drawn in place of the shape: of a mesh, a compound or a body that has sheared
Instance instanceOf(const BodyDef& body, const Vec3& x, const Quat& q, const Colour& colour,
                    const Vec3& near, double extent,
                    const std::shared_ptr<const Facets>& facets = nullptr);

/// A half-space that looks up (n·Y > 0.9999) and so is drawn as the floor of the page.
bool isFloor(const BodyDef& body);

/// Whether a half-space would hide everything from an eye [m]: one that lies inside it.
bool hides(const BodyDef& body, const Vec3& eye);

/// The power of 1000 that brings a positive value into [least, 1000 least).
double decadeOf(double value, double least);

/// How many bodies move.
int movingCount(const Scene& scene);

/// Median height [m] of the moving bodies at the start, along Y; 1 without any.
double typicalHeight(const Scene& scene);

/// Corners of the boxes around every moving body at a sample. World frame [m].
void addMovingPoints(const Scene& scene, const Sample& sample,
                     std::vector<Eigen::Vector3d>& points);

/// Where joints are fixed to the world, and corners of the boxes around fixed bodies at most twice
/// as long as the motion; without either, of a box of 2 m. World frame [m].
/// @param motion  points of all samples
std::vector<Eigen::Vector3d> standingPoints(const Scene& scene,
                                            const std::vector<Eigen::Vector3d>& motion);

/// The moving points of all samples and what stands. World frame [m].
std::vector<Eigen::Vector3d> motionPoints(const Scene& scene, const Recording& recording);

/// Corners of a box around one body at the start, with room about it for what it does and meets,
/// however it turns. World frame [m].
std::vector<Eigen::Vector3d> pointsAround(const BodyDef& body, const BodySample& start);

}  // namespace tumble
