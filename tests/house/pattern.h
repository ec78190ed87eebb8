// Regular expressions of POSIX: the house looks for words in its sources with what the system has,
// since <regex> takes a compiler longer than the rest of the house.
#pragma once

#include <regex.h>

#include <algorithm>
#include <array>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

namespace tumble::test {

/// An extended regular expression with GNU's \w, \b and \s; "[^…]" and "." take ends of lines too,
/// ^ and $ are the ends of the text.
class Pattern {
 public:
  /// The whole at [0], then the groups; those that take no part are empty.
  using Match = std::array<std::string, 8>;

  explicit Pattern(const std::string& text) {
    if (::regcomp(&compiled_, text.c_str(), REG_EXTENDED) != 0)
      throw std::invalid_argument("no regular expression: " + text);
  }
  ~Pattern() { ::regfree(&compiled_); }
  Pattern(const Pattern&) = delete;
  Pattern& operator=(const Pattern&) = delete;

  /// The first match, if there is one.
  std::optional<Match> first(const std::string& text) const {
    std::size_t from = 0;
    return next(text, from);
  }

  /// Every match from left to right, none within another.
  std::vector<Match> all(const std::string& text) const {
    std::vector<Match> matches;
    std::size_t from = 0;
    while (from <= text.size())
      if (std::optional<Match> match = next(text, from))
        matches.push_back(*match);
      else
        break;
    return matches;
  }

 private:
  // The next match from a place on, which moves behind it.
  std::optional<Match> next(const std::string& text, std::size_t& from) const {
    std::array<regmatch_t, std::tuple_size_v<Match>> spans;
    const char* const begin = text.c_str() + from;
    if (::regexec(&compiled_, begin, spans.size(), spans.data(), from > 0 ? REG_NOTBOL : 0) != 0)
      return {};
    Match match;
    for (std::size_t k = 0; k < spans.size(); ++k)
      if (spans[k].rm_so >= 0) match[k].assign(begin + spans[k].rm_so, begin + spans[k].rm_eo);
    from += static_cast<std::size_t>(std::max<regoff_t>(spans[0].rm_eo, 1));
    return match;
  }

  regex_t compiled_;
};

}  // namespace tumble::test
