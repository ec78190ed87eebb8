#include "app/viewer/ui_context.h"

#include <imgui.h>

#include <filesystem>

#include "render/context/context.h"

namespace tumble {

namespace {

constexpr float kSize = 17.0f;  // [px]

// Latin with its marks from Lato; Greek, indices, arrows and mathematics from DejaVu.
constexpr ImWchar kLatin[] = {0x20, 0xff, 0x2013, 0x2014, 0x2019, 0x2019, 0};
constexpr ImWchar kSymbols[] = {0x370,  0x3ff,  0x2070, 0x209f, 0x2190, 0x21ff,
                                0x2200, 0x22ff, 0x25a0, 0x25ff, 0};

void addFont(const std::string& file, const ImWchar* ranges, bool merge) {
  if (!std::filesystem::is_regular_file(file))
    throw NoContext("the font '" + file + "' is missing; install fonts-lato and fonts-dejavu-core");
  ImFontConfig config;
  config.MergeMode = merge;
  ImGui::GetIO().Fonts->AddFontFromFileTTF(file.c_str(), kSize, &config, ranges);
}

ImVec4 colour(unsigned rgb) {
  return {(rgb >> 16 & 255) / 255.0f, (rgb >> 8 & 255) / 255.0f, (rgb & 255) / 255.0f, 1.0f};
}

void style() {
  ImGui::StyleColorsLight();
  ImGuiStyle& style = ImGui::GetStyle();
  style.WindowRounding = 0.0f;
  style.FrameRounding = 3.0f;
  style.WindowBorderSize = 0.0f;
  style.WindowPadding = {16.0f, 14.0f};
  style.ItemSpacing = {8.0f, 7.0f};
  style.Colors[ImGuiCol_Text] = colour(0x2b2d35);
  style.Colors[ImGuiCol_WindowBg] = colour(0xf6f4ef);
  style.Colors[ImGuiCol_FrameBg] = colour(0xe6e2d9);
  style.Colors[ImGuiCol_Button] = colour(0xe6e2d9);
  style.Colors[ImGuiCol_ButtonHovered] = colour(0xd5dee8);
  style.Colors[ImGuiCol_Header] = colour(0xc7d3dd);
  style.Colors[ImGuiCol_HeaderHovered] = colour(0xdae0e4);
  style.Colors[ImGuiCol_CheckMark] = colour(0x3a6fa8);
  style.Colors[ImGuiCol_SliderGrab] = colour(0x3a6fa8);
  style.Colors[ImGuiCol_SliderGrabActive] = colour(0xd5401a);
}

}  // namespace

UiContext::UiContext(const std::string& fonts) {
  ImGui::CreateContext();
  ImGui::GetIO().IniFilename = nullptr;
  try {
    addFont(fonts + "/Lato-Regular.ttf", kLatin, false);
    addFont(fonts + "/DejaVuSans.ttf", kSymbols, true);
  } catch (...) {
    ImGui::DestroyContext();
    throw;
  }
  style();
}

UiContext::~UiContext() {
  ImGui::DestroyContext();
}

}  // namespace tumble
