// What goldens are kept of, and how they are drawn.
#pragma once

#include <string>
#include <string_view>

#include "app/golden/golden.h"
#include "app/scene/scene.h"
#include "render/renderer.h"

namespace tumble {

/// The subject that is not a demo: the window with its user interface.
inline constexpr std::string_view kWindowSubject = "viewer";

/// The scene that the window shows in its golden.
Scene windowScene();

/// Draws a scene's start, instants and strobe, 480×270, and writes down its motion at 21 instants;
/// its page of panels and charts with the charts' numbers. Images that show nothing new are left
/// out. The subject has the scene's name.
/// @throws SceneError, NoContext, StoppedError if the physics could not go on
Golden drawGolden(const Scene& scene, Renderer& renderer);

/// The same of a demo of that name, or of the window.
Golden drawGolden(const std::string& subject, Renderer& renderer);

}  // namespace tumble
