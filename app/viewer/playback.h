// How far the play of a recording has come.
#pragma once

namespace tumble {

/// A clock that runs over samples 0 … last at a rate [1/s]. Times in seconds of the recording.
class Playback {
 public:
  Playback() = default;
  Playback(int last, double rate) : last_(last), rate_(rate) {}

  /// Lets wall-clock time pass; stops at the end.
  void advance(double seconds);
  /// Play or pause; from the end, play starts over.
  void toggle();
  /// Pauses and goes this many samples on, or back.
  void step(int samples);
  /// Pauses at a time.
  void seek(double time);

  bool playing() const { return playing_; }
  double time() const { return time_; }
  double end() const { return last_ / rate_; }
  int last() const { return last_; }
  /// The sample to show: the latest that is not in the future.
  int sample() const;

  /// More samples are known.
  void extend(int last) { last_ = last; }
  /// So many samples at the start are no more.
  void forget(int samples);

  bool growing = false;  ///< at the end play waits for more
  double speed = 1.0;    ///< [1] recording time over wall-clock time

 private:
  int last_ = 0;
  double rate_ = 60.0;
  double time_ = 0.0;
  bool playing_ = false;
};

}  // namespace tumble
