// The floor: a disc with a grid and shadows that fades into the page; single-sampled, under
// everything.
#pragma once

#include <string>

#include "render/gl.h"
#include "render/mesh.h"
#include "render/picture.h"
#include "render/stage.h"

namespace tumble {

class FloorDisc {
 public:
  /// Where it has faded, in radii of the scene, as in floor.frag.
  static constexpr double kFaded = 1.96;

  explicit FloorDisc(const std::string& shaders);
  /// Draws into the bound target, premultiplied; needs the map from above on unit 1.
  void draw(const Floor& floor, const Stage& stage) const;

 private:
  gl::Program program_;
  MeshBuffer disc_ = makeDisc(48);
};

}  // namespace tumble
