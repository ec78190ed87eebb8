#include "app/command/gallery_page.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <compare>
#include <cstdlib>
#include <map>
#include <utility>

#include "app/file/html.h"
#include "app/panel/page.h"

namespace tumble {

namespace {

// Chapters in the order of the lectures; others follow in the order of the alphabet.
std::pair<int, std::string> lectureOf(const Scene& scene) {
  constexpr std::array kLectures = {"how it works", "particles and rigid bodies",
                                    "rigid bodies", "collision",
                                    "contact",      "resting contact",
                                    "friction"};
  const auto known = std::find(kLectures.begin(), kLectures.end(), scene.chapter);
  return {static_cast<int>(known - kLectures.begin()),
          known == kLectures.end() ? scene.chapter : std::string()};
}

constexpr const char* kHead = R"(<!DOCTYPE html>
<html lang="en"><head><meta charset="utf-8"><title>tumble</title>
<meta name="viewport" content="width=device-width, initial-scale=1">
<style>
body { margin: 2rem auto; max-width: 1280px; padding: 0 1rem; background: #f8f8f6; color: #2b2f36;
       font: 16px/1.5 Lato, "DejaVu Sans", sans-serif; }
h1, h2 { font-weight: 700; } h2 { margin: 3rem 0 0; } p { margin: .3rem 0 1rem; color: #5c636e; }
figure { margin: 0 0 1rem; } figcaption { color: #5c636e; font-size: 14px; }
img, video { width: 100%; border: 1px solid #c9ced6; background: #fff; cursor: zoom-in; display: block; }
figure button { all: unset; display: block; width: 100%; } a { color: #0a63b0; }
:focus-visible { outline: 3px solid #0a63b0 !important; }
nav ul { columns: 18rem; padding-left: 1.2rem; margin: 0; } nav h2 { font-size: 1rem; margin: 1rem 0 0; }
.plates { display: grid; grid-template-columns: repeat(auto-fit, minmax(min(420px, 100%), 1fr)); gap: 1rem;
          grid-auto-flow: dense; }
details { overflow-x: auto; } code { background: #ebeff4; padding: 1px 4px; }
table { border-collapse: collapse; font-size: 14px; font-variant-numeric: tabular-nums; }
td, th { padding: .1rem .8rem; text-align: right; border-bottom: 1px solid #e4e6ea; }
td:first-child, th:first-child { text-align: left; } .failed { color: #b03010; font-weight: 700; }
@media screen { .wide { grid-column: 1 / -1; } }
@media print { .plates { grid-template-columns: repeat(4, 1fr); gap: .3rem; } h2 { margin: 1rem 0 0; break-after: avoid; }
  figure { break-inside: avoid; margin: 0; } body { margin: 0; max-width: none; font-size: 10px; } details, video, dialog { display: none; } }
dialog { width: 96vw; max-width: 96vw; border: 0; padding: 0; background: #f8f8f6; text-align: center; }
dialog img { max-height: 92vh; width: auto; max-width: 100%; border: 0; cursor: zoom-out; }
</style></head><body>
<header><h1>tumble</h1>
<p>Click a picture, or press Enter on it, to enlarge it; the arrow keys leaf through all of them.</p></header>
)";

constexpr const char* kTail =
    R"(<dialog aria-label="a picture, enlarged"><img alt=""><p><a target="_blank"></a></p></dialog>
<script>
const plates = [...document.querySelectorAll('figure img')], dialog = document.querySelector('dialog');
let now = 0;
function show(index) {
  now = (index + plates.length) % plates.length;
  dialog.querySelector('img').src = plates[now].src;
  const link = dialog.querySelector('a');
  link.href = plates[now].src;
  link.textContent = plates[now].alt + ', every pixel of it';
  if (!dialog.open) dialog.showModal();
}
plates.forEach((plate, index) => plate.parentElement.onclick = () => show(index));
dialog.onclick = () => dialog.close();
document.onkeydown = event => {
  const step = {ArrowRight: 1, ArrowLeft: -1}[event.key];
  if (step && dialog.open) show(now + step);
};
</script></body></html>
)";

std::string claimTable(const Verdict& verdict) {
  std::string out =
      fmt::format("<details{}><summary>{}</summary><table>\n", verdict.failed > 0 ? " open" : "",
                  verdict.rows.empty() ? "no claims" : toldOf(verdict));
  out += "<tr><th>claim</th><th>measured</th><th>exact</th><th>error</th><th>allowed</th></tr>\n";
  for (const ClaimRow& row : verdict.rows)
    out += fmt::format(
        "<tr{}><td>{}</td><td>{:.10g}</td><td>{}{:.10g}</td><td>{:.2g}</td><td>{:.2g}</td></tr>\n",
        row.holds() ? "" : " class=\"failed\"", htmlText(row.label), row.measured,
        signOf(row.relation), row.exact, row.error, row.allowed);
  return out + "</table></details>\n";
}

// "play it · scene · numbers: graph · tumble render drop"
std::string linksOf(const Exhibit& exhibit) {
  std::string out = "<p>";
  for (const Plate& link : exhibit.links)
    out += fmt::format("<a href=\"{}\">{}</a> · ", htmlText(link.file), htmlText(link.caption));
  return out + fmt::format("<code>tumble render {}</code></p>\n", htmlText(exhibit.scene.name));
}

std::string section(const Exhibit& exhibit) {
  const Scene& scene = exhibit.scene;
  std::string out = fmt::format("<h2 id=\"{0}\">{1}</h2>\n<p>{0}: {2}</p>\n", htmlText(scene.name),
                                htmlText(scene.title), htmlText(scene.claim));
  out += linksOf(exhibit) + "<div class=\"plates\">\n";
  for (const Plate& plate : exhibit.plates)
    out += fmt::format(
        "<figure{}><button><img loading=\"lazy\" src=\"{}\" "
        "alt=\"{}\"></button><figcaption>{}</figcaption></figure>\n",
        plate.wide ? " class=\"wide\"" : "", htmlText(plate.file),
        htmlText(scene.title + ": " + plate.caption), htmlText(plate.caption));
  if (!exhibit.film.empty())
    out += fmt::format(
        "<figure><video controls src=\"{}\"></video><figcaption>film</figcaption>"
        "</figure>\n",
        htmlText(exhibit.film));
  return out + "</div>\n" + claimTable(exhibit.verdict);
}

// A picture that shows a slide.
struct Sight {
  std::string link, text;
};

// "SD3" of a series and a number, in the order of both; then what has words in place of a number.
struct Slide {
  bool words;
  std::string series;
  int number;
  auto operator<=>(const Slide&) const = default;
};

Slide slideOf(const std::string& name) {
  const std::size_t digits = name.find_first_of("0123456789");
  if (digits == std::string::npos) return {true, name, 0};
  return {false, name.substr(0, digits), std::atoi(name.c_str() + digits)};
}

std::string nameOf(const Slide& slide) {
  return slide.words ? slide.series : slide.series + std::to_string(slide.number);
}

using Sights = std::map<Slide, std::vector<Sight>>;

void addSights(const std::vector<std::string>& slides, const std::string& link,
               const std::string& text, Sights& sights) {
  for (const std::string& slide : slides) sights[slideOf(slide)].push_back({link, text});
}

// Which picture shows which slide of the lectures.
std::string slideTable(const std::vector<const Exhibit*>& exhibits) {
  Sights sights;
  for (const Exhibit* exhibit : exhibits) {
    const Scene& scene = exhibit->scene;
    addSights(scene.slides, scene.name + "/still.png", scene.title, sights);
    for (const PanelDef& panel : scene.panels)
      addSights(panel.slides, scene.name + "/panels.png", panel.variant.title, sights);
    const auto plots = plotNames(scene);
    for (std::size_t i = 0; i < plots.size(); ++i) {
      const std::size_t chart = i - scene.graphs.size();
      addSights(i < scene.graphs.size() ? scene.graphs[i].slides : scene.charts[chart].slides,
                scene.name + "/" + plots[i].first + ".png", plots[i].second, sights);
    }
  }
  if (sights.empty()) return "";
  std::string out = "<h2 id=\"slides\">Slides and their pictures</h2>\n<table>\n";
  for (const auto& [slide, shown] : sights) {
    out += "<tr><td>" + htmlText(nameOf(slide)) + "</td><td>";
    for (std::size_t i = 0; i < shown.size(); ++i)
      out += fmt::format("{}<a href=\"{}\">{}</a>", i > 0 ? " · " : "", htmlText(shown[i].link),
                         htmlText(shown[i].text));
    out += "</td></tr>\n";
  }
  return out + "</table>\n";
}

}  // namespace

std::string galleryPage(const std::vector<Exhibit>& exhibits) {
  // In the order of the lectures, within a chapter as given.
  std::vector<const Exhibit*> order;
  for (const Exhibit& exhibit : exhibits) order.push_back(&exhibit);
  std::stable_sort(order.begin(), order.end(), [](const Exhibit* a, const Exhibit* b) {
    return lectureOf(a->scene) < lectureOf(b->scene);
  });
  std::string out = std::string(kHead) + "<nav aria-label=\"contents\">";
  for (std::size_t i = 0; i < order.size(); ++i) {
    const Scene& scene = order[i]->scene;
    const bool first = i == 0 || order[i - 1]->scene.chapter != scene.chapter;
    if (first)
      out += fmt::format("{}<h2>{}</h2>\n<ul>\n", i == 0 ? "" : "</ul>\n",
                         htmlText(scene.chapter.empty() ? "other" : scene.chapter));
    out += fmt::format("<li><a href=\"#{}\">{}</a></li>\n", htmlText(scene.name),
                       htmlText(scene.title));
  }
  out += order.empty() ? "</nav>\n<main>\n"
                       : "</ul><p><a href=\"#slides\">Slides and their pictures</a></p></nav>\n"
                         "<main>\n";
  for (const Exhibit* exhibit : order) out += section(*exhibit);
  out += slideTable(order);
  return out + "</main>\n" + kTail;
}

}  // namespace tumble
