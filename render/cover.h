// Which faces of bodies no pixel shows, found before anything is drawn.
// With several samples a pixel llvmpipe shades what stands behind as well, and drops it afterwards:
// in a heap that is three of four fragments.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "render/picture.h"
#include "render/stage.h"

namespace tumble {

/// How far the image is covered by boxes, in cells of a few pixels.
class Cover {
 public:
  /// Faces of the box around a body: bit 2·axis for that on the negative side, the next for that on
  /// the positive side.
  using Faces = unsigned;
  static constexpr Faces kAll = 63;

  explicit Cover(const Stage& stage);

  /// Adds a solid box. One that reaches to the near plane covers nothing.
  void add(const Instance& box);

  /// The faces that no sample of the image can show, because they have their back to the eye or
  /// stand behind what covers the image wherever they would show. Not all of these are found. The
  /// body lies within the box of its half extents `scale`.
  Faces hiddenFaces(const Instance& body) const;

 private:
  /// A box as the eye sees it. On each of its six planes 1/depth is linear across the image: its
  /// value at pixel (x, y) is plane·(x, y, 1). Sight enters the box at the least of those that face
  /// the eye and leaves it at the largest of the others.
  struct SeenBox {
    std::array<Eigen::Vector3d, 6> planes;
    std::array<bool, 6> front;
    int left, right, top, bottom;  ///< cells that it may touch, the last excluded
  };

  std::optional<SeenBox> see(const Instance& body, double grow) const;
  bool hides(const SeenBox& box, int face) const;

  const Stage& stage_;
  int size_, columns_, rows_;     // of cells [px, 1, 1]
  std::vector<double> nearness_;  // 1/depth before which all of a cell is covered; 0: not all of it
};

}  // namespace tumble
