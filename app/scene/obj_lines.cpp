#include "app/scene/obj_lines.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <vector>

#include "app/scene/node.h"

namespace tumble {

namespace {

// What an OBJ file may say besides points and faces.
constexpr std::string_view kPassedOver[] = {
    "vt",       "vn",       "vp",     "g",          "s",         "o",      "mg",
    "l",        "p",        "usemtl", "mtllib",     "usemap",    "maplib", "bevel",
    "c_interp", "d_interp", "lod",    "shadow_obj", "trace_obj", "ctech",  "stech",
    "cstype",   "deg",      "bmat",   "step",       "curv",      "curv2",  "surf",
    "parm",     "trim",     "hole",   "scrv",       "sp",        "end",    "con"};

struct Word {
  std::string_view text;
  int line = 1, column = 1;  // from 1; a column is a byte
};

// Cuts a text into statements of words.
class Words {
 public:
  explicit Words(std::string_view text) : text_(text) {
    if (text_.starts_with("\xEF\xBB\xBF")) at_ = lineStart_ = 3;
  }

  // The words up to the end of the line, or of the lines that \ joins; false at the end of the
  // text.
  bool next(std::vector<Word>& words) {
    words.clear();
    if (at_ >= text_.size()) return false;
    while (at_ < text_.size()) {
      if (const std::size_t end = endOfLine(at_)) {
        startLine(end);
        return true;
      }
      if (const std::size_t end = joint())
        startLine(end);
      else if (text_[at_] == '#')
        skipComment();
      else if (isBlank(text_[at_]))
        ++at_;
      else
        words.push_back(word());
    }
    return true;
  }

 private:
  static bool isBlank(char c) { return c == ' ' || c == '\t' || c == '\v' || c == '\f'; }

  // Where the next line begins if one ends at i, else 0.
  std::size_t endOfLine(std::size_t i) const {
    if (i >= text_.size()) return 0;
    if (text_[i] == '\n') return i + 1;
    if (text_[i] != '\r') return 0;
    return i + 1 < text_.size() && text_[i + 1] == '\n' ? i + 2 : i + 1;
  }
  std::size_t joint() const { return text_[at_] == '\\' ? endOfLine(at_ + 1) : 0; }

  void startLine(std::size_t begin) {
    at_ = lineStart_ = begin;
    ++line_;
  }
  void skipComment() {
    while (at_ < text_.size() && !endOfLine(at_)) ++at_;
  }
  Word word() {
    const std::size_t begin = at_;
    while (at_ < text_.size() && !isBlank(text_[at_]) && text_[at_] != '#' && !endOfLine(at_) &&
           !joint())
      ++at_;
    return {text_.substr(begin, at_ - begin), line_, static_cast<int>(begin - lineStart_) + 1};
  }

  std::string_view text_;
  std::size_t at_ = 0, lineStart_ = 0;
  int line_ = 1;
};

// The number that a text is from end to end.
template <class Number>
bool whole(std::string_view text, Number& number) {
  if (text.size() > 1 && text[0] == '+' && text[1] != '-') text.remove_prefix(1);
  const char* end = text.data() + text.size();
  const std::from_chars_result result = std::from_chars(text.data(), end, number);
  return !text.empty() && result.ec == std::errc() && result.ptr == end;
}

// How many digits the coordinates of a file have. They are all written alike, to a number of
// decimals or of significant digits, of which zeros at the end may be left out.
class Digits {
 public:
  void take(std::string_view text, double number) {
    const std::size_t e = std::min(text.find_first_of("eE"), text.size());
    int power = 0;
    if (e < text.size()) whole(text.substr(e + 1), power);
    int decimals = 0, significant = 0;
    bool fraction = false;
    for (const char c : text.substr(0, e)) {
      if (c == '.') fraction = true;
      if (c < '0' || c > '9') continue;
      if (fraction) ++decimals;
      if (significant > 0 || c != '0') ++significant;
    }
    decimals_ = std::max(decimals_, decimals - power);
    if (fraction) ofFraction_ = std::max(ofFraction_, significant);
    significant_ = std::max(significant_, significant);
    largest_ = std::max(largest_, std::abs(number));
  }
  // [m]
  double grain() const {
    if (largest_ == 0.0) return 0.0;
    const double decimal = std::pow(10.0, -decimals_),
                 single = largest_ * std::numeric_limits<float>::epsilon();
    // Significant digits are what is limited only if whole numbers keep to it too.
    if (ofFraction_ < significant_) return std::max(decimal, single);
    const double places = std::floor(std::log10(largest_)) + 1.0;
    return std::max({decimal, std::pow(10.0, places - significant_), single});
  }

