#include "render/sheet.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <vector>

#include "render/canvas.h"
#include "render/heading.h"

namespace tumble {
namespace {

using Eigen::Vector2d;

constexpr int kMargin = 32, kGutter = 16;  // [px]
// [px] of type: above the panels, of the first line below one, of each further line and below all.
constexpr double kTop = 100.0, kFirst = 30.0, kLine = 20.0, kGap = 2.0, kFoot = 16.0;
constexpr double kLetter = 20.0;       // [px] of type, room for the letter
constexpr std::size_t kMostLines = 4;  // of the title, and of the subtitle
const Canvas::TextStyle kName{16.0, Face::Bold, Align::Left, ink::text};
const Canvas::TextStyle kCaption{16.0, Face::Regular, Align::Left, ink::text};
const Canvas::TextStyle kFinding{14.0, Face::Regular, Align::Left, ink::secondary};

/// What stands below a panel, line by line.
struct Words {
  std::vector<std::string> caption, finding;
  double height() const {
    return kFirst + kGap + kFoot +
           kLine * static_cast<double>(std::max<std::size_t>(1, caption.size()) - 1 +
                                       std::max<std::size_t>(1, finding.size()));
  }
};

/// Type is as high as on a page of 1800 px that is shown as wide as this one.
double typeOf(int pageWidth) {
  return std::clamp(pageWidth / 1800.0, 1.0, 2.0);
}

void place(Image& page, const Image& image, int left, int top) {
  for (int y = 0; y < image.height; ++y)
    std::copy_n(image.rgb.begin() + 3 * static_cast<std::ptrdiff_t>(y) * image.width,
                3 * image.width,
                page.rgb.begin() + 3 * (static_cast<std::ptrdiff_t>(top + y) * page.width + left));
}

/// a … z, then aa, ab, …
std::string letter(int index) {
  const std::string last(1, static_cast<char>('a' + index % 26));
  return index < 26 ? last : letter(index / 26 - 1) + last;
}

/// @param corner  [px] of type, where the words begin: below the panel, on its left
void drawWords(const Words& words, const std::string& name, const Vector2d& corner,
               Canvas& canvas) {
  Vector2d pen = corner + Vector2d(2.0, kFirst);
  canvas.text(pen, name, kName);
  pen.x() = corner.x() + kLetter;
  for (const std::string& line : words.caption) {
    canvas.text(pen, line, kCaption);
    pen.y() += kLine;
  }
  pen.y() += words.caption.empty() ? kLine + kGap : kGap;
  for (const std::string& line : words.finding) {
    canvas.text(pen, line, kFinding);
    pen.y() += kLine;
  }
}

void requireAlike(std::span<const Panel> panels, int columns) {
  if (panels.empty() || columns < 1)
    throw std::invalid_argument("a sheet needs a panel and a column");
  const Image& first = panels[0].image;
  const int count = static_cast<int>(panels.size()), free = columns - (count - 1) % columns;
  for (const Panel& panel : panels) {
    const bool last = &panel == &panels.back();
    const int most = last && count > 1 ? spanningWidth(first.width, free) : first.width;
    if (panel.image.width < first.width || panel.image.width > most ||
        panel.image.height != first.height)
      throw std::invalid_argument("the panels of a sheet must have one size");
  }
}

}  // namespace

int spanningWidth(int width, int columns) {
  return columns * width + (columns - 1) * kGutter;
}

Image drawSheet(std::span<const Panel> panels, int columns, const std::string& title,
                const std::string& subtitle, Fonts& fonts) {
  requireAlike(panels, columns);
  const int width = panels[0].image.width, height = panels[0].image.height;
  const int count = static_cast<int>(panels.size()), across = std::min(columns, count);
  Image page{2 * kMargin + spanningWidth(width, across), 0, {}};
  const double type = typeOf(page.width);

  // Words on as many lines as they take, rows as high as the longest words in them.
  Canvas rule(page, fonts, type);
  const Heading heading(rule, title, subtitle, (page.width - 2.0 * kMargin) / type, kMostLines);
  std::vector<Words> words;
  std::vector<int> tops = {static_cast<int>(std::lround(type * (kTop + heading.below())))};
  for (int first = 0; first < count; first += across) {
    double below = 0.0;
    for (int i = first; i < std::min(count, first + across); ++i) {
      const double room = panels[i].image.width / type - kLetter;
      words.push_back({rule.lines(panels[i].caption, room, kCaption),
                       rule.lines(panels[i].finding, room, kFinding)});
      below = std::max(below, words.back().height());
    }
    tops.push_back(tops.back() + height + static_cast<int>(std::lround(type * below)));
  }

  page.height = tops.back();
  page.rgb.resize(3u * static_cast<std::size_t>(page.width) * page.height);
  Canvas pixels(page, fonts, 1.0), canvas(page, fonts, type);
  for (Canvas* each : {&pixels, &canvas}) each->setPaper(ink::page);
  pixels.fill({0.0, 0.0}, {pixels.width(), pixels.height()}, ink::page);
  for (int i = 0; i < count; ++i) {
    const Image& image = panels[i].image;
    const int left = kMargin + i % across * (width + kGutter), top = tops[i / across];
    place(page, image, left, top);
    pixels.frame({left, top}, {image.width, image.height}, 1.0, ink::frame);
    drawWords(words[i], letter(i), Vector2d(left, top + height) / type, canvas);
  }
  heading.draw(kMargin / type, canvas);
  return page;
}

}  // namespace tumble
