// The page of the viewer, panel by panel.
#include <fmt/core.h>

#include "app/viewer/viewer.h"

namespace tumble {

namespace {

constexpr float kListWidth = 290.0f, kTransportHeight = 98.0f;  // [px]
constexpr ImGuiWindowFlags kPanel = ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoResize |
                                    ImGuiWindowFlags_NoCollapse | ImGuiWindowFlags_NoMove |
                                    ImGuiWindowFlags_NoSavedSettings |
                                    ImGuiWindowFlags_NoBringToFrontOnFocus;

void beginPanel(const char* name, float x, float y, float width, float height,
                ImGuiWindowFlags more = 0) {
  ImGui::SetNextWindowPos({x, y});
  ImGui::SetNextWindowSize({width, height});
  ImGui::Begin(name, nullptr, kPanel | more);
}

// A choice whose text takes as many lines as it needs.
bool choice(const std::string& text, const std::string& name, bool shown) {
  const float width = ImGui::GetContentRegionAvail().x;
  const ImVec2 size = ImGui::CalcTextSize(text.c_str(), nullptr, false, width);
  const ImVec2 place = ImGui::GetCursorPos();
  const bool chosen = ImGui::Selectable(("##" + name).c_str(), shown, 0, {width, size.y});
  const ImVec2 after = ImGui::GetCursorPos();
  ImGui::SetCursorPos(place);
  ImGui::PushTextWrapPos(place.x + width);
  ImGui::TextUnformatted(text.c_str());
  ImGui::PopTextWrapPos();
  ImGui::SetCursorPos(after);
  return chosen;
}

}  // namespace

void Viewer::page() {
  pull();
  reloadIfSaved();
  const ImVec2 size = ImGui::GetIO().DisplaySize;
  const float width = size.x - kListWidth, height = size.y - kTransportHeight;
  keys();
  const float list = (live_ ? 0.2f : 0.45f) * size.y;
  beginPanel("demos", 0.0f, 0.0f, kListWidth, list);
  demoList();
  ImGui::End();
  beginPanel("numbers", 0.0f, list, kListWidth, size.y - list);
  numbers();
  shownList();
  ImGui::End();

  // Before the picture, which then shows what was asked for without waiting for the next image.
  beginPanel("transport", kListWidth, height, width, kTransportHeight,
             ImGuiWindowFlags_NoScrollbar);
  transport();
  ImGui::End();
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {0.0f, 0.0f});
  beginPanel("picture", kListWidth, 0.0f, width, height, ImGuiWindowFlags_NoScrollbar);
  ImGui::PopStyleVar();
  picture(width, height);
  ImGui::End();
  if (helping_) help();
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
    if (choice(demo.title, demo.name, shown)) load(demo.path);
  }
}

void Viewer::picture(float width, float height) {
  if (!presenter_) {
    ImGui::SetCursorPos({0.5f * width - 110.0f, 0.5f * height});
    ImGui::TextDisabled(recorder_ ? "simulating" : "choose a demo, or drop a scene here");
    return;
  }
  if (width < 16.0f || height < 16.0f) return;
  mouse(width, height);
  draw(static_cast<int>(width), static_cast<int>(height));
  ImGui::Image(texture_.id(), {width, height});
  handLine(width, height);
}

void Viewer::mouse(float width, float height) {
  const ImGuiIO& io = ImGui::GetIO();
  if (live_ && live_->hand() && !io.MouseDown[ImGuiMouseButton_Left]) live_->hold({});
  if (!ImGui::IsWindowHovered(ImGuiHoveredFlags_AllowWhenBlockedByActiveItem)) return;
  const ImVec2 corner = ImGui::GetWindowPos();
  const float x = io.MousePos.x - corner.x, y = io.MousePos.y - corner.y;
  if (ImGui::IsMouseClicked(ImGuiMouseButton_Left)) {
    dragged_ = 0.0f;
    grip(x, y, width, height);
  }
  if (ImGui::IsMouseDragging(ImGuiMouseButton_Left, 0.0f)) {
    dragged_ += std::abs(io.MouseDelta.x) + std::abs(io.MouseDelta.y);
    if (live_ && live_->hand())
      lead(x, y, width, height);
    else
      orbit_.turn(io.MouseDelta.x, io.MouseDelta.y, height);
  }
  if (ImGui::IsMouseDragging(ImGuiMouseButton_Right, 0.0f))
    orbit_.pan(io.MouseDelta.x, io.MouseDelta.y, height);
  if (io.MouseWheel != 0.0f) orbit_.zoom(io.MouseWheel);
  // A click that does not turn the picture picks a body.
  if (ImGui::IsMouseReleased(ImGuiMouseButton_Left) && dragged_ < 4.0f) pick(x, y, width, height);
}

