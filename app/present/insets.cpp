#include "app/present/insets.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

#include "app/present/digits.h"
#include "app/present/palette.h"
#include "app/record/bodies.h"
#include "sim/contact/rows.h"
#include "sim/problem/delassus.h"

namespace tumble {

namespace {

using Eigen::Vector2d;

constexpr Colour kBelow = hex(0x2E6299), kZero = hex(0xF1F0EE), kAbove = hex(0xC4622D);

void addShape(Flat form, const Vector2d& from, const Vector2d& to, double width,
              const Colour& colour, Picture& picture) {
  picture.pageShapes.push_back({form, from, to, width, colour});
}

void addText(const Vector2d& pen, const std::string& text, float size, Align align,
             const Colour& colour, Picture& picture) {
  Label label;
  label.offset = pen;
  label.text = text;
  label.size = size;
  label.align = align;
  label.colour = colour;
  picture.labels.push_back(label);
}

// "−2", with a minus as printers have it.
std::string number(double value) {
  const double tidy = std::round(value * 1e9) / 1e9;
  return fmt::format("{}{:.3g}", tidy < 0.0 ? "−" : "", std::abs(tidy));
}

// Whether every number of a matrix is short enough for a small cell.
bool allShort(const MatX& A) {
  for (const double value : A.reshaped())
    if (number(std::abs(value)).size() > 2) return false;
  return true;
}

void addCells(const MatX& A, const Vector2d& corner, double cell, Picture& picture) {
  const Colour stops[] = {kBelow, kZero, kAbove};
  const double largest = A.cwiseAbs().maxCoeff();
  const bool printed = cell >= 15.0 && allShort(A);
  for (Eigen::Index i = 0; i < A.rows(); ++i)
    for (Eigen::Index k = 0; k < A.cols(); ++k) {
      const Vector2d at = corner + cell * Vector2d(k, i);
      const Colour colour = ramp(stops, 0.5 + 0.5 * A(i, k) / largest);
      addShape(Flat::Rectangle, at, at + Vector2d::Constant(cell), 0.0, colour, picture);
      if (printed)
        addText(at + cell * Vector2d(0.5, 0.72), number(A(i, k)), static_cast<float>(0.62 * cell),
                Align::Centre, colour::kInk, picture);
    }
}

// Lines between the contacts of different pairs.
void addPairLines(const Sample& sample, const Vector2d& corner, double cell, Picture& picture) {
  const double side = cell * static_cast<double>(sample.contacts.size());
  for (std::size_t i = 1; i < sample.contacts.size(); ++i) {
    const ContactSample &before = sample.contacts[i - 1], &now = sample.contacts[i];
    if (before.a == now.a && before.b == now.b) continue;
    const double at = cell * static_cast<double>(i);
    addShape(Flat::Line, corner + Vector2d(0.0, at), corner + Vector2d(side, at), 1.0,
             colour::kQuiet, picture);
    addShape(Flat::Line, corner + Vector2d(at, 0.0), corner + Vector2d(at, side), 1.0,
             colour::kQuiet, picture);
  }
}

/// A pair that touches: the sum of its normal forces, the least of its accelerations.
struct PairState {
  double force = 0.0;                                             ///< [N]
  double acceleration = std::numeric_limits<double>::infinity();  ///< [m/s²]
};

using Pair = std::pair<int, int>;

std::map<Pair, PairState> pairsOf(const Sample& sample) {
  std::map<Pair, PairState> pairs;
  for (const ContactSample& contact : sample.contacts)
    pairs[{contact.a, contact.b}].force += contact.force.dot(contact.n);
  return pairs;
}

// The next of 1, 2, 3, 5, 10, … that is no less.
double roundedUp(double value) {
  const double unit = std::pow(10.0, std::floor(std::log10(value)));
  for (const double times : {1.0, 2.0, 3.0, 5.0})
    if (value <= times * unit * (1.0 + 1e-9)) return times * unit;
  return 10.0 * unit;
}

// Of the run, and no less than the weight of a body.
double largestPairForce(const Scene& scene, const Recording& recording) {
  double largest = 0.0;
  for (const BodyDef& body : scene.world.bodies)
    if (moves(body)) largest = std::max(largest, bodyMass(body) * scene.world.gravity.norm());
  for (const Sample& sample : recording.samples)
    for (const auto& [pair, state] : pairsOf(sample)) largest = std::max(largest, state.force);
  return largest > 0.0 ? roundedUp(largest) : 1.0;
}

/// The two half-lines on the page.
struct Axes {
  Vector2d origin;      ///< [px]
  double side;          ///< [px]
  double force;         ///< [N] at the end of the upper one
  double acceleration;  ///< [m/s²] at the end of the other

