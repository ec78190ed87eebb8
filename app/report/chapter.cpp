#include "app/report/chapter.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>

#include "app/file/html.h"
#include "app/report/headline.h"

namespace tumble {

namespace {

constexpr const char* kCharts =
    R"(<p>Good is lower left. Each point is one run: across, the error that the figure names, over the whole
run; upwards, the CPU seconds that a simulated second takes, the least of at least five runs made for
the clock alone. The dashed line is what double precision leaves to any method: the error of starts
that differ in the last place. The order in the legend is the slope of error over step, fitted where the
curve is straight and rounding has no part. The exact method takes no steps and is one point; it
is held to small steps from sample to sample, and shown no further left than the rounding.</p>
)";

template <class Figures>  // whose elements have a name, a title and a subtitle
void addFigures(const Figures& figures, Chapter& chapter) {
  for (const auto& figure : figures)
    chapter.figures.push_back({figure.name, figure.title, figure.subtitle});
}

std::string titleOf(const std::string& chapter) {
  if (chapter.empty()) return "Charts";
  std::string title = chapter;
  title[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(title[0])));
  return title;
}

std::string headlineTable(const std::vector<HeadlineRow>& rows) {
  std::string out = "<table><tr><th>scene</th><th>curve</th>";
  for (const double goal : kGoals) out += fmt::format("<th>CPU s per s to {:.0e}</th>", goal);
  out += "<th>best error</th></tr>\n";
  for (const HeadlineRow& row : rows) {
    out += fmt::format("<tr><td>{}</td><td>{}</td>", htmlText(row.scene), htmlText(row.curve));
    for (const std::optional<double>& cost : row.cost)
      out += cost ? fmt::format("<td>{:.1e}</td>", *cost) : "<td>–</td>";
    out += fmt::format("<td>{:.1e}</td></tr>\n", row.best);
  }
  return out + "</table>\n";
}

std::string slopeTable(const std::vector<Scaling>& scalings) {
  std::string out = "<table><tr><th>what</th><th>by</th><th>slope</th></tr>\n";
  for (const Scaling& scaling : scalings)
    for (const ScalingCurve& curve : scaling.curves)
      out += fmt::format("<tr><td>{}</td><td>{}</td><td>{:.2f}</td></tr>\n",
                         htmlText(scaling.title), htmlText(curve.label), curve.slope);
  return out + "</table>\n";
}

}  // namespace

PageFigure figureOf(const Study& study) {
  return {study.name, study.chart.variant.title, study.chart.subtitle};
}

std::vector<Chapter> chaptersOf(const std::vector<Study>& studies,
                                const std::vector<Profile>& methods) {
  std::vector<Chapter> chapters;
  for (const Study& study : studies) {
    const std::string title = titleOf(study.chapter);
    auto found = std::find_if(chapters.begin(), chapters.end(),
                              [&](const Chapter& chapter) { return chapter.title == title; });
    if (found == chapters.end())
      found = chapters.insert(found, {title, chapters.empty() ? kCharts : "", {}, ""});
    found->figures.push_back(figureOf(study));
  }
  Chapter& accuracy = chapters.emplace_back();
  accuracy.title = "Time to an accuracy";
  accuracy.introduction =
      "<p>CPU seconds for a simulated second of the cheapest run of a curve that is right to so "
      "much; <a href=\"table.csv\">numbers</a>, <a href=\"table.md\">Markdown</a>.</p>\n";
  addFigures(methods, accuracy);
  accuracy.table = headlineTable(headlineRows(studies));
  return chapters;
}

Chapter bendingChapter(const std::vector<Study>& studies) {
  Chapter chapter{"What bends",
                  "<p>Cloth and soft solids by implicit steps: how far they are from where small "
                  "steps lead, against CPU time, by preset. The order is the slope of error over "
                  "step. Presets that sweep end where a sweep changes speeds by less than their "
                  "tolerance.</p>\n",
                  {},
                  ""};
  for (const Study& study : studies) chapter.figures.push_back(figureOf(study));
  return chapter;
}

Chapter solverChapter(const std::vector<Profile>& profiles) {
  Chapter chapter{"Solvers on what the demos ask",
                  "<p>For what share of the problems a solver takes at most so many times the CPU "
                  "time of the fastest; where a curve ends is the share that it solves. The "
                  "residual is that of the natural map, over the largest velocity of the "
                  "problem.</p>\n",
                  {},
                  ""};
  addFigures(profiles, chapter);
  return chapter;
}

Chapter growthChapter(const std::vector<Scaling>& scalings) {
  Chapter chapter{"Growth",
                  "<p>CPU time against size, both logarithmic: a cost that grows with its size "
                  "alone has slope 1.</p>\n",
                  {},
                  slopeTable(scalings)};
  addFigures(scalings, chapter);
  return chapter;
}

Chapter priceChapter(const std::vector<Price>& prices) {
  return {
      "What a scene pays for",
      "<p>Scenes that differ by one thing, and what the world uses of its machinery for each. CPU "
      "microseconds for a simulated second, by every method that takes the scene, with 240 "
      "steps a second where it takes steps; <a href=\"prices.csv\">numbers</a>.</p>\n",
      {},
      priceTable(prices)};
}

Chapter convergenceChapter(const std::vector<SpeedOfScene>& demos) {
  Chapter chapter;
  chapter.title = "Convergence";
  chapter.introduction = fmt::format(
      "<p>The first {:g} s of each demo by every method that takes it, at the demo's step, its "
      "half, quarter and eighth. The error is Richardson's estimate of how far [m] the farthest "
      "point of a body is from where it would be without steps; a method without a step has what "
      "the last place of its start changes. The reference is `exact` where it came so far, else "
      "the method with the least error. No run takes more than {:g} CPU s: it is ended there, and "
      "finer ones are not begun, as the table says; `tumble converge` has no such bound. <a "
      "href=\"convergence.csv\">Numbers</a>.</p>\n",
      kDemoSpan, kDemoBudget);
  std::vector<Convergence> tables;
  for (const SpeedOfScene& demo : demos) {
    tables.push_back(demo.convergence);
    if (drawable(demo.speed)) chapter.figures.push_back(figureOf(demo.speed));
  }
  chapter.table = convergenceTable(tables);
  return chapter;
}

}  // namespace tumble
