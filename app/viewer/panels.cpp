// The panels beside the picture: what there is to read, and what is to be shown.
#include <fmt/core.h>

#include "app/viewer/viewer.h"

namespace tumble {

namespace {

void line(const std::string& text) {
  ImGui::TextUnformatted(text.c_str());
}

struct Toggle {
  const char* name;
  bool ShowFlags::*flag;
};
constexpr Toggle kToggles[] = {
    {"paths", &ShowFlags::path},           {"forces", &ShowFlags::contact_forces},
    {"normals", &ShowFlags::normals},      {"velocities", &ShowFlags::velocities},
    {"P, L, ω", &ShowFlags::momenta},      {"planes", &ShowFlags::planes},
    {"boxes", &ShowFlags::boxes},          {"glass", &ShowFlags::glass},
    {"impacts", &ShowFlags::impacts},      {"names", &ShowFlags::labels},
    {"ellipsoids", &ShowFlags::ellipsoid}, {"energy", &ShowFlags::energy}};

struct Key {
  const char *key, *what;
};
constexpr Key kKeys[] = {
    {"space", "play, pause"},
    {"← →", "one image back, on"},
    {"Home, End", "start, end"},
    {"drag", "turn;  right drag: shift;  wheel: nearer"},
    {"click", "pick a body;  f: follow it"},
    {"l", "live: it runs on from here, without an end, under settings"},
    {"", "beside the picture; drag a body to pull it"},
    {"v", "the view of the start"},
    {"k", "keep this view;  1 to 9: back to a view kept"},
    {"s", "write the picture as PNG, 1280 × 720"},
    {"c", "copy the command that draws it"},
    {"h", "this help"},
};

std::string vector(const Vec3& v) {
  return fmt::format("{:.4g}  {:.4g}  {:.4g}", v.x(), v.y(), v.z());
}

}  // namespace

void Viewer::numbers() {
  if (!complaint_.empty()) {
    ImGui::PushStyleColor(ImGuiCol_Text, {0.835f, 0.251f, 0.102f, 1.0f});
    ImGui::TextWrapped("%s", complaint_.c_str());
    ImGui::PopStyleColor();
  }
  if (!presenter_) return;
  if (live_) liveList();
  const Sample& sample = recording_->samples[playback_.sample()];
  line(fmt::format("t = {:.3f} s", sample.t));
  line(fmt::format("kinetic {:.4g} J", sample.kinetic));
  line(fmt::format("potential {:.4g} J", sample.potential));
  const std::size_t points = sample.contacts.size();
  line(fmt::format("{} contact point{}", points, points == 1 ? "" : "s"));
  plot();
  bodyNumbers();
  if (!recorder_ && !live_) certificate();
}

void Viewer::bodyNumbers() {
  if (!picked_) return;
  const BodySample& body = recording_->samples[playback_.sample()].bodies[*picked_];
  ImGui::Spacing();
  ImGui::TextDisabled("%s", scene_->world.bodies[*picked_].name.c_str());
  line("x  " + vector(body.x) + " m");
  line("v  " + vector(body.v) + " m/s");
  line("ω  " + vector(body.omega) + " rad/s");
  ImGui::Checkbox("follow (f)", &following_);
}

void Viewer::certificate() {
  const Certificate& certificate = recording_->report.certificate;
  ImGui::Spacing();
  ImGui::TextDisabled("certificate");
  line(fmt::format("method {}", recording_->method));
  line(fmt::format("{} steps, {} events", certificate.steps, certificate.events));
  line(fmt::format("penetration {:.1e} m", certificate.max_penetration));
  line(fmt::format("energy balance {:.1e}", certificate.energy_balance_error));
}

// What is drawn besides the bodies, in two columns.
void Viewer::shownList() {
  if (!presenter_) return;
  ImGui::Spacing();
  ImGui::TextDisabled("show");
  const float half = 0.5f * ImGui::GetContentRegionAvail().x;
  bool left = true;
  for (const Toggle& toggle : kToggles) {
    if (!left) ImGui::SameLine(half + 16.0f);
    if (ImGui::Checkbox(toggle.name, &(scene_->show.*toggle.flag))) ++revision_;
    left = !left;
  }
}

void Viewer::help() {
  ImGui::SetNextWindowPos({340.0f, 60.0f}, ImGuiCond_Appearing);
  ImGui::Begin("keys", &helping_,
               ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoCollapse |
                   ImGuiWindowFlags_NoSavedSettings);
  for (const auto& [key, what] : kKeys) {
    line(key);
    ImGui::SameLine(100.0f);
    line(what);
  }
  line("A scene that is saved, or dropped here, is shown anew.");
  ImGui::End();
}

}  // namespace tumble
