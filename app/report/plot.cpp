#include "app/report/plot.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <limits>

extern char** environ;

namespace tumble {

namespace {

// Masataka Okabe and Kei Ito, Color Universal Design, 2008, without its yellow, and three of Paul
// Tol's; with a marker each.
constexpr std::array kColours = {"#D55E00", "#0072B2", "#009E73", "#CC79A7", "#56B4E9", "#E69F00",
                                 "#000000", "#7F7F7F", "#882255", "#332288", "#999933"};
constexpr std::array kMarkers = {7, 5, 9, 13, 11, 6, 4, 8, 12, 3, 10};

struct Figure {
  const char *kind, *terminal;
  std::string_view end;  ///< of a whole file
};
constexpr Figure kFigures[] = {
    {"svg", "svg size 960,600 dynamic font 'Lato,13' background 'white'", "</svg>\n"},
    {"png", "pngcairo size 960,600 font 'Lato,11'", "IEND\xAE\x42\x60\x82"},
};

// A text inside gnuplot's single quotes, where nothing but the quote has a meaning; within double
// quotes it would run what stands between backticks.
std::string quotedText(std::string_view text) {
  std::string out = "'";
  for (const char c : text) {
    if (c == '\'') out += c;
    out += c == '\n' ? ' ' : c;
  }
  return out + "'";
}

// A file beside the script, quoted; without a folder gnuplot takes a name like "<ls" for a command.
std::string quotedFile(const std::string& name, const char* kind) {
  return quotedText(fmt::format("./{}.{}", name, kind));
}

std::string curveTitle(const Study& study, std::size_t i) {
  const std::string& label = study.series[i].label;
  if (i < study.notes.size()) return fmt::format("{}  ({})", label, study.notes[i]);
  return study.orders[i] ? fmt::format("{}  (order {:.1f})", label, *study.orders[i]) : label;
}

constexpr const char* kStyle = R"(set datafile separator ','
set logscale xy
set format xy '10^{%L}'
set grid xtics ytics linecolor rgb '#d8dbe0'
set border linecolor rgb '#5c636e'
set key outside right top Left reverse samplen 2 spacing 1.15 noenhanced
)";

// The errors drawn, in whole decades: from the least, or from the floor if that is below, to the
// largest, of which what is above 10 is left out unless all are.
std::string errorRange(const Study& study) {
  double least = std::numeric_limits<double>::max(), largest = 0.0;
  for (const ChartSeries& series : study.series)
    for (const ChartPoint& point : series.points) {
      if (!(point.error > 0.0) || !std::isfinite(point.error)) continue;
      least = std::min(least, point.error);
      largest = std::max(largest, point.error);
    }
  const double floor = study.chart.floor.value_or(0.0);
  const auto decade = [](double x) { return static_cast<int>(std::floor(std::log10(x))); };
  return fmt::format("[1e{}:1e{}]", decade(floor > 0.0 ? std::min(least, floor) : least),
                     std::max(std::min(1, decade(largest) + 1), decade(least) + 1));
}

std::string curves(const Study& study, std::span<const std::string> labels) {
  std::string text;
  std::size_t row = 0;  // of the numbers below their header
  for (std::size_t i = 0; i < study.series.size(); ++i) {
    const std::size_t first = row;
    row += study.series[i].points.size();
    const std::size_t style = static_cast<std::size_t>(
        std::find(labels.begin(), labels.end(), study.series[i].label) - labels.begin());
    text += fmt::format(
        "{}{} skip 1 every ::{}::{} using 4:6 with linespoints linewidth {} "
        "pointtype {} pointsize {} linecolor rgb '{}' title {}",
        i == 0 ? "plot " : ", \\\n     ", quotedFile(study.name, "csv"), first, row - 1,
        i == 0 ? 3.5 : 1.5, kMarkers[style % kMarkers.size()], i == 0 ? 1.1 : 0.8,
        kColours[style % kColours.size()], quotedText(curveTitle(study, i)));
  }
  return text + "\n";
}

// The head of a script: what it draws, its axes, title and captions.
std::string headOf(const std::string& name, const std::string& across, const std::string& upwards,
                   const std::string& title, const std::string& subtitle,
                   const std::string& caption) {
  std::string script =
      fmt::format("# gnuplot {}: draws {}\n", quotedFile(name, "gp"), quotedFile(name, "csv"));
  script += kStyle;
  script += fmt::format("set xlabel {}\nset ylabel {}\n", quotedText(across), quotedText(upwards));
  script += fmt::format("set title {} noenhanced\n", quotedText(title));
  script += fmt::format("set label 1 {} at graph 0, screen 0.055 font ',9' noenhanced\n",
                        quotedText(subtitle));
  script += fmt::format("set label 2 {} at graph 0, screen 0.02 font ',9' noenhanced\n",
                        quotedText(caption));
  return script + "set bmargin 6.5\n";
}

std::string pathOf(const Figure& figure, const std::string& folder, const std::string& name) {
  return fmt::format("{}/{}.{}", folder, name, figure.kind);
}

void removeFigures(const std::string& folder, const std::string& name) {
  std::error_code ignored;
  for (const Figure& figure : kFigures)
    std::filesystem::remove(pathOf(figure, folder, name), ignored);
}

// gnuplot ends well even where it could not write all of a file, or nothing.
void requireWhole(const Figure& figure, const std::string& folder, const std::string& name) {
  const std::string path = pathOf(figure, folder, name);
  std::string content = std::filesystem::exists(path) ? readFile(path) : "";
  while (content.ends_with("\n\n")) content.pop_back();
  if (!content.ends_with(figure.end))
    throw FileError(fmt::format("gnuplot left '{}' {}; is there room on the disk?", path,
                                content.empty() ? "empty" : "incomplete"));
}

// Runs gnuplot on <name>.gp in the folder.
void execute(const std::string& folder, const std::string& name) {
  std::string program = "gnuplot", script = "./" + name + ".gp";
  char* const arguments[] = {program.data(), script.data(), nullptr};
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addchdir_np(&actions, folder.c_str());
  pid_t process = -1;
  const int error =
      ::posix_spawnp(&process, program.c_str(), &actions, nullptr, arguments, environ);
  posix_spawn_file_actions_destroy(&actions);
  if (error != 0)
    throw NoGnuplot(fmt::format(
        "cannot run gnuplot, which draws the figures: {}; install the package gnuplot-nox. The "
        "numbers are in '{}'",
        std::strerror(error), folder));
  int status = -1;
  while (::waitpid(process, &status, 0) < 0 && errno == EINTR) {
  }
  if (!WIFEXITED(status) || WEXITSTATUS(status) != 0)
    throw FileError(
        fmt::format("gnuplot could not draw '{}/{}.gp'; see its words above", folder, name));
}

}  // namespace

