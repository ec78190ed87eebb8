// One scene, drawn into the files of one folder.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "app/command/masks.h"
#include "app/command/progress.h"
#include "app/command/studio.h"
#include "app/present/present.h"

namespace tumble {

inline constexpr int kSheetPanel = 640;  ///< [px] width of a panel on a sheet of variants

/// Simulates when the first image is needed. An image that is there already, whole and made from
/// the same scene, is kept.
class Shoot {
 public:
  /// Scene and studio must outlive it.
  /// @throws FileError if the folder cannot be made.
  Shoot(const Scene& scene, std::string folder, Studio& studio);

  /// Each writes its file or files and returns the path.
  std::string still(double t);  ///< still.png, the sample nearest to t [s]
  std::string strobe();         ///< strobe.png
  std::string sheet();          ///< sheet.png: up to twelve stills, where the bodies have moved on
  /// events.svg: all events on a line of time.
  std::string events();
  /// From now on each still and image of the sequence has masks beside it, image-000000.depth.png
  /// and image-000000.identity.png, and the folder identities.csv.
  void withMasks() { masked_ = true; }
  /// panels.png with all panels, graphs and charts of the scene, and graph.png, graph.svg,
  /// graph.csv, chart.png, …, chart-2.png … of each plot alone. Nothing for a scene without them.
  std::vector<std::string> panels();
  /// image-000000.png …: these images of the sequence, one per sample, by so many processes at
  /// once. Says which images of the folder are of another run.
  /// @throws Interrupted after the image at hand, if the user asks for that
  std::string sequence(const std::vector<int>& images, int jobs = 1);
  /// The images of the range as a film.
  void video(const std::string& path, std::pair<int, int> range);

  /// The whole run as a page for a browser; needs no OpenGL.
  void page(const std::string& path);

  /// Images of the whole sequence, one per sample.
  int count() const;
  const Recording& recording();
  bool recorded() const { return recording_.has_value(); }

 private:
  const Presenter& presenter();
  bool finished(const std::string& path, const std::string& what) const;
  std::string imagePath(int k) const;
  bool hasImage(int k) const;
  bool hasMasks(const std::string& path, const std::string& what) const;
  void drawMasks(int k, const std::string& path, const std::string& what);
  void drawImages(const std::vector<int>& images, const std::function<void()>& tell);
  void drawBy(int jobs, const std::vector<int>& images, Progress& progress);
  void tellStrangers(const std::vector<int>& images) const;

  const Scene& scene_;
  std::string folder_;
  Studio& studio_;
  std::optional<Recording> recording_;
  std::optional<Presenter> presenter_;
  bool masked_ = false;
  std::optional<MaskDrawer> masks_;
};

}  // namespace tumble
