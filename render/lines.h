// Solid polylines: strokes of a width in pixels, fainter where a body hides them.
#pragma once

#include <string>
#include <vector>

#include "render/gl.h"
#include "render/mesh.h"
#include "render/picture.h"
#include "render/stage.h"

namespace tumble {

class Lines {
 public:
  explicit Lines(const std::string& shaders);
  void load(const std::vector<Polyline>& lines, const Stage& stage);
  void draw() const;

 private:
  /// As line.vert reads it; places in pixels, y upwards.
  struct Stretch {
    float start[3], end[3], seams[4], colour[3], halfWidth;
  };
  gl::Program program_;
  MeshBuffer quad_ = makeQuad();
  gl::Object buffer_;
  std::vector<Stretch> stretches_;
};

/// A polyline on the image: the pieces of it in front of the near plane, as pixels (y down) and
/// depth [m].
std::vector<std::vector<Eigen::Vector3d>> projectLine(const std::vector<Eigen::Vector3d>& points,
                                                      const Projection& projection);

}  // namespace tumble
