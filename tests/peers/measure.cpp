#include "tests/peers/measure.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "tests/peers/overlap.h"

namespace tumble::peers {

namespace {

constexpr double kLost = std::numeric_limits<double>::infinity();

const BodyDef& lastBody(const Scene& scene) {
  return scene.world.bodies.back();
}

// Way of the last body from its start at the end [m].
Vec3 wayOf(const Scene& scene, const Motion& motion) {
  return motion.looks.back().back().x - lastBody(scene).position;
}

// x = x₀ + v₀ t + ½ g t²
double parabola(const Scene& scene, const Motion& motion) {
  const double t = scene.world.duration;
  return (wayOf(scene, motion) - lastBody(scene).velocity * t - 0.5 * t * t * scene.world.gravity)
      .norm();
}

// A block on the ground y = 0, with gravity that leans: from rest it stays or slides down, thrown
// on level ground it stops after v²/(2 μ g).
Vec3 slidingWay(const Scene& scene) {
  const BodyDef& block = lastBody(scene);
  const double t = scene.world.duration, normal = -scene.world.gravity.y();
  const Vec3 along(scene.world.gravity.x(), 0.0, scene.world.gravity.z());
  const double speed = block.velocity.norm(), brake = block.friction * normal;
  if (speed > 0.0) return block.velocity * speed / (2.0 * brake);
  const double pull = along.norm();
  return pull <= brake ? Vec3(Vec3::Zero()) : Vec3(along * (0.5 * t * t * (1.0 - brake / pull)));
}
double sliding(const Scene& scene, const Motion& motion) {
  return (wayOf(scene, motion) - slidingWay(scene)).norm();
}

// 5/7 of gravity's part along the ground.
double rolling(const Scene& scene, const Motion& motion) {
  const double t = scene.world.duration;
  const Vec3 along(scene.world.gravity.x(), 0.0, scene.world.gravity.z());
  return (wayOf(scene, motion) - 5.0 / 14.0 * t * t * along).norm();
}

// Heights of the lowest point at each apex: the vertex of the parabola through a look that is
// highest and its two neighbours, which is exact for looks at free flight. The start is none.
std::vector<double> apexes(const Motion& motion, double radius, double least) {
  std::vector<double> heights;
  for (std::size_t k = 1; k + 1 < motion.looks.size(); ++k) {
    const double a = motion.looks[k - 1].back().x.y(), b = motion.looks[k].back().x.y(),
                 c = motion.looks[k + 1].back().x.y();
    if (b < a || b <= c || b - radius < least) continue;
    const double bend = a - 2.0 * b + c;
    heights.push_back(b - (c - a) * (c - a) / (8.0 * bend) - radius);
  }
  return heights;
}

// Each apex is e² of the one before; a missing one counts with its whole height.
double bouncing(const Scene& scene, const Motion& motion) {
  constexpr double kLeast = 0.01;  // [m] lower apexes are not asked for
  const BodyDef& ball = lastBody(scene);
  const double g = scene.world.gravity.norm(), e2 = ball.restitution * ball.restitution;
  const double radius = std::get<Sphere>(ball.shape).r, drop = ball.position.y() - radius;
  const std::vector<double> seen = apexes(motion, radius, kLeast / 2.0);
  double error = 0.0, t = std::sqrt(2.0 * drop / g), height = drop;
  for (std::size_t k = 0;; ++k) {
    height *= e2;
    t += std::sqrt(2.0 * height / g);  // of this apex
    if (t > scene.world.duration - 0.05 || height < kLeast) return error;
    error = std::max(error, k < seen.size() ? std::abs(seen[k] - height) : height);
    t += std::sqrt(2.0 * height / g);  // of the next hit
  }
}

// How far any body ever was from where it stands [m]; lost once a cube is no longer on its own.
double standing(const Scene& scene, const Motion& motion) {
  constexpr double kCollapsed = 0.3;  // m
  double most = 0.0;
  for (const auto& look : motion.looks)
    for (std::size_t i = 1; i < look.size(); ++i)
      most = std::max(most, (look[i].x - scene.world.bodies[i].position).norm());
  return most > kCollapsed ? kLost : most;
}

// Whether a body is where nothing that only falls and rolls a little can come to: what has flown
// apart does not overlap either.
bool flownApart(const Scene& scene, const std::vector<BodySample>& look) {
  constexpr double kSlack = 1.0;  // m
  Aabb start{Vec3::Constant(kLost), Vec3::Constant(-kLost)};
  for (const BodyDef& body : scene.world.bodies) {
    if (std::holds_alternative<HalfSpace>(body.shape)) continue;
    start.lo = start.lo.cwiseMin(body.position);
    start.hi = start.hi.cwiseMax(body.position);
  }
  const Vec3 wide(start.hi.y(), kSlack, start.hi.y());  // a heap may spread by its height
  return std::any_of(look.begin() + 1, look.end(), [&](const BodySample& body) {
    return body.x.y() < -kSlack || ((body.x - start.hi - wide).array() > 0.0).any() ||
           body.x.x() < start.lo.x() - wide.x() || body.x.z() < start.lo.z() - wide.z();
  });
}

double overlapLeft(const Scene& scene, const Motion& motion) {
  const auto& end = motion.looks.back();
  return flownApart(scene, end) ? kLost : deepestOverlap(scene.world, end);
}

double overlapEver(const Scene& scene, const Motion& motion) {
  double most = 0.0;
  for (const auto& look : motion.looks)
    most = std::max(most, flownApart(scene, look) ? kLost : deepestOverlap(scene.world, look));
  return most;
}

// A free body by Runge and Kutta in long double: q̇ = ½ q ω, I ω̇ = (I ω) × ω in body axes.
struct Rotor {
  long double y[7];  // q (w, x, y, z), ω_B
};
Rotor rateOf(const Rotor& r, const long double I[3]) {
  const auto [w, x, y, z, p, q, s] = r.y;
  return {{(-x * p - y * q - z * s) / 2, (w * p + y * s - z * q) / 2, (w * q + z * p - x * s) / 2,
           (w * s + x * q - y * p) / 2, (I[1] - I[2]) * q * s / I[0], (I[2] - I[0]) * s * p / I[1],
           (I[0] - I[1]) * p * q / I[2]}};
}
Rotor sum(const Rotor& a, long double f, const Rotor& b) {
  Rotor r = a;
  for (int i = 0; i < 7; ++i) r.y[i] += f * b.y[i];
  return r;
}
Quat spunReference(const Scene& scene) {
  constexpr long double h = 1e-5L;  // [s] halved, the end moves by 3e-11 rad
  const BodyDef& body = lastBody(scene);
  const Vec3 diagonal = massOf(body).inertia.diagonal();
  const Vec3 w = body.orientation.conjugate() * body.angularVelocity;
  const Quat& q = body.orientation;
  const long double I[3] = {diagonal.x(), diagonal.y(), diagonal.z()};
  Rotor r{{q.w(), q.x(), q.y(), q.z(), w.x(), w.y(), w.z()}};
  const long steps = std::lround(scene.world.duration / 1e-5);
  for (long k = 0; k < steps; ++k) {
    const Rotor a = rateOf(r, I), b = rateOf(sum(r, h / 2, a), I), c = rateOf(sum(r, h / 2, b), I),
                d = rateOf(sum(r, h, c), I);
    for (int i = 0; i < 7; ++i) r.y[i] += h / 6 * (a.y[i] + 2 * b.y[i] + 2 * c.y[i] + d.y[i]);
  }
  return Quat(double(r.y[0]), double(r.y[1]), double(r.y[2]), double(r.y[3])).normalized();
}

const Quat& spun(const Scene& scene) {
  static const Quat reference = spunReference(scene);
  return reference;
}

// Angle to the reference at the end [rad]; lost, if the brick did not turn over twice: then an
// angle says nothing.
double spinning(const Scene& scene, const Motion& motion) {
  const auto side = [](const BodySample& body) { return (body.q * Vec3::UnitY()).y(); };
  int flips = 0;
  bool up = true;
  for (const auto& look : motion.looks)
    if (const double y = side(look.back()); up ? y < -0.5 : y > 0.5) {
      up = !up;
      ++flips;
    }
  if (flips != 2) return kLost;
  return spun(scene).angularDistance(motion.looks.back().back().q.normalized());
}

std::vector<Trial> makeTrials() {
  const std::vector<double> fine = {60, 120, 240, 480, 960, 2400, 10000};
  const std::vector<double> stacks = {60, 120, 240, 480, 960}, crowds = {15, 30, 60, 120, 240, 480};
  std::vector<Trial> all = {{"projectile",
                             "projectile",
                             {},
                             "A thrown brick, 2 s",
                             "place at the end, m",
                             parabola,
                             fine},
                            {"free-spin",
                             "free_spin",
                             {},
                             "A brick about its middle axis, 10 s",
                             "angle at the end, rad; lost if it does not turn over twice",
                             spinning,
                             fine,
                             [](const Scene& scene) { spun(scene); }}};
  for (const char* e : {"0.2", "0.4", "0.6", "0.8", "1.0"})
    all.push_back({"bounce-" + std::string(e),
                   "bounce",
                   {"materials.rubber.restitution=" + std::string(e)},
                   "A ball bounces, e = " + std::string(e),
                   "largest of all apexes, m",
                   bouncing,
                   fine});
  const std::vector<Trial> more = {
      {"slide", "slide", {}, "A brick slides to a stop", "place at the end, m", sliding, fine},
      {"slide45",
       "slide45",
       {},
       "A brick slides askew to a stop",
       "place at the end, m",
       sliding,
       fine},
      {"slope",
       "slope",
       {},
       "A brick slides down 20°, μ = 0.2",
       "place after 2 s, m",
       sliding,
       fine},
      {"hold", "hold", {}, "A brick stays on 20°, μ = 0.38", "creep in 5 s, m", sliding, fine},
      {"roll", "roll", {}, "A ball rolls down 30°", "place after 2 s, m", rolling, fine},
      {"tower",
       "tower",
       {},
       "Ten cubes",
       "way of any from its place, m; lost beyond 0.3 m",
       standing,
       stacks},
      {"tower-heavy",
       "tower_heavy",
       {},
       "A tonne on a kilogramme",
       "way of any from its place, m; lost beyond 0.3 m",
       standing,
       stacks},
      {"tower-powers",
       "tower_powers",
       {},
       "Ten cubes, each twice as heavy as the one below",
       "way of any from its place, m; lost beyond 0.3 m",
       standing,
       stacks},
      {"pile",
       "pile",
       {},
       "216 cubes fall on each other",
       "overlap left after 6 s, m",
       overlapLeft,
       crowds},
      {"tray-boxes",
       "tray_boxes",
       {},
       "200 boxes fall into a tray",
       "deepest overlap ever, m",
       overlapEver,
       crowds},
      {"tray-balls",
       "tray_balls",
       {},
       "200 balls fall into a tray",
       "deepest overlap ever, m",
       overlapEver,
       crowds}};
  all.insert(all.end(), more.begin(), more.end());
  return all;
}

}  // namespace

const std::vector<Trial>& trials() {
  static const std::vector<Trial> all = makeTrials();
  return all;
}

}  // namespace tumble::peers
