#include "render/sheet.h"

#include <algorithm>
#include <sstream>
#include <stdexcept>
#include <vector>

#include "render/canvas.h"

namespace tumble {
namespace {

using Eigen::Vector2d;

constexpr int kMargin = 32, kGutter = 16, kTop = 100, kCaption = 48, kLine = 20;
constexpr double kFindingSize = 14.0;

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

/// The words of a text, set on lines that are at most as wide as asked [px], if a word is not.
std::vector<std::string> wrapped(const std::string& text, double width, Fonts& fonts) {
  std::vector<std::string> lines(1);
  std::istringstream words(text);
  for (std::string word; words >> word;) {
    const std::string longer = lines.back().empty() ? word : lines.back() + " " + word;
    const bool fits = fonts.set(longer, Face::Regular, kFindingSize, 0.0).advance <= width;
    if (fits || lines.back().empty())
      lines.back() = longer;
    else
      lines.push_back(word);
  }
  return lines;
}

void drawPanel(const Panel& panel, const std::string& name, std::span<const std::string> finding,
               int left, int top, Image& page, Canvas& canvas) {
  place(page, panel.image, left, top);
  canvas.frame({left, top}, {panel.image.width, panel.image.height}, 1.0, ink::frame);
  const Vector2d corner(left, top + panel.image.height);
  canvas.text(corner + Vector2d(2.0, 30.0), name, {16.0, Face::Bold, Align::Left, ink::text});
  canvas.text(corner + Vector2d(20.0, 30.0), panel.caption,
              {16.0, Face::Regular, Align::Left, ink::text});
  for (std::size_t i = 0; i < finding.size(); ++i)
    canvas.text(corner + Vector2d(20.0, 52.0 + kLine * static_cast<double>(i)), finding[i],
                {kFindingSize, Face::Regular, Align::Left, ink::secondary});
}

}  // namespace

Image drawSheet(std::span<const Panel> panels, int columns, const std::string& title,
                const std::string& subtitle, Fonts& fonts) {
  if (panels.empty() || columns < 1)
    throw std::invalid_argument("a sheet needs a panel and a column");
  const int width = panels[0].image.width, height = panels[0].image.height;
  for (const Panel& panel : panels)
    if (panel.image.width != width || panel.image.height != height)
      throw std::invalid_argument("the panels of a sheet must have one size");

  // Findings on as many lines as the longest needs.
  std::vector<std::vector<std::string>> findings;
  std::size_t lines = 1;
  for (const Panel& panel : panels) {
    findings.push_back(wrapped(panel.finding, width - 20.0, fonts));
    lines = std::max(lines, findings.back().size());
  }

  const int count = static_cast<int>(panels.size()), across = std::min(columns, count);
  const int rows = (count + across - 1) / across;
  const int row = height + kCaption + kLine * static_cast<int>(lines);
  Image page{2 * kMargin + across * width + (across - 1) * kGutter, kTop + rows * row, {}};
  page.rgb.resize(3u * static_cast<std::size_t>(page.width) * page.height);
  Canvas canvas(page, fonts, 1.0);
  canvas.setPaper(ink::page);
  canvas.fill({0.0, 0.0}, {canvas.width(), canvas.height()}, ink::page);
  for (int i = 0; i < count; ++i)
    drawPanel(panels[i], letter(i), findings[static_cast<std::size_t>(i)],
              kMargin + i % across * (width + kGutter), kTop + i / across * row, page, canvas);
  canvas.text({32.0, 46.0}, title, {22.0, Face::Bold, Align::Left, ink::text});
  canvas.text({32.0, 70.0}, subtitle, {15.0, Face::Regular, Align::Left, ink::secondary});
  return page;
}

}  // namespace tumble
