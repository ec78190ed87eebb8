#include "app/present/diagram.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "app/claim/free_body.h"
#include "app/present/sketch.h"

namespace tumble {

namespace {

using Eigen::Vector2d;

constexpr Colour kPaper = hex(0xFBFAF7), kLit = hex(0xF6D9C8), kUnknown = hex(0xE6E8EC);
constexpr double kEdge = 20.0;        // [px] below a diagram
constexpr double kLeastPage = 800.0;  // [px] across that a diagram is laid out on

// Pixels of a page to a unit of what a diagram is laid out in.
double unitOf(const Vector2d& page) {
  return std::min(1.0, page.x() / kLeastPage);
}

/// A part of the state, what becomes of it in time, and the numbers of both.
struct Slot {
  std::string name, numbers, rate, rateNumbers;
};

// "0.50  −1.20  0.00"
std::string numbersOf(std::span<const double> values) {
  std::string text;
  for (const double value : values) {
    const double tidy = std::abs(value) < 0.005 ? 0.0 : value;
    text +=
        fmt::format("{}{}{:.2f}", text.empty() ? "" : "  ", tidy < 0.0 ? "−" : "", std::abs(tidy));
  }
  return text;
}

std::string numbersOf(const Vec3& v) {
  return numbersOf(std::span<const double>(v.data(), 3));
}

std::string numbersOf(const Quat& q) {
  const std::array<double, 4> values = {q.w(), q.x(), q.y(), q.z()};
  return numbersOf(values);
}

Slot slotOf(const std::string& name, const BodyDef& def, const BodySample& sample,
            const RigidBody& body) {
  if (name == "x") return {"x", numbersOf(sample.x) + " m", "v", numbersOf(sample.v) + " m/s"};
  if (name == "v")
    return {"v", numbersOf(sample.v) + " m/s", "F/m",
            numbersOf(Vec3(body.force / bodyMass(def))) + " m/s²"};
  if (name == "R") {
    const Quat rate = Quat(0.0, sample.omega.x(), sample.omega.y(), sample.omega.z()) * sample.q;
    return {
        "R", "q = " + numbersOf(sample.q), "ω* R",
        "q̇ = " + numbersOf(Quat(0.5 * rate.w(), 0.5 * rate.x(), 0.5 * rate.y(), 0.5 * rate.z()))};
  }
  if (name == "P")
    return {"P", numbersOf(Vec3(bodyMass(def) * sample.v)) + " N s", "F",
            numbersOf(body.force) + " N"};
  if (name == "L") {
    const Vec3 L = angularMomentum(massOf(def).inertia, sample.q, sample.omega);
    return {"L", numbersOf(L) + " N m s", "τ", numbersOf(body.torque) + " N m"};
  }
  return {"?", "", "?", ""};
}

void drawCell(const Vector2d& corner, const Vector2d& size, const std::string& name,
              const std::string& numbers, const Colour& colour, Sketch& sketch) {
  const bool known = name != "?";
  sketch.box(corner, size, known ? kPaper : kUnknown, colour::kQuiet);
  const double middle = corner.x() + 0.5 * size.x();
  if (known) {
    sketch.text({middle, corner.y() + 22.0}, name, {18.0, Align::Centre, colour, true});
    sketch.text({middle, corner.y() + 40.0}, numbers, {12.0, Align::Centre, colour::kQuiet});
  } else {
    sketch.text({middle, corner.y() + 33.0}, name, {26.0, Align::Centre, colour::kForce, true});
  }
}

constexpr double kCellHeight = 48.0, kRowGap = 14.0, kFlowHeight = 118.0;

}  // namespace

double diagramShare(const Scene& scene, const Vector2d& page) {
  if (scene.show.diagram.empty()) return 0.0;
  const double height = scene.show.diagram == "state" ? 2.0 * kCellHeight + kRowGap : kFlowHeight;
  return (height + kEdge + 24.0) / page.y();
}

void addStateDiagram(const Scene& scene, const Sample& sample, const Vector2d& whole,
                     Picture& picture) {
  const Vector2d page = whole / unitOf(whole);
  const std::vector<BodyDef>& bodies = scene.world.bodies;
  const auto first = std::find_if(bodies.begin(), bodies.end(), moves);
  if (first == bodies.end() || scene.show.slots.empty()) return;
  const std::size_t i = static_cast<std::size_t>(first - bodies.begin());
  const std::vector<RigidBody> loaded = loadedBodiesAt(scene.world, sample);
  const double count = static_cast<double>(scene.show.slots.size());
  const double width = std::min(220.0, (page.x() - 110.0) / count);
  const double left = 0.5 * (page.x() - count * width) + 28.0;
  const double upper = page.y() - kEdge - 2.0 * kCellHeight - kRowGap;
  const double lower = upper + kCellHeight + kRowGap;
  Sketch sketch(picture, unitOf(whole));
  sketch.text({left - 14.0, upper + 30.0}, "Y =", {18.0, Align::Right, colour::kInk, true});
  sketch.text({left - 14.0, lower + 30.0}, "Ẏ =", {18.0, Align::Right, colour::kInk, true});
  for (std::size_t k = 0; k < scene.show.slots.size(); ++k) {
    const Slot slot = slotOf(scene.show.slots[k], bodies[i], sample.bodies[i], loaded[i]);
    const double x = left + width * static_cast<double>(k);
    drawCell({x, upper}, {width + 1.5, kCellHeight}, slot.name, slot.numbers, colour::kInk, sketch);
    drawCell({x, lower}, {width + 1.5, kCellHeight}, slot.rate, slot.rateNumbers, colour::kVelocity,
             sketch);
  }
}

void addSolverDiagram(const Scene& scene, const Vector2d& whole, Picture& picture) {
  const Vector2d page = whole / unitOf(whole);
  const Vector2d size(190.0, 64.0);
  const Vector2d corner(0.5 * (page.x() - size.x()), page.y() - kEdge - 92.0);
  const double middle = corner.y() + 0.5 * size.y(), right = corner.x() + size.x();
  Sketch sketch(picture, unitOf(whole));
  sketch.box(corner, size, kUnknown, colour::kInk);
  sketch.text({0.5 * page.x(), middle - 3.0}, "ode", {22.0, Align::Centre, colour::kInk, true});
  sketch.text({0.5 * page.x(), middle + 18.0},
              fmt::format("{}, h = {:g} s", scene.world.course.integrator, scene.world.course.step),
              {12.5, Align::Centre, colour::kQuiet});
  for (const auto& [name, y] : {std::pair("Y(t₀)", -18.0), std::pair("t₀, t₁", 18.0)}) {
    sketch.arrow({corner.x() - 60.0, middle + y}, {corner.x() - 3.0, middle + y}, colour::kInk);
    sketch.text({corner.x() - 68.0, middle + y + 5.0}, name, {16.0, Align::Right});
  }
  sketch.arrow({right + 3.0, middle}, {right + 60.0, middle}, colour::kInk);
  sketch.text({right + 68.0, middle + 5.0}, "Y(t₁)", {16.0, Align::Left});
  const double foot = corner.y() + size.y();
  sketch.arrow({0.5 * page.x() - 26.0, foot + 22.0}, {0.5 * page.x() - 26.0, foot + 3.0},
               colour::kVelocity);
  sketch.arrow({0.5 * page.x() + 26.0, foot + 3.0}, {0.5 * page.x() + 26.0, foot + 22.0},
               colour::kVelocity);
  sketch.text({0.5 * page.x(), foot + 38.0}, "Ẏ = dydt(t, Y), as often as the method asks",
              {14.0, Align::Centre, colour::kVelocity});
}

namespace {

struct Stage {
  const char *upper, *lower;  // its words, in two lines
};
constexpr std::array kStages = {Stage{"update", "the state"}, Stage{"detect", "collisions"},
                                Stage{"find contact", "points"}, Stage{"respond:", "impulses"},
                                Stage{"forces", "at rest"}};

// Which stage the instant is about: that of an impact since the sample before, of contacts that
// rest, or of free flight.
std::size_t stageAt(const Recording& recording, const Sample& sample) {
  for (const Event& event : recording.report.events)
    if (event.kind == EventKind::Impact && event.t <= sample.t &&
        event.t > sample.t - 1.0 / recording.rate)
      return 3;
  return sample.contacts.empty() ? 0 : 4;
}

void drawEvents(const Recording& recording, const Sample& sample, double left, double right,
                double y, Sketch& sketch) {
  const double end = std::max(recording.samples.back().t, 1e-9);
  const auto at = [&](double t) { return left + t / end * (right - left); };
  sketch.line({left, y}, {right, y}, 1.6, colour::kQuiet);
  double last = -1e9;
  for (const Event& event : recording.report.events) {
    const bool impact = event.kind == EventKind::Impact;
    const double x = at(event.t);
    if (x < last + 1.0) continue;
    last = x;
    sketch.line({x, y - (impact ? 12.0 : 7.0)}, {x, y}, 1.6,
                impact ? colour::kForce : colour::kVelocity);
  }
  sketch.disc({at(sample.t), y}, 11.0, colour::kInk);
  sketch.text({left - 8.0, y + 4.0}, "0", {16.0, Align::Right, colour::kQuiet});
  sketch.text({right + 8.0, y + 4.0}, fmt::format("{:g} s", end),
              {16.0, Align::Left, colour::kQuiet});
}

}  // namespace

void addFlowDiagram(const Recording& recording, const Sample& sample, const Vector2d& whole,
                    Picture& picture) {
  const Vector2d page = whole / unitOf(whole);
  constexpr double kGap = 22.0, kHeight = 54.0;
  const double width = std::min(190.0, (page.x() - 60.0 - 4.0 * kGap) / 5.0);
  const double left = 0.5 * (page.x() - 5.0 * width - 4.0 * kGap);
  const double top = page.y() - kEdge - kFlowHeight;
  const std::size_t lit = stageAt(recording, sample);
  Sketch sketch(picture, unitOf(whole));
  for (std::size_t k = 0; k < kStages.size(); ++k) {
    const double x = left + static_cast<double>(k) * (width + kGap);
    const bool now = k == lit;
    sketch.box({x, top}, {width, kHeight}, now ? kLit : kPaper,
               now ? colour::kForce : colour::kQuiet);
    const Sketch::Style words{std::min(19.0, 0.145 * width), Align::Centre, colour::kInk, now};
    sketch.text({x + 0.5 * width, top + 23.0}, kStages[k].upper, words);
    sketch.text({x + 0.5 * width, top + 44.0}, kStages[k].lower, words);
    if (k > 0)
      sketch.arrow({x - kGap + 2.0, top + 0.5 * kHeight}, {x - 2.0, top + 0.5 * kHeight},
                   colour::kQuiet);
  }
  const double back = top + kHeight + 16.0, second = left + 1.5 * width + kGap;
  sketch.line({second, top + kHeight}, {second, back}, 1.6, colour::kQuiet);
  sketch.line({second, back}, {left + 0.5 * width, back}, 1.6, colour::kQuiet);
  sketch.arrow({left + 0.5 * width, back}, {left + 0.5 * width, top + kHeight + 2.0},
               colour::kQuiet);
  sketch.text({second + 8.0, back + 4.0}, "too deep: back to the instant of touch",
              {16.0, Align::Left, colour::kQuiet});
  // The colour bar of a strobe stands in the corner.
  const double right =
      std::min(left + 5.0 * width + 4.0 * kGap - 40.0, page.x() - (picture.bar ? 400.0 : 0.0));
  drawEvents(recording, sample, left + 20.0, right, page.y() - kEdge - 8.0, sketch);
}

}  // namespace tumble
