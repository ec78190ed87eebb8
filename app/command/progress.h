// How far a long command has come: a bar with the time left on a terminal, plain lines elsewhere.
#pragma once

#include <chrono>
#include <string>

namespace tumble {

/// Whether the user wants to hear of nothing but results and errors.
void setQuiet(bool quiet);
bool quiet();

/// A line on standard output that is not a result, such as the path of a file that was written.
void say(const std::string& line);

/// Text on standard error; that it cannot be written is no error.
void tell(const std::string& text);

/// A line on standard error about something that the user may not have meant.
void note(const std::string& line);

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
