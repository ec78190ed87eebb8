// A ball at rest between two walls: neither alone can hold it, and each gives its share.
#include <fmt/format.h>

#include <algorithm>

#include "app/claim/rows.h"
#include "app/record/bodies.h"
#include "sim/math/rotation.h"

namespace tumble {

namespace {

bool isWall(const BodyDef& def) {
  return std::holds_alternative<Box>(def.shape) || std::holds_alternative<HalfSpace>(def.shape);
}

// The normal of the plane, or of the face of a box, that a point outside is nearest to.
Vec3 faceTowards(const BodyDef& def, const Vec3& p) {
  if (const HalfSpace* plane = std::get_if<HalfSpace>(&def.shape)) return plane->n;
  const Box& box = std::get<Box>(def.shape);
  const Mat3 R = rotationMatrix(def.orientation.normalized());
  const Vec3 p_B = R.transpose() * (p - def.position);
  int axis = 0;
  (p_B.cwiseAbs() - box.half).maxCoeff(&axis);
  return p_B[axis] < 0.0 ? Vec3(-R.col(axis)) : Vec3(R.col(axis));
}

}  // namespace

// Where a ball lies still between two bodies, from the start, or for so long that what its arrival
// left has faded: a method draws it back in some steps.
std::vector<const Sample*> atRest(const Recording& recording, int ball, double step) {
  constexpr double kStill = 1e-9, kSteps = 160.0;  // [m/s]
  std::vector<const Sample*> still;
  double since = recording.samples.front().t;
  bool ever = true;
  for (const Sample& sample : recording.samples) {
    const auto touches = [&](const ContactSample& c) { return c.a == ball || c.b == ball; };
    const bool rests = sample.bodies[ball].v.norm() <= kStill &&
                       std::count_if(sample.contacts.begin(), sample.contacts.end(), touches) > 1;
    if (!rests) since = sample.t;
    ever = ever && rests;
    if (rests && (ever || sample.t - since > kSteps * step)) still.push_back(&sample);
  }
  return still;
}

std::vector<ClaimRow> grooveRows(const Scene& scene, const Recording& recording) {
  if (recording.samples.empty()) return {emptyClaim("the run has no samples")};
  std::vector<ClaimRow> rows;
  const std::vector<BodyDef>& bodies = scene.world.bodies;
  for (int ball = 0; ball < static_cast<int>(bodies.size()); ++ball) {
    if (!std::holds_alternative<Sphere>(bodies[ball].shape) || !moves(bodies[ball])) continue;
    const std::vector<const Sample*> still = atRest(recording, ball, scene.world.course.step);
    if (still.empty()) continue;
    std::vector<int> walls;
    for (const ContactSample& c : still.back()->contacts)
      for (const auto& [one, other] : {std::pair(c.a, c.b), std::pair(c.b, c.a)})
        if (one == ball && isWall(bodies[other])) walls.push_back(other);
    if (walls.size() != 2) continue;

    // Of two normals that hold the weight between them, how much each has to give.
    Vec3 normal[2];
    for (int k : {0, 1}) normal[k] = faceTowards(bodies[walls[k]], still.back()->bodies[ball].x);
    const Vec3 weight = -bodyMass(bodies[ball]) * scene.world.gravity;
    const double c = normal[0].dot(normal[1]), n0 = normal[0].dot(weight),
                 n1 = normal[1].dot(weight);
    const double lambda[2] = {(n0 - c * n1) / (1.0 - c * c), (n1 - c * n0) / (1.0 - c * c)};
    for (int k : {0, 1}) {
      WorstRow row(bodies[ball].name + ": force of " + bodies[walls[k]].name + " / N", 1e-12);
      for (const Sample* sample : still) {
        Vec3 force = Vec3::Zero();
        for (const ContactSample& s : sample->contacts) {
          if (s.a == ball && s.b == walls[k]) force += s.force;
          if (s.b == ball && s.a == walls[k]) force -= s.force;
        }
        row.see(force.norm(), lambda[k], (force - lambda[k] * normal[k]).norm() / lambda[k],
                fmt::format("t = {:.4g} s", sample->t));
      }
      rows.push_back(row.row());
    }
  }
  if (rows.empty()) return {emptyClaim("no ball rests between two boxes or planes")};
  return rows;
}

}  // namespace tumble
