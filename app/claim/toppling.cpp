// A row of boxes that topple one another: the fall of the first, where each is hit, in which order.
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "app/claim/free_body.h"
#include "app/claim/rows.h"

namespace tumble {

namespace {

// Allowed errors: of a height, in which feet that slide a little have their part, measured 0.009;
// of the energy lost, measured 3e-4 in steps of 2 ms; of an instant [s] beside three
// steps, measured two.
constexpr double kHeight = 0.02, kGain = 1e-3, kInstant = 1e-6;

/// Boxes in a row on a level plane, the one that starts the fall first.
struct Row {
  std::vector<int> bodies;
  Vec3 up = Vec3::UnitY(), along = Vec3::UnitX();  ///< [1] along: the way that the fall runs
  double ground = 0.0;                             ///< [m] height of the plane
};

const Box& boxOf(const Scene& scene, int body) {
  return std::get<Box>(scene.world.bodies[body].shape);
}

// Edge [m] of a box along the axis of its frame that is nearest to a direction.
double edge(const Scene& scene, int body, const Vec3& direction) {
  const Vec3 d_B = scene.world.bodies[body].orientation.conjugate() * direction;
  int axis = 0;
  d_B.cwiseAbs().maxCoeff(&axis);
  return 2.0 * boxOf(scene, body).half[axis];
}

// How far a body leans from upright [rad].
double tilt(const Scene& scene, const Sample& sample, int body, const Vec3& up) {
  const BodyDef& def = scene.world.bodies[body];
  const Vec3 up_B = def.orientation.conjugate() * up;
  int axis = 0;
  up_B.cwiseAbs().maxCoeff(&axis);
  const double c = std::abs(up.dot(sample.bodies[body].q * Vec3(Vec3::Unit(axis))));
  return std::acos(std::min(1.0, c));
}

// From the box that leans at the start to the one that is farthest from it.
Row rowOf(const Scene& scene, const Recording& recording) {
  Row row;
  row.up = -scene.world.gravity.normalized();
  bool level = false;
  for (int body = 0; body < static_cast<int>(scene.world.bodies.size()); ++body) {
    const BodyDef& def = scene.world.bodies[body];
    if (moves(def) && std::holds_alternative<Box>(def.shape)) row.bodies.push_back(body);
    const HalfSpace* plane = std::get_if<HalfSpace>(&def.shape);
    if (!plane || plane->n.cross(row.up).norm() > 1e-9) continue;
    row.ground = plane->d;
    level = true;
  }
  if (!level || row.bodies.size() < 3) return {};
  const Sample& start = recording.samples.front();
  const auto leans = [&](int a, int b) {
    return tilt(scene, start, a, row.up) < tilt(scene, start, b, row.up);
  };
  const int first = *std::max_element(row.bodies.begin(), row.bodies.end(), leans);
  if (tilt(scene, start, first, row.up) == 0.0) return {};
  const auto from = [&](int body) -> Vec3 {
    const Vec3 d = start.bodies[body].x - start.bodies[first].x;
    return d - row.up * row.up.dot(d);
  };
  std::stable_sort(row.bodies.begin(), row.bodies.end(),
                   [&](int a, int b) { return from(a).norm() < from(b).norm(); });
  row.along = from(row.bodies.back()).normalized();
  return row;
}

/// The first time that two bodies hit each other; at infinity if they never do.
Event firstHit(const Recording& recording, int a, int b) {
  for (const Event& event : recording.report.events)
    if ((event.a == a && event.b == b) || (event.a == b && event.b == a)) return event;
  Event never;
  never.t = std::numeric_limits<double>::infinity();
  return never;
}

// Between the faces of two neighbours that stand upright [m].
double gapBetween(const Scene& scene, const Row& row, int a, int b) {
  const Vec3 d = scene.world.bodies[b].position - scene.world.bodies[a].position;
  return row.along.dot(d) - 0.5 * (edge(scene, a, row.along) + edge(scene, b, row.along));
}

// The first box turns about the edge it leans over, from rest: I ω²/2 = m g r (cos θ₀ − cos θ),
// with θ of its centre from upright and I about the edge. Its face has reached the next box where
// h sin φ is the way there. [s]; θ = θ₀ + (θ₁ − θ₀) s² takes the root out of the integral.
std::optional<double> fallTime(const Scene& scene, const Recording& recording, const Row& row) {
  const int first = row.bodies[0], next = row.bodies[1];
  const Sample& start = recording.samples.front();
  Vec3 foot = Vec3::Zero();
  int points = 0;
  for (const ContactSample& c : start.contacts)
    if (c.a == first || c.b == first) {
      foot += c.p;
      ++points;
    }
  if (points == 0 || !start.bodies[first].v.isZero() || !start.bodies[first].omega.isZero())
    return {};
  foot /= points;
  const Vec3 arm = start.bodies[first].x - foot, side = row.up.cross(row.along);
  const MassProperties mass = massOf(scene.world.bodies[first]);
  const Vec3 side_B = start.bodies[first].q.conjugate() * side;
  const double I = side_B.dot(mass.inertia * side_B) + mass.mass * arm.squaredNorm();
  const double face = scene.world.bodies[next].position.dot(row.along) -
                      0.5 * edge(scene, next, row.along) - foot.dot(row.along);
  const double from = std::atan2(arm.dot(row.along), arm.dot(row.up));
  const double turn =
      std::asin(face / edge(scene, first, row.up)) - tilt(scene, start, first, row.up);
  constexpr int kPieces = 2000;
  double time = 0.0;
  for (int k = 0; k < kPieces; ++k) {
    const double s = (k + 0.5) / kPieces, theta = from + turn * s * s;
    const double omega = std::sqrt(2.0 * mass.mass * scene.world.gravity.norm() * arm.norm() *
                                   (std::cos(from) - std::cos(theta)) / I);
    time += 2.0 * turn * s / omega / kPieces;
  }
  return time;
}

// Whether bodies that hit each other part again.
bool rebounds(const Scene& scene, const Row& row) {
  return surfaceOf(scene.world, row.bodies[0], row.bodies[1]).restitution > 0.0;
}

// Hits come in the order of the row. A box that turns about its foot hits the next one where
// h² = gap² + height²; with restitution its foot leaps.
void addHits(const Scene& scene, const Recording& recording, const Row& row,
             std::vector<ClaimRow>& rows) {
  const int count = static_cast<int>(row.bodies.size());
  WorstRow heights("height of the hits / m, relative", kHeight);
  int inOrder = 0;
  double before = 0.0;
  for (int k = 0; k + 1 < count; ++k) {
    const int a = row.bodies[k], b = row.bodies[k + 1];
    const Event hit = firstHit(recording, a, b);
    inOrder += hit.t > before && std::isfinite(hit.t);
    before = hit.t;
    if (k == 0 || !std::isfinite(hit.t)) continue;
    const double h = edge(scene, a, row.up), gap = gapBetween(scene, row, a, b);
    const double told = std::sqrt(h * h - gap * gap), seen = hit.p.dot(row.up) - row.ground;
    heights.see(seen, told, std::abs(seen / told - 1.0));
  }
  if (!rebounds(scene, row)) rows.push_back(heights.row());
  rows.push_back({"hits in the order of the row", double(inOrder), count - 1.0,
                  std::abs(inOrder - (count - 1.0)), 0.0});
}

// No sample has more energy than the one before; with restitution, than the first: what leaves one
// contact as fast as Newton's law says may bring energy to others that rub.
void addEnergy(const Scene& scene, const Recording& recording, const Row& row,
               std::vector<ClaimRow>& rows) {
  const std::vector<Sample>& samples = recording.samples;
  const auto energy = [](const Sample& s) { return s.kinetic + s.potential; };
  const double lost = energy(samples.front()) - energy(samples.back());
  WorstRow gained("energy gained / J, of what is lost", kGain);
  for (std::size_t k = 1; k < samples.size(); ++k) {
    const Sample& before = rebounds(scene, row) ? samples.front() : samples[k - 1];
    const double gain = std::max(0.0, energy(samples[k]) - energy(before));
    gained.see(gain, 0.0, gain / lost);
  }
  rows.push_back(gained.row());
}

}  // namespace

std::vector<ClaimRow> topplingRows(const Scene& scene, const Recording& recording) {
  if (recording.samples.empty()) return {emptyClaim("the run has no samples")};
  const Row row = rowOf(scene, recording);
  if (row.bodies.empty()) return {emptyClaim("no box leans towards others on a level plane")};
  std::vector<ClaimRow> rows;
  if (const std::optional<double> told = fallTime(scene, recording, row)) {
    const double step = scene.world.method == "stepping" ? scene.world.stepping.step : 0.0;
    const double seen = firstHit(recording, row.bodies[0], row.bodies[1]).t;
    rows.push_back(
        {"the first falls for / s", seen, *told, std::abs(seen - *told), kInstant + 3.0 * step});
  }
  addHits(scene, recording, row, rows);
  addEnergy(scene, recording, row, rows);
  double fallen = 0.0;
  for (const int body : row.bodies)
    fallen += tilt(scene, recording.samples.back(), body, row.up) > EIGEN_PI / 4.0;
  const double count = static_cast<double>(row.bodies.size());
  rows.push_back({"lie at the end", fallen, count, count - fallen, 0.0});
  return rows;
}

}  // namespace tumble
