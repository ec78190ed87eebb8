#include "app/command/sweeping.h"

#include <fmt/format.h>

#include <algorithm>
#include <deque>
#include <filesystem>

#include "app/claim/expect.h"
#include "app/claim/verdict.h"
#include "app/command/command.h"
#include "app/command/run.h"
#include "app/command/shoot.h"
#include "app/command/stamp.h"
#include "app/file/file.h"
#include "app/panel/variant_run.h"
#include "app/record/output.h"

namespace tumble {

namespace {

// "restitution" of "materials.rubber.restitution".
std::string lastKey(const std::string& parameter) {
  return parameter.substr(parameter.rfind('.') + 1);
}

// A value stands bare where it can, as numbers do; lists and texts with commas are quoted.
std::string csvValue(const std::string& text) {
  return text.find_first_of(",\"\n") == std::string::npos ? text : csvQuoted(text);
}

std::string csvHeader(const Scene& scene) {
  std::string header = "parameter,value,";
  for (const auto& [key, number] : kCertificateFields) header += fmt::format("{},", key);
  header += "cpu_seconds,stopped,claims,claims_failed,worst_claim,worst_error_share";
  for (const ExpectDef& expect : scene.expects) {
    const std::string label = labelOf(expect);
    header += fmt::format(",{},{}", csvValue(label), csvValue("expected: " + label));
  }
  return header + "\n";
}

// Measured and expected of each [[expect]] of the scene that is swept; two empty cells for one that
// the run does not measure.
std::string expectCells(std::size_t count, const Verdict& verdict) {
  std::vector<std::string> cells(count, ",,");
  const std::size_t first = verdict.rows.size() - verdict.expects.size();
  for (std::size_t k = 0; k < verdict.expects.size(); ++k) {
    const ClaimRow& row = verdict.rows[first + k];
    if (verdict.expects[k] < count)
      cells[verdict.expects[k]] = fmt::format(",{:.17g},{:.17g}", row.measured, row.exact);
  }
  return fmt::format("{}", fmt::join(cells, ""));
}

std::string csvRow(const Scene& scene, std::size_t k, const VariantRun& run,
                   const Verdict& verdict) {
  const Sweep& sweep = *scene.sweep;
  std::string row = fmt::format("{},{},", sweep.parameter, csvValue(sweep.values[k]));
  const Report& report = run.recording.report;
  for (const auto& [key, number] : kCertificateFields) {
    if (const auto* count = std::get_if<long Certificate::*>(&number))
      row += fmt::format("{},", report.certificate.**count);
    else
      row += fmt::format("{:.17g},", report.certificate.*std::get<double Certificate::*>(number));
  }
  row += fmt::format("{:.17g},{},{},{},{},{:.17g}", run.recording.cpuSeconds,
                     report.stopped ? 1 : 0, verdict.rows.size(), verdict.failed,
                     csvQuoted(verdict.worst), verdict.worstShare);
  return row + expectCells(scene.expects.size(), verdict) + "\n";
}

std::string findingOf(const Recording& recording, const Verdict& verdict) {
  if (recording.report.stopped) return "stopped: " + recording.report.reason;
  return toldOf(verdict);
}

// All strobes on one page.
Image drawSweep(const Scene& scene, const std::deque<VariantRun>& runs, Studio& studio) {
  ImageFormat format = scene.image;
  format.width = kSheetPanel;
  format.height = panelHeight(scene, kSheetPanel);
  format.transparent = false;
  const Eigen::Vector2d page = panelPage(scene);
  const std::vector<Panel> panels = drawPanels(
      runs, page, [&](const Picture& picture) { return studio.draw(picture, format, page.y()); });
  return drawSheet(panels, columnsOf(panels.size()), scene.title,
                   fmt::format("{} from {} to {}", scene.sweep->parameter,
                               scene.sweep->values.front(), scene.sweep->values.back()),
                   studio.fonts());
}

// Takes away what a sweep over more values left: its strobes would pass for some of this one.
void removeLater(const std::string& folder, std::size_t count) {
  std::error_code ignored;
  for (std::size_t k = count;; ++k) {
    const std::filesystem::path place = fmt::format("{}/sweep-{}", folder, k);
    if (!std::filesystem::remove(place / "strobe.png", ignored)) return;
    std::filesystem::remove(place, ignored);  // unless something else is in it
  }
}

}  // namespace

SweepResult runSweep(const Scene& scene, const std::string& folder, std::pair<int, int> part,
                     Studio& studio) {
  const Sweep& sweep = *scene.sweep;
  SweepResult result;
  std::deque<VariantRun> runs;
  std::string csv = csvHeader(scene);
  for (std::size_t k = part.first; k < sweep.values.size(); k += part.second) {
    VariantRun& run = runs.emplace_back();
    run.scene = sceneOf(scene, {"", {sweep.setting(k)}, {}});
    Shoot shoot(run.scene, fmt::format("{}/sweep-{}", folder, k), studio);
    run.recording = shoot.recording();
    const Verdict verdict = judge(run.scene, run.recording);
    run.title = lastKey(sweep.parameter) + " = " + sweep.values[k];
    run.subtitle = findingOf(run.recording, verdict);
    run.picture = [first = runs.size() == 1](const Presenter& presenter) {
      Picture picture = presenter.strobe();
      stripForPanel(picture);
      if (!first) picture.bar.reset();  // one scale, told once
      return picture;
    };
    csv += csvRow(scene, k, run, verdict);
    ++result.runs;
    result.failing += verdict.failed > 0;
    result.files.push_back(shoot.strobe());
    result.code = std::max(
        {result.code, exitOf(run.recording), static_cast<int>(verdict.failed > 0 ? kFailed : kOk)});
  }

  const bool whole = part.second == 1;
  if (whole) removeLater(folder, sweep.values.size());
  result.files.push_back(
      whole ? folder + "/sweep.csv"
            : fmt::format("{}/sweep-{}-of-{}.csv", folder, part.first, part.second));
  writeFile(result.files.back(), csv);
  if (!whole || runs.empty()) return result;
  result.files.push_back(folder + "/sweep.png");
  writePng(result.files.back(), drawSweep(scene, runs, studio), stampOf(scene, "sweep"));
  return result;
}

}  // namespace tumble
