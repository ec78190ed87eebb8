#include "app/report/page.h"

#include <fmt/format.h>

#include "app/file/html.h"

namespace tumble {

namespace {

constexpr const char* kIntroduction =
    R"(<p>Good is lower left. Each point is one run: across, the error that the figure names, over the whole
run; upwards, the CPU seconds that a simulated second takes, the least of at least five runs made for
the clock alone. The dashed line is what double precision leaves to any method: the error of starts
that differ in the last place. The order in the legend is the slope of error over step, fitted where the
curve is straight and rounding has no part. The exact method takes no steps and is one point; it
is held to small steps from sample to sample, and shown no further left than the rounding.</p>
)";

std::string tableOf(const std::vector<HeadlineRow>& rows) {
  std::string out = "<table><tr><th>scene</th><th>method</th>";
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

void addFigure(const std::string& name, const std::string& title, const std::string& subtitle,
               bool figures, std::string& out) {
  const std::string file = htmlText(name);
  out +=
      fmt::format("<h2 id=\"{}\">{}</h2>\n<p>{}</p>\n", file, htmlText(title), htmlText(subtitle));
  if (figures)
    out += fmt::format("<a href=\"{0}.svg\"><img src=\"{0}.svg\" alt=\"{1}\"></a>\n", file,
                       htmlText(title));
  out +=
      fmt::format("<p><a href=\"{0}.csv\">numbers</a> · <a href=\"{0}.gp\">script</a></p>\n", file);
}

}  // namespace

std::string pageHead(const std::string& title) {
  constexpr const char* kStyle = R"(
<style>
body { margin: 2rem auto; max-width: 1000px; padding: 0 1rem; background: #f8f8f6; color: #2b2f36;
       font: 16px/1.5 Lato, "DejaVu Sans", sans-serif; }
h2 { margin: 3rem 0 0; } p { margin: .3rem 0 1rem; color: #5c636e; } img { width: 100%; background: #fff; }
table { border-collapse: collapse; font-size: 14px; font-variant-numeric: tabular-nums; }
td, th { padding: .1rem .8rem; text-align: right; border-bottom: 1px solid #e4e6ea; }
td:first-child, th:first-child, td:nth-child(2), th:nth-child(2) { text-align: left; }
</style></head><body>
)";
  return "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><title>tumble: " +
         title +
         "</title>\n<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">" +
         kStyle + "<h1>" + title + "</h1>\n";
}

std::string figureSection(const Study& study, bool figures) {
  std::string out;
  addFigure(study.name, study.chart.variant.title, study.chart.subtitle, figures, out);
  return out;
}

std::string reportPage(const std::vector<Study>& studies, const std::string& machine, bool figures,
                       const std::vector<Scaling>& scalings, const std::vector<Profile>& profiles) {
  std::string out = pageHead("Speed against error") + kIntroduction;
  out += fmt::format("<p>Measured on {}.</p>\n", htmlText(machine));
  for (const Study& study : studies) out += figureSection(study, figures);
  out +=
      "<h2 id=\"table\">Time to an accuracy</h2>\n<p>CPU seconds for a simulated second of the "
      "cheapest run that is right to so much; <a href=\"table.csv\">numbers</a>, "
      "<a href=\"table.md\">Markdown</a>.</p>\n";
  out += tableOf(headlineRows(studies));
  if (!scalings.empty()) out += "<h1>Detection</h1>\n";
  for (const Scaling& scaling : scalings)
    addFigure(scaling.name, scaling.title, scaling.subtitle, figures, out);
  if (!profiles.empty())
    out +=
        "<h1>Contact</h1>\n<p>For what share of the problems a solver takes at most so many times "
        "the CPU time of the fastest; where a curve ends is the share that it solves. The residual "
        "is that of the natural map, over the largest velocity of the problem.</p>\n";
  for (const Profile& profile : profiles)
    addFigure(profile.name, profile.title, profile.subtitle, figures, out);
  if (!profiles.empty())
    out +=
        "<h1>Convergence</h1>\n<p><a href=\"convergence.html\">Every demo</a> at halved steps, by "
        "every method.</p>\n";
  return out + "</body></html>\n";
}

std::string convergencePage(const std::vector<SpeedOfScene>& demos, const std::string& machine,
                            bool figures) {
  std::string out = pageHead("Convergence");
  out += fmt::format(
      "<p>The first {:g} s of each demo by every method "
      "that takes it, at the demo's step, its half, quarter and eighth. The error is Richardson's "
      "estimate of how far [m] the farthest point of a body is from where it would be without "
      "steps; a method without a step has what the last place of its start changes. The reference "
      "is `exact` where it came so far, else the method with the least error. No run takes more "
      "than {:g} CPU s: it is ended there, and finer ones are not begun, as the table says; "
      "`tumble converge` has no such bound. <a "
      "href=\"convergence.csv\">numbers</a></p>\n<p>Measured on {}.</p>\n",
      kDemoSpan, kDemoBudget, htmlText(machine));
  std::vector<Convergence> tables;
  for (const SpeedOfScene& demo : demos) tables.push_back(demo.convergence);
  out += convergenceTable(tables);
  for (const SpeedOfScene& demo : demos)
    if (drawable(demo.speed))
      addFigure(demo.speed.name, demo.speed.chart.variant.title, demo.speed.chart.subtitle, figures,
                out);
  return out + "</body></html>\n";
}

}  // namespace tumble
