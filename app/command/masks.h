// Depth and identity of what an image shows, as images beside it.
#pragma once

#include <string>

#include "app/command/stamp.h"
#include "app/command/studio.h"
#include "app/present/present.h"

namespace tumble {

/// The colour that stands for a body on a mask of identities: never black, and another one for each
/// of the first 2²⁴ − 1 bodies, neighbours far apart.
Rgb identityColour(int body);

/// Draws masks of one recording. Surfaces that bend are one body each, that of their first point.
class MaskDrawer {
 public:
  /// All three must outlive it.
  MaskDrawer(const Scene& scene, const Recording& recording, Studio& studio);

  /// identity.png and depth.png of sample k: paths are as given, with ".identity" and ".depth"
  /// before their ending.
  void write(int k, const std::string& imagePath, const Stamp& identity, const Stamp& depth);
  /// body,red,green,blue – a row for each body that a mask can show.
  std::string legend() const;

 private:
  const Scene& scene_;
  Scene flat_;  ///< the scene in colours of identities
  Studio& studio_;
  Presenter presenter_;
};

/// "image-000000.png" → "image-000000.depth.png"
std::string maskPath(const std::string& imagePath, const std::string& mask);

}  // namespace tumble
