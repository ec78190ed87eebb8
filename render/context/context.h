// One interface to whatever makes OpenGL 3.3 core possible on this machine.
#pragma once

#include <memory>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>

namespace tumble {

/// No context: what was tried, what to install or try.
class NoContext : public std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// A current OpenGL 3.3 core context with its functions loaded. One per thread.
class Context {
 public:
  virtual ~Context() = default;
  virtual std::string_view name() const = 0;
  virtual void makeCurrent() = 0;
  std::string renderer() const;  ///< GL_RENDERER
  std::string version() const;   ///< GL_VERSION
};

/// A row of the table of contexts.
struct ContextKind {
  std::string_view name;  ///< "osmesa", "egl"
  std::string_view summary;
  std::unique_ptr<Context> (*make)();  ///< @throws NoContext
};
std::span<const ContextKind> contextKinds();

/// The named kind, or with "" the value of $TUMBLE_GL, or else the first kind that works.
/// @throws NoContext naming every kind tried and why it failed.
std::unique_ptr<Context> makeContext(std::string_view kind = "");

}  // namespace tumble
