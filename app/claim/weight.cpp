// What bodies weigh by the method that their scene chooses, against exact values; and that they
// turn by it.
#include <array>
#include <cmath>

#include "app/claim/rows.h"
#include "app/record/bodies.h"
#include "sim/math/rotation.h"

namespace tumble {

namespace {

struct Moments {
  Vec3 centre = Vec3::Zero();       // m
  Mat3 inertia = Mat3::Identity();  // kg m², about the centre
};

// The tensor of a mesh as a sum of tetrahedra from its mean point to the triangles of its faces: no
// Green's theorem, so an oracle for it.
//   ∫ x = D/24 Σ x,  ∫ x xᵀ = D/120 (Σ x Σ xᵀ + Σ x xᵀ),  D = det(a b c)
Moments byTetrahedra(const Polyhedron& solid, double mass) {
  Vec3 middle = Vec3::Zero();
  for (const Vec3& p : solid.points) middle += p / static_cast<double>(solid.points.size());
  double sixfold = 0.0;
  Vec3 first = Vec3::Zero();
  Mat3 second = Mat3::Zero();
  for (const std::vector<int>& face : solid.faces) {
    std::vector<std::array<int, 3>> triangles;
    cutIntoTriangles(solid, face, triangles);
    for (const std::array<int, 3>& t : triangles) {
      Mat3 corners;
      for (int k = 0; k < 3; ++k)
        corners.col(k) = solid.points[static_cast<std::size_t>(t[k])] - middle;
      const double D = corners.col(0).dot(corners.col(1).cross(corners.col(2)));
      const Vec3 sum = corners.rowwise().sum();
      sixfold += D;
      first += D / 24.0 * sum;
      second += D / 120.0 * (sum * sum.transpose() + corners * corners.transpose());
    }
  }
  const double volume = sixfold / 6.0;
  const Vec3 d = first / volume;
  const Mat3 spread = second / volume - d * d.transpose();
  return {middle + d, mass * (spread.trace() * Mat3::Identity() - spread)};
}

Moments exactMoments(const BodyDef& body) {
  const double mass = bodyMass(body);
  if (const Hull* hull = std::get_if<Hull>(&body.shape)) return byTetrahedra(*hull->solid, mass);
  if (const Mesh* mesh = std::get_if<Mesh>(&body.shape)) return byTetrahedra(*mesh->solid, mass);
  const MassProperties properties = solidMass(body.shape, mass);
  return {properties.centre, properties.inertia};
}

// What a method may miss of the tensor: rounding; the whole box; five standard deviations of N
// draws, of which the share inside the box counts.
double allowedError(const BodyDef& body) {
  const InertiaMethod* method = findInertiaMethod(body.inertiaBy);
  if (method->spread) return 5.0 / std::sqrt(static_cast<double>(body.samples));
  return body.inertiaBy == "box" ? 1.0 : 1e-13;
}

// Bodies that spin about a principal axis keep their angular velocity: the angle they turn by from
// one sample to the next tells it.
void addTurning(const Recording& recording, const BodyDef& def, int body, const Mat3& found,
                const Mat3& exact, std::vector<ClaimRow>& rows) {
  const Mat3 R = rotationMatrix(def.orientation);
  const Vec3 omega_B = R.transpose() * def.angularVelocity;
  const Vec3 L_B = found * omega_B;
  if (L_B.cross(omega_B).norm() > 1e-9 * L_B.norm() * omega_B.norm() || omega_B.isZero()) return;
  const double told = omega_B.norm() / (exact.inverse() * L_B).norm();
  WorstRow row(def.name + ": turns this many times as fast as it should", 1e-9);
  for (std::size_t k = 1; k < recording.samples.size(); ++k) {
    const Sample &before = recording.samples[k - 1], &now = recording.samples[k];
    const double angle = before.bodies[body].q.angularDistance(now.bodies[body].q);
    const double rate = angle / (now.t - before.t);
    if (angle > 3.0) continue;  // half a turn between samples tells nothing
    const double measured = rate / (exact.inverse() * L_B).norm();
    row.see(measured, told, std::abs(measured / told - 1.0));
  }
  rows.push_back(row.row());
}

}  // namespace

std::vector<ClaimRow> weightRows(const Scene& scene, const Recording& recording) {
  if (recording.samples.empty()) return {emptyClaim("the run has no samples")};
  std::vector<ClaimRow> rows;
  for (std::size_t i = 0; i < scene.world.bodies.size(); ++i) {
    const BodyDef& body = scene.world.bodies[i];
    const bool solid = !std::holds_alternative<HalfSpace>(body.shape) &&
                       !std::holds_alternative<Particle>(body.shape);
    if (!solid || bodyMass(body) == 0.0 || body.inertia) continue;
    const MassProperties found = massOf(body);
    const Moments exact = exactMoments(body);
    const double off = (found.inertia - exact.inertia).norm() / exact.inertia.norm();
    rows.push_back({body.name + ": inertia tensor by " + body.inertiaBy + ", off / its size", off,
                    0.0, off, allowedError(body)});
    const double size = boundingRadius(body.shape);
    const double astray = (found.centre - exact.centre).norm() / size;
    rows.push_back({body.name + ": centre of mass by " + body.inertiaBy + ", off / radius", astray,
                    0.0, astray, allowedError(body)});
    if (moves(body))
      addTurning(recording, body, static_cast<int>(i), found.inertia, exact.inertia, rows);
  }
  if (rows.empty()) return {emptyClaim("no body has a mass of its own")};
  return rows;
}

}  // namespace tumble
