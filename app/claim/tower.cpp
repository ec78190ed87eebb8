// Bodies at rest on one another: forces carry the weight above, nothing drifts, nothing sinks.
#include <algorithm>
#include <cmath>
#include <numeric>

#include "app/claim/free_body.h"
#include "app/claim/rows.h"

namespace tumble {

namespace {

/// Bodies that touch, directly or through others, lowest first.
using Tower = std::vector<int>;

// Towers are the connected groups of moving bodies in the first sample that has contacts.
std::vector<Tower> towersOf(const Scene& scene, const Recording& recording, const Vec3& up) {
  const int count = static_cast<int>(scene.world.bodies.size());
  std::vector<int> group(count);
  std::iota(group.begin(), group.end(), 0);
  for (const Sample& sample : recording.samples) {
    if (sample.contacts.empty()) continue;
    for (const ContactSample& contact : sample.contacts) {
      if (!moves(scene.world.bodies[contact.a]) || !moves(scene.world.bodies[contact.b])) continue;
      const int from = group[contact.a], to = group[contact.b];
      std::replace(group.begin(), group.end(), from, to);
    }
    break;
  }
  std::vector<Tower> towers(count);
  for (int body = 0; body < count; ++body)
    if (moves(scene.world.bodies[body])) towers[group[body]].push_back(body);
  std::erase_if(towers, [](const Tower& tower) { return tower.empty(); });
  for (Tower& tower : towers)
    std::stable_sort(tower.begin(), tower.end(), [&](int a, int b) {
      return up.dot(scene.world.bodies[a].position) < up.dot(scene.world.bodies[b].position);
    });
  return towers;
}

// Force [N] on the listed bodies by all that are not listed.
Vec3 forceOn(const Sample& sample, std::span<const int> bodies) {
  const auto listed = [&](int body) {
    return std::find(bodies.begin(), bodies.end(), body) != bodies.end();
  };
  Vec3 sum = Vec3::Zero();
  for (const ContactSample& contact : sample.contacts) {
    if (listed(contact.a) == listed(contact.b)) continue;
    sum += listed(contact.a) ? contact.force : Vec3(-contact.force);
  }
  return sum;
}

// At each level, what lies below carries what lies above: the cut that Newton's law needs.
ClaimRow weightRow(const Scene& scene, const Recording& recording, const Tower& tower, int level) {
  const std::span<const int> above = std::span(tower).subspan(level);
  Vec3 weight = Vec3::Zero();
  for (const int body : above) {
    const double mass = bodyMass(scene.world.bodies[body]);
    weight += mass * freeAcceleration(scene.world, body).value_or(scene.world.gravity);
  }
  WorstRow worst(scene.world.bodies[tower[level]].name + ": force from below / N", 1e-6);
  for (const Sample& sample : recording.samples) {
    const Vec3 force = forceOn(sample, above);
    worst.see(force.norm(), weight.norm(), (force + weight).norm() / weight.norm());
  }
  return worst.row();
}

}  // namespace

std::vector<ClaimRow> towerRows(const Scene& scene, const Recording& recording) {
  const Vec3 up = -scene.world.gravity.normalized();
  const std::vector<Tower> towers = towersOf(scene, recording, up);
  if (towers.empty() || recording.samples.empty()) return {emptyClaim("no body rests on another")};

  std::vector<ClaimRow> rows;
  for (const Tower& tower : towers)
    for (int level = 0; level < static_cast<int>(tower.size()); ++level)
      rows.push_back(weightRow(scene, recording, tower, level));

  // Sideways drift and sinking, over all bodies and samples.
  WorstRow drift("largest drift sideways / m", 1e-3), overlap("deepest overlap / m", 1e-4);
  const double deepest = recording.report.certificate.max_penetration;
  overlap.see(deepest, 0.0, deepest);
  for (const Sample& sample : recording.samples) {
    for (const Tower& tower : towers)
      for (const int body : tower) {
        const Vec3 moved = sample.bodies[body].x - scene.world.bodies[body].position;
        const double sideways = (moved - up * up.dot(moved)).norm();
        drift.see(sideways, 0.0, sideways);
      }
    for (const ContactSample& contact : sample.contacts)
      overlap.see(-contact.separation, 0.0, -contact.separation);
  }
  rows.push_back(drift.row());
  rows.push_back(overlap.row());
  return rows;
}

}  // namespace tumble
