// A window on the desktop as a context (GLFW). Only the viewer needs a display.
#pragma once

#include <memory>
#include <string>

#include "render/context/context.h"

struct GLFWwindow;

namespace tumble {

/// A window with a current OpenGL 3.3 core context. One at a time, on the main thread.
class Window : public Context {
 public:
  struct Options {
    int width = 1280, height = 800;  ///< [screen units]
    std::string title = "tumble";
    bool visible = true;
  };

  /// @throws NoContext without a display, or if the driver offers no OpenGL 3.3 core.
  explicit Window(const Options& options);
  ~Window() override;
  Window(const Window&) = delete;
  Window& operator=(const Window&) = delete;

  std::string_view name() const override { return "window"; }
  void makeCurrent() override;

  /// Takes in what mouse, keys and window manager did since the last call; waits up to `patience`
  /// [s] for something to happen.
  void poll(double patience = 0.0);
  bool closing() const;
  /// Shows what was drawn into framebuffer 0.
  void swap();
  /// Width and height of framebuffer 0 [px].
  std::pair<int, int> pixels() const;
  GLFWwindow* handle() const { return window_; }

 private:
  GLFWwindow* window_ = nullptr;
};

}  // namespace tumble
