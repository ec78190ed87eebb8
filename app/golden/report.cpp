#include "app/golden/report.h"

#include <fmt/core.h>

#include <algorithm>

#include "app/file/html.h"

namespace tumble {

namespace {

constexpr const char* kHead = R"html(<!doctype html>
<html lang="en"><head><meta charset="utf-8"><title>Goldens that fail</title>
<meta name="viewport" content="width=device-width, initial-scale=1">
<style>
body { font: 16px/1.5 Lato, sans-serif; color: #2b2f36; background: #f8f8f6; margin: 2em auto; max-width: 1100px; padding: 0 12px; }
h2 { margin: 2em 0 0; } p { margin: .3em 0 .8em; } figure { margin: 0; } figcaption { font-size: 14px; }
code { background: #ebeff4; padding: 1px 4px; } a { color: #0a63b0; }
.row { display: grid; grid-template-columns: repeat(3, 1fr); gap: 12px; } .row img { width: 100%; }
.wipe { position: relative; width: 960px; max-width: 100%; } .wipe img { display: block; width: 100%; }
.wipe img + img { position: absolute; inset: 0; clip-path: inset(0 0 0 50%); }
input[type=range] { width: 960px; max-width: 100%; } svg { width: 100%; max-width: 960px; background: #fff; }
</style></head><body><h1>Goldens that fail</h1>
)html";

constexpr const char* kTail = R"html(<script>
for (const slider of document.querySelectorAll('input[type=range]')) {
  const over = slider.previousElementSibling.lastElementChild;
  slider.oninput = () => over.style.clipPath = `inset(0 0 0 ${slider.value}%)`;
}
</script></body></html>
)html";

std::string embedded(const Image& image, const char* what) {
  return fmt::format("<img alt=\"{}\" src=\"data:image/png;base64,{}\">", what,
                     base64(encodePng(image)));
}

std::string figure(const Image& image, const char* what) {
  return fmt::format("<figure>{}<figcaption>{}</figcaption></figure>\n", embedded(image, what),
                     what);
}

std::string imagePart(const Finding& finding) {
  std::string html;
  if (finding.expected && finding.actual && finding.image.sameSize) {
    html += "<div class=\"wipe\">" + embedded(*finding.expected, "expected") +
            embedded(*finding.actual, "actual") +
            "</div><input type=\"range\" min=\"0\" max=\"100\" value=\"50\" "
            "aria-label=\"wipe between expected (left) and actual (right)\">\n"
            "<p>left of the wipe: expected; right of it: actual</p>\n";
  }
  html += "<div class=\"row\">";
  if (finding.expected) html += figure(*finding.expected, "expected");
  if (finding.actual) html += figure(*finding.actual, "actual");
  if (finding.expected && finding.actual && finding.image.sameSize)
    html += figure(differenceImage(*finding.expected, *finding.actual), "difference × 16");
  return html + "</div>\n";
}

// Points of a curve in a field of 940 × 180 below and right of (10, 10).
std::string pointsOf(const Column& curve, std::pair<double, double> x,
                     std::pair<double, double> y) {
  std::string points;
  for (std::size_t k = 0; k < curve.x.size(); ++k) {
    const double u = (curve.x[k] - x.first) / (x.second - x.first);
    const double v = (curve.y[k] - y.first) / (y.second - y.first);
    points += fmt::format("{:.2f},{:.2f} ", 10.0 + 940.0 * u, 190.0 - 180.0 * v);
  }
  return points;
}

// The least interval that has both in it, not empty.
std::pair<double, double> spanOf(const std::vector<double>& a, const std::vector<double>& b) {
  double lo = a.front(), hi = a.front();
  for (const std::vector<double>* values : {&a, &b})
    for (const double value : *values) {
      lo = std::min(lo, value);
      hi = std::max(hi, value);
    }
  return {lo, hi > lo ? hi : lo + 1.0};
}

// Both curves in one field, or what one has above the other in a field of its own.
std::string plot(const Column& expected, const Column& actual, const std::string& caption) {
  const auto x = spanOf(expected.x, actual.x), y = spanOf(expected.y, actual.y);
  return fmt::format(
      "<figure><svg viewBox=\"0 0 960 200\" role=\"img\" aria-label=\"{0}\">"
      "<polyline fill=\"none\" stroke=\"#2b2f36\" stroke-width=\"4\" opacity=\".35\" "
      "points=\"{1}\"/><polyline fill=\"none\" stroke=\"#d5401a\" stroke-width=\"1.5\" "
      "points=\"{2}\"/></svg><figcaption>{0}; t from {3:.6g} to {4:.6g} s, upward from {5:.6g} to "
      "{6:.6g}</figcaption></figure>\n",
      caption, pointsOf(expected, x, y), pointsOf(actual, x, y), x.first, x.second, y.first,
      y.second);
}

std::string numberPart(const Finding& finding) {
  const NumberDifference& numbers = *finding.numbers;
  const Column expected = columnOf(finding.expectedCsv, numbers.line, numbers.column);
  const Column actual = columnOf(finding.actualCsv, numbers.line, numbers.column);
  if (expected.x.size() < 2 || actual.x.size() != expected.x.size()) return "";
  Column zero = expected, difference = actual;
  for (std::size_t k = 0; k < expected.x.size(); ++k) {
    difference.y[k] -= expected.y[k];
    zero.y[k] = 0.0;
  }
  return plot(expected, actual, "the worst column: expected broad and grey, actual thin and red") +
         plot(zero, difference, "actual minus expected");
}

std::string anchorOf(const Finding& finding) {
  return htmlText(finding.subject + "-" + finding.name);
}

std::string listOf(const Holding& holding) {
  std::string html = "<ol>\n";
  for (const Finding& finding : holding.findings)
    if (!finding.passes())
      html += fmt::format("<li><a href=\"#{}\">{}: {}</a> – {}</li>\n", anchorOf(finding),
                          htmlText(finding.subject), htmlText(finding.name),
                          htmlText(finding.verdict()));
  return html + "</ol>\n";
}

}  // namespace

std::string htmlReport(const Holding& holding) {
  std::string html = kHead;
  html += fmt::format("<p>{} of {} goldens in <code>{}</code> pass. {}</p>\n", holding.passing(),
                      holding.findings.size(), htmlText(holding.folder),
                      htmlText(holding.environment()));
  html += listOf(holding);
  for (const Finding& finding : holding.findings) {
    if (finding.passes()) continue;
    html +=
        fmt::format("<h2 id=\"{}\">{}: {}</h2>\n<p>{}</p>\n<p>accept it with <code>{}</code></p>\n",
                    anchorOf(finding), htmlText(finding.subject), htmlText(finding.name),
                    htmlText(finding.verdict()), htmlText(holding.approvalOf(finding.subject)));
    html += finding.numbers ? numberPart(finding) : imagePart(finding);
  }
  return html + kTail;
}

}  // namespace tumble
