// A body that spins about its middle axis turns over again and again: when, by elliptic functions.
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <limits>

#include "app/claim/free_rotor.h"
#include "app/claim/rows.h"
#include "app/claim/spinner.h"
#include "sim/math/elliptic.h"
#include "sim/math/root.h"

namespace tumble {

namespace {

// Spins nearer to the middle axis than this cosine are told to flip.
constexpr double kNearAxis = 0.7;
// Allowed of a half period, to a method that takes steps and to one that does not.
constexpr double kStepped = 1e-3, kExact = 1e-9;
// What the quintic bridges between samples, and how far small steps go where it does not [rad].
constexpr double kApart = 0.2, kFarthest = 20'000.0;

// Motion of the unit vector l along L in the principal axes 1, 2, 3 with moments I₁ < I₂ < I₃:
//   l₂ = a sn(u | m),  u = u₀ + rate t,  which is 0 at each u = 2 n K.
// Landau and Lifshitz, Mechanics, §37, with sums of squares in place of differences of energies.
struct Middle {
  Mat3 axes_B;                     // columns; right-handed
  Vec3 inertia;                    // [kg m²]
  double L = 0.0;                  // [kg m²/s]
  double first = 0.0, half = 0.0;  // [s] of the first flip; from one to the next

  Middle(const Spinner& spinner, const Quat& q);
  // l₂ and its first two derivatives for a sample.
  Vec3 heightOf(const Spinner& spinner, const BodySample& seen) const;
};

Middle::Middle(const Spinner& spinner, const Quat& q) {
  const Eigen::SelfAdjointEigenSolver<Mat3> principal(spinner.inertia);
  axes_B = principal.eigenvectors();
  if (axes_B.determinant() < 0.0) axes_B.col(0) *= -1.0;
  inertia = principal.eigenvalues();
  L = spinner.L.norm();
  const Vec3 l = axes_B.transpose() * (q.conjugate() * (spinner.L / L));

  // Of the outer axes, c is the one that l goes round.
  const Vec3 w = inertia.cwiseInverse();
  int b = 0, c = 2;
  if (std::abs(w[1] - w[0]) * l[0] * l[0] > std::abs(w[2] - w[1]) * l[2] * l[2]) std::swap(b, c);
  const double db = std::abs(w[1] - w[b]), dc = std::abs(w[c] - w[1]), d = db + dc;
  const double sc2 = dc * (d * l[c] * l[c] + db * l[1] * l[1]);
  const double complement = std::sqrt(d * (dc * l[c] * l[c] - db * l[b] * l[b]) / sc2);  // k′
  const double rate = L * std::sqrt(sc2);
  if (!(sc2 > 0.0 && complement > 0.0)) {  // exactly on the axis, or two moments are one
    half = std::numeric_limits<double>::infinity();
    return;
  }
  half = 3.14159265358979323846 / agm(1.0, complement) / rate;  // 2K/rate

  // u₀ = F(φ|m) with sn = l₂/a, cn² = l_b²/…, dn² = l_c²/…; l̇₂ = L l₁ l₃ (1/I₁ − 1/I₃).
  const double a2 = l[1] * l[1] + l[b] * l[b] * d / dc;
  const double cn2 = l[b] * l[b] * (d / dc) / a2,
               dn2 = l[c] * l[c] / (l[c] * l[c] + l[1] * l[1] * db / d);
  const double rising = l[0] * l[2] >= 0.0 ? 1.0 : -1.0;
  const double u0 = rising * l[1] / std::sqrt(a2) * carlsonRF(cn2, dn2, 1.0);
  first = u0 < 0.0 ? -u0 / rate : half - u0 / rate;
}

Vec3 Middle::heightOf(const Spinner& spinner, const BodySample& seen) const {
  const Vec3 now = axes_B.transpose() * (seen.q.conjugate() * spinner.momentum(seen));
  const Vec3 omega = now.cwiseQuotient(inertia);
  const Vec3 rate = now.cross(omega);
  const Vec3 bend = rate.cross(omega) + now.cross(rate.cwiseQuotient(inertia));
  return Vec3(now[1], rate[1], bend[1]) / L;
}

// The value at s in [0, 1] of the polynomial of degree five that meets value, slope and bend at
// both ends of a step of h.
double quintic(const Vec3& p, const Vec3& q, double h, double s) {
  const double a = p[0], b = h * p[1], c = 0.5 * h * h * p[2];
  const double e = q[0] - a - b - c, f = h * q[1] - b - 2.0 * c, g = h * h * q[2] - 2.0 * c;
  const double d3 = 10.0 * e - 4.0 * f + 0.5 * g, d4 = -15.0 * e + 7.0 * f - g,
               d5 = 6.0 * e - 3.0 * f + 0.5 * g;
  return a + s * (b + s * (c + s * (d3 + s * (d4 + s * d5))));
}

/// Samples as they come, and between those that stand far apart more, by small steps of the free
/// rotor from the one before.
struct Close {
  double t;     ///< [s]
  Vec3 height;  ///< l₂ and its first two derivatives
};

std::vector<Close> closeSamples(const Recording& recording, const Spinner& spinner,
                                const Middle& middle) {
  const Mat3 inverse = spinner.inertia.inverse();
  const double most = spinner.fastest();
  std::vector<Close> close;
  for (std::size_t k = 0; k < recording.samples.size(); ++k) {
    const Sample& now = recording.samples[k];
    if (now.t > spinner.end) break;
    BodySample seen = now.bodies[spinner.body];
    close.push_back({now.t, middle.heightOf(spinner, seen)});
    if (k + 1 == recording.samples.size()) break;
    const double h = recording.samples[k + 1].t - now.t;
    const int parts = static_cast<int>(std::ceil(most * h / kApart));
    FreeRotor rotor{inverse, spinner.momentum(seen), seen.q};
    for (int part = 1; part < parts; ++part) {
      rotor.advance(h / parts, most);
      seen.q = rotor.q.normalized();
      seen.omega = rotor.omega(seen.q);
      close.push_back({now.t + h * part / parts, middle.heightOf(spinner, seen)});
    }
  }
  return close;
}

std::vector<double> flipsOf(const std::vector<Close>& samples) {
  std::vector<double> flips;
  for (std::size_t k = 0; k + 1 < samples.size(); ++k) {
    const Vec3 &p = samples[k].height, &q = samples[k + 1].height;
    if ((p[0] > 0.0) == (q[0] > 0.0)) continue;
    const double h = samples[k + 1].t - samples[k].t;
    const auto height = [&](double s) { return quintic(p, q, h, s); };
    flips.push_back(samples[k].t + h * findRoot(height, 0.0, 1.0, p[0], q[0], 1e-13).lo);
  }
  return flips;
}

// The instant of the last sample that the recording should have.
double endOf(const Scene& scene, const Recording& recording) {
  if (recording.samples.empty()) return 0.0;
  if (recording.report.stopped) return recording.samples.back().t;
  return std::floor(scene.world.duration * recording.rate + 1e-9) / recording.rate;
}

}  // namespace

std::vector<ClaimRow> flipRows(const Scene& scene, const Recording& recording) {
  const double allowed = scene.world.method == "exact" ? kExact : kStepped;
  std::vector<ClaimRow> rows;
  for (const Spinner& spinner : spinnersOf(scene, recording)) {
    const BodyDef& def = scene.world.bodies[spinner.body];
    const Middle middle(spinner, def.orientation);
    const Vec3 l = middle.axes_B.transpose() * (def.orientation.conjugate() * spinner.L);
    if (std::abs(l[1]) < kNearAxis * middle.L || !std::isfinite(middle.half)) continue;

    const bool apart = spinner.fastest() > kApart * recording.rate;
    if (apart && spinner.fastest() * recording.samples.back().t > kFarthest) {
      rows.push_back(spinner.lost(def.name));
      continue;
    }
    const std::vector<double> flips = flipsOf(closeSamples(recording, spinner, middle));
    const double last = std::min(spinner.end, endOf(scene, recording));
    // A flip that falls on the end itself may be seen or not.
    const auto told = [&](double slack) {
      return std::max(0.0, std::floor((last + slack - middle.first) / middle.half + 1.0));
    };
    const double count = static_cast<double>(flips.size()), slack = allowed * middle.half;
    const bool right = count >= told(-slack) && count <= told(slack);
    rows.push_back(
        {def.name + ": flips", count, told(0.0), right ? 0.0 : std::abs(count - told(0.0)), 0.0});
    if (flips.empty()) continue;
    WorstRow time(def.name + ": time of a flip / s, error in half periods", allowed);
    for (std::size_t n = 0; n < flips.size(); ++n) {
      const double exact = middle.first + static_cast<double>(n) * middle.half;
      time.see(flips[n], exact, std::abs(flips[n] - exact) / middle.half);
    }
    rows.push_back(time.row());
  }
  if (rows.empty()) rows.push_back(emptyClaim("no body spins freely about its middle axis"));
  return rows;
}

}  // namespace tumble
