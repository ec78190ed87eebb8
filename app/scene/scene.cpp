// Complaints about scenes, and where they point.
#include "app/scene/scene.h"

#include <fmt/core.h>

namespace tumble {

namespace {

std::string joined(const std::vector<Diagnostic>& diagnostics) {
  std::string text;
  for (const Diagnostic& diagnostic : diagnostics) {
    if (!text.empty()) text += '\n';
    text += format(diagnostic);
  }
  return text;
}

}  // namespace

std::string format(const Diagnostic& diagnostic) {
  const Place& place = diagnostic.place;
  if (place.line == 0) return fmt::format("{}: error: {}", place.file, diagnostic.message);
  return fmt::format("{}:{}:{}: error: {}", place.file, place.line, place.column,
                     diagnostic.message);
}

SceneError::SceneError(std::vector<Diagnostic> diagnostics)
    : std::runtime_error(joined(diagnostics)), diagnostics_(std::move(diagnostics)) {}

Diagnostic locate(const Scene& scene, const Refusal& refusal) {
  // Shorten the path until it is one that somebody wrote.
  std::string where = refusal.where();
  while (!where.empty()) {
    const auto it = scene.places.find(where);
    if (it != scene.places.end()) return {it->second, refusal.what()};
    const std::size_t dot = where.find_last_of(".[");
    where.resize(dot == std::string::npos ? 0 : dot);
  }
  return {{scene.file, 0, 0}, refusal.what()};
}

}  // namespace tumble
