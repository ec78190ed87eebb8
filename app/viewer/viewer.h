// What the window shows: demos to the left, the picture, and the transport below it.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/present/present.h"
#include "app/record/recording.h"
#include "app/scene/scene.h"
#include "app/viewer/live.h"
#include "app/viewer/orbit.h"
#include "app/viewer/playback.h"
#include "app/viewer/recorder.h"
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
  /// Shows the scene from its start and plays it while it is recorded.
  void begin(Scene scene);
  /// Reads a scene and begins it; a refusal is shown with its place. With the overrides of the
  /// scene at hand if it is the same file.
  void load(const std::string& path);
  /// Lets wall-clock time pass.
  void advance(double seconds);
  /// Emits one page into the current ImGui frame and handles what the user does with it.
  void page();
  /// Whether the page changes by itself.
  bool busy() const { return playback_.playing() || recorder_; }

  Playback& playback() { return playback_; }
  const std::optional<Recording>& recording() const { return recording_; }

 private:
  /// A picture is framed anew when the run has grown by this factor.
  static constexpr double kGrown = 1.5;

  void demoList();
  void shownList();
  void numbers();
  void bodyNumbers();
  void certificate();
  void picture(float width, float height);
  void transport();
  void eventMarks();
  void help();
  void liveList();
  void plot();
  void choosePlot();
  void handLine(float width, float height);
  void keys();
  void mouse(float width, float height);
  void draw(int width, int height);
  void pull();
  void show();
  void pick(float x, float y, float width, float height);
  void setLive(bool live);
  void play();
  void branch();
  void present();
  bool grow();
  void step(int samples);
  void grip(float x, float y, float width, float height);
  void lead(float x, float y, float width, float height);
  void reloadIfSaved();
  void screenshot();
  void keepView();
  Camera camera() const;
  std::string command() const;

  Renderer& renderer_;
  std::vector<DemoEntry> demos_;
  std::optional<Scene> scene_;
  std::optional<Scene> whole_;  ///< the scene with its claims, while it is recorded, or lives
  std::optional<Recording> recording_;
  std::optional<Presenter> presenter_;  // of scene_ and recording_
  std::unique_ptr<Recorder> recorder_;  ///< while it is recorded
  std::optional<Live> live_;            ///< while it runs on as the user wants it
  std::size_t presented_ = 0;           ///< samples that the presenter has seen all of
  std::string complaint_;               ///< why the scene that was asked for is not shown
  std::string told_;                    ///< what the last command did
  Playback playback_;
  Orbit orbit_, home_;
  std::vector<Orbit> kept_;    ///< views of this scene that the digits go back to
  std::optional<int> picked_;  ///< a body
  bool following_ = false;     ///< the picked body
  bool helping_ = false;
  std::string plotted_ = "energy";  ///< a quantity, or ""
  float dragged_ = 0.0f;            ///< [px] since the button went down
  double owed_ = 0.0;               ///< [s] that the live run is behind
  std::filesystem::file_time_type saved_;
  double looked_ = 0.0;  ///< [s] when the file was last looked at

  /// What the texture shows, so that it is drawn only when something changed.
  struct Drawn {
    int sample = -1, width = 0, height = 0, revision = 0;
    Eigen::Vector3d eye = Eigen::Vector3d::Zero(), target = Eigen::Vector3d::Zero();
    bool operator==(const Drawn&) const = default;
  } drawn_;
  int revision_ = 0;  ///< counts what changes a picture besides time and camera
  UiTexture texture_;
};

}  // namespace tumble