std::vector<std::string> labelsOf(std::span<const Study> studies) {
  std::vector<std::string> labels;
  for (const Study& study : studies)
    for (const ChartSeries& series : study.series)
      if (std::find(labels.begin(), labels.end(), series.label) == labels.end())
        labels.push_back(series.label);
  return labels;
}

std::string plotScript(const Study& study, std::span<const std::string> labels,
                       const std::string& caption) {
  std::string script = headOf(study.name, "error", "CPU seconds per simulated second",
                              study.chart.variant.title, study.chart.subtitle, caption);
  script += fmt::format("set xrange {}\n", errorRange(study));
  if (study.chart.floor && *study.chart.floor > 0.0)
    script += fmt::format(
        "set arrow 1 from {0:.3g}, graph 0 to {0:.3g}, graph 1 nohead dashtype 2 linecolor rgb "
        "'#5c636e'\nset label 3 'rounding' at {0:.3g}, graph 0.97 rotate by 90 right offset "
        "0.8, 0 font ',9'\n",
        *study.chart.floor);
  for (const Figure& figure : kFigures) {
    script += fmt::format("set terminal {}\nset output {}\n", figure.terminal,
                          quotedFile(study.name, figure.kind));
    script += curves(study, labels);
  }
  return script;
}

std::string plotScript(const Scaling& scaling, const std::string& caption) {
  std::string script = headOf(scaling.name, scaling.across, scaling.upwards, scaling.title,
                              scaling.subtitle, caption);
  for (const Figure& figure : kFigures) {
    script += fmt::format("set terminal {}\nset output {}\n", figure.terminal,
                          quotedFile(scaling.name, figure.kind));
    std::size_t row = 0;
    for (std::size_t i = 0; i < scaling.curves.size(); ++i) {
      const ScalingCurve& curve = scaling.curves[i];
      const std::size_t first = row;
      row += curve.points.size();
      script += fmt::format(
          "{}{} skip 1 every ::{}::{} using 2:3 with linespoints linewidth 1.5 pointtype {} "
          "pointsize 0.9 linecolor rgb '{}' title {}",
          i == 0 ? "plot " : ", \\\n     ", quotedFile(scaling.name, "csv"), first, row - 1,
          kMarkers[i % kMarkers.size()], kColours[i % kColours.size()],
          quotedText(fmt::format("{}  (slope {:.2f})", curve.label, curve.slope)));
    }
    script += "\n";
  }
  return script;
}

std::string plotScript(const Profile& profile, const std::string& caption) {
  std::string script = headOf(profile.name, "times the fastest", "share of the problems",
                              profile.title, profile.subtitle, caption);
  script += "unset logscale y\nset format y '%g'\nset yrange [0:1.02]\n";
  for (const Figure& figure : kFigures) {
    script += fmt::format("set terminal {}\nset output {}\n", figure.terminal,
                          quotedFile(profile.name, figure.kind));
    std::size_t row = 0;
    for (std::size_t i = 0; i < profile.curves.size(); ++i) {
      const auto steps = profileSteps(profile, i);
      const std::size_t first = row;
      row += steps.size();
      script += fmt::format(
          "{}{} skip 1 every ::{}::{} using 2:3 with steps linewidth 2.5 linecolor rgb '{}' title "
          "{}",
          i == 0 ? "plot " : ", \\\n     ", quotedFile(profile.name, "csv"), first, row - 1,
          kColours[i % kColours.size()],
          quotedText(
              fmt::format("{}  ({:.0f} %)", profile.curves[i].label, 100.0 * steps.back().second)));
    }
    script += "\n";
  }
  return script;
}

void runGnuplot(const std::string& folder, const std::string& name) {
  // A figure of an earlier run would pass for one of this; after a failure none is left.
  removeFigures(folder, name);
  try {
    execute(folder, name);
    for (const Figure& figure : kFigures) requireWhole(figure, folder, name);
  } catch (const FileError&) {
    removeFigures(folder, name);
    throw;
  }
}

}  // namespace tumble
