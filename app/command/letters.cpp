#include "app/command/letters.h"

#include <fmt/format.h>

#include <algorithm>

#include "app/command/progress.h"
#include "app/file/data.h"

namespace tumble {

namespace {

// Each letter once, in the order of the text.
std::u32string lackingOf(const std::string& text, const Fonts& fonts) {
  std::u32string lacking;
  for (const char32_t letter : decodeUtf8(text))
    if (!fonts.knows(letter) && lacking.find(letter) == std::u32string::npos) lacking += letter;
  return lacking;
}

std::string encodeUtf8(char32_t letter) {
  const auto tail = [&](int shift) { return static_cast<char>(0x80 | ((letter >> shift) & 0x3F)); };
  if (letter < 0x80) return {static_cast<char>(letter)};
  if (letter < 0x800) return {static_cast<char>(0xC0 | (letter >> 6)), tail(0)};
  if (letter < 0x10000) return {static_cast<char>(0xE0 | (letter >> 12)), tail(6), tail(0)};
  return {static_cast<char>(0xF0 | (letter >> 18)), tail(12), tail(6), tail(0)};
}

}  // namespace

std::vector<std::string> lackingLetters(const Scene& scene, const Fonts& fonts) {
  constexpr std::size_t kMost = 8;  // letters that are told
  std::vector<std::string> lines;
  for (const Wording& wording : scene.wordings) {
    const std::u32string lacking = lackingOf(wording.text, fonts);
    if (lacking.empty()) continue;
    std::vector<std::string> told;
    for (const char32_t letter : lacking.substr(0, kMost))
      told.push_back(fmt::format("{} (U+{:04X})", encodeUtf8(letter), static_cast<int>(letter)));
    if (lacking.size() > kMost) told.push_back("…");
    const Place& place = wording.place;
    const std::string where = place.line == 0
                                  ? place.file
                                  : fmt::format("{}:{}:{}", place.file, place.line, place.column);
    lines.push_back(fmt::format("{}: {}: the fonts lack {}; a box stands for each", where,
                                wording.key, fmt::join(told, ", ")));
  }
  return lines;
}

void noteLackingLetters(const Scene& scene) {
  if (scene.wordings.empty()) return;
  for (const std::string& line : lackingLetters(scene, Fonts(dataFolder("fonts")))) note(line);
}

}  // namespace tumble
