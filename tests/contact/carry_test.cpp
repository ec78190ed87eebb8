// Whether the contacts of one pair can share a load in another way than they do.
#include "sim/contact/carry.h"

#include <array>

#include "sim/body/mass_properties.h"
#include "tests/catch.h"

using namespace tumble;

namespace {

constexpr double kOff = 1e-9;

/// A cube of 1 kg on a floor, whose corners carry these forces [N]: −x −z, −x +z, +x −z, +x +z.
bool carries(const std::array<Vec3, 4>& forces, double mu, bool slides = false) {
  const RigidBody floor = makeFixedBody(Pose{});
  RigidBody cube = makeBody(solidMass(Box{{0.5, 0.5, 0.5}}, 1.0));
  cube.x = {0.0, 0.5, 0.0};
  updateDerived(cube);
  std::array<Contact, 4> contacts;
  for (std::size_t k = 0; k < 4; ++k) {
    Contact& c = contacts[k];
    c.a = 1;
    c.point.n = Vec3::UnitY();
    c.point.p = {k < 2 ? -0.5 : 0.5, 0.0, k % 2 == 0 ? -0.5 : 0.5};
    c.friction = mu;
    c.sliding = slides;
    c.slipDirection = Vec3::UnitX();
    c.force = forces[k];
  }
  return canCarry(cube, floor, contacts, kOff);
}

}  // namespace

// Oracle: closed form. A load passes through the floor within the square of the four corners, or
// through none of their shares. One corner pulls in all of them.
TEST_CASE("corners that pull stand for others while the load is within their square") {
  const auto at = [](double x) {  // 1 N at that x, with a pull of 0.1 N at one corner
    const double right = 0.5 + x;
    return std::array<Vec3, 4>{Vec3(0, -0.1, 0), Vec3(0, 1.1 - right, 0), Vec3(0, right - 0.5, 0),
                               Vec3(0, 0.5, 0)};
  };
  for (const double mu : {0.0, 0.3}) {
    CHECK(carries(at(0.2), mu));
    CHECK_FALSE(carries(at(0.6), mu));
    CHECK_FALSE(carries(at(-0.6), mu));
  }
}

// Oracle: Coulomb's law for the sum: four corners of friction mu hold mu times their load.
TEST_CASE("corners share a pull along the floor up to mu times their load, and not above") {
  const auto pulled = [](double side) {  // at two corners, without a moment about the vertical
    return std::array<Vec3, 4>{Vec3(side, 0.25, 0), Vec3(0, 0.25, side), Vec3(0, 0.25, 0),
                               Vec3(0, 0.25, 0)};
  };
  // 1 N on the floor, √2 side along it.
  CHECK(carries(pulled(0.2), 0.3));
  CHECK_FALSE(carries(pulled(0.22), 0.3));
  // What slides along x rubs against it, and not aside.
  CHECK_FALSE(carries(pulled(0.2), 0.3, true));
}
