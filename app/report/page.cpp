#include "app/report/page.h"

#include <fmt/format.h>

#include "app/file/file.h"
#include "app/file/html.h"

namespace tumble {

namespace {

// As a browser shows it from any place: the file's bytes in the page.
std::string embedded(const std::string& path) {
  const std::string svg = readFile(path);
  const auto* bytes = reinterpret_cast<const std::uint8_t*>(svg.data());
  return "data:image/svg+xml;base64," + base64({bytes, svg.size()});
}

std::string contents(const std::vector<Chapter>& chapters) {
  std::string out = "<nav><ul>\n";
  for (std::size_t k = 0; k < chapters.size(); ++k) {
    out += fmt::format("<li><a href=\"#chapter-{}\">{}</a></li>\n", k, htmlText(chapters[k].title));
  }
  return out + "</ul></nav>\n";
}

}  // namespace

std::string pageHead(const std::string& title) {
  constexpr const char* kStyle = R"(
<style>
body { margin: 2rem auto; max-width: 1000px; padding: 0 1rem; background: #f8f8f6; color: #2b2f36;
       font: 16px/1.5 Lato, "DejaVu Sans", sans-serif; }
h2 { margin: 4rem 0 0; } h3 { margin: 2.5rem 0 0; } p { margin: .3rem 0 1rem; color: #5c636e; }
img { width: 100%; background: #fff; } a { color: #0a63b0; } nav ul { padding-left: 1.2rem; }
table { border-collapse: collapse; font-size: 14px; font-variant-numeric: tabular-nums; }
td, th { padding: .1rem .8rem; text-align: right; border-bottom: 1px solid #e4e6ea; }
td:first-child, th:first-child, td:nth-child(2), th:nth-child(2) { text-align: left; }
@media print {
  body { margin: 0; max-width: none; padding: 0; background: none; font-size: 10pt; }
  h2, h3 { break-after: avoid; margin-top: 1rem; } section, tr { break-inside: avoid; }
  img { max-height: 11cm; width: auto; max-width: 100%; } table { font-size: 7.5pt; }
  thead { display: table-header-group; } nav, .beside { display: none; }
}
</style></head><body>
)";
  return "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><title>tumble: " +
         title +
         "</title>\n<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">" +
         kStyle + "<h1>" + title + "</h1>\n";
}

std::string figureSection(const PageFigure& figure, const std::string& folder) {
  const std::string name = htmlText(figure.name);
  std::string out = fmt::format("<section><h3 id=\"{}\">{}</h3>\n<p>{}</p>\n", name,
                                htmlText(figure.title), htmlText(figure.subtitle));
  if (!folder.empty())
    out += fmt::format("<img src=\"{}\" alt=\"{}\">\n",
                       embedded(folder + "/" + figure.name + ".svg"), htmlText(figure.title));
  return out + fmt::format(
                   "<p class=\"beside\"><a href=\"{0}.csv\">numbers</a> · "
                   "<a href=\"{0}.gp\">script</a></p></section>\n",
                   name);
}

std::string reportPage(const std::string& title, const std::string& machine,
                       const std::vector<Chapter>& chapters, const std::string& folder) {
  std::string out = pageHead(title);
  out += fmt::format("<p>Measured on {}.</p>\n", htmlText(machine));
  if (chapters.size() > 1) out += contents(chapters);
  for (std::size_t k = 0; k < chapters.size(); ++k) {
    const Chapter& chapter = chapters[k];
    out += fmt::format("<h2 id=\"chapter-{}\">{}</h2>\n{}", k, htmlText(chapter.title),
                       chapter.introduction);
    for (const PageFigure& figure : chapter.figures) out += figureSection(figure, folder);
    out += chapter.table;
  }
  return out + "</body></html>\n";
}

}  // namespace tumble
