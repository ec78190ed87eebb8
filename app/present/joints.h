// What joints look like, and what they exert.
#pragma once

#include "app/record/recording.h"
#include "render/picture.h"

namespace tumble {

/// Whether it holds a point of what bends to something, as pins and roots do: there is nothing to
/// see of it but the surface.
bool isSeam(const Scene& scene, const JointDef& joint);

/// A dark pin at each anchor: a ball, or, of a hinge, along its axis through the body; a thin rod
/// along a distance; the rail of a slider.
/// @param size  [m] radius of what the picture shows
void addJoints(const Scene& scene, const Sample& sample, double size, Picture& picture);

/// What of a joint's look stays the same through a run: enough to draw it from the poses of its
/// bodies, as `addJoints` does.
struct JointLook {
  JointKind kind = JointKind::Ball;
  int a = 0, b = kNoBody;
  Vec3 pa, pb;        ///< [m] its anchors in the body frames of a and b; of the world, in that
  Vec3 axis;          ///< unit, in the body frame of b
  double half = 0.0;  ///< [m] of a hinge's pin
  bool leverToA = false, leverToB = false;  ///< whether a rod leads from the body to the anchor
};
struct JointLooks {
  std::vector<JointLook> joints;
  double pin = 0.0, rod = 0.0, rail = 0.0;  ///< [m] radii, and the length of a slider's rail
  Colour pinColour, rodColour;
};
/// @param size  [m] radius of what the picture shows
JointLooks jointLooks(const Scene& scene, const Sample& start, double size);

/// Arrows of the force that each joint exerts on the one of its bodies that more joints part from
/// the world, at its anchor there, on a where that is none; red if it points within 60 degrees of
/// straight down, else green, with its number beside it, negative where it is red; the same of
/// contacts, one arrow a pair, if these are shown.
/// @param metresPerNewton  of an arrow
/// @param most  [N] larger ones of joints are as long as that
void addJointForces(const Scene& scene, const Sample& sample, double metresPerNewton, double most,
                    Picture& picture);

/// The force [N] of a joint whose arrow is longest: the largest of the run, unless that is a spike,
/// more than three times what 98 of 100 forces that joints exert stay below.
struct JointScale {
  double longest = 0.0;            ///< [N]; 0 without joints
  double largest = 0.0, at = 0.0;  ///< [N] of the run, [s]
};
JointScale jointScale(const Recording& recording);

}  // namespace tumble
