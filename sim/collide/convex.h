// Chapter 5, collide: the general path, for any two convex solids that have a core. Frame of b.
#pragma once

#include <vector>

#include "sim/collide/contact_point.h"
#include "sim/collide/core.h"

namespace tumble::convex {

/// A plane between two cores, and the features that it is fixed to.
struct Plane {
  NormalTie tie = NormalTie::Points;
  int i = -1, j = -1;  ///< numbers of the face, edge or vertex of a and of b; −1 if they have none
  double gap = -std::numeric_limits<double>::infinity();  ///< [m] between the cores; < 0: overlap
  Vec3 n = Vec3::UnitY();                                 ///< [1] unit, out of b towards a
  Vec3 pa = Vec3::Zero(), pb = Vec3::Zero();              ///< [m] nearest points of the cores
  Vec3 ea = Vec3::Zero(), eb = Vec3::Zero();  ///< [1] unit edges, where the tie names any
  double ra = 0.0, rb = 0.0;      ///< [m] round about pa and pb, beside the cores' own radii
  double rimA = 0.0, rimB = 0.0;  ///< [m] of the rims that pa and pb are on; ea and eb their axes
  bool alongside = false;         ///< ea and eb are parallel lines
};

/// Puts pa and pb where the lines through p along ea and through q along eb, unit vectors that are
/// not parallel, are nearest to each other. By their product, since 1 − (ea·eb)² has no digit left
/// where the sine is 1e-8.
void cross(const Vec3& p, const Vec3& ea, const Vec3& q, const Vec3& eb, Plane& plane);

/// The widest of the planes along the faces of either core. A face of a must win over one of b by
/// more than `bias` [m]. gap = −∞ if neither has faces.
Plane widestOfFaces(const Core& a, const Core& b, double bias);

/// Puts a plane across a pair of edges in the place of `best`, if one is wider than it by more than
/// `bias` [m], and than `least` [m]: the widest, of those pairs that make a face of the difference
/// a − b, whose arcs on the sphere of normals cross (Gregorius, The Separating Axis Test between
/// Convex Polyhedra, GDC 2013). The widest plane between overlapping solids is one of these or of
/// the faces (Gottschalk, Separating axis theorem, 1996).
/// @param n  [1] along which the solids are apart, out of b towards a: the nearer it is to that of
///   the widest plane, the fewer edges are looked at
void widenByEdges(const Core& a, const Core& b, double bias, const Vec3& n, double least,
                  Plane& best);

/// All planes that these have to choose from, the widest first, faces of b before those of a and
/// before pairs of edges where gaps are the same.
void allAxes(const Core& a, const Core& b, std::vector<Plane>& planes);

/// The plane across the line between the nearest points of two cores that are apart; gap = −∞ if
/// they are not.
Plane nearestPlane(const Core& a, const Core& b);

/// The widest plane where a or b is a cylinder or an ellipsoid, or that of a face that leans by no
/// more than `level` [1] against it. Where they are further apart than `enough` [m], any that says
/// so, and nothing but its gap.
Plane widestPlaneRound(const Core& a, const Core& b, double level, double enough);

/// Of the planes between features that a and b show along n, or nearly, the widest; where several
/// are, that of faces first, then of edges. A face that leans by no more than `level` [1] against
/// the widest lies, and tells all that touches. gap = −∞ if none is right.
Plane planeOfFeatures(const Core& a, const Core& b, const Vec3& n, double level);

/// The widest of all: between cores apart, that of their distance.
/// @param enough  [m] as of widestPlaneRound
Plane widestPlane(const Core& a, const Core& b, double bias,
                  double enough = std::numeric_limits<double>::infinity());

/// The points of contact along a plane, separations at most `margin` [m].
/// @param tolerance  [m] lying on a side counts as inside
void clipFacets(const Core& a, const Core& b, const Plane& plane, double tolerance, double margin,
                Manifold& out);

/// The same where a or b is a cylinder.
void roundPoints(const Core& a, const Core& b, const Plane& plane, double tolerance, double margin,
                 Manifold& out);

/// Where solids lie side by side, along edges or axes of cylinders that are nearly parallel: the
/// ends of what these lines share, tied to lines. @return whether there are two
bool lineEnds(const Core& a, const Core& b, const Plane& plane, double tolerance, Manifold& ends);

/// Of capsules and sides of cylinders that cross: beside the point where they do, which runs along
/// them as they turn, the ends of what their axes share, as far as they are no further apart than
/// the margin.
/// @param nearest  where they cross
void endsBeside(const Core& a, const Core& b, const ContactPoint& nearest, double tolerance,
                double margin, Manifold& out);

/// Takes a contact point from the frame of b, which stands at xb turned by Rb, to the world.
void toWorld(const Mat3& Rb, const Vec3& xb, ContactPoint& c);

/// A contact point of the plane itself.
ContactPoint pointOf(const Plane& plane, const Core& a, const Core& b);

}  // namespace tumble::convex
