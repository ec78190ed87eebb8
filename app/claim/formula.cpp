// The one file that reads muParser.
#include "app/claim/formula.h"

#include <muParser.h>

#include <algorithm>

#include "app/scene/findings.h"

namespace tumble {

namespace {

constexpr const char* kNameChars =
    "0123456789_.abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ";

/// A name in a text, or a number, which is of the same letters.
struct Word {
  std::size_t at = 0;
  std::string text;
  bool called = false;  ///< a parenthesis follows
};

std::vector<Word> wordsOf(const std::string& text) {
  std::vector<Word> words;
  for (std::size_t at = text.find_first_of(kNameChars); at != std::string::npos;) {
    const std::size_t end = std::min(text.find_first_not_of(kNameChars, at), text.size());
    const std::size_t next = text.find_first_not_of(" \t", end);
    words.push_back(
        {at, text.substr(at, end - at), next != std::string::npos && text[next] == '('});
    at = text.find_first_of(kNameChars, end);
  }
  return words;
}

bool isName(const Word& word) {
  return std::string("0123456789.").find(word.text.front()) == std::string::npos;
}

// What muParser calls a parenthesis that it did not expect.
void requireKnownFunctions(const std::string& text, const mu::Parser& parser) {
  std::vector<std::string> known;
  for (const auto& [name, ignored] : parser.GetFunDef()) known.push_back(name);
  for (const Word& word : wordsOf(text))
    if (word.called && isName(word) &&
        std::find(known.begin(), known.end(), word.text) == known.end())
      throw NotAFormula("unknown function " + inQuotes(word.text) + hint(word.text, known),
                        static_cast<int>(word.at));
}

// What begins like a number and goes on like a name: muParser reads the number, and stumbles
// behind.
void requireNamesApart(const std::string& text, std::size_t stumbled) {
  for (const Word& word : wordsOf(text))
    if (!isName(word) && word.at < stumbled && stumbled < word.at + word.text.size())
      throw NotAFormula(inQuotes(word.text) +
                            " begins like a number; give what it names another name, or put a * "
                            "behind the number",
                        static_cast<int>(word.at));
}

}  // namespace

struct Formula::Parser {
  mu::Parser parser;
  std::vector<double> numbers;
};

Formula::Formula(const std::string& text) : parser_(new Parser) {
  mu::Parser& parser = parser_->parser;
  parser.DefineNameChars(kNameChars);
  parser.DefineConst("pi", 3.14159265358979323846);
  // An assignment would be taken for the value that is assigned.
  for (std::size_t i = 0; i < text.size(); ++i)
    if (text[i] == '=' && (i + 1 == text.size() || text[i + 1] != '=') &&
        (i == 0 || std::string("=<>!").find(text[i - 1]) == std::string::npos))
      throw NotAFormula("a formula has no '='; what it should be stands in `equals`",
                        static_cast<int>(i));
  requireKnownFunctions(text, parser);
  try {
    parser.SetExpr(text);
    for (const auto& [name, ignored] : parser.GetUsedVar()) names_.push_back(name);
    parser_->numbers.resize(names_.size());
    for (std::size_t i = 0; i < names_.size(); ++i)
      parser.DefineVar(names_[i], &parser_->numbers[i]);
    parser.Eval();
  } catch (const mu::Parser::exception_type& error) {
    requireNamesApart(text, static_cast<std::size_t>(std::max(0, error.GetPos())));
    throw NotAFormula(error.GetMsg() + "; expected for example \"ball.y\" or \"energy / 2\"",
                      std::clamp(error.GetPos(), 0, static_cast<int>(text.size())));
  }
}

int Formula::placeOf(const std::string& name, const std::string& text) {
  for (const Word& word : wordsOf(text))
    if (word.text == name) return static_cast<int>(word.at);
  return static_cast<int>(text.size());
}

Formula::~Formula() = default;
Formula::Formula(Formula&&) noexcept = default;

double Formula::operator()(const std::vector<double>& numbers) {
  std::copy(numbers.begin(), numbers.end(), parser_->numbers.begin());
  return parser_->parser.Eval();
}

}  // namespace tumble
