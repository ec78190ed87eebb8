// One table [[body]], or the template of an array, to a body of the world.
#pragma once

#include "app/scene/material.h"

namespace tumble {

/// A body with what is drawn of it.
struct BodyEntry {
  BodyDef def;
  std::optional<Rgb> colour, back;
  std::string label;
};

/// Reads all keys of a body but its name, which the caller has found already.
/// A key of the body wins over its material.
BodyEntry readBody(Section& section, const std::string& name, const Materials& materials);

/// Complains, with the nearest name there is, if none of the bodies has the name that a key gives.
void requireBody(Section& section, std::string_view key, const std::string& name,
                 std::span<const BodyDef> bodies);

/// Appends to the scene, where forces will look for the name.
class BodyList {
 public:
  explicit BodyList(Scene& scene) : scene_(scene) {}

  /// Complains, at the spot and on behalf of the section, about a name that is taken or not a name.
  void add(BodyEntry entry, Spot spot, Section& section);
  /// Takes the name that a section gives what is made of many bodies, or joins some: an "array", a
  /// "cloth". Complains if anything has it.
  void claim(Section& section, const std::string& name, const std::string& what);
  /// Index of the next body; its path into the world is "bodies[next]".
  std::size_t next() const { return scene_.world.bodies.size(); }
  std::string nextPath() const { return "bodies[" + std::to_string(next()) + "]"; }
  /// True, after a complaint, if there are so many bodies that no more are taken.
  bool full(Spot spot, Findings& findings) const;

  /// Index of the body that the key of the section names; nothing, after a complaint, if there is
  /// none.
  std::optional<int> named(Section& section, std::string_view key) const;
  /// Indices of the copies of the array, or of the one body, that the key names; kNoBody, for
  /// every body, without the key or after a complaint.
  std::vector<int> group(Section& section, std::string_view key) const;

 private:
  void share(Shape& shape);
  void share(std::shared_ptr<const Polyhedron>& solid);

  Scene& scene_;
  std::map<std::string, int> indices_;
  std::map<std::string, std::string> claimed_;  // what has a name that is no body's
  std::vector<std::shared_ptr<const Polyhedron>> solids_;
};

/// Reads [[body]].
void readBodies(Section& root, const Materials& materials, BodyList& bodies);

}  // namespace tumble
