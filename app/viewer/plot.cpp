// The viewer's plot: one quantity of the run, or of the picked body, against time.
#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "app/claim/quantity.h"
#include "app/viewer/viewer.h"

namespace tumble {

namespace {

constexpr std::size_t kPoints = 256;  // of a curve
constexpr float kHeight = 90.0f;      // [px]

// Values at kPoints samples spread over all, or at all of fewer; 0 where there is none.
std::vector<float> valuesOf(const Gauge& gauge, const std::vector<Sample>& samples) {
  const std::size_t count = std::min(kPoints, samples.size());
  std::vector<float> values;
  for (std::size_t k = 0; k < count; ++k) {
    const double value = gauge(samples[count == 1 ? 0 : k * (samples.size() - 1) / (count - 1)]);
    values.push_back(std::isfinite(value) ? static_cast<float>(value) : 0.0f);
  }
  return values;
}

}  // namespace

void Viewer::choosePlot() {
  const auto offer = [&](const std::string& name, const char* meaning) {
    if (ImGui::Selectable(name.c_str(), name == plotted_)) plotted_ = name;
    if (ImGui::IsItemHovered()) ImGui::SetTooltip("%s", meaning);
  };
  ImGui::SetNextItemWidth(ImGui::GetContentRegionAvail().x);
  if (!ImGui::BeginCombo("##plotted", plotted_.empty() ? "nothing" : plotted_.c_str())) return;
  if (ImGui::Selectable("nothing", plotted_.empty())) plotted_.clear();
  if (picked_)
    for (const Quantity& one : bodyQuantities())
      offer(scene_->world.bodies[*picked_].name + "." + one.name, one.meaning);
  for (const Quantity& one : runQuantities()) offer(one.name, one.meaning);
  ImGui::EndCombo();
}

void Viewer::plot() {
  ImGui::Spacing();
  choosePlot();
  if (plotted_.empty()) return;
  const auto gauge = Gauge::named(*scene_, plotted_);
  if (!gauge) return plotted_.clear();
  const std::vector<float> values = valuesOf(*gauge, recording_->samples);
  const auto [low, high] = std::minmax_element(values.begin(), values.end());
  const double now = (*gauge)(recording_->samples[playback_.sample()]);
  const std::string unit = gauge->quantity().unit;
  ImGui::PlotLines("##plot", values.data(), static_cast<int>(values.size()), 0, nullptr, *low,
                   *high, {ImGui::GetContentRegionAvail().x, kHeight});
  // Where the picture stands.
  const ImVec2 from = ImGui::GetItemRectMin(), to = ImGui::GetItemRectMax();
  const double share = playback_.end() > 0.0 ? playback_.time() / playback_.end() : 0.0;
  const float inset = ImGui::GetStyle().FramePadding.x;
  const float x = from.x + inset + static_cast<float>(share) * (to.x - from.x - 2.0f * inset);
  ImGui::GetWindowDrawList()->AddLine({x, from.y}, {x, to.y}, IM_COL32(0xd5, 0x40, 0x1a, 0xff));
  ImGui::TextUnformatted(fmt::format("{:.4g} {}", now, unit).c_str());
  ImGui::TextDisabled("%s", fmt::format("{:.4g} to {:.4g} {}", *low, *high, unit).c_str());
}

}  // namespace tumble
