#include "render/sheet.h"

#include <algorithm>
#include <stdexcept>
#include <vector>

#include "render/canvas.h"

namespace tumble {
namespace {

using Eigen::Vector2d;

constexpr int kMargin = 32, kGutter = 16, kTop = 100, kCaption = 48, kLine = 20;
const Canvas::TextStyle kFinding{14.0, Face::Regular, Align::Left, ink::secondary};

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
                kFinding);
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
  Image nothing;
  Canvas rule(nothing, fonts, 1.0);
  std::vector<std::vector<std::string>> findings;
  std::size_t lines = 1;
  for (const Panel& panel : panels) {
    findings.push_back(rule.lines(panel.finding, width - 20.0, kFinding));
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
