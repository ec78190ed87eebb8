// What the window shows: demos to the left, the picture, and the transport below it.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "app/present/present.h"
#include "app/record/recording.h"
#include "app/scene/scene.h"
#include "app/viewer/orbit.h"
#include "app/viewer/playback.h"
#include "app/viewer/ui_renderer.h"
#include "render/renderer.h"

namespace tumble {

/// A demo as the list shows it.
struct DemoEntry {
  std::string name, title, chapter, path;
};

/// All demos, by chapter, then by name. One that cannot be read is listed without a title.
std::vector<DemoEntry> demoEntries();

/// The page of the window. Knows Dear ImGui and the renderer, but no window: the same page is drawn
/// off-screen for its golden.
class Viewer {
 public:
  Viewer(Renderer& renderer, std::vector<DemoEntry> demos);

  /// Records the scene and shows it from its start. @throws SceneError
  void open(Scene scene);
  /// Lets wall-clock time pass.
  void advance(double seconds) { playback_.advance(seconds); }
  /// Emits one page into the current ImGui frame and handles what the user does with it.
  void page();

  Playback& playback() { return playback_; }

 private:
  void demoList();
  void numbers();
  void picture(float width, float height);
  void transport();
  void keys();
  void mouse(float height);
  void choose(const DemoEntry& demo);
  void draw(int width, int height);

  Renderer& renderer_;
  std::vector<DemoEntry> demos_;
  std::optional<Scene> scene_;
  std::optional<Recording> recording_;
  std::optional<Presenter> presenter_;  // of scene_ and recording_
  std::string complaint_;               ///< why the scene that was asked for is not shown
  Playback playback_;
  Orbit orbit_, home_;

  /// What the texture shows, so that it is drawn only when something changed.
  struct Drawn {
    int sample = -1, width = 0, height = 0;
    Eigen::Vector3d eye = Eigen::Vector3d::Zero(), target = Eigen::Vector3d::Zero();
    bool operator==(const Drawn&) const = default;
  } drawn_;
  UiTexture texture_;
};

}  // namespace tumble
