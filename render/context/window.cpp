#include "render/context/window.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include "render/context/kinds.h"

namespace tumble {

namespace {

// What GLFW said last; its calls tell of an error only here.
std::string& lastError() {
  static std::string text;
  return text;
}

[[noreturn]] void fail(const std::string& what) {
  glfwTerminate();
  throw NoContext(what + " (" + lastError() +
                  "); a window needs a desktop session with OpenGL 3.3 – `tumble render` does not");
}

}  // namespace

Window::Window(const Options& options) {
  glfwSetErrorCallback([](int, const char* text) { lastError() = text; });
  if (!glfwInit()) fail("no window can be opened");
  glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 3);
  glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 3);
  glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
  glfwWindowHint(GLFW_VISIBLE, options.visible);
  window_ =
      glfwCreateWindow(options.width, options.height, options.title.c_str(), nullptr, nullptr);
  if (!window_) fail("no window with OpenGL 3.3 core");
  try {
    makeCurrent();
  } catch (...) {
    glfwTerminate();
    throw;
  }
  glfwSwapInterval(1);
}

Window::~Window() {
  forgetFunctions(*this);
  glfwTerminate();
}

void Window::makeCurrent() {
  glfwMakeContextCurrent(window_);
  loadFunctions(*this, glfwGetProcAddress);
}

void Window::poll(double patience) {
  if (patience > 0.0)
    glfwWaitEventsTimeout(patience);
  else
    glfwPollEvents();
}

bool Window::closing() const {
  return glfwWindowShouldClose(window_);
}

void Window::swap() {
  glfwSwapBuffers(window_);
}

std::pair<int, int> Window::pixels() const {
  int width = 0, height = 0;
  glfwGetFramebufferSize(window_, &width, &height);
  return {width, height};
}

}  // namespace tumble
