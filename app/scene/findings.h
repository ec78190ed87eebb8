// What reading a scene collects beside the scene: complaints, and where each value was written.
#pragma once

#include <map>
#include <string>
#include <utility>
#include <vector>

#include "app/scene/node.h"
#include "app/scene/scene.h"

namespace tumble {

class Findings {
 public:
  /// @param sources  the file, then each "--set KEY=VALUE"
  explicit Findings(std::vector<std::string> sources) : sources_(std::move(sources)) {}

  /// Keeps "key: what" for later, unless something is wrong with that key there already, or with
  /// the table that it should be in.
  /// @throws SceneError when there are so many that more help nobody.
  void complain(Spot spot, const std::string& key, const std::string& what);

  /// Remembers the first place of a path into the world ("bodies[3].mass").
  void note(const std::string& where, Spot spot) { places_.emplace(where, place(spot)); }

  /// Remembers a text that pictures show, if a font may lack letters of it.
  void noteWording(Spot spot, const std::string& key, const std::string& text);

  /// The key of the first mesh that was asked for in these words and refused; "" if none was.
  std::string& refusedMesh(const std::string& words) { return refusedMeshes_[words]; }

  /// The scene file.
  const std::string& file() const { return sources_[0]; }

  std::size_t count() const { return diagnostics_.size(); }
  std::map<std::string, Place> takePlaces() { return std::move(places_); }
  std::vector<Wording> takeWordings() { return std::move(wordings_); }

  /// @throws SceneError with all complaints in the order of their places, if there are any.
  void raise();

 private:
  Place place(Spot spot) const { return {sources_[spot.source], spot.line, spot.column}; }

  std::vector<std::string> sources_;
  std::vector<Diagnostic> diagnostics_;
  std::vector<std::pair<Place, std::string>> faulty_;  // keys, each with where it stands
  std::map<std::string, Place> places_;
  std::vector<Wording> wordings_;
  std::map<std::string, std::string> refusedMeshes_;  // keys, by the words that asked for them
};

/// The name that the word is an everyday one for ("ball", a sphere); else
/// the name at the fewest slips (insertion, deletion, replacement, swap of neighbours: optimal
/// string alignment after Damerau and Levenshtein) from the word, if these are at most a third of
/// its length (one, in two letters), or the only one that the word begins; else "".
std::string nearestName(std::string_view word, const std::vector<std::string>& names);

/// ", did you mean 'X'? Valid: a, b, c" with what there is to say.
std::string hint(std::string_view word, const std::vector<std::string>& names);

}  // namespace tumble
