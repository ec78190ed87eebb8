// The framebuffer that masks are drawn into.
#pragma once

#include "render/gl.h"
#include "render/mask.h"

namespace tumble {

class MaskTarget {
 public:
  void begin(int width, int height);
  Masks read() const;

 private:
  int width_ = 0, height_ = 0;
  gl::Object identity_, distance_, depth_, framebuffer_;
};

}  // namespace tumble
