// What flies as a whole, held by nothing: its centre falls on a parabola, and it turns as loads
// alone have it, whatever its bodies do to each other.
#include <algorithm>
#include <cmath>

#include "sim/flight/rotor.h"
#include "sim/math/rotation.h"
#include "sim/method/stepping/stepping.h"

namespace tumble {

bool Stepping::isHeld(const Island& island, const Vec3& falls, double h) const {
  const auto stands = [&](int i) {
    return i == static_cast<int>(state_.bodies.size()) || model_.fixed(i);
  };
  const auto holds = [&](const Touch& touch) {
    const Contact& c = touch.contact;
    const double sinks = c.point.n.dot(stands(c.a) ? Vec3(-falls) : falls);
    return !touch.impulse.isZero(0.0) ||
           gapAhead(c.point, {c.b, c.a}, h) < h * sinks - tolerance_.drift;
  };
  return std::any_of(island.links.begin(), island.links.end(), [&](Link link) {
    const auto [b, a] = ends(link);
    if (!stands(a) && !stands(b)) return false;
    if (!isPair(link)) return true;
    const std::vector<Touch>& touches = memory_.pairs[link].touches;
    return std::any_of(touches.begin(), touches.end(), holds);
  });
}

/// What nothing that stands holds moves as a whole by the parabola of what is free, whatever its
/// bodies do to each other: all go by  h v⁺ − ½ h² ΣF/ΣM,  a shift that changes no way of one
/// against another. What drag brakes decays on its way.
/// @return whether the island flies so
bool Stepping::flyAsOne(Island& island, double h) {
  double mass = 0.0;
  Vec3 force = Vec3::Zero(), later = Vec3::Zero();  // [N], and [N s] of what acts after the move
  for (const int i : island.movers) {
    const RigidBody& body = state_.bodies[i];
    if (!work_.touched[i]) continue;
    if (memory_.drives->dragOf[i] >= 0 || isHalved(i)) return false;
    mass += body.M;
    force += body.force;
    later += work_.later[i] * body.force;
  }
  if (mass == 0.0) return false;
  const Vec3 falls = 0.5 * h / mass * force - later / mass;
  if (isHeld(island, falls, h)) return false;
  for (const int i : island.movers) work_.falls[i] = falls;
  return true;
}

/// Spin [N·m·s] that a step gives what flies beyond what it should: a taut spring pulls, in the
/// course of it, along another line than at its start; a wind has another arm.
Vec3 Stepping::spinAmiss(const Island& island, double h) const {
  Vec3 amiss = Vec3::Zero(), sum = Vec3::Zero();
  for (const Link link : island.links) {
    const SpringRow* spring = isPair(link) ? nullptr : springOf(link);
    if (!spring || spring->across == 0) continue;
    const Row& row = work_.bonds.rows[spring->bond];
    const SpringEnds at = endsOf(*spring->spring, 0.0);
    amiss += (at.pa - at.pb).cross(work_.bonds.lambda[spring->bond] * row.linear);
  }
  double mass = 0.0;
  bool blown = false;
  for (const int i : island.movers) {
    const RigidBody& body = state_.bodies[i];
    blown = blown || body.force != body.M * model_.def.gravity;
    mass += body.M;
    sum += body.M * (work_.after[i].head<3>() - work_.falls[i]);
  }
  for (const int i : island.movers) {
    if (!blown || !work_.touched[i]) continue;
    const Vec3 way = h * (work_.after[i].head<3>() - work_.falls[i] - sum / mass);
    amiss -= (0.5 * h - work_.later[i]) * way.cross(state_.bodies[i].force);
  }
  return amiss;
}

/// All of what flies turns faster as one by δ, which gives back the spin that was lost in a step:
///   Σ M r⁺ × (v + δ × r⁺) − M r × v + I δ = −ΔL,   r⁺ = exp(h δ) r,
/// with r from the centre to where a body goes. That moves none against another.
void Stepping::keepSpin(Island& island, double h) {
  constexpr int kMost = 10;
  constexpr double kSame = 1e-15;  // [rad]
  const Vec3 amiss = spinAmiss(island, h);
  if (amiss.isZero(0.0)) return;

  double mass = 0.0;
  Vec3 centre = Vec3::Zero();
  std::vector<Vec3>&ends = island.ends, &speeds = island.speeds;
  ends.clear();
  speeds.clear();
  for (const int i : island.movers) {
    const RigidBody& body = state_.bodies[i];
    const Vec3 later = work_.later[i] * body.invM * body.force;
    if (!work_.touched[i]) work_.falls[i] = 0.5 * h * body.invM * body.force - later;
    work_.touched[i] = 1;
    ends.push_back(body.x + h * (work_.after[i].head<3>() - work_.falls[i]));
    speeds.push_back(work_.after[i].head<3>() + later);
    mass += body.M;
    centre += body.M * ends.back();
  }
  centre /= mass;
  Mat3 I = Mat3::Zero(), own = Mat3::Zero();
  for (std::size_t k = 0; k < ends.size(); ++k) {
    const RigidBody& body = state_.bodies[island.movers[k]];
    const Mat3 lever = skew(ends[k] -= centre);
    I += body.M * lever * lever.transpose();
    if (!body.particle) own += body.R * body.Ibody * body.R.transpose();
  }
  I += own;
  const auto inverse = I.completeOrthogonalDecomposition();  // points in a line have none about it

  Vec3 turn = Vec3::Zero();
  for (int n = 0; n < kMost; ++n) {
    Vec3 open = -amiss - own * turn;
    const Quat ahead = rotated(Quat::Identity(), h * turn);
    for (std::size_t k = 0; k < ends.size(); ++k) {
      const double M = state_.bodies[island.movers[k]].M;
      const Vec3 r = ahead * ends[k];
      open -= M * (r.cross(speeds[k] + turn.cross(r)) - ends[k].cross(speeds[k]));
    }
    const Vec3 change = inverse.solve(open);
    turn += change;
    if (h * change.norm() <= kSame) break;
  }
  const Quat ahead = rotated(Quat::Identity(), h * turn);
  for (std::size_t k = 0; k < ends.size(); ++k) {
    const int i = island.movers[k];
    const RigidBody& body = state_.bodies[i];
    Vec6& after = work_.after[i];
    const Vec3 r = ahead * ends[k], more = turn.cross(r);
    after.head<3>() += more;
    work_.falls[i] += more - (r - ends[k]) / h;
    double work = body.M * more.dot(work_.before[i].head<3>() + speeds[k] + more);
    if (!body.particle) {
      after.tail<3>() += turn;
      const Vec3 spin = body.R * (body.Ibody * (body.R.transpose() * turn));
      work += spin.dot(after.tail<3>() + work_.before[i].tail<3>());
    }
    island.memory->books.work += 0.5 * work;
  }
}

void Stepping::flyBent(Island& island, double h) {
  bool free = true;
  forBent(island, [&](BendingPart& part) {
    part.held = true;
    free = free && part.flies();
  });
  if (!free || !flyAsOne(island, h)) return;
  forBent(island, [](BendingPart& part) { part.held = false; });
}

namespace {

/// Points of mass as one: where they are, how they move, and what turns about their centre.
struct Whole {
  double mass = 0.0;
  Vec3 x = Vec3::Zero(), v = Vec3::Zero();
  Mat3 second = Mat3::Zero();                  ///< [kg m²] Σ M r rᵀ
  Vec3 L = Vec3::Zero(), line = Vec3::Zero();  ///< line: the longest r
  double motion = 0.0, turning = 0.0;  ///< Σ M |r| |v|, and ½ Σ M |v|², of v against the centre's

