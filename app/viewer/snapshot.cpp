#include "app/viewer/snapshot.h"

#include "app/file/data.h"
#include "app/viewer/ui_context.h"
#include "app/viewer/viewer.h"

namespace tumble {

Image viewerSnapshot(Renderer& renderer, const Scene& scene, double share, int width, int height) {
  const UiContext ui(dataFolder("fonts"));
  ImGuiIO& io = ImGui::GetIO();
  io.DisplaySize = {static_cast<float>(width), static_cast<float>(height)};
  io.DeltaTime = 1.0f / 60.0f;
  UiRenderer uiRenderer;
  Viewer viewer(renderer, {{scene.name, scene.title, scene.chapter, scene.file}});
  viewer.open(scene);
  viewer.playback().seek(share * viewer.playback().end());
  // ImGui settles its layout while it draws the first page.
  for (int pages = 0; pages < 2; ++pages) {
    ImGui::NewFrame();
    viewer.page();
    ImGui::Render();
  }
  return uiRenderer.drawToImage(*ImGui::GetDrawData());
}

}  // namespace tumble
