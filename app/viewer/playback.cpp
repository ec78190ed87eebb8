#include "app/viewer/playback.h"

#include <algorithm>
#include <cmath>

namespace tumble {

void Playback::advance(double seconds) {
  if (!playing_) return;
  time_ = std::min(time_ + speed * seconds, end());
  if (time_ == end() && !growing) playing_ = false;
}

void Playback::toggle() {
  if (!playing_ && time_ == end() && !growing) time_ = 0.0;
  playing_ = !playing_;
}

void Playback::step(int samples) {
  seek((sample() + samples) / rate_);
}

void Playback::seek(double time) {
  playing_ = false;
  time_ = std::clamp(time, 0.0, end());
}

void Playback::forget(int samples) {
  last_ = std::max(0, last_ - samples);
  time_ = std::clamp(time_ - samples / rate_, 0.0, end());
}

int Playback::sample() const {
  // The margin keeps k/rate on sample k in spite of rounding.
  return std::clamp(static_cast<int>(std::floor(time_ * rate_ + 1e-6)), 0, last_);
}

}  // namespace tumble
