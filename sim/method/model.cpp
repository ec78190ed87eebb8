#include "sim/method/model.h"

#include <algorithm>
#include <charconv>
#include <cmath>

#include "sim/problem/problem.h"

namespace tumble {

void SteppingSettings::take(const SolverPreset& preset) {
  solver = preset.solver;
  tolerance = preset.settings.tolerance;
  iterations = preset.settings.maxIterations;
  crowdSolver = preset.crowdSolver;
  crowdTolerance = preset.crowd.tolerance;
  crowdIterations = preset.crowd.maxIterations;
  anyCrowd = preset.anyCrowd;
  crowdOpen = preset.open;
  divides = preset.divides;
  bent = preset.bent;
}

void SteppingSettings::treatCrowdsAlike() {
  crowdSolver = solver;
  crowdTolerance = tolerance;
  crowdIterations = iterations;
}

std::string shortNumber(double value) {
  if (std::isnan(value)) return "nan";  // whatever its sign
  char text[32];
  const auto end = std::to_chars(text, text + sizeof text, value, std::chars_format::general, 6);
  return {text, end.ptr};
}

namespace {

const InertiaMethod& methodOf(const BodyDef& body) {
  const InertiaMethod* method = findInertiaMethod(body.inertiaBy);
  if (!method)
    throw std::invalid_argument("no inertia method is called \"" + body.inertiaBy + "\"");
  return *method;
}

}  // namespace

double bodyMass(const BodyDef& body) {
  return body.mass ? *body.mass : body.density.value_or(0.0) * volume(body.shape);
}

Mat3 givenInertia(const BodyDef& body) {
  Mat3 I = body.inertia->asDiagonal();
  for (int k = 0; k < 3; ++k) {
    const int i = (k + 1) % 3, j = (k + 2) % 3;
    I(i, j) = I(j, i) = body.products[k];
  }
  return I;
}

MassProperties massOf(const BodyDef& body) {
  MassProperties properties = methodOf(body).weigh(body.shape, bodyMass(body), body.samples, 0);
  if (body.inertia) properties.inertia = givenInertia(body);
  return properties;
}

Shape centredShape(const BodyDef& body) {
  if (!hasOwnFrame(body.shape)) return body.shape;
  return withOrigin(body.shape, methodOf(body).weigh(body.shape, 1.0, body.samples, 0).centre);
}

bool Model::mayTouch(int a, int b) const {
  if ((fixed(a) && fixed(b)) || (bends(a) && bends(b))) return false;
  return !std::binary_search(partners.begin(), partners.end(), std::minmax({a, b}));
}

Surface Model::surface(int a, int b) const {
  const BodyDef &p = def.bodies[a], &q = def.bodies[b];
  Surface s{std::max(p.restitution, q.restitution), std::sqrt(p.friction * q.friction)};
  if (bends(a) || bends(b)) s.restitution = 0.0;
  for (const PairDef& pair : def.pairs) {
    const bool straight = pair.materialA == p.material && pair.materialB == q.material;
    const bool crossed = pair.materialA == q.material && pair.materialB == p.material;
    if (!straight && !crossed) continue;
    if (!bends(a) && !bends(b)) s.restitution = pair.restitution.value_or(s.restitution);
    s.friction = pair.friction.value_or(s.friction);
  }
  return s;
}

void requireStep(const std::string& path, double step, double duration) {
  if (!(step > 0.0) || !std::isfinite(step))
    throw Refusal(path, "a step must be a positive number of seconds");
  if (duration / step > kMostSteps)
    throw Refusal(path, "more than 1e11 steps would lead to the end; take longer ones");
}

}  // namespace tumble
