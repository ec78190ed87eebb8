// Reads one table of a scene key by key.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "app/scene/findings.h"
#include "app/scene/node.h"
#include "sim/math/vec.h"

namespace tumble {

/// Numbers that a key takes; never NaN, infinite, or nearer to lo than 1e-30 if that is refused.
struct Range {
  double lo = -1e30, hi = 1e30;
  bool above = false;          ///< lo itself is refused
  std::string_view unit = {};  ///< "m", for messages
};

/// Positions, velocities, forces: any number that a sum of squares does not overflow.
inline constexpr Range any(std::string_view unit) {
  return {-1e30, 1e30, false, unit};
}
inline constexpr Range positive(std::string_view unit) {
  return {0.0, 1e30, true, unit};
}
inline constexpr Range notNegative(std::string_view unit) {
  return {0.0, 1e30, false, unit};
}
/// Shorter, an inertia would underflow; longer, a volume would drown everything else.
inline constexpr Range kLength{1e-9, 1e6, false, "m"};
inline constexpr Range kShare{0.0, 1.0, false, {}};  ///< [0, 1]

/// What to say of a key that is unknown here, and has its place elsewhere.
using Elsewhere = std::map<std::string, std::string, std::less<>>;

/// A table of a scene: each key is asked for once; a key that nobody asked for is unknown.
/// A reader sets `out` only if the key is there and right, and complains if it is there and wrong.
class Section {
 public:
  /// @param key    how a person addresses the table, as behind --set: "body.brick"; "" for the root
  /// @param where  path of the same into the world: "bodies[3]", "" for the world itself; keys are
  ///               noted below it. Nothing for what is not part of the world.
  Section(const Node& node, std::string key, Findings& findings,
          std::optional<std::string> where = {});

  const Node* find(std::string_view key);

  void read(std::string_view key, double& out, const Range& range);
  void read(std::string_view key, Vec3& out, const Range& range);
  void read(std::string_view key, bool& out);
  void read(std::string_view key, int& out, int lo, int hi);
  void read(std::string_view key, std::string& out);
  /// Only one of the listed words.
  void read(std::string_view key, std::string& out, const std::vector<std::string>& choices);
  /// A list of strings.
  void read(std::string_view key, std::vector<std::string>& out);
  /// A list of points [x, y, z].
  void read(std::string_view key, std::vector<Vec3>& out, const Range& range);
  /// A list of exactly `count` numbers.
  void read(std::string_view key, double* out, std::size_t count, const Range& range);

  template <class T>
  void read(std::string_view key, std::optional<T>& out, const Range& range) {
    T value;
    if (find(key) && tryRead(key, value, range)) out = value;
  }

  /// The elements of an array of tables, or nothing.
  const Array& tables(std::string_view key);

  /// Complains about each key that was not asked for.
  void finish(const Elsewhere& elsewhere = {});

  void complain(std::string_view key, const std::string& what);
  /// True if nothing was wrong with this table since it was opened.
  bool good() const { return findings_.count() == complaintsBefore_; }

  Spot spot() const { return node_.spot; }
  std::string path(std::string_view key) const;
  const std::string& key() const { return key_; }
  Findings& findings() { return findings_; }
  /// The keys that were asked for.
  const std::vector<std::string_view>& asked() const { return asked_; }

 private:
  template <class T>
  bool tryRead(std::string_view key, T& out, const Range& range) {
    const std::size_t before = findings_.count();
    read(key, out, range);
    return findings_.count() == before;
  }

  const Node& node_;
  const Table* table_;
  std::string key_;
  std::optional<std::string> where_;
  Findings& findings_;
  std::size_t complaintsBefore_;
  std::vector<std::string_view> asked_;  ///< literals
};

/// The number that stands at a node, if it is one in range.
bool readNumber(const Node& node, const std::string& key, const Range& range, Findings& findings,
                double& out);

/// The string at a node.
bool readText(const Node& node, const std::string& key, Findings& findings, std::string& out);

}  // namespace tumble
