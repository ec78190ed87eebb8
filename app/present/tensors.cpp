// The inertia tensor of a body in its own frame and in the world's, as numbers on the page.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "app/present/inertia.h"
#include "app/present/sketch.h"
#include "app/record/bodies.h"
#include "render/axis.h"
#include "sim/math/rotation.h"

namespace tumble {

namespace {

using Eigen::Vector2d;

constexpr double kCell = 54.0, kHeight = 34.0;  // [px]

/// The power of ten [1] that numbers up to so much are told in, to fill their cells and no more.
int powerFor(double largest) {
  constexpr double kLeast = 0.01, kMost = 99.9995;
  if (largest >= kLeast && largest < kMost) return 0;
  return largest > 0.0 ? static_cast<int>(std::floor(std::log10(largest))) : 0;
}

/// @param power  of ten that its numbers are told in
void addMatrix(const Mat3& I, int power, const Vector2d& corner, const std::string& name,
               Picture& picture) {
  const Colour stops[] = {hex(0x2E6299), hex(0xF1F0EE), hex(0xC4622D)};
  const double largest = I.cwiseAbs().maxCoeff();
  const double unit = std::pow(10.0, power);
  Sketch sketch(picture);
  sketch.text(corner - Vector2d(0.0, 10.0), name, {15.0, Align::Left, colour::kInk, false, true});
  for (int i = 0; i < 3; ++i)
    for (int k = 0; k < 3; ++k) {
      const Vector2d at = corner + Vector2d(kCell * k, kHeight * i);
      const double value = I(i, k), share = value / largest;
      const double tidy = std::abs(share) < 5e-4 ? 0.0 : value;
      sketch.fill(at, at + Vector2d(kCell - 1.0, kHeight - 1.0), ramp(stops, 0.5 + 0.35 * share));
      sketch.text(at + Vector2d(0.5 * kCell, 0.5 * kHeight + 5.0),
                  fmt::format("{}{:.3f}", tidy < 0.0 ? "−" : "", std::abs(tidy / unit)), {13.0});
    }
}

}  // namespace

void addTensors(const Scene& scene, const Sample& sample, const Vector2d& page, Picture& picture) {
  const std::vector<BodyDef>& bodies = scene.world.bodies;
  const auto turning = [](const BodyDef& body) {
    return moves(body) && !std::holds_alternative<Particle>(body.shape);
  };
  const auto body = std::find_if(bodies.begin(), bodies.end(), turning);
  if (body == bodies.end()) return;
  const Mat3 Ibody = massOf(*body).inertia;
  const Mat3 R = rotationMatrix(sample.bodies[static_cast<std::size_t>(body - bodies.begin())].q);
  const Vector2d corner(page.x() - 3.0 * kCell - 40.0, 0.5 * page.y() - 3.0 * kHeight - 30.0);
  const int power = powerFor(Ibody.cwiseAbs().maxCoeff());
  const std::string unit = (power == 0 ? "" : "10" + raised(power) + " ") + "kg m²";
  addMatrix(Ibody, power, corner, "Ibody / (" + unit + "): stays", picture);
  addMatrix(R * Ibody * R.transpose(), power, corner + Vector2d(0.0, 3.0 * kHeight + 60.0),
            "I = R Ibody Rᵀ: turns", picture);
}

}  // namespace tumble
