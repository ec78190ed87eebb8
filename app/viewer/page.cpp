// The page of the viewer, panel by panel.
#include <fmt/core.h>

#include "app/viewer/viewer.h"

namespace tumble {

namespace {

constexpr float kListWidth = 270.0f, kTransportHeight = 92.0f;  // [px]
constexpr ImGuiWindowFlags kPanel = ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove |
                                    ImGuiWindowFlags_NoSavedSettings |
                                    ImGuiWindowFlags_NoBringToFrontOnFocus;

void beginPanel(const char* name, float x, float y, float width, float height) {
  ImGui::SetNextWindowPos({x, y});
  ImGui::SetNextWindowSize({width, height});
  ImGui::Begin(name, nullptr, kPanel);
}

void line(const std::string& text) {
  ImGui::TextUnformatted(text.c_str());
}

}  // namespace

void Viewer::page() {
  const ImVec2 size = ImGui::GetIO().DisplaySize;
  const float width = size.x - kListWidth, height = size.y - kTransportHeight;
  keys();
  beginPanel("list", 0.0f, 0.0f, kListWidth, size.y);
  demoList();
  numbers();
  ImGui::End();

  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {0.0f, 0.0f});
  beginPanel("picture", kListWidth, 0.0f, width, height);
  ImGui::PopStyleVar();
  picture(width, height);
  ImGui::End();

  beginPanel("transport", kListWidth, height, width, kTransportHeight);
  transport();
  ImGui::End();
}

void Viewer::demoList() {
  std::string chapter = "\n";
  for (const DemoEntry& demo : demos_) {
    if (demo.chapter != chapter) {
      chapter = demo.chapter;
      ImGui::Spacing();
      ImGui::TextDisabled("%s", chapter.empty() ? "demos" : chapter.c_str());
    }
    const bool shown = scene_ && scene_->name == demo.name;
    if (ImGui::Selectable((demo.title + "##" + demo.name).c_str(), shown)) choose(demo);
  }
}

void Viewer::numbers() {
  ImGui::Spacing();
  ImGui::Separator();
  ImGui::Spacing();
  if (!complaint_.empty()) {
    ImGui::PushStyleColor(ImGuiCol_Text, {0.835f, 0.251f, 0.102f, 1.0f});
    ImGui::TextWrapped("%s", complaint_.c_str());
    ImGui::PopStyleColor();
  }
  if (!recording_) return;
  const Sample& sample = recording_->samples[playback_.sample()];
  const Certificate& certificate = recording_->report.certificate;
  line(fmt::format("t = {:.3f} s", sample.t));
  line(fmt::format("kinetic {:.4g} J", sample.kinetic));
  line(fmt::format("potential {:.4g} J", sample.potential));
  line(fmt::format("{} contact points", sample.contacts.size()));
  ImGui::Spacing();
  ImGui::TextDisabled("certificate");
  line(fmt::format("method {}", recording_->method));
  line(fmt::format("{} steps, {} events", certificate.steps, certificate.events));
  line(fmt::format("penetration {:.1e} m", certificate.max_penetration));
  line(fmt::format("energy balance {:.1e}", certificate.energy_balance_error));
}

void Viewer::picture(float width, float height) {
  if (!recording_) {
    ImGui::SetCursorPos({0.5f * width - 80.0f, 0.5f * height});
    ImGui::TextDisabled("choose a demo on the left");
    return;
  }
  if (width < 16.0f || height < 16.0f) return;
  mouse(height);
  draw(static_cast<int>(width), static_cast<int>(height));
  ImGui::Image(texture_.id(), {width, height});
}

void Viewer::mouse(float height) {
  if (!ImGui::IsWindowHovered(ImGuiHoveredFlags_AllowWhenBlockedByActiveItem)) return;
  const ImGuiIO& io = ImGui::GetIO();
  if (ImGui::IsMouseDragging(ImGuiMouseButton_Left, 0.0f))
    orbit_.turn(io.MouseDelta.x, io.MouseDelta.y, height);
  if (ImGui::IsMouseDragging(ImGuiMouseButton_Right, 0.0f))
    orbit_.pan(io.MouseDelta.x, io.MouseDelta.y, height);
  if (io.MouseWheel != 0.0f) orbit_.zoom(io.MouseWheel);
}

void Viewer::transport() {
  if (!recording_) return;
  if (ImGui::Button(playback_.playing() ? "pause" : "play", {72.0f, 0.0f})) playback_.toggle();
  ImGui::SameLine();
  if (ImGui::Button("- 1")) playback_.step(-1);
  ImGui::SameLine();
  if (ImGui::Button("+ 1")) playback_.step(1);
  ImGui::SameLine();
  if (ImGui::Button("view")) orbit_ = home_;
  ImGui::SameLine();
  for (const double speed : {0.1, 0.25, 1.0}) {
    if (ImGui::RadioButton(fmt::format("{}×", speed).c_str(), playback_.speed == speed))
      playback_.speed = speed;
    ImGui::SameLine();
  }
  ImGui::TextDisabled("drag: turn   right drag: shift   wheel: nearer");

  float time = static_cast<float>(playback_.time());
  ImGui::SetNextItemWidth(-1.0f);
  if (ImGui::SliderFloat("##time", &time, 0.0f, static_cast<float>(playback_.end()), "%.3f s"))
    playback_.seek(time);
}

void Viewer::keys() {
  const ImGuiIO& io = ImGui::GetIO();
  if (!recording_ || io.WantTextInput) return;
  const auto pressed = [](ImGuiKey key, bool repeat) {
    return ImGui::IsKeyPressed(ImGui::GetKeyIndex(key), repeat);
  };
  if (pressed(ImGuiKey_Space, false)) playback_.toggle();
  if (pressed(ImGuiKey_LeftArrow, true)) playback_.step(-1);
  if (pressed(ImGuiKey_RightArrow, true)) playback_.step(1);
  if (pressed(ImGuiKey_Home, false)) playback_.seek(0.0);
  if (pressed(ImGuiKey_End, false)) playback_.seek(playback_.end());
}

}  // namespace tumble
