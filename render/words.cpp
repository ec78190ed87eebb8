// Words in the room that there is for them: broken into lines, made smaller, cut.
#include <algorithm>
#include <iterator>

#include "render/canvas.h"

namespace tumble {
namespace {

/// The words on both sides of a blank.
std::string_view wordBefore(std::string_view text, std::size_t blank) {
  text = text.substr(0, blank);
  return text.substr(text.rfind(' ') + 1);
}
std::string_view wordAfter(std::string_view text, std::size_t blank) {
  text.remove_prefix(std::min(blank + 1, text.size()));
  return text.substr(0, text.find(' '));
}

bool isOperator(std::string_view word) {
  constexpr std::string_view kOperators[] = {"=", "<", ">", "≤", "≥", "≈",
                                             "+", "−", "±", "·", "×", "/"};
  return std::find(std::begin(kOperators), std::end(kOperators), word) != std::end(kOperators);
}

bool isNumber(std::string_view word) {
  const auto digit = [](char c) { return c >= '0' && c <= '9'; };
  if (word.starts_with("−")) word.remove_prefix(std::string_view("−").size());
  return word == "½" || (!word.empty() && digit(word.front()) && digit(word.back()));
}

/// Whether a line is not to end between two words: at the sign of a formula, or between a number
/// and what it counts or measures.
bool belongTogether(std::string_view before, std::string_view after) {
  return isOperator(before) || isOperator(after) || isNumber(before);
}

}  // namespace

std::vector<std::string> Drawing::lines(std::string_view utf8, double width, const TextStyle& style,
                                        std::size_t most) {
  constexpr const char* kBlanks = " \t\n\r";
  std::vector<std::string> lines;
  std::size_t begin = 0, blank = 0, good = 0;  // of the line, and its last blanks that fit
  for (std::size_t end = 0; end < utf8.size() && lines.size() < most;) {
    end = std::min(utf8.find_first_of(kBlanks, end + 1), utf8.size());
    while (blank > begin && textWidth(utf8.substr(begin, end - begin), style) > width) {
      const std::size_t at = good > begin ? good : blank;
      lines.emplace_back(utf8.substr(begin, at - begin));
      begin = std::min(utf8.find_first_not_of(kBlanks, at), utf8.size());
    }
    blank = end;
    if (!belongTogether(wordBefore(utf8, end), wordAfter(utf8, end))) good = end;
  }
  if (begin < utf8.size()) lines.emplace_back(utf8.substr(begin));
  return lines;
}

std::string Drawing::shortened(std::string text, double width, const TextStyle& style) {
  if (textWidth(text, style) <= width) return text;
  const auto drop = [&] {
    while ((text.back() & 0xC0) == 0x80 && text.size() > 1) text.pop_back();
    text.pop_back();
  };
  while (!text.empty() && textWidth(text + "…", style) > width) drop();
  while (!text.empty() && (text.back() == ' ' || text.back() == ',')) text.pop_back();
  return text + "…";
}

Drawing::Words Drawing::fitted(std::string_view utf8, double width, std::size_t most,
                               const TextStyle& style, double least) {
  constexpr double kSmaller = 0.95;
  const auto fits = [&](const std::vector<std::string>& all, const TextStyle& as) {
    return all.size() <= most && std::all_of(all.begin(), all.end(), [&](const std::string& line) {
             return textWidth(line, as) <= width;
           });
  };
  TextStyle as = style;
  for (;; as.size = std::max(least, kSmaller * as.size)) {
    Words words{lines(utf8, width, as, most), as.size};
    if (fits(words.lines, as)) return words;
    if (as.size > least) continue;
    // The last line goes on as far as it may.
    if (words.lines.size() > most) {
      words.lines[most - 1] += " " + words.lines[most];
      words.lines.resize(most);
    }
    for (std::string& line : words.lines) line = shortened(line, width, as);
    return words;
  }
}

void Drawing::text(const Eigen::Vector2d& pen, const Words& words, double step, TextStyle style) {
  style.size = words.size;
  for (std::size_t i = 0; i < words.lines.size(); ++i)
    text(pen + Eigen::Vector2d(0.0, step * static_cast<double>(i)), words.lines[i], style);
}

}  // namespace tumble
