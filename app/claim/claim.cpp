#include "app/claim/claim.h"

#include <cmath>
#include <limits>
#include <utility>

#include "app/claim/rows.h"

namespace tumble {

namespace {

constexpr Check kChecks[] = {
    {"bounce-apex", "n-th apex = e^(2n) h for bodies that fall without spin on a floor",
     bounceApexRows, bouncePaths},
    {"bouncing", "height, energy and hits of what bounces without spin are those of its parabolas",
     bouncingRows, bouncePaths},
    {"rest-time", "a bouncing body rests at t1 (1+e)/(1-e)", restTimeRows, nullptr},
    {"first-hit", "the first hit comes when parabola and free rotation say", firstHitRows, nullptr},
    {"arcs",
     "between hits a parabola; each hit changes momentum, spin and energy as its impulse says",
     arcRows, arcPaths},
    {"orbit", "in a circular field, radius and phase of the exact orbit", orbitRows, orbitPaths},
    {"tower-forces", "contact forces carry the weight above; nothing drifts or sinks", towerRows,
     nullptr},
    {"weight", "inertia and centre of mass by the chosen method, and turning by them", weightRows,
     nullptr},
    {"free-spin", "bodies free of torque turn as the exact rotor does, and keep energy and |L|",
     freeSpinRows, nullptr},
    {"flips", "a spin about the middle axis turns over each half period of its elliptic function",
     flipRows, nullptr},
    {"heavy-top", "about a held point as another method turns; energy, angular momentum, the point",
     topRows, nullptr},
    {"plans", "a step into the floor is backed up, repaired or lied about: instant, depth, height",
     planRows, bouncePaths},
    {"point-plans",
     "points found in a solid: gradual is bad, displace worse, implicit and constraint are right",
     pointPlanRows, nullptr},
    {"holds", "three ways to hold points in the implicit step find one motion; steps, residuals",
     holdRows, nullptr},
    {"spring-contact", "a ball on a penalty floor is half a period in touch; on a rigid one, j",
     springContactRows, nullptr},
    {"row-of-balls", "balls in a row end with the velocities that the impact law gives them",
     rowOfBallsRows, nullptr},
    {"lever", "a plank on a hinge and a prop: f = m g L/(2 d) at the prop, m g - f at the hinge",
     leverRows, nullptr},
    {"groove", "each wall of a groove carries what a ball at rest in it needs", grooveRows,
     nullptr},
    {"apart",
     "planes part the corners of bodies that pass, remembered or not; hulls of compounds hit",
     apartRows, nullptr},
    {"sliding", "on a plane a block stays or slides by tan θ = μ, and a ball slides until it rolls",
     slidingRows, nullptr},
    {"sliding-way", "what a plane carries at the start: its way, its speed, when its slip ends",
     wayRows, nullptr},
    {"books", "the run's certificate: forces are solved for, nothing overlaps, energy is kept",
     bookRows, nullptr},
    {"crowd",
     "energy only goes and is accounted for, momentum is kept, repairs and overlap are small",
     crowdRows, nullptr},
    {"equilibrium",
     "what rests at the start stays where forces in the cones can hold it, else falls",
     equilibriumRows, nullptr},
    {"settled", "at the end all lie still, and the ground carries their weight", settledRows,
     nullptr},
    {"toppling", "the first falls as a pendulum does; each is hit where geometry says, in order",
     topplingRows, nullptr},
    {"spins", "on a floor energy goes by slip alone; Jellett's integral, a steady disk, a held tip",
     spinRows, nullptr},
};

}  // namespace

std::span<const Check> checks() {
  return kChecks;
}

const Check* findCheck(std::string_view name) {
  for (const Check& check : kChecks)
    if (check.name == name) return &check;
  return nullptr;
}

const char* signOf(Relation relation) {
  return relation == Relation::AtMost ? "≤ " : relation == Relation::AtLeast ? "≥ " : "";
}

WorstRow::WorstRow(std::string label, double allowed)
    : label_(std::move(label)),
      row_{label_, 0.0, 0.0, std::numeric_limits<double>::infinity(), allowed} {}

void WorstRow::see(double measured, double exact, double error, const std::string& where) {
  if (seen_ && (std::isnan(row_.error) || error <= row_.error)) return;
  seen_ = true;
  row_.measured = measured;
  row_.exact = exact;
  row_.error = error;
  row_.label = where.empty() ? label_ : label_ + ", worst at " + where;
}

ClaimRow emptyClaim(const std::string& what) {
  return {what, 0.0, 1.0, std::numeric_limits<double>::infinity(), 0.0, true};
}

}  // namespace tumble
