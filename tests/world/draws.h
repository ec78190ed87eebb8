// Numbers at random, the same with every standard library: distributions differ between them.
#pragma once

#include <random>

namespace tumble::scenes {

struct Draws {
  std::mt19937 source;
  double operator()(double from, double to) {
    return from + (to - from) * (static_cast<double>(source()) / 4294967296.0);
  }
};

}  // namespace tumble::scenes
