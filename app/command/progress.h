// How far a long command has come: a bar with the time left on a terminal, plain lines elsewhere.
#pragma once

#include <chrono>
#include <string>

namespace tumble {

class Progress {
 public:
  /// @param task what is being done, "simulating" or "drawing"
  explicit Progress(std::string task);
  /// Wipes the bar.
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  /// Tells the share done, in [0, 1]. Shown at most ten times a second, or in lines at each quarter
  /// of a task that takes longer than two seconds.
  void show(double share);

 private:
  using Clock = std::chrono::steady_clock;
  void drawBar(double share, double seconds);

  std::string task_;
  bool terminal_;
  Clock::time_point start_, last_;
  int quarter_ = 0;
};

}  // namespace tumble
