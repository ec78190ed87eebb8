#include "render/svg.h"

#include <array>
#include <cmath>
#include <cstdio>

namespace tumble {
namespace {

using Eigen::Vector2d;

// A length in hundredths of a pixel, without zeros at the end.
std::string number(double value) {
  std::array<char, 32> digits;
  std::snprintf(digits.data(), digits.size(), "%.2f", std::abs(value) < 0.005 ? 0.0 : value);
  std::string text = digits.data();
  text.erase(text.find_last_not_of('0') + 1);
  if (text.back() == '.') text.pop_back();
  return text;
}

std::string point(const Vector2d& p) {
  return number(p.x()) + " " + number(p.y());
}

std::string attribute(const char* name, const std::string& value) {
  return std::string(" ") + name + "=\"" + value + "\"";
}

std::string hex(const Colour& colour) {
  std::array<char, 8> text;
  const auto level = [&](int c) { return static_cast<int>(std::lround(255.0 * colour[c])); };
  std::snprintf(text.data(), text.size(), "#%02x%02x%02x", level(0), level(1), level(2));
  return text.data();
}

std::string opacity(const char* name, double alpha) {
  return alpha < 1.0 ? attribute(name, number(alpha)) : "";
}

std::string escaped(std::string_view text) {
  std::string out;
  for (const char letter : text)
    out += letter == '&'   ? std::string("&amp;")
           : letter == '<' ? std::string("&lt;")
           : letter == '>' ? std::string("&gt;")
                           : std::string(1, letter);
  return out;
}

}  // namespace

SvgDrawing::SvgDrawing(double width, double height, Fonts& fonts)
    : width_(width), height_(height), fonts_(fonts) {}

void SvgDrawing::endPath() {
  if (!path_.empty()) body_ += "<path" + attribute("d", path_) + look_ + "/>\n";
  path_.clear();
}

void SvgDrawing::stroke(const Vector2d& from, const Vector2d& to, double width,
                        const Colour& colour, double alpha) {
  const std::string look = attribute("stroke", hex(colour)) +
                           attribute("stroke-width", number(width)) +
                           opacity("stroke-opacity", alpha) + attribute("fill", "none");
  // What lets something through is darker where it covers itself, but not within one path.
  if (look != look_ || (alpha < 1.0 && from != end_)) endPath();
  if (path_.empty() || from != end_) path_ += "M" + point(from);
  look_ = look;
  path_ += "L" + point(to);
  end_ = to;
}

void SvgDrawing::fill(const Vector2d& topLeft, const Vector2d& size, const Colour& colour) {
  endPath();
  body_ += "<rect" + attribute("x", number(topLeft.x())) + attribute("y", number(topLeft.y())) +
           attribute("width", number(size.x())) + attribute("height", number(size.y())) +
           attribute("fill", hex(colour)) + "/>\n";
}

void SvgDrawing::disc(const Vector2d& centre, double radius, const Colour& colour, double alpha) {
  endPath();
  body_ += "<circle" + attribute("cx", number(centre.x())) + attribute("cy", number(centre.y())) +
           attribute("r", number(radius)) + attribute("fill", hex(colour)) +
           opacity("fill-opacity", alpha) + "/>\n";
}

void SvgDrawing::ring(const Vector2d& centre, double radius, double stroke, const Colour& colour) {
  endPath();
  body_ += "<circle" + attribute("cx", number(centre.x())) + attribute("cy", number(centre.y())) +
           attribute("r", number(radius)) + attribute("stroke", hex(colour)) +
           attribute("stroke-width", number(stroke)) + attribute("fill", "none") + "/>\n";
}

void SvgDrawing::triangle(const Vector2d& a, const Vector2d& b, const Vector2d& c,
                          const Colour& colour) {
  endPath();
  body_ += "<path" + attribute("d", "M" + point(a) + "L" + point(b) + "L" + point(c) + "Z") +
           attribute("fill", hex(colour)) + "/>\n";
}

void SvgDrawing::text(const Vector2d& pen, std::string_view utf8, const TextStyle& style) {
  if (utf8.empty()) return;
  endPath();
  const char* anchor = style.align == Align::Right    ? "end"
                       : style.align == Align::Centre ? "middle"
                                                      : "start";
  body_ += "<text" + attribute("x", number(pen.x())) + attribute("y", number(pen.y())) +
           attribute("font-size", number(style.size)) + attribute("text-anchor", anchor) +
           (style.face == Face::Bold ? attribute("font-weight", "bold") : "") +
           (style.face == Face::Italic ? attribute("font-style", "italic") : "") +
           attribute("fill", hex(style.colour)) + ">" + escaped(utf8) + "</text>\n";
}

double SvgDrawing::textWidth(std::string_view utf8, const TextStyle& style) {
  return fonts_.set(utf8, style.face, style.size, 0.0).advance;
}

std::string SvgDrawing::document() {
  endPath();
  return "<svg xmlns=\"http://www.w3.org/2000/svg\"" + attribute("width", number(width_)) +
         attribute("height", number(height_)) +
         attribute("viewBox", "0 0 " + number(width_) + " " + number(height_)) +
         " font-family=\"Lato, Carlito, 'DejaVu Sans', sans-serif\" stroke-linecap=\"round\" "
         "stroke-linejoin=\"round\">\n" +
         body_ + "</svg>\n";
}

}  // namespace tumble
