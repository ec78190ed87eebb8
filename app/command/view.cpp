// tumble view: the window.
#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <backends/imgui_impl_glfw.h>

#include "app/command/command.h"
#include "app/command/options.h"
#include "app/file/data.h"
#include "app/viewer/ui_context.h"
#include "app/viewer/viewer.h"
#include "render/context/window.h"

namespace tumble::command {

namespace {

/// Mouse and keys of a window on their way into Dear ImGui.
class UiInput {
 public:
  explicit UiInput(Window& window) { ImGui_ImplGlfw_InitForOpenGL(window.handle(), true); }
  ~UiInput() { ImGui_ImplGlfw_Shutdown(); }
  UiInput(const UiInput&) = delete;
  UiInput& operator=(const UiInput&) = delete;
  void takeIn() { ImGui_ImplGlfw_NewFrame(); }
};

// A file that is dropped onto the window is shown.
void acceptDrops(Window& window, Viewer& viewer) {
  glfwSetWindowUserPointer(window.handle(), &viewer);
  glfwSetDropCallback(window.handle(), [](GLFWwindow* handle, int count, const char** paths) {
    if (count > 0) static_cast<Viewer*>(glfwGetWindowUserPointer(handle))->load(paths[count - 1]);
  });
}

// Until the window is closed, or so many images are drawn if `images` is positive.
void show(Window& window, UiInput& input, Viewer& viewer, UiRenderer& renderer, int images) {
  for (int drawn = 0; !window.closing() && (images <= 0 || drawn < images); ++drawn) {
    window.poll(viewer.busy() || images > 0 ? 0.0 : 0.1);
    input.takeIn();
    ImGui::NewFrame();
    viewer.advance(ImGui::GetIO().DeltaTime);
    viewer.page();
    ImGui::Render();
    renderer.drawToWindow(*ImGui::GetDrawData());
    window.swap();
  }
}

}  // namespace

int view(int argc, char** argv) {
  CommandLine line(
      "view", "Opens a window with all demos: play, step, scrub, turn, live.",
      {"                    # choose in the window", "stacked-boxes       # start with one",
       "my-scene.toml --set world.gravity=[0,-1.62,0]"});
  SceneOptions options;
  int images = 0;
  line.option("SCENE", options.scene, "a demo's name or a TOML file [none]");
  addOverrides(line, options.overrides);
  line.option("--images", images, "close after so many images", {.hidden = true});
  if (!line.read(argc, argv)) return kOk;

  // A scene that is refused ends the program before a window flashes up.
  std::optional<Scene> scene;
  if (!options.scene.empty()) scene = load(options);
  Window window({});
  Renderer renderer(window, dataFolder("shaders"), dataFolder("fonts"));
  const UiContext ui(dataFolder("fonts"));
  UiInput input(window);
  UiRenderer uiRenderer;
  Viewer viewer(renderer, demoEntries());
  if (scene) viewer.begin(*scene);
  acceptDrops(window, viewer);
  show(window, input, viewer, uiRenderer, images);
  return kOk;
}

}  // namespace tumble::command
