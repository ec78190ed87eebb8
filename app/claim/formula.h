// A formula over named numbers, such as "max(ball.y, 0) * 9.81".
#pragma once

#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

namespace tumble {

/// A text that is no formula, and where in it that shows.
class NotAFormula : public std::invalid_argument {
 public:
  NotAFormula(const std::string& what, int at) : std::invalid_argument(what), at_(at) {}
  int at() const { return at_; }  ///< bytes from the start of the text

 private:
  int at_;
};

/// + − * / ^, comparisons, && || ?:, parentheses, pi, and the functions sin cos tan asin acos atan
/// sqrt abs exp ln log10 min max sum avg. A name is of letters, digits, dots and underlines and
/// begins with a letter; before a parenthesis it is that of a function. By muParser.
class Formula {
 public:
  /// Where a text asks for a name: bytes from its start, or where it ends if it never does.
  static int placeOf(const std::string& name, const std::string& text);

  /// @throws NotAFormula
  explicit Formula(const std::string& text);
  ~Formula();
  Formula(Formula&&) noexcept;

  /// The numbers that it asks for, each once.
  const std::vector<std::string>& names() const { return names_; }
  /// Its value, with one number for each name.
  double operator()(const std::vector<double>& numbers);

 private:
  struct Parser;
  std::unique_ptr<Parser> parser_;
  std::vector<std::string> names_;
};

}  // namespace tumble
