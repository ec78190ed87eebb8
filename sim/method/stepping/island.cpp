// The contact problem, island by island. Forces are a function of the configuration: an island
// whose contacts, loads and velocities are those it was solved with keeps its answer, one that goes
// on as it did keeps its forces, any other one is solved from λ = 0.
#include <algorithm>

#include "sim/contact/rows.h"
#include "sim/method/stepping/stepping.h"

namespace tumble {

std::pair<int, int> Stepping::ends(Link link) const {
  if (isPair(link)) return state_.near[link];
  const Row& row = work_.bonds.rows[link - state_.near.size()];
  return {row.b, row.a};
}

bool Stepping::isBonded(const Island& island) const {
  return std::any_of(island.links.begin(), island.links.end(),
                     [&](Link link) { return !isPair(link); });
}

bool Stepping::anyYields(const Island& island) const {
  return std::any_of(island.links.begin(), island.links.end(),
                     [&](Link link) { return !isPair(link) && springOf(link); });
}

void Stepping::solveSteadily(double h) {
  allKept_ = true;
  ++step_;
  if (!bends() || bend(h)) solveInTurns(h);
  if (bends() && !misses_) misses_ = isToHalve(h);
  misses_ = misses_ || swingsIntoBlow(h);
  if (work_.crushed.empty() && !misses_) bookIslands(h);
}

void Stepping::solveInTurns(double h) {
  constexpr int kRounds = 10, kAgain = 12, kNewton = 40, kPresses = 6;
  const int rounds = isDrafted() ? 1 : kRounds;
  if (tiesRun()) freeChains(h);
  const auto solve = [&] {
    again_ = false;
    solveIslands(h);
    again_ = true;
    for (int round = 0; round < rounds && work_.crushed.empty() && !misses_ && seeFurther(h);
         ++round)
      solveIslands(h);
  };
  guesses_ = bends() && mayGuess();
  solve();
  const int most = model_.def.stepping.linearisations;
  int looks = 0, presses = 0;
  for (int k = 1; bends() && work_.crushed.empty() && !misses_; ++k) {
    const bool flipped = presses < kPresses && flips(h);
    if (flipped || endGuess()) {
      presses += flipped, --k;
      solve();
      continue;
    }
    const bool again = gains(h) && k < kAgain, all = k < most,
               newton = anyByNewton() && k < kNewton;
    if (presses < kPresses && pressesFurther(h, again, looks)) {
      ++presses, --k;
      solve();
      continue;
    }
    if (!(again || all || newton) || !bendFurther(h, all)) break;
    solve();
  }
}

void Stepping::solveIslands(double h) {
  const std::size_t n = state_.bodies.size();
  bindGroups(h);
  foreseeTwists(h);
  if (bends()) foreseeBent();
  work_.bonds.clear();
  work_.crushed.clear();
  if (!joints().empty())
    stepBonds(state_.bodies, joints(), work_.star, h, tolerance_.touch, work_.bonds);
  addSprings(h);
  work_.touched.resize(n);
  work_.later.resize(n);
  work_.falls.resize(n, Vec3::Zero());
  work_.smooth.resize(n);
  for (const int i : work_.active) {
    work_.after[i] = work_.star[i];
    work_.touched[i] = isHalved(i);
    work_.later[i] = 0.0;
    work_.falls[i].setZero();
    work_.smooth[i] = 0;
    memory_.left[i] = 0.0;
  }
  if (bends()) markBent();
  groupLinks(h);
  solveEach(h);
  if (bends()) moveAlone(h);
}

/// Whichever worker solves an island finds the same; what they tell is taken in their order.
void Stepping::solveEach(double h) {
  const StageScope stage(state_.times, StepStage::Forces);
  constexpr std::size_t kWorthwhile = 32;  // links: fewer are solved before a thread wakes up
  const int count = static_cast<int>(work_.begin.size()) - 1;
  const int workers = count < 2 || work_.order.size() < kWorthwhile ? 1 : model_.workers.count;
  work_.answers.assign(count, {});
  work_.islands.resize(std::max<std::size_t>(work_.islands.size(), workers));
  const auto solve = [&](int i, int worker) {
    Island& island = work_.islands[worker];
    startIsland(island, linksOf(i));
    solveIsland(island, h);
    work_.answers[i] = std::move(island.answer);
  };
  if (workers > 1)
    model_.workers.forEach(count, solve);
  else
    for (int i = 0; i < count; ++i) solve(i, 0);
  leftOpen_ = 0.0;
  rough_ = false;
  for (const IslandAnswer& answer : work_.answers) {
    if (answer.head < 0) continue;
    allKept_ = allKept_ && answer.kept;
    rough_ = rough_ || answer.rough;
    leftOpen_ = std::max(leftOpen_, answer.leftOpen);
    misses_ = misses_ || answer.misses;
    memory_.missed = std::max(memory_.missed, answer.parts);
    if (work_.crushed.empty()) work_.crushed = answer.crushed;
  }
}

void Stepping::bookIslands(double h) {
  Certificate& certificate = report_.certificate;
  // By their heads: near pairs, and with them the numbers of links, may be others by now.
  for (const IslandAnswer& answer : work_.answers) {
    if (answer.head < 0) continue;
    const IslandMemory& memory = memory_.islands[answer.head];
    ++(memory.kept    ? certificate.islands_kept
       : memory.rough ? certificate.islands_rough
                      : certificate.islands_solved);
    certificate.max_complementarity = std::max(certificate.max_complementarity, memory.residual);
    certificate.energy_lost_impact += memory.books.lostImpact;
    certificate.energy_lost_friction += memory.books.lostFriction;
    certificate.work_of_forces += memory.books.work;
    state_.externalImpulse += memory.books.external;
    if (memory.above)
      report_.note("some steps were left above the tolerance; max_complementarity has the worst");
  }
  if (!work_.bonds.empty() || !joints().empty()) bookJoints(h);
}

[[gnu::flatten]] void Stepping::foreseeTwists(double h) {
  for (const int i : work_.active) {
    const RigidBody& body = state_.bodies[i];
    Vec6& star = work_.star[i];
    star = work_.before[i];
    if (body.fixed()) continue;
    if (const int drag = memory_.drives->dragOf[i]; drag >= 0 && !isHalved(i)) {
      const DragStep& step = work_.drags[drag];
      const Vec3 force = body.force + memory_.drives->drags[drag].linear * body.v;
      const Vec3 torque = body.torque + memory_.drives->drags[drag].angular * body.omega;
      star.head<3>() = step.way.left * body.v + h * step.way.mean * body.invM * force;
      star.tail<3>() = step.left * body.omega + h * step.Iinv * torque;
      continue;
    }
    const double part = isHalved(i) ? 0.5 * h : h;
    star.head<3>() = body.v + part * body.invM * body.force;
    star.tail<3>() = body.Iinv * (body.L + part * body.torque);
  }
}

void Stepping::startIsland(Island& island, std::span<const Link> links) {
  for (const int i : island.bodies) island.local[i] = -1;
  island.local.resize(state_.bodies.size() + 1, -1);
  island.bodies.clear();
  island.movers.clear();
  island.links = links;
  island.smooth = false;
  island.answer = {};
}

/// The bodies of an island that move, in the order of its links.
void Stepping::collectBodies(Island& island) {
  const int world = static_cast<int>(state_.bodies.size());
  for (const Link link : island.links) {
    const auto [b, a] = ends(link);
    for (const int i : {a, b}) {
      if (i == world || model_.fixed(i) || island.local[i] >= 0) continue;
      island.local[i] = 0;
      island.movers.push_back(i);
    }
  }
  if (bends()) collectBent(island);
  for (const int i : island.movers) island.local[i] = -1;
}

/// Bodies that joints alone hold take half of what forces give before they move, half after: their
/// error is of second order. Springs must not be met later.
void Stepping::swing(Island& island, double h) {
  for (const Link link : island.links)
    if (isPair(link) || work_.bonds.kinds[link - state_.near.size()] != ConeKind::Equality) return;
  for (const int i : island.movers) {
    const RigidBody& body = state_.bodies[i];
    if (isDriven(i)) continue;
    work_.later[i] = 0.5 * h;
    work_.star[i] << body.v + work_.later[i] * body.invM * body.force,
        body.Iinv * (body.L + work_.later[i] * body.torque);
  }
}

/// Bodies that touch each other alone, under gravity alone, fall on the parabola of what is free:
/// it changes no velocity of one against another.
void Stepping::fallAsOne(Island& island, double h) {
  const auto stands = [&](int i) {
    return i == static_cast<int>(state_.bodies.size()) || model_.fixed(i);
  };
  for (const Link link : island.links) {
    const auto [b, a] = ends(link);
    if (stands(a) || stands(b)) return;
  }
  for (const int i : island.movers) {
    const RigidBody& body = state_.bodies[i];
    if (isDriven(i) || !body.torque.isZero(0.0) || body.force != body.M * model_.def.gravity)
      return;
  }
  for (const int i : island.movers) work_.later[i] = 0.5 * h;
}

[[gnu::flatten]] void Stepping::solveIsland(Island& island, double h) {
  collectBodies(island);
  if (island.movers.empty()) return;
  IslandAnswer& answer = island.answer;
  answer.head = island.movers.front();
  const bool bent = anyBends(island), bonded = !bent && isBonded(island), pushed = !bent && !bonded;
  if (bonded) swing(island, h);
  if (pushed) fallAsOne(island, h);
  IslandMemory& memory = memory_.islands[answer.head];
  island.memory = &memory;
  if (!bent && isAnswered(island, h)) return answerAgain(island, h);
  const bool sprung = bonded && isSprung(island),
             notSmooth = again_ && memory.step == step_ && !memory.smooth;
  island.smooth = (pushed || sprung) && !notSmooth && foreseesSmooth(island, h);
  if (island.smooth) gripAnew(island, h);
  const bool stretches = !bent && rests(island, h);
  memory.kept = stretches || (!bent && (keeps(island, h) || pushesAlike(island, h)));
  if (stretches) stretch(island, h);
  const bool solves = !memory.kept && !(bent && keepsBent(island, h));
  if (solves) {
    answer.kept = false;
    memory.above = false;
    const bool sweeps = bent && canSweep(island), crowd = crowd_ && isCrowd(island);
    if (bent && !sweeps) factorSwept(island);
    if (sweeps) memory.rough = false;
    build(island, h);
    if (bent) coupleBent(island);
    SolveReport solved = sweeps ? sweepBent(island, h) : solveAsPlanned(island, bent, crowd, h);
    if (sweeps && solved.status != SolveStatus::Solved) {
      leaveSweeps(island);
      if (answer.crushed.empty()) solved = solveAsPlanned(island, bent, crowd, h);
    }
    if (!answer.crushed.empty()) return;
    if (bonded && !closeGaps(island, crowd, h, solved)) return;
    share(island, h);
    if (island.smooth && !isSmooth(island, h)) {
      island.smooth = false;
      gripAnew(island, h);
      build(island, h);
      solved = solveAsPlanned(island, bent, crowd, h);
      share(island, h);
    }
    memory.residual = solved.residual;
    memory.scale = solved.scale > 0.0 ? solved.scale : velocityScale(island.problem);
    tellRough(island, h);
    if (bent) forBent(island, [](BendingPart& part) { part.fresh = true; });
    if (pushed) stand(island, crowd, h);
  }
  if (bent) forBent(island, [](BendingPart& part) { part.touched = true; });
  giveMotion(island);
  if (bent) flyBent(island, h);
  if (bent && solves) bookWays(island, h);  // of the solids in it
  if (bonded && !island.smooth && flyAsOne(island, h)) keepSpin(island, h);
  memory.smooth = (pushed || island.smooth) && isSmooth(island, h);
  if (memory.smooth)
    for (const int i : island.movers) work_.smooth[i] = 1;
  else if (pushed || island.smooth)
    bookLanding(island, h);
}

/// Its answer becomes the motion of the bodies of an island.
void Stepping::giveMotion(const Island& island) {
  constexpr double kNothing = 1e-15;  // of a velocity: forces that change it by less are rounding
  const IslandMemory& memory = *island.memory;
  for (std::size_t i = 0; i < island.movers.size(); ++i) {
    memory_.left[island.movers[i]] = memory.residual * memory.scale;
    const Vec6 &v = memory.movers[i].v, &star = memory.movers[i].vStar;
    const bool touched =
        (v - star).lpNorm<Eigen::Infinity>() > kNothing * star.lpNorm<Eigen::Infinity>();
    work_.after[island.movers[i]] = touched ? v : star;
    work_.touched[island.movers[i]] =
        touched || model_.bends(island.movers[i]) || isHalved(island.movers[i]);
  }
}

void Stepping::tellRough(Island& island, double h) const {
  island.answer.rough = island.memory->rough;
  if (island.memory->rough) island.answer.leftOpen = mayLeave(island.memory->scale, h);
}

}  // namespace tumble
