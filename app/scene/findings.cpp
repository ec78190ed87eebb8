#include "app/scene/findings.h"

#include <algorithm>
#include <iterator>
#include <numeric>
#include <tuple>

namespace tumble {

namespace {

constexpr std::size_t kMostComplaints = 100;
constexpr std::size_t kMostListed = 32;   // names in a hint
constexpr std::size_t kLongestWord = 64;  // a slip of the finger happens in shorter words

// What people say and what a scene calls it.
struct Everyday {
  std::string_view said, name;
};
constexpr Everyday kEveryday[] = {{"ball", "sphere"},
                                  {"cube", "box"},
                                  {"cuboid", "box"},
                                  {"brick", "box"},
                                  {"block", "box"},
                                  {"tube", "cylinder"},
                                  {"disc", "cylinder"},
                                  {"disk", "cylinder"},
                                  {"pill", "capsule"},
                                  {"egg", "ellipsoid"},
                                  {"floor", "plane"},
                                  {"ground", "plane"},
                                  {"half_space", "plane"},
                                  {"wall", "plane"},
                                  {"weight", "mass"},
                                  {"bounce", "restitution"},
                                  {"rotation", "orientation"},
                                  {"speed", "velocity"},
                                  {"spin", "angular_velocity"},
                                  {"static", "fixed"}};

int slips(std::string_view a, std::string_view b) {
  // Three rows of the table of distances between prefixes: a swap looks two rows back.
  std::vector<int> before(b.size() + 1), last(b.size() + 1), row(b.size() + 1);
  std::iota(row.begin(), row.end(), 0);
  for (std::size_t i = 1; i <= a.size(); ++i) {
    std::swap(before, last);
    std::swap(last, row);
    row[0] = static_cast<int>(i);
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const int replaced = last[j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1);
      row[j] = std::min({replaced, last[j] + 1, row[j - 1] + 1});
      const bool swapped = i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1];
      if (swapped) row[j] = std::min(row[j], before[j - 2] + 1);
    }
  }
  return row.back();
}

}  // namespace

void Findings::complain(Spot spot, const std::string& key, const std::string& what) {
  const Place at = place(spot);
  const auto isSaid = [&](const std::pair<Place, std::string>& said) {
    return said.first.file == at.file && said.first.line == at.line &&
           said.first.column == at.column &&
           (key == said.second || key.starts_with(said.second + "."));
  };
  if (!key.empty() && std::any_of(faulty_.begin(), faulty_.end(), isSaid)) return;
  if (!key.empty()) faulty_.emplace_back(at, key);
  diagnostics_.push_back({at, key.empty() ? what : key + ": " + what});
  if (diagnostics_.size() >= kMostComplaints) raise();
}

void Findings::noteWording(Spot spot, const std::string& key, const std::string& text) {
  constexpr std::string_view kShown[] = {"title", "subtitle", "text", "label", "axis", "across"};
  const std::string last = key.substr(key.rfind('.') + 1);
  if (std::find(std::begin(kShown), std::end(kShown), last) == std::end(kShown)) return;
  if (std::any_of(text.begin(), text.end(), [](char c) { return (c & 0x80) != 0; }))
    wordings_.push_back({place(spot), key, text});
}

void Findings::raise() {
  if (diagnostics_.empty()) return;
  std::stable_sort(
      diagnostics_.begin(), diagnostics_.end(), [](const Diagnostic& a, const Diagnostic& b) {
        return std::tie(a.place.line, a.place.column) < std::tie(b.place.line, b.place.column);
      });
  throw SceneError(std::move(diagnostics_));
}

std::string nearestName(std::string_view word, const std::vector<std::string>& names) {
  if (word.size() > kLongestWord) return "";
  for (const Everyday& everyday : kEveryday)
    if (word == everyday.said &&
        std::find(names.begin(), names.end(), everyday.name) != names.end())
      return std::string(everyday.name);
  // One slip in a word of one letter leaves nothing of it: any other would be as near.
  const int letters = static_cast<int>(word.size());
  int fewest = (letters < 2 ? 0 : std::max(1, letters / 3)) + 1;
  std::string nearest;
  int begun = 0;
  std::string longer;
  for (const std::string& name : names) {
    if (name.size() > kLongestWord) continue;
    const int count = slips(word, name);
    if (count < fewest) {
      fewest = count;
      nearest = name;
    }
    if (!word.empty() && name.starts_with(word)) {
      ++begun;
      longer = name;
    }
  }
  if (!nearest.empty()) return nearest;
  return begun == 1 ? longer : "";
}

std::string hint(std::string_view word, const std::vector<std::string>& names) {
  if (names.empty()) return "";
  const std::string nearest = nearestName(word, names);
  std::string text = nearest.empty() ? "; valid: " : ", did you mean '" + nearest + "'? Valid: ";
  for (std::size_t i = 0; i < std::min(names.size(), kMostListed); ++i)
    text += (i == 0 ? "" : ", ") + names[i];
  return text + (names.size() > kMostListed ? ", …" : "");
}

}  // namespace tumble
