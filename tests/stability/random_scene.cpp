#include "tests/stability/random_scene.h"

#include <fmt/format.h>

#include <cmath>
#include <vector>

#include "sim/math/vec.h"
#include "tests/problem/problems.h"

namespace tumble::test {
namespace {

/// Radius [m] of a ball that holds any of the bodies.
constexpr double kHold = 0.26;

std::string listed(const Vec3& v) {
  return fmt::format("[{:.6g}, {:.6g}, {:.6g}]", v.x(), v.y(), v.z());
}

Vec3 inCube(Draw& draw, double half) {
  const double x = draw(-half, half), y = draw(-half, half), z = draw(-half, half);
  return {x, y, z};
}

std::string boxOf(Draw& draw, double most) {
  const double x = draw(0.3, 1.0), y = draw(0.3, 1.0), z = draw(0.3, 1.0);
  return "box = " + listed(most * Vec3(x, y, z));
}

std::string round(Draw& draw, const char* kind) {
  const double r = draw(0.05, 0.12), h = draw(0.06, 0.24);
  return fmt::format("{} = [{:.6g}, {:.6g}]", kind, r, h);
}

std::string hull(Draw& draw) {
  std::string points;
  const int corners = 6 + draw.below(6);
  for (int k = 0; k < corners; ++k) {
    const Vec3 u = inCube(draw, 1.0);
    const Vec3 p = 0.18 / (u.norm() + 1e-3) * u;
    points += (k ? ", " : "") + listed(p);
  }
  return "hull = [" + points + "]";
}

/// Two boxes that share a face, as an L or a T.
std::string compound(Draw& draw) {
  // Whole millimetres, so that the parts touch.
  const double w = 0.001 * std::floor(draw(60.0, 90.0)), l = 0.001 * std::floor(draw(150.0, 220.0));
  const double side = draw(-0.5, 0.5);
  return fmt::format(
      "compound = [{{ box = [{0:.6g}, {1:.6g}, {0:.6g}] }}, {{ box = [{1:.6g}, {0:.6g}, {0:.6g}], "
      "position = [{2:.6g}, {3:.17g}, 0] }}]",
      w, l, side * l * 0.5, 0.5 * l + 0.5 * w);
}

std::string shapeOf(Draw& draw) {
  switch (draw.below(8)) {
    case 0:
    case 1:
      return fmt::format("sphere = {:.6g}", draw(0.05, 0.2));
    case 2:
      return round(draw, "cylinder");
    case 3:
      return round(draw, "capsule");
    case 4:
      return hull(draw);
    case 5:
      return compound(draw);
    default:
      return boxOf(draw, 0.28);
  }
}

void addMaterial(Draw& draw, const char* name, std::string& text) {
  const bool dead = draw.below(3) == 0, smooth = draw.below(4) == 0;
  const double e = draw(0.0, 1.0), mu = draw(0.0, 2.0), density = draw(300.0, 3000.0);
  text += fmt::format("[materials.{}]\ndensity = {:.6g}\nrestitution = {:.6g}\nfriction = {:.6g}\n",
                      name, density, dead ? 0.0 : e, smooth ? 0.0 : mu);
}

void addGround(Draw& draw, std::string& text) {
  const int kind = draw.below(10);
  if (kind == 0) return;  // nothing to fall on
  text += "[[body]]\nname = \"ground\"\nmaterial = \"a\"\nfixed = true\n";
  if (kind == 1)
    text +=
        "shape = { cylinder = [1.5, 0.2] }\nposition = [0, -0.1, 0]\n"
        "angular_velocity = [0, 2, 0]\n";
  else if (kind == 2)
    text += "shape = { box = [1.2, 0.2, 1.2] }\nposition = [0, -0.1, 0]\n";
  else if (kind == 3)
    text += "shape = { plane = [0.3, 1, 0.1, 0] }\n";
  else
    text += "shape = { plane = [0, 1, 0, 0] }\n";
}

/// Places at least two radii apart, above the ground.
std::vector<Vec3> places(Draw& draw, int count) {
  std::vector<Vec3> found;
  while (static_cast<int>(found.size()) < count) {
    const double x = draw(-0.6, 0.6), y = draw(0.45, 1.2), z = draw(-0.6, 0.6);
    const Vec3 place(x, y, z);
    bool free = true;
    for (const Vec3& other : found) free = free && (other - place).norm() > 2.0 * kHold;
    if (free) found.push_back(place);
  }
  return found;
}

void addJoint(Draw& draw, const std::vector<Vec3>& at, std::string& text) {
  const char* kinds[] = {"ball", "hinge", "slider", "distance", "fixed"};
  const int kind = draw.below(5), a = draw.below(static_cast<int>(at.size()));
  const int b = a > 0 ? a - 1 : -1;
  const Vec3 anchor = b >= 0 ? Vec3(0.5 * (at[a] + at[b])) : Vec3(at[a] + Vec3(0, 0.3, 0));
  text += fmt::format("[[joint]]\nkind = \"{}\"\na = \"b{}\"\nanchor = {}\n", kinds[kind], a,
                      listed(anchor));
  if (b >= 0) text += fmt::format("b = \"b{}\"\n", b);
  if (kind == 1 || kind == 2) text += "axis = " + listed(inCube(draw, 1.0)) + "\n";
  if (kind == 3) text += "anchor_b = " + listed(b >= 0 ? at[b] : Vec3(anchor.array() + 0.2)) + "\n";
}

void addForce(Draw& draw, int count, std::string& text) {
  const int body = draw.below(count);
  switch (draw.below(4)) {
    case 0: {
      const double k = draw(20.0, 500.0), c = draw.below(2) * draw(0.0, 5.0);
      text += fmt::format(
          "[[force]]\nkind = \"spring\"\na = \"b{}\"\nanchor_a = {}\nanchor_b = {}\n"
          "stiffness = {:.6g}\ndamping = {:.6g}\nrest = {:.6g}\n",
          body, listed(inCube(draw, 0.1)), listed(inCube(draw, 1.0)), k, c, draw(0.0, 1.0));
      break;
    }
    case 1:
      text += fmt::format(
          "[[force]]\nkind = \"drag\"\nbody = \"b{}\"\nlinear = {:.6g}\nangular = {:.6g}\n", body,
          draw(0.0, 3.0), draw(0.0, 0.02));
      break;
    case 2:
      text += fmt::format("[[force]]\nkind = \"point\"\nbody = \"b{}\"\npoint = {}\nforce = {}\n",
                          body, listed(inCube(draw, 0.1)), listed(inCube(draw, 20.0)));
      break;
    default:
      text += fmt::format("[[force]]\nkind = \"wind\"\nbody = \"b{}\"\nforce = {}\n", body,
                          listed(inCube(draw, 20.0)));
  }
}

}  // namespace

std::string randomScene(std::uint64_t seed, int most) {
  Draw draw(seed);
  std::string text = fmt::format("title = \"seed {}\"\n[world]\nduration = 1.0\n", seed);
  const int count = 1 + draw.below(most);
  addMaterial(draw, "a", text);
  addMaterial(draw, "b", text);
  addGround(draw, text);
  const std::vector<Vec3> at = places(draw, count);
  const bool joined = draw.below(6) == 0, forced = draw.below(4) == 0;
  for (int i = 0; i < count; ++i) {
    text +=
        fmt::format("[[body]]\nname = \"b{}\"\nmaterial = \"{}\"\n", i, draw.below(2) ? "a" : "b");
    text += "shape = { " + shapeOf(draw) + " }\nposition = " + listed(at[i]) + "\n";
    if (draw.below(3)) {
      const Vec3 axis = inCube(draw, 1.0);
      text += fmt::format("orientation = {{ axis = {}, degrees = {:.6g} }}\n", listed(axis),
                          draw(0.0, 180.0));
    }
    if (joined) continue;  // velocities would have to agree
    text += "velocity = " + listed(inCube(draw, 2.0)) + "\n";
    if (draw.below(3)) text += "angular_velocity = " + listed(inCube(draw, 6.0)) + "\n";
  }
  if (joined) addJoint(draw, at, text);
  if (forced) addForce(draw, count, text);
  return text;
}

}  // namespace tumble::test
