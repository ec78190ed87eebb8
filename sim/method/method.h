// Chapter 9, method: the table of ways to let time run.
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "sim/method/model.h"
#include "sim/method/report.h"
#include "sim/method/state.h"

namespace tumble {

/// A row of the table of methods. None of them includes another.
struct Method {
  std::string_view name;
  std::string_view summary;
  /// Throws Refusal for settings or bodies that this method cannot handle.
  void (*check)(const Model&, std::span<const RigidBody> bodies);
  /// Makes whole steps of the method's own grid until state.t ≥ t_end or the report says stopped.
  void (*advance)(const Model&, State&, double t_end, Report&);
  /// The bodies at time t inside the trail, their lasting contacts with forces, and those of
  /// joints.
  void (*look)(const Model&, const State&, double t, std::vector<RigidBody>&, std::vector<Contact>&,
               std::vector<JointForce>&);
  bool contact;  ///< bodies may touch and go on
};

/// All methods. To add one: write `sim/method/<name>/` and add its row in methods.cpp.
std::span<const Method> methods();
const Method* findMethod(std::string_view name);

/// Refuses what bends, in the method's words on why it does.
void refuseWhatBends(const Model& model, const std::string& why);

/// Pairs of bodies worth a closer look: boxes overlap, and not both are fixed. The witnesses of
/// state.near pass on to the pairs that stay; the caller puts the pairs in its place.
/// `boxes` has one entry per body of model.solid.
std::vector<std::pair<int, int>> nearPairs(const Model& model, State& state,
                                           std::span<const Aabb> boxes);

/// Stops a run before two bodies meet whose shapes have no contact rule: as soon as their boxes
/// overlap. True if it did.
bool stopAtUnknownPair(const Model& model, std::span<const std::pair<int, int>> near,
                       Report& report);

/// Boxes that hold each body of model.solid during the next `h` seconds at its present velocity,
/// grown by the way a constant acceleration of size `acceleration` [m/s²] goes, and by `margin`
/// [m].
void sweptBoxes(const Model& model, std::span<const RigidBody> bodies, double h,
                double acceleration, double margin, std::vector<Aabb>& boxes);

/// The box that holds one body at a velocity [m/s] and turning speed [rad/s], grown by `margin`
/// [m].
Aabb sweptBox(const Model& model, int i, const RigidBody& body, const Vec3& v, const Vec3& omega,
              double h, double margin);

/// All contact points of a pair within `margin` [m], with restitution and friction of the pair.
/// b is the body that stands first in the scene. Appends to `contacts`.
void findContacts(const Model& model, std::span<const RigidBody> bodies, std::pair<int, int> pair,
                  double margin, std::vector<Contact>& contacts);

/// The points that `collide` finds of the near pair k of the state, at its bodies' poses; but first
/// asks the plane that parted the pair when it was last looked at. The answer is the same, bit by
/// bit; the certificate counts how often the plane gave it.
void findNearPoints(const Model& model, State& state, std::size_t k, double margin,
                    Manifold& points, Report& report);
/// The same with restitution and friction of the pair. Appends to `contacts`.
void findNearContacts(const Model& model, State& state, std::size_t k, double margin,
                      std::vector<Contact>& contacts, Report& report);

/// Whether the remembered plane of near pair k shows it apart by more than `margin` [m] with these
/// bodies.
bool planeShowsApart(const Model& model, const State& state, std::span<const RigidBody> bodies,
                     std::size_t k, double margin, Report& report);

/// The last instant of the grid of step h [s] after step k, not beyond the duration.
double gridTime(const Model& model, long k, double h);

/// Forgets the stretches of motion that end before t.
void trimTrail(State& state, double t);

/// Why a method leaves a scene to another one after all that effort.
std::string spentBy(const Model& model, const State& state);

/// Brings the running totals and the certificate up to date at the end of a step.
/// @param potential  [J] of the bodies, in gravity and of all forces
void account(const Model& model, State& state, Report& report, double potential);
void account(const Model& model, State& state, Report& report);

/// Energy [J] stored in contacts that are springs.
double energyStored(std::span<const Contact> contacts);

/// Tells what became of lasting contacts at time t [s], where the bodies are as given: rest,
/// separate, slip and stick. One event for a pair, told at its first contact.
void recordChanges(const std::vector<Contact>& before, const std::vector<Contact>& now,
                   std::span<const RigidBody> bodies, double t, Report& report);

/// Sorts the events that came after the first `from` by time, then a, then b.
void sortEvents(Report& report, std::size_t from);

}  // namespace tumble
