#include "app/command/sweeping.h"

#include <fmt/format.h>

#include <algorithm>
#include <deque>

#include "app/command/command.h"
#include "app/command/run.h"
#include "app/command/shoot.h"
#include "app/command/stamp.h"
#include "app/command/verdict.h"
#include "app/present/bodies.h"
#include "app/record/file.h"
#include "render/sheet.h"

namespace tumble {

namespace {

/// One value, run.
struct Run {
  int index = 0;
  std::string value;
  Scene scene;
  Recording recording;
  Verdict verdict;
};

// "restitution" of "materials.rubber.restitution".
std::string lastKey(const std::string& parameter) {
  return parameter.substr(parameter.rfind('.') + 1);
}

std::string quoted(const std::string& text) {
  std::string out = "\"";
  for (const char c : text) out += c == '"' ? std::string("\"\"") : std::string(1, c);
  return out + "\"";
}

std::string csvHeader() {
  std::string header = "parameter,value,";
  for (const auto& [key, number] : kCertificateFields) header += fmt::format("{},", key);
  return header + "cpu_seconds,stopped,claims,claims_failed,worst_claim,worst_error_share\n";
}

std::string csvRow(const std::string& parameter, const Run& run) {
  std::string row = fmt::format("{},{},", parameter, quoted(run.value));
  const Report& report = run.recording.report;
  for (const auto& [key, number] : kCertificateFields) {
    if (const auto* count = std::get_if<long Certificate::*>(&number))
      row += fmt::format("{},", report.certificate.**count);
    else
      row += fmt::format("{:.17g},", report.certificate.*std::get<double Certificate::*>(number));
  }
  return row + fmt::format("{:.17g},{},{},{},{},{:.17g}\n", run.recording.cpuSeconds,
                           report.stopped ? 1 : 0, run.verdict.rows.size(), run.verdict.failed,
                           quoted(run.verdict.worst), run.verdict.worstShare);
}

std::string findingOf(const Run& run) {
  if (run.recording.report.stopped) return "stopped: " + run.recording.report.reason;
  if (run.verdict.rows.empty()) return "";
  if (run.verdict.failed == 0) return fmt::format("all {} claims hold", run.verdict.rows.size());
  return fmt::format("{} of {} claims fail", run.verdict.failed, run.verdict.rows.size());
}

// All strobes on one page, seen by the camera that sees every motion.
Image drawPage(const Scene& scene, const std::deque<Run>& runs, Studio& studio) {
  std::vector<Eigen::Vector3d> points;
  for (const Run& run : runs)
    for (const Eigen::Vector3d& point : motionPoints(run.scene, run.recording))
      points.push_back(point);
  const Framing framing = framingOf(scene, points);

  ImageFormat format = scene.image;
  format.width = 640;
  format.height = std::max(16, format.width * scene.image.height / scene.image.width);
  std::vector<Panel> panels;
  for (const Run& run : runs) {
    Picture picture = Presenter(run.scene, run.recording, framing).strobe();
    stripForPanel(picture);
    panels.push_back({studio.draw(picture, format),
                      lastKey(scene.sweep->parameter) + " = " + run.value, findingOf(run)});
  }
  const int columns = panels.size() <= 3 ? static_cast<int>(panels.size()) : 4;
  return drawSheet(panels, columns, scene.title,
                   fmt::format("{} from {} to {}", scene.sweep->parameter,
                               scene.sweep->values.front(), scene.sweep->values.back()),
                   studio.fonts());
}

}  // namespace

SweepResult runSweep(const SceneOptions& options, const Scene& scene, const std::string& folder,
                     std::pair<int, int> part, Studio& studio) {
  const Sweep& sweep = *scene.sweep;
  SweepResult result;
  std::deque<Run> runs;  // stays put while it grows: shoots refer to the scenes in it
  std::string csv = csvHeader();
  for (int k = part.first; k < static_cast<int>(sweep.values.size()); k += part.second) {
    SceneOptions one = options;
    one.overrides.push_back(sweep.parameter + "=" + sweep.values[static_cast<std::size_t>(k)]);
    Run& run = runs.emplace_back();
    run.index = k;
    run.value = sweep.values[static_cast<std::size_t>(k)];
    run.scene = load(one);
    Shoot shoot(run.scene, fmt::format("{}/sweep-{}", folder, k), studio);
    run.recording = shoot.recording();
    run.verdict = judge(run.scene, run.recording);
    csv += csvRow(sweep.parameter, run);
    result.files.push_back(shoot.strobe());
    result.code = std::max({result.code, exitOf(run.recording),
                            static_cast<int>(run.verdict.failed > 0 ? kFailed : kOk)});
  }

  const bool whole = part.second == 1;
  result.files.push_back(
      whole ? folder + "/sweep.csv"
            : fmt::format("{}/sweep-{}-of-{}.csv", folder, part.first, part.second));
  writeFile(result.files.back(), csv);
  if (!whole || runs.empty()) return result;
  result.files.push_back(folder + "/sweep.png");
  writePng(result.files.back(), drawPage(scene, runs, studio), stampOf(scene, "sweep"));
  return result;
}

}  // namespace tumble