  Vector2d place(const PairState& state) const {
    const double up = std::clamp(state.force / force, 0.0, 1.0);
    const double right = std::clamp(state.acceleration / acceleration, 0.0, 1.0);
    return origin + side * Vector2d(right, -up);
  }
};

void addAxes(const Axes& axes, Picture& picture) {
  const Vector2d top = axes.origin - Vector2d(0.0, axes.side),
                 end = axes.origin + Vector2d(axes.side, 0.0);
  addShape(Flat::Rectangle, top, end, 0.0, kZero, picture);
  addShape(Flat::Line, axes.origin, top, 3.0, colour::kInk, picture);
  addShape(Flat::Line, axes.origin, end, 3.0, colour::kInk, picture);
  addText(top + Vector2d(0.0, -10.0), fmt::format("f, to {:.4g} N", axes.force), 13.0f, Align::Left,
          colour::kInk, picture);
  addText(end + Vector2d(0.0, 19.0), fmt::format("a, to {:.3g} m/s²", axes.acceleration), 13.0f,
          Align::Right, colour::kInk, picture);
  addText(axes.origin + axes.side * Vector2d(0.56, -0.52), "f ≥ 0, a ≥ 0, f a = 0", 13.0f,
          Align::Centre, colour::kQuiet, picture);
}

// What is not 0, beside the dot.
void addDot(const Axes& axes, const PairState& state, Picture& picture) {
  const Vector2d at = axes.place(state);
  addShape(Flat::Disc, at, at, 17.0, hex(0xFBFAF7), picture);
  addShape(Flat::Disc, at, at, 12.0, colour::kForce, picture);
  const bool pushes = state.force > 1e-6 * axes.force;
  const bool parts = state.acceleration > 1e-6 * axes.acceleration;
  if (pushes)
    addText({at.x() + 14.0, std::min(at.y() + 5.0, axes.origin.y() - 7.0)},
            fourDigits(state.force) + " N", 14.0f, Align::Left, colour::kForce, picture);
  else  // clear of the upper half-line
    addText(
        Vector2d(parts ? std::max(at.x(), axes.origin.x() + 44.0) : at.x() + 14.0, at.y() - 14.0),
        parts ? fourDigits(state.acceleration) + " m/s²" : "neither", 14.0f,
        parts ? Align::Centre : Align::Left, colour::kForce, picture);
}

}  // namespace

MatX contactMatrix(const Scene& scene, const Sample& sample) {
  const std::vector<RigidBody> bodies = bodiesAt(scene.world, sample);
  Problem problem;
  beginAccelerationProblem(bodies, problem);
  for (const ContactSample& c : sample.contacts) {
    problem.cones.push_back({ConeKind::Push, static_cast<int>(problem.rows.size()), 0.0});
    problem.rows.push_back(pointRow(bodies, c.a, c.b, c.p, c.n, 0.0));
  }
  return delassus(problem).A;
}

std::vector<double> contactAccelerations(const Scene& scene, const Sample& sample) {
  const std::vector<RigidBody> bodies = loadedBodiesAt(scene.world, sample);
  std::vector<double> found;
  for (const ContactSample& c : sample.contacts)
    found.push_back(
        c.n.dot(pointAcceleration(bodies[c.a], c.p) - pointAcceleration(bodies[c.b], c.p)));
  return found;
}

double matrixSide(const Vector2d& page) {
  return std::min(0.56 * page.y(), 0.4 * page.x());
}

void addContactMatrix(const Scene& scene, const Sample& sample, const Vector2d& page,
                      Picture& picture) {
  const MatX A = contactMatrix(scene, sample);
  if (A.size() == 0) return;
  const double side = matrixSide(page);
  const double cell = side / static_cast<double>(A.rows());
  const Vector2d corner(page.x() - 40.0 - side, 0.42 * page.y() - 0.5 * side);
  addCells(A, corner, cell, picture);
  addPairLines(sample, corner, cell, picture);
  addText(corner - Vector2d(0.0, 12.0), fmt::format("A of {} contacts", A.rows()), 14.0f,
          Align::Left, colour::kInk, picture);
  const double largest = A.cwiseAbs().maxCoeff();
  // Three digits of it.
  const double unit = std::pow(10.0, std::floor(std::log10(largest)) - 2.0);
  const double told = unit * std::floor(largest / unit);
  picture.bar =
      ColourBar{"a_ij / (1/kg)", {kBelow, kZero, kAbove}, -largest, largest, {-told, 0.0, told}};
}

void addEitherOr(const Scene& scene, const Recording& recording, const Sample& sample,
                 const Vector2d& page, Picture& picture) {
  const double side = 0.34 * page.y(), g = scene.world.gravity.norm();
  const Axes axes{{page.x() - 40.0 - side, 0.13 * page.y() + side},
                  side,
                  largestPairForce(scene, recording),
                  g > 0.0 ? g : 1.0};
  addAxes(axes, picture);
  std::map<Pair, PairState> pairs = pairsOf(sample);
  const std::vector<double> accelerations = contactAccelerations(scene, sample);
  for (std::size_t i = 0; i < sample.contacts.size(); ++i) {
    PairState& state = pairs[{sample.contacts[i].a, sample.contacts[i].b}];
    state.acceleration = std::min(state.acceleration, accelerations[i]);
  }
  for (const auto& [pair, state] : pairs) addDot(axes, state, picture);
}

}  // namespace tumble