 private:
  int decimals_ = 0, significant_ = 0, ofFraction_ = 0;
  double largest_ = 0.0;  // [m]
};

class ObjReader {
 public:
  explicit ObjReader(const std::string& file) : file_(file) {}

  void take(const std::vector<Word>& words) {
    const std::string_view key = words[0].text;
    if (key == "v") return takePoint(words);
    if (key == "f" || key == "fo") return takeFace(words);
    if (std::find(std::begin(kPassedOver), std::end(kPassedOver), key) == std::end(kPassedOver))
      refuse(words[0], "v, f or another keyword of OBJ files");
  }
  ObjFile taken() && {
    taken_.grain = digits_.grain();
    return std::move(taken_);
  }

 private:
  [[noreturn]] void refuse(const Word& word, const std::string& expected,
                           const std::string& found = {}) const {
    throw ObjError(file_ + ":" + std::to_string(word.line) + ":" + std::to_string(word.column) +
                   ": expected " + expected + ", found " +
                   (found.empty() ? inQuotes(word.text) : found));
  }
  void needThree(const std::vector<Word>& words, const char* what) const {
    if (words.size() < 4)
      refuse(words[0], std::string("three ") + what + " or more", std::to_string(words.size() - 1));
  }

  void takePoint(const std::vector<Word>& words) {
    Vec3 p = Vec3::Zero();
    for (std::size_t k = 1; k < words.size(); ++k) {
      double number = 0.0;
      if (!whole(words[k].text, number) || !std::isfinite(number))
        refuse(words[k], "a finite number");
      if (k > 3) continue;
      p[static_cast<Eigen::Index>(k) - 1] = number;
      digits_.take(words[k].text, number);
    }
    needThree(words, "numbers");
    taken_.points.push_back(p);
  }

  void takeFace(const std::vector<Word>& words) {
    needThree(words, "points");
    std::vector<int> face;
    for (std::size_t k = 1; k < words.size(); ++k)
      face.push_back(static_cast<int>(point(words[k])) - 1);
    taken_.faces.push_back(std::move(face));
    taken_.lines.push_back(words[0].line);
  }

  // The point, counted from 1, of a reference n, n/t, n//u or n/t/u.
  long long point(const Word& word) const {
    long long number[3] = {1, 1, 1};
    std::string_view rest = word.text;
    for (int k = 0; k < 3; ++k) {
      const std::size_t slash = std::min(rest.find('/'), rest.size());
      const bool leftOut = k == 1 && slash == 0 && rest.size() > 1;
      if (!leftOut && !whole(rest.substr(0, slash), number[k])) break;
      if (slash == rest.size()) return checked(word, number[0]);
      rest.remove_prefix(slash + 1);
    }
    refuse(word, "the number of a point, like 3, 3/1, 3//2 or 3/1/2");
  }

  long long checked(const Word& word, long long n) const {
    const long long count = static_cast<long long>(taken_.points.size());
    if (n >= 1 && n <= count) return n;
    if (n <= -1 && n >= -count) return count + n + 1;
    const std::string most = std::to_string(count);
    refuse(word, count == 0 ? "points above the first face"
                            : "a point from 1 to " + most + ", or from -1 back to -" + most);
  }

  const std::string& file_;
  ObjFile taken_;
  Digits digits_;
};

}  // namespace

ObjFile readObj(std::string_view text, const std::string& file) {
  Words lines(text);
  ObjReader reader(file);
  std::vector<Word> words;
  while (lines.next(words))
    if (!words.empty()) reader.take(words);
  return std::move(reader).taken();
}

}  // namespace tumble
