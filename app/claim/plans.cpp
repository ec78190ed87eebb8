// The three plans for a step that leads a falling body into the floor: where it is put, and what
// that does to its height.
#include <algorithm>
#include <cmath>
#include <limits>

#include "app/claim/fall.h"
#include "app/claim/free_body.h"
#include "app/claim/rows.h"

namespace tumble {

namespace {

constexpr double kTouch = 1e-9;  // [m] less overlap is none

// A body that falls in whole steps: parabolas between their ends, where its overlap is mended and
// its speed turned round.
struct Stepper {
  double gap, speed;        // [m], [m/s] upward
  double g, e, h, share;    // share [1] of an overlap that a step takes away
  double lifted = 0.0;      // [m] by all repairs
  double firstDepth = 0.0;  // [m] of the first overlap
  bool rests = false;

  void step() {
    if (!rests) {
      gap += speed * h - 0.5 * g * h * h;
      speed -= g * h;
    }
    if (gap < -kTouch) {
      if (firstDepth == 0.0) firstDepth = -gap;
      lifted -= share * gap;
      gap -= share * gap;
    }
    if (gap > kTouch || speed >= 0.0) return;
    speed *= -e;
    rests = rests || e == 0.0;
  }
  // Height [m] that the energy of this moment reaches.
  double apex() const { return gap + speed * speed / (2.0 * g); }
};

Stepper stepperOf(const Scene& scene, const Fall& fall) {
  const CourseSettings& course = scene.world.course;
  const double share = course.plan == "lie" ? 1.0 : 1.0 / course.repairSteps;
  return {fall.height, fall.speed, fall.g, fall.e, course.step, share};
}

std::string nameOf(const Scene& scene, const Fall& fall) {
  return scene.world.bodies[fall.body].name;
}

// Height [m] that the energy of a sample reaches above where the body touches.
double apexOf(const Scene& scene, const Fall& fall, const Sample& sample) {
  const BodySample& body = sample.bodies[fall.body];
  const double risen = fall.normal.dot(body.x - scene.world.bodies[fall.body].position);
  const double v = fall.normal.dot(body.v);
  return fall.height + risen + v * v / (2.0 * fall.g);
}

// Backstep: the hit is where the parabola meets the floor.
void addCollisionTime(const Scene& scene, const Recording& recording, const Fall& fall,
                      std::vector<ClaimRow>& rows) {
  double measured = std::numeric_limits<double>::infinity();
  for (const Event& event : recording.report.events)
    if (event.kind == EventKind::Impact && (event.a == fall.body || event.b == fall.body)) {
      measured = event.t;
      break;
    }
  const double exact = fall.firstHit();
  rows.push_back(
      {nameOf(scene, fall) + ": t_c / s", measured, exact, std::abs(measured - exact), 1e-10});
  WorstRow worst(nameOf(scene, fall) + ": worst apex / m", 1e-6);
  for (const Sample& sample : recording.samples)
    if (const double apex = fall.apex(sample.t < exact ? 0 : 1);
        sample.t < exact || sample.t < fall.apexTime(1))
      worst.see(apexOf(scene, fall, sample), apex,
                std::abs(apexOf(scene, fall, sample) - apex) / std::max(apex, 1e-3));
  rows.push_back(worst.row());
}

// Gradual and lie: the steps, one by one.
void addSteps(const Scene& scene, const Recording& recording, const Fall& fall, double& added,
              std::vector<ClaimRow>& rows) {
  Stepper stepper = stepperOf(scene, fall);
  WorstRow worst(nameOf(scene, fall) + ": worst apex / m", 1e-6);
  long done = 0;
  for (const Sample& sample : recording.samples) {
    for (; static_cast<double>(done + 1) * stepper.h <= sample.t; ++done) stepper.step();
    const double measured = apexOf(scene, fall, sample);
    worst.see(measured, stepper.apex(),
              std::abs(measured - stepper.apex()) / std::max(std::abs(stepper.apex()), 1e-3));
  }
  rows.push_back(worst.row());
  const long all = std::lround(scene.world.duration / stepper.h);
  for (; done < all; ++done) stepper.step();
  added += bodyMass(scene.world.bodies[fall.body]) * fall.g * stepper.lifted;

  double measured = 0.0;
  for (const Misstep& misstep : recording.report.missteps)
    if (misstep.body == fall.body) {
      measured = -misstep.separation;
      break;
    }
  rows.push_back({nameOf(scene, fall) + ": first overlap / m", measured, stepper.firstDepth,
                  std::abs(measured - stepper.firstDepth), 1e-9});
}

}  // namespace

std::vector<ClaimRow> planRows(const Scene& scene, const Recording& recording) {
  const CourseSettings& course = scene.world.course;
  const bool steps = course.plan != "backstep";
  std::vector<ClaimRow> rows;
  double added = 0.0;
  for (const Fall& fall : fallsOf(scene))
    if (steps)
      addSteps(scene, recording, fall, added, rows);
    else
      addCollisionTime(scene, recording, fall, rows);
  if (rows.empty() || scene.world.method != "course" || course.contact != "constraint")
    return {emptyClaim("no body falls onto a floor without spin, in steps of the course")};
  const double measured = recording.report.certificate.energy_added_repair;
  if (static_cast<int>(fallsOf(scene).size()) ==
      std::count_if(scene.world.bodies.begin(), scene.world.bodies.end(), moves))
    rows.push_back({"energy added by repairs / J", measured, added, std::abs(measured - added),
                    1e-9 * std::max(1.0, added)});
  return rows;
}

}  // namespace tumble
