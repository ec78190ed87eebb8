#include "app/golden/report.h"

#include <fmt/core.h>

#include "app/file/html.h"

namespace tumble {

std::string base64(const std::vector<std::uint8_t>& bytes) {
  static const char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const std::size_t count = std::min<std::size_t>(3, bytes.size() - i);
    std::uint32_t triple = 0;
    for (std::size_t k = 0; k < 3; ++k) triple = triple << 8 | (k < count ? bytes[i + k] : 0u);
    for (std::size_t k = 0; k < 4; ++k)
      text += k <= count ? digits[triple >> (18 - 6 * k) & 63] : '=';
  }
  return text;
}

namespace {

constexpr const char* kHead = R"html(<!doctype html>
<html lang="en"><head><meta charset="utf-8"><title>Goldens that fail</title>
<style>
body { font: 16px/1.5 Lato, sans-serif; color: #2b2d35; background: #f6f4ef; margin: 2em auto; max-width: 1100px; }
h2 { margin: 2em 0 0; } p { margin: .3em 0 .8em; } figure { margin: 0; } figcaption { font-size: 14px; }
.row { display: grid; grid-template-columns: repeat(3, 1fr); gap: 12px; } .row img { width: 100%; }
.wipe { position: relative; width: 960px; max-width: 100%; } .wipe img { display: block; width: 100%; }
.wipe img + img { position: absolute; inset: 0; clip-path: inset(0 0 0 50%); }
input[type=range] { width: 960px; max-width: 100%; }
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
            "aria-label=\"wipe between expected (left) and actual (right)\">\n";
  }
  html += "<div class=\"row\">";
  if (finding.expected) html += figure(*finding.expected, "expected");
  if (finding.actual) html += figure(*finding.actual, "actual");
  if (finding.expected && finding.actual && finding.image.sameSize)
    html += figure(differenceImage(*finding.expected, *finding.actual), "difference × 16");
  return html + "</div>\n";
}

}  // namespace

std::string htmlReport(const std::vector<Finding>& findings, const std::string& environment) {
  std::string html = kHead;
  html += fmt::format("<p>{}</p>\n", htmlText(environment));
  for (const Finding& finding : findings) {
    if (finding.passes()) continue;
    html += fmt::format("<h2>{}: {}</h2>\n<p>{}</p>\n", htmlText(finding.subject),
                        htmlText(finding.name), htmlText(finding.verdict()));
    if (!finding.numbers) html += imagePart(finding);
  }
  return html + kTail;
}

}  // namespace tumble
