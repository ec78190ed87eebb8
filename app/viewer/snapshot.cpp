#include "app/viewer/snapshot.h"

#include "app/file/data.h"
#include "app/viewer/ui_context.h"
#include "app/viewer/viewer.h"

namespace tumble {

namespace {

void perform(const Deed& deed, ImGuiIO& io, Viewer& viewer) {
  io.MousePos = {deed.pointer.x(), deed.pointer.y()};
  io.MouseDown[0] = deed.pressed;
  io.MouseWheel = deed.wheel;
  io.AddInputCharactersUTF8(deed.typed.c_str());
  if (!deed.dropped.empty()) viewer.load(deed.dropped);
}

}  // namespace

Image viewerSnapshot(Renderer& renderer, const Scene& scene, double share, int width, int height,
                     std::span<const Deed> deeds) {
  const UiContext ui(dataFolder("fonts"));
  ImGuiIO& io = ImGui::GetIO();
  io.DisplaySize = {static_cast<float>(width), static_cast<float>(height)};
  io.DeltaTime = 1.0f / 60.0f;
  UiRenderer uiRenderer;
  Viewer viewer(renderer, {{scene.name, scene.title, scene.chapter, scene.file}});
  viewer.open(scene);
  viewer.playback().seek(share * viewer.playback().end());
  const auto page = [&] {
    ImGui::NewFrame();
    viewer.page();
    ImGui::Render();
  };
  // ImGui settles its layout while it draws the first page, and what is new while it draws the
  // next.
  page();
  for (const Deed& deed : deeds) {
    perform(deed, io, viewer);
    viewer.advance(deed.seconds);
    page();
  }
  if (!deeds.empty() && !deeds.back().pressed) perform({}, io, viewer);
  page();
  return uiRenderer.drawToImage(*ImGui::GetDrawData());
}

}  // namespace tumble
