// Variants of a scene, run, and their pictures on one page.
#pragma once

#include <deque>
#include <functional>
#include <optional>

#include "app/present/present.h"
#include "app/scene/scene.h"
#include "render/sheet.h"

namespace tumble {

/// A variant with its scene and recording. Stays where it is: presenters refer to it.
struct VariantRun {
  std::string title, subtitle;  ///< below its picture
  Scene scene;
  Recording recording;
  bool still = false;                                ///< one instant, not the whole motion
  bool wrong = false;                                ///< a state that is not legal: in red
  std::function<Picture(const Presenter&)> picture;  ///< what of the motion is shown
};

/// The scene of a variant, read from the same file.
/// @throws SceneError
Scene sceneOf(const Scene& scene, const Variant& variant);

/// Told after each run.
using RunDone = std::function<void()>;

/// The runs of a scene's panels.
/// @throws SceneError, or StoppedError for a run without a single sample.
std::deque<VariantRun> runPanels(const Scene& scene, const RunDone& done);

/// Draws a picture at the size of a panel.
using DrawPanel = std::function<Image(const Picture&)>;

/// The pictures of the runs without their titles, as panels of a sheet. Stills of
/// the same bodies that are looked at from the same side share a camera, and so do strobes.
/// @param page  [px] that each is drawn for
std::vector<Panel> drawPanels(const std::deque<VariantRun>& runs, const Eigen::Vector2d& page,
                              const DrawPanel& draw);

/// Page [px] that a panel of the scene's page is drawn for: text is nearly as large as the
/// captions.
Eigen::Vector2d panelPage(const Scene& scene);

/// Height [px] of panels of a width: in the proportion of the scene's images.
int panelHeight(const Scene& scene, int width);

/// Columns of a sheet of that many panels: 2 × 2, 2 × 3, 3 × 4 ….
int columnsOf(std::size_t panels);

}  // namespace tumble
