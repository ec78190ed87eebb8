// Newton's cradle: a row of balls on a straight line, held to what its impact law makes of it.
#include <algorithm>
#include <cmath>

#include "app/claim/ball_row.h"
#include "app/claim/free_body.h"
#include "app/claim/rows.h"

namespace tumble {

namespace {

constexpr double kAligned = 1e-9;  // [1] of lengths and speeds, off the line

/// Balls of a scene on one line, in its order.
struct Line {
  Vec3 along;
  std::vector<int> bodies;
  BallRow row;
};

double radiusOf(const BodyDef& body) {
  const Sphere* sphere = std::get_if<Sphere>(&body.shape);
  return sphere ? sphere->r : 0.0;
}

bool isBall(const BodyDef& body) {
  return moves(body) && radiusOf(body) > 0.0 && body.angularVelocity.isZero();
}

// The balls on the line through one of them along its velocity; none unless they move along it and
// are pulled alike.
Line lineThrough(const WorldDef& world, int first) {
  const BodyDef& ball = world.bodies[first];
  Line line{ball.velocity.normalized(), {}, {}};
  for (int i = 0; i < static_cast<int>(world.bodies.size()); ++i) {
    const BodyDef& other = world.bodies[i];
    if (!isBall(other)) continue;
    const Vec3 apart = other.position - ball.position;
    if (line.along.cross(apart).norm() > kAligned * std::max(1.0, apart.norm())) continue;
    if (line.along.cross(other.velocity).norm() > kAligned * ball.velocity.norm()) return {};
    const std::optional<Vec3> pull = freeAcceleration(world, i);
    if (!pull || !pull->isApprox(*freeAcceleration(world, first))) return {};
    line.bodies.push_back(i);
  }
  const auto place = [&](int i) { return line.along.dot(world.bodies[i].position); };
  std::sort(line.bodies.begin(), line.bodies.end(),
            [&](int i, int j) { return place(i) < place(j); });
  return line;
}

BallRow rowOf(const WorldDef& world, const Line& line) {
  BallRow row;
  row.law = world.impact;
  for (std::size_t k = 0; k < line.bodies.size(); ++k) {
    const BodyDef& ball = world.bodies[line.bodies[k]];
    row.m.push_back(bodyMass(ball));
    row.u.push_back(line.along.dot(ball.velocity));
    row.x.push_back(0.0);
    if (k == 0) continue;
    const BodyDef& left = world.bodies[line.bodies[k - 1]];
    row.gap.push_back(line.along.dot(ball.position - left.position) - radiusOf(left) -
                      radiusOf(ball));
    row.e.push_back(surfaceOf(world, line.bodies[k], line.bodies[k - 1]).restitution);
  }
  return row;
}

bool has(const std::vector<int>& bodies, int body) {
  return std::find(bodies.begin(), bodies.end(), body) != bodies.end();
}

// Whether the line is left alone by everything beside it.
bool undisturbed(const Line& line, const Recording& recording) {
  return std::all_of(
      recording.report.events.begin(), recording.report.events.end(),
      [&](const Event& event) { return has(line.bodies, event.a) == has(line.bodies, event.b); });
}

std::vector<Line> linesOf(const Scene& scene, const Recording& recording) {
  const WorldDef& world = scene.world;
  std::vector<Line> lines;
  std::vector<int> seen;
  for (int i = 0; i < static_cast<int>(world.bodies.size()); ++i) {
    const BodyDef& ball = world.bodies[i];
    if (!isBall(ball) || ball.velocity.isZero() || !freeAcceleration(world, i) || has(seen, i))
      continue;
    Line line = lineThrough(world, i);
    if (line.bodies.size() < 2 || !undisturbed(line, recording)) continue;
    seen.insert(seen.end(), line.bodies.begin(), line.bodies.end());
    line.row = rowOf(world, line);
    lines.push_back(std::move(line));
  }
  return lines;
}

// An instant at which an impact happens has two velocities.
bool atImpact(const Recording& recording, double t) {
  return std::any_of(recording.report.events.begin(), recording.report.events.end(),
                     [&](const Event& event) { return std::abs(event.t - t) < 1e-9; });
}

void compare(const Scene& scene, const Recording& recording, Line line,
             std::vector<ClaimRow>& rows) {
  const std::string name = scene.world.bodies[line.bodies.front()].name + " …: ";
  WorstRow speed(name + "worst velocity / (m/s)", 1e-9), place(name + "worst place / m", 1e-9);
  const Vec3 pull = *freeAcceleration(scene.world, line.bodies.front());
  double t = 0.0;
  for (const Sample& sample : recording.samples) {
    line.row.advance(sample.t - t);
    t = sample.t;
    if (atImpact(recording, t)) continue;
    for (std::size_t k = 0; k < line.bodies.size(); ++k) {
      const BodySample& body = sample.bodies[line.bodies[k]];
      const Vec3 v = body.v - t * pull;
      const Vec3 moved = body.x - scene.world.bodies[line.bodies[k]].position - 0.5 * t * t * pull;
      const double u = line.row.u[k], x = line.row.x[k];
      speed.see(line.along.dot(v), u, (v - u * line.along).norm());
      place.see(line.along.dot(moved), x, (moved - x * line.along).norm());
    }
  }
  if (!line.row.ended) return;
  rows.push_back(speed.row());
  rows.push_back(place.row());
}

}  // namespace

std::vector<ClaimRow> rowOfBallsRows(const Scene& scene, const Recording& recording) {
  if (scene.world.method == "stepping")
    return {emptyClaim("the method \"stepping\" has an impact law of its own")};
  std::vector<ClaimRow> rows;
  for (const Line& line : linesOf(scene, recording)) compare(scene, recording, line, rows);
  if (rows.empty())
    rows.push_back(emptyClaim("no balls without spin on a line along which they move, left alone"));
  return rows;
}

}  // namespace tumble