void Viewer::transport() {
  if (!presenter_) return;
  if (ImGui::Button(playback_.playing() ? "pause" : "play", {72.0f, 0.0f})) play();
  ImGui::SameLine();
  if (ImGui::Button("- 1")) step(-1);
  ImGui::SameLine();
  if (ImGui::Button("+ 1")) step(1);
  ImGui::SameLine();
  bool live = live_.has_value();
  if (ImGui::Checkbox("live", &live)) setLive(live);
  ImGui::SameLine();
  if (ImGui::Button("view")) orbit_ = home_, following_ = false;
  ImGui::SameLine();
  for (const double speed : {0.1, 0.25, 1.0}) {
    if (ImGui::RadioButton(fmt::format("{}×", speed).c_str(), playback_.speed == speed))
      playback_.speed = speed;
    ImGui::SameLine();
  }
  if (recorder_)
    ImGui::ProgressBar(static_cast<float>(recorder_->share()), {160.0f, 0.0f}, "simulating");
  else
    ImGui::TextDisabled("%s", told_.empty() ? "h: help" : told_.c_str());

  float time = static_cast<float>(playback_.time());
  ImGui::SetNextItemWidth(-1.0f);
  const float end = static_cast<float>(std::max(playback_.end(), 1e-9));
  if (ImGui::SliderFloat("##time", &time, 0.0f, end, "%.3f s")) playback_.seek(time);
  eventMarks();
}

// A line for each impact, above the slider's own rectangle.
void Viewer::eventMarks() {
  const ImVec2 low = ImGui::GetItemRectMin(), high = ImGui::GetItemRectMax();
  const double end = playback_.end();
  if (!(end > 0.0)) return;
  float last = -1.0f;
  for (const Event& event : recording_->report.events) {
    if (event.kind != EventKind::Impact) continue;
    const float x = low.x + static_cast<float>(std::min(1.0, event.t / end)) * (high.x - low.x);
    if (x < last + 1.0f) continue;
    last = x;
    ImGui::GetWindowDrawList()->AddLine({x, high.y - 5.0f}, {x, high.y},
                                        IM_COL32(0xd5, 0x40, 0x1a, 0xff));
  }
}

void Viewer::keys() {
  const ImGuiIO& io = ImGui::GetIO();
  const auto pressed = [](ImGuiKey key, bool repeat) {
    return ImGui::IsKeyPressed(ImGui::GetKeyIndex(key), repeat);
  };
  if (!presenter_ || io.WantTextInput) return;
  if (pressed(ImGuiKey_Space, false)) play();
  if (pressed(ImGuiKey_LeftArrow, true)) step(-1);
  if (pressed(ImGuiKey_RightArrow, true)) step(1);
  if (pressed(ImGuiKey_Home, false)) playback_.seek(0.0);
  if (pressed(ImGuiKey_End, false)) playback_.seek(playback_.end());
  // Letters come as text, whatever the keyboard's layout.
  for (const ImWchar letter : io.InputQueueCharacters) {
    if (letter == 'h' || letter == '?') helping_ = !helping_;
    if (letter == 'l') setLive(!live_);
    if (letter == 'v') orbit_ = home_, following_ = false;
    if (letter == 'f') following_ = picked_ && !following_;
    if (letter == 's') screenshot();
    if (letter == 'k') keepView();
    if (letter >= '1' && letter < '1' + static_cast<int>(kept_.size()))
      orbit_ = kept_[letter - '1'], following_ = false;
    if (letter == 'c') ImGui::SetClipboardText(command().c_str()), told_ = command();
  }
}

}  // namespace tumble