  /// Whether an angular momentum is more than rounding.
  bool spinsBy(const Vec3& momentum) const {
    constexpr double kSpin = 1e-9;  // of the angular momenta of its points
    return momentum.norm() > kSpin * motion;
  }
};

template <class Place, class Rate>
Whole wholeOf(const BendingPart& part, std::span<const RigidBody> bodies, const Place& place,
              const Rate& rate) {
  Whole whole;
  const std::size_t n = part.bodies.size();
  for (std::size_t p = 0; p < n; ++p) {
    const double M = bodies[part.bodies[p]].M;
    whole.mass += M;
    whole.x += M * place(p);
    whole.v += M * rate(p);
  }
  whole.x /= whole.mass;
  whole.v /= whole.mass;
  for (std::size_t p = 0; p < n; ++p) {
    const double M = bodies[part.bodies[p]].M;
    const Vec3 r = place(p) - whole.x, v = rate(p) - whole.v;
    whole.second += M * r * r.transpose();
    whole.L += M * r.cross(v);
    whole.motion += M * r.norm() * rate(p).norm();
    whole.turning += 0.5 * M * v.squaredNorm();
    if (r.squaredNorm() > whole.line.squaredNorm()) whole.line = r;
  }
  return whole;
}

/// The inertia tensor [kg m²] of what has the second moments S about its centre. Points in a line
/// have none about it: there, as much as across it, for they cannot turn so.
Mat3 inertiaOf(const Mat3& second, const Vec3& line) {
  constexpr double kLine = 1e-12;
  const double size = second.trace();
  Mat3 I = size * Mat3::Identity() - second;
  if (I.determinant() < kLine * size * size * size)
    I += size / line.squaredNorm() * line * line.transpose();
  return I;
}

/// The turn R that takes arms r to arms y best,  Σ M (R r) × y = 0,  from B = Σ M y rᵀ by Newton's
/// method.
Quat bestTurn(const Mat3& B, const Vec3& line, const Quat& guess) {
  constexpr int kMost = 20;
  constexpr double kSame = 1e-15;  // [rad]
  Quat R = guess;
  for (int k = 0; k < kMost; ++k) {
    const Mat3 C = B * R.toRotationMatrix().transpose();
    const Vec3 off(C(2, 1) - C(1, 2), C(0, 2) - C(2, 0), C(1, 0) - C(0, 1));
    const Vec3 turn = inertiaOf(0.5 * (C + C.transpose()), line).inverse() * off;
    if (!turn.allFinite() || turn.norm() > 1.0) return guess;
    R = rotated(R, turn).normalized();
    if (turn.norm() <= kSame) break;
  }
  return R;
}

}  // namespace

/// A step moves points along chords, and an implicit one finds velocities along those: of what
/// turns, half a turn behind. As a body turns, its velocities are ω × r and those of its shape; for
/// the step they are taken as the chord that led to where it is, and those of its shape:
///   v⁻ + (r − exp(−h ω) r)/h − ω × r,
/// and forces linear about where it turns to.
void Stepping::lean(BendingPart& part, double h) {
  part.lean.clear();
  part.placed = false;
  const std::size_t number = &part - memory_.bendings->parts.data();
  if (!part.flies() || part.joined || part.several || memory_.chords[number]) return;
  const auto body = [&](std::size_t p) -> const RigidBody& {
    return state_.bodies[part.bodies[p]];
  };
  const Whole whole = wholeOf(
      part, state_.bodies, [&](std::size_t p) { return body(p).x; },
      [&](std::size_t p) { return body(p).v; });
  if (!whole.spinsBy(whole.L)) return;
  const Mat3 I = inertiaOf(whole.second, whole.line);
  const Vec3 omega = I.inverse() * whole.L;
  const Quat back = rotated(Quat::Identity(), -h * omega),
             ahead = Rotor(I, Quat::Identity(), whole.L).attitude(h);
  for (std::size_t p = 0; p < part.bodies.size(); ++p) {
    const Vec3 r = body(p).x - whole.x;
    part.lean.push_back((r - back * r) / h - omega.cross(r));
    part.about[p] = whole.v + (ahead * r - r) / h;
  }
}

void Stepping::turnBent(double h) {
  std::vector<BendingPart>& parts = memory_.bendings->parts;
  for (std::size_t k = 0; k < parts.size(); ++k) {
    if (!parts[k].flies()) continue;
    if (parts[k].held || parts[k].movesOut())
      memory_.chords[k] = 1;
    else
      turnWhole(parts[k], h);
  }
}

/// The moment [N·m·s] about `centre` that contacts and joints give a part in the step.
Vec3 Stepping::momentOn(const BendingPart& part, const Vec3& centre, bool& pushed) const {
  Vec3 moment = Vec3::Zero();
  if (!part.touched) return moment;
  const int number = memory_.bendings->partOf[part.bodies.front()];
  const auto isOf = [&](int i) {
    return i < static_cast<int>(state_.bodies.size()) && memory_.bendings->partOf[i] == number;
  };
  const auto add = [&](int i, const Vec3& p, const Vec3& impulse) {
    if (!isOf(i) || impulse.isZero(0.0)) return;
    moment += (p - centre).cross(impulse);
    pushed = true;
  };
  for (const PairMemory& pair : memory_.pairs)
    for (const Touch& touch : pair.touches) {
      add(touch.contact.a, touch.contact.point.p, touch.impulse);
      add(touch.contact.b, touch.contact.point.p, -touch.impulse);
    }
  const Bonds& bonds = work_.bonds;
  for (std::size_t k = 0; k < bonds.lambda.size(); ++k) {
    const Row& row = bonds.rows[k];
    if (isOf(row.a)) add(row.a, state_.bodies[row.a].x, bonds.lambda[k] * row.linear);
    if (isOf(row.b)) add(row.b, state_.bodies[row.b].x, -bonds.lambda[k] * row.linear);
  }
  return moment;
}

/// An implicit step takes spin from what turns, by (h ω)² of it, and turns it less far; linear
/// forces leave it a false one. What no body pushes goes as the implicit step shapes it, turned as
/// the rigid body that it was turns under its angular momentum, which only loads change:
///   r⁺ = S y,   u = S (y − R r)/h,   v⁺ = v̄ + ω × r⁺ + s u,   ω = I⁻¹ (L − s Σ M r⁺ × u),
/// with R the turn from its arms r before the step to y, and S what takes R to that of the body.
/// Neither changes the elastic energy, nor the momentum. 0 ≤ s ≤ 1 takes so much of the motions of
/// its shape that energy does not rise. What is pushed in flight, or several cloths, keeps its
/// places, and gets the least change of its velocities that has the right L:  ω × r.
void Stepping::turnWhole(BendingPart& part, double h) {
  const std::size_t number = &part - memory_.bendings->parts.data(), n = part.bodies.size();
  const auto body = [&](std::size_t p) -> const RigidBody& {
    return state_.bodies[part.bodies[p]];
  };
  const auto after = [&](std::size_t p) { return Vec3(work_.after[part.bodies[p]].head<3>()); };
  const Whole was = wholeOf(
      part, state_.bodies, [&](std::size_t p) { return body(p).x; },
      [&](std::size_t p) { return body(p).v; });
  const Whole is = wholeOf(
      part, state_.bodies, [&](std::size_t p) { return part.reachedAt[p]; }, after);
  bool pushed = part.joined || part.several;
  Vec3 gained = momentOn(part, was.x, pushed);
  memory_.chords[number] = pushed;
  Mat3 B = Mat3::Zero();
  for (std::size_t p = 0; p < n; ++p) {
    const Vec3 r = body(p).x - was.x, y = part.reachedAt[p] - is.x;
    gained += 0.5 * h * (r + y).cross(body(p).force);
    B += body(p).M * y * r.transpose();
  }
  const Vec3 L = was.L + gained;
  if (!was.spinsBy(was.L) && !is.spinsBy(is.L) && !is.spinsBy(L)) return;

  Quat R = Quat::Identity(), S = Quat::Identity();
  const auto shapes = [&](std::size_t p) -> Vec3 {
    const Vec3 r = body(p).x - was.x, y = part.reachedAt[p] - is.x;
    return pushed ? Vec3(after(p) - is.v) : Vec3(S * (y - R * r) / h);
  };
  if (!pushed) {
    const Mat3 I = inertiaOf(was.second, was.line);
    const Vec3 omega = I.inverse() * was.L;
    R = bestTurn(B, is.line, rotated(Quat::Identity(), h * omega));
    S = (Rotor(I, Quat::Identity(), was.L + 0.5 * gained).attitude(h) * R.conjugate()).normalized();
  }
  const Mat3 turn = S.toRotationMatrix(),
             I = inertiaOf(turn * is.second * turn.transpose(), turn * is.line), Iinv = I.inverse();
  Vec3 own = Vec3::Zero();
  double swings = 0.0;
  for (std::size_t p = 0; p < n; ++p) {
    const Vec3 u = shapes(p);
    own += body(p).M * (turn * (part.reachedAt[p] - is.x)).cross(u);
    swings += 0.5 * body(p).M * u.squaredNorm();
  }
  double share = 1.0;
  Vec3 omega = Iinv * (L - own);
  if (!pushed) {
    double given = 0.0;
    for (std::size_t p = 0; p < n; ++p) {
      const Vec3 v = omega.cross(turn * (part.reachedAt[p] - is.x)) + shapes(p);
      given += 0.5 * h * body(p).force.dot(v + body(p).v - was.v);
    }
    const double gain = 0.5 * omega.dot(I * omega) + omega.dot(own) + swings + part.reached -
                        was.turning - part.stored - given;
    if (gain > 0.0 && swings > 0.0) share = std::sqrt(std::max(0.0, 1.0 - gain / swings));
    omega = Iinv * (L - share * own);
  }
  const auto armOf = [&](std::size_t p) { return Vec3(turn * (part.reachedAt[p] - is.x)); };
  const auto rateOf = [&](std::size_t p) {
    return Vec3(is.v + omega.cross(armOf(p)) + share * shapes(p));
  };
  Vec3 rounding = Vec3::Zero();  // of the momentum
  for (std::size_t p = 0; p < n; ++p) rounding += body(p).M / is.mass * (rateOf(p) - after(p));
  double& turned = bentBooks_[number].turned;
  for (std::size_t p = 0; p < n; ++p) {
    const Vec3 arm = armOf(p), v = after(p), now = rateOf(p) - rounding;
    const Vec3 wind = body(p).force - body(p).M * model_.def.gravity;
    turned += 0.5 * body(p).M * (now.squaredNorm() - v.squaredNorm()) - 0.5 * h * wind.dot(now - v);
    work_.after[part.bodies[p]].head<3>() = now;
    part.reachedAt[p] = is.x + arm;
  }
  part.placed = true;
}

}  // namespace tumble
