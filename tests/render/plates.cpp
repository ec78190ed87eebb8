#include "tests/render/plates.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <numbers>

#include "render/camera.h"

namespace tumble::plates {
namespace {

using Eigen::AngleAxisd;
using Eigen::Quaterniond;
using Eigen::Vector3d;

/// Numbers in [0, 1) that are the same on every machine (splitmix64).
class Random {
 public:
  double next() {
    state_ += 0x9e3779b97f4a7c15u;
    std::uint64_t z = state_;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return static_cast<double>((z ^ (z >> 31)) >> 11) * 0x1p-53;
  }

 private:
  std::uint64_t state_ = 7;
};

Colour hex(unsigned value) {
  return {static_cast<float>(value >> 16 & 255) / 255.0f,
          static_cast<float>(value >> 8 & 255) / 255.0f, static_cast<float>(value & 255) / 255.0f};
}

Colour along(const std::vector<Colour>& stops, double u) {
  const double place = std::clamp(u, 0.0, 1.0) * static_cast<double>(stops.size() - 1);
  const std::size_t i = std::min(static_cast<std::size_t>(place), stops.size() - 2);
  const float t = static_cast<float>(place - static_cast<double>(i));
  Colour c;
  for (int k = 0; k < 3; ++k) c[k] = stops[i][k] + t * (stops[i + 1][k] - stops[i][k]);
  return c;
}

const std::vector<Colour> kTime = {hex(0x2E6299), hex(0x6A93BF), hex(0xC2BDC6), hex(0xDDB27A),
                                   hex(0xDB8A24)};
const std::vector<Colour> kOrder = {hex(0x00224E), hex(0x123570), hex(0x3B496C), hex(0x575D6D),
                                    hex(0x707173), hex(0x8A8678), hex(0xA59C74), hex(0xC3B369),
                                    hex(0xE1CC55), hex(0xFEE838)};

std::string format(const char* pattern, double value) {
  char text[64];
  std::snprintf(text, sizeof text, pattern, value);
  return text;
}

/// Corners of the box that holds the given points, grown by a margin.
std::vector<Vector3d> corners(const std::vector<Vector3d>& points, double grow) {
  Vector3d low = points.front(), high = low;
  for (const Vector3d& p : points) low = low.cwiseMin(p), high = high.cwiseMax(p);
  std::vector<Vector3d> result;
  for (int i = 0; i < 8; ++i) {
    const Vector3d pick(i & 1, i >> 1 & 1, i >> 2 & 1);
    result.push_back(low - Vector3d::Constant(grow) +
                     pick.cwiseProduct(high - low + Vector3d::Constant(2.0 * grow)));
  }
  return result;
}

/// Height of a point that falls from `height` onto `ground` and bounces with restitution e.
double bounce(double t, double height, double ground, double e) {
  const double g = 9.81;
  double speed = 0.0, from = height;
  while (true) {
    const double fall = (speed + std::sqrt(speed * speed + 2.0 * g * (from - ground))) / g;
    if (t < fall || fall < 1e-3) return fall < 1e-3 ? ground : from + speed * t - 0.5 * g * t * t;
    t -= fall;
    speed = e * (g * fall - speed);
    from = ground;
  }
}

}  // namespace

Picture strobe() {
  Picture picture;
  picture.title = "A brick thrown, bouncing with ε = 0.8";
  picture.subtitle =
      "Strobe every 0.1 s, colour by time.  Solid: path of the centre of mass.  Dots: closed-form "
      "arcs.";
  const double end = 3.3;
  const auto centre = [](double t) {
    return Vector3d(-2.6 + 1.3 * t, bounce(t, 2.3, 0.3, 0.8), 0.0);
  };
  std::vector<Vector3d> motion;
  for (int i = 0; i <= 33; ++i) {
    const double u = i / 33.0, t = end * u;
    Instance brick;
    brick.position = centre(t);
    brick.orientation = AngleAxisd(0.6 + 2.3 * t, Vector3d(0.25, 0.2, -1.0).normalized());
    brick.scale = {0.25, 0.16, 0.12};
    brick.colour = along(kTime, u);
    brick.alpha = static_cast<float>(0.55 + 0.35 * u);
    brick.finish = i < 33 ? Finish::Ghost : Finish::Solid;
    motion.push_back(brick.position);
    picture.instances.push_back(brick);
  }
  Polyline path, theory;
  for (int i = 0; i <= 660; ++i) path.points.push_back(centre(end * i / 660.0));
  for (int i = 0; i <= 720; ++i) theory.points.push_back(centre((end + 0.25) * i / 720.0));
  theory.stroke = Stroke::Dotted;
  theory.colour = hex(0xD5401A);
  picture.lines = {path, theory};
  const double hits[] = {0.6386, 1.6603, 2.4777, 3.1317};
  double impulse = 168.3;
  for (const double t : hits) {
    Vector3d p = centre(t);
    p.y() = 0.0;
    picture.marks.push_back(
        {p, {format("t = %.3f s", t), format("j = %.1f N·s", impulse)}, hex(0xD5401A)});
    impulse *= 0.8;
  }
  picture.bar = ColourBar{"time / s", kTime, 0.0, end, {0, 1, 2, 3}};
  picture.centre = {-0.4, 1.1, 0.0};
  picture.radius = 2.6;
  picture.floor.fineGrid = 0.2;
  motion.push_back({0.0, 0.0, 0.0});
  picture.camera =
      frame(corners(motion, 0.3), 14.0, 12.0, 24.0, 16.0 / 9.0, {0.08, 0.08, 0.17, 0.22});
  return picture;
}

Picture tower() {
  Picture picture;
  picture.title = "Contact forces in a tower of ten boxes";
  picture.subtitle = "1 kg each, edge 0.5 m.  Arrow length is proportional to force.";
  Random random;
  std::vector<Vector3d> motion;
  for (int level = 0; level < 10; ++level) {
    Instance box;
    const double x = 0.06 * (random.next() - 0.5);
    const double z = 0.06 * (random.next() - 0.5);
    box.position = {x, 0.25 + 0.5 * level, z};
    box.scale = Vector3d::Constant(0.25);
    box.finish = Finish::Glass;
    picture.instances.push_back(box);
    motion.push_back(box.position);
    const double weight = 9.81 * (10 - level);
    for (int corner = 0; corner < 4; ++corner) {
      Arrow arrow;
      arrow.base = {x + (corner & 1 ? 0.21 : -0.21), 0.5 * level, z + (corner & 2 ? 0.21 : -0.21)};
      arrow.tip = arrow.base + Vector3d(0.0, 0.44 * weight / 98.1, 0.0);
      arrow.radius = static_cast<float>(1.5 + 0.6 * weight / 98.1);
      picture.arrows.push_back(arrow);
    }
  }
  picture.centre = {0.0, 2.5, 0.0};
  picture.radius = 2.7;
  picture.floor.rule = false;
  picture.camera =
      frame(corners(motion, 0.25), 28.0, 13.0, 20.0, 16.0 / 9.0, {0.1, 0.1, 0.06, 0.12});
  const Projection page(picture.camera, 1280, 720);
  for (int level = 0; level < 10; ++level) {
    const Vector3d foot =
        picture.instances[level].position - Vector3d(0.0, 0.25, 0.0) + 0.3 * page.right();
    const double weight = 9.81 * (10 - level);
    picture.pageBars.push_back({foot,
                                {762.0, (*page.project(foot)).y()},
                                220.0 * weight / 98.1,
                                format("%.1f N", weight),
                                hex(0xD5401A)});
  }
  Label note;
  note.offset = {762.0, 68.0};
  note.text = "sum over four corners = weight above";
  note.size = 13.0f;
  note.italic = true;
  note.colour = hex(0x5C636E);
  picture.labels.push_back(note);
  return picture;
}

Picture fan() {
  Picture picture;
  picture.title = "Eleven balls dropped from 2 m, restitution 0 to 1";
  picture.subtitle = "Strobe every 0.1 s over 3.2 s, drifting to the right.  n-th apex: ε²ⁿ · 2 m.";
  const double r = 0.1, end = 3.2;
  std::vector<Vector3d> motion;
  for (int k = 0; k <= 10; ++k) {
    const double e = k / 10.0, z = 1.5 - 0.3 * k;
    const Colour colour = along(kOrder, 0.04 + 0.86 * e);
    const auto centre = [&](double t) {
      return Vector3d(-2.0 + 1.25 * t, bounce(t, 2.0 + r, r, e), z);
    };
    for (int i = 0; i <= 32; ++i) {
      const double u = i / 32.0;
      Instance ball;
      ball.form = Form::Sphere;
      ball.position = centre(end * u);
      ball.scale = Vector3d::Constant(r);
      ball.colour = colour;
      ball.alpha = static_cast<float>(0.22 + 0.48 * u);
      ball.finish = i < 32 ? Finish::Ghost : Finish::Solid;
      picture.instances.push_back(ball);
      motion.push_back(ball.position);
    }
    Polyline path;
    for (int i = 0; i <= 640; ++i) path.points.push_back(centre(end * i / 640.0));
    path.colour = {0.8f * colour[0], 0.8f * colour[1], 0.8f * colour[2]};
    picture.lines.push_back(path);
    Label label;
    label.anchor = centre(end);
    label.offset = {18.0, -10.0};
    label.text = k == 0 ? "ε = 0.0" : format("%.1f", e);
    picture.labels.push_back(label);
  }
  picture.centre = {0.0, 0.9, 0.0};
  picture.radius = 2.7;
  picture.camera =
      frame(corners(motion, 0.1), 24.0, 22.0, 24.0, 16.0 / 9.0, {0.1, 0.14, 0.16, 0.12});
  return picture;
}

Picture pile(int boxes) {
  Picture picture;
  picture.title = std::to_string(boxes) + " bodies in a heap";
  picture.subtitle = "Boxes, balls and cylinders.  Grid 1 m, fine lines 0.2 m.";
  const unsigned palette[] = {0x3A6FA8, 0xE8BE57, 0xB5485D, 0xB4BBC4, 0x3F9C8C, 0x4B3F78};
  Random random;
  std::vector<Vector3d> motion;
  for (int i = 0; i < boxes; ++i) {
    const double u = std::sqrt(random.next()), phi = 2.0 * std::numbers::pi * random.next();
    Instance body;
    body.form = i % 10 == 3 ? Form::Sphere : i % 10 == 7 ? Form::Cylinder : Form::Box;
    body.position = {1.9 * u * std::cos(phi), 0.17 + 1.5 * (1.0 - u) * random.next(),
                     1.9 * u * std::sin(phi)};
    const double a = random.next(), b = random.next(), c = random.next();
    body.orientation = Quaterniond(a - 0.5, b - 0.5, c - 0.5, 0.3).normalized();
    body.scale = body.form == Form::Sphere ? Vector3d(0.13, 0.13, 0.13)
                 : body.form == Form::Box  ? Vector3d(0.18, 0.10, 0.13)
                                           : Vector3d(0.1, 0.16, 0.1);
    body.position.y() = std::max(body.position.y(), 0.0);
    body.colour = hex(palette[i % 6]);
    motion.push_back(body.position);
    picture.instances.push_back(body);
  }
  picture.centre = {0.0, 0.7, 0.0};
  picture.radius = 2.4;
  picture.camera =
      frame(corners(motion, 0.15), -20.0, 17.0, 24.0, 16.0 / 9.0, {0.06, 0.06, 0.13, 0.08});
  return picture;
}

Picture sunk() {
  Picture picture;
  picture.title = "Three bodies that sank";
  const Form forms[] = {Form::Sphere, Form::Box, Form::Cylinder};
  const unsigned palette[] = {0xB5485D, 0x3A6FA8, 0xE8BE57};
  for (int i = 0; i < 3; ++i) {
    Instance body;
    body.form = forms[i];
    body.position = {-1.2 + 1.2 * i, 0.22, 0.0};
    body.scale = {0.3, 0.3, 0.3};
    body.orientation = AngleAxisd(0.3 * i, Vector3d(1.0, 0.5, 0.3).normalized());
    body.colour = hex(palette[i]);
    picture.instances.push_back(body);
    Arrow speed;
    speed.base = body.position + Vector3d(0.5, 0.4, 0.0);
    speed.tip = speed.base - Vector3d(0.0, 0.4, 0.0);
    speed.colour = hex(0x0A63B0);
    picture.arrows.push_back(speed);
  }
  picture.centre = {0.0, 0.3, 0.0};
  picture.radius = 2.0;
  picture.camera = {{0.8, 1.2, 5.5}, {0.0, 0.3, 0.0}, 24.0};
  return picture;
}

}  // namespace tumble::plates
