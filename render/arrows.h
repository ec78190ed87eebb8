// Arrows in the world with a thickness in pixels and a pale rim that lifts them off what is behind.
// What stands before them, or holds them inside, does not hide them: they show through it, fainter.
#pragma once

#include <string>
#include <vector>

#include "render/gl.h"
#include "render/mesh.h"
#include "render/picture.h"
#include "render/stage.h"

namespace tumble {

class Arrows {
 public:
  explicit Arrows(const std::string& shaders);
  void load(const std::vector<Arrow>& arrows, const Stage& stage);
  void draw() const;

 private:
  /// As arrow.vert reads it.
  struct Shaft {
    float base[3], radius, reach[3], colour[3];
  };
  gl::Program program_;
  MeshBuffer mesh_ = makeArrow(16);
  gl::Object buffer_;
  std::vector<Shaft> shafts_;
};

}  // namespace tumble
