// The one file that reads muParser.
#include "app/claim/formula.h"

#include <muParser.h>

#include <algorithm>

namespace tumble {

struct Formula::Parser {
  mu::Parser parser;
  std::vector<double> numbers;
};

Formula::Formula(const std::string& text) : parser_(new Parser) {
  mu::Parser& parser = parser_->parser;
  parser.DefineNameChars("0123456789_.abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ");
  parser.DefineConst("pi", 3.14159265358979323846);
  // An assignment would be taken for the value that is assigned.
  for (std::size_t i = 0; i < text.size(); ++i)
    if (text[i] == '=' && (i + 1 == text.size() || text[i + 1] != '=') &&
        (i == 0 || std::string("=<>!").find(text[i - 1]) == std::string::npos))
      throw NotAFormula("a formula has no '='; what it should be stands in `equals`",
                        static_cast<int>(i));
  try {
    parser.SetExpr(text);
    for (const auto& [name, ignored] : parser.GetUsedVar()) names_.push_back(name);
    parser_->numbers.resize(names_.size());
    for (std::size_t i = 0; i < names_.size(); ++i)
      parser.DefineVar(names_[i], &parser_->numbers[i]);
    parser.Eval();
  } catch (const mu::Parser::exception_type& error) {
    throw NotAFormula(error.GetMsg() + "; expected for example \"ball.y\" or \"energy / 2\"",
                      std::clamp(error.GetPos(), 0, static_cast<int>(text.size())));
  }
}

Formula::~Formula() = default;
Formula::Formula(Formula&&) noexcept = default;

double Formula::operator()(const std::vector<double>& numbers) {
  std::copy(numbers.begin(), numbers.end(), parser_->numbers.begin());
  return parser_->parser.Eval();
}

}  // namespace tumble
