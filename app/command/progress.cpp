#include "app/command/progress.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cmath>
#include <cstdio>

namespace tumble {

namespace {

bool silent = false;

}  // namespace

void setQuiet(bool quiet) {
  silent = quiet;
}

bool quiet() {
  return silent;
}

void say(const std::string& line) {
  if (!silent) fmt::print("{}\n", line);
}

void tell(const std::string& text) {
  std::fputs(text.c_str(), stderr);
}

void note(const std::string& line) {
  if (!silent) tell(fmt::format("note: {}\n", line));
}

Progress::Progress(std::string task)
    : task_(std::move(task)),
      terminal_(::isatty(STDERR_FILENO) != 0),
      start_(Clock::now()),
      last_(start_) {}

Progress::~Progress() {
  if (terminal_ && !silent) tell("\r\033[K");
}

void Progress::show(double share) {
  if (silent) return;
  const Clock::time_point now = Clock::now();
  const double seconds = std::chrono::duration<double>(now - start_).count();
  if (terminal_) {
    if (now - last_ < std::chrono::milliseconds(100)) return;
    last_ = now;
    drawBar(share, seconds);
    return;
  }
  const int quarter = static_cast<int>(share * 4.0);
  if (quarter <= quarter_ || seconds < 2.0) return;
  quarter_ = quarter;
  tell(fmt::format("{}: {} % after {:.0f} s\n", task_, 25 * quarter, seconds));
}

void Progress::drawBar(double share, double seconds) {
  constexpr int kWidth = 30;
  const int done = static_cast<int>(share * kWidth);
  const double left = share > 0.0 ? seconds * (1.0 - share) / share : 0.0;
  tell(fmt::format("\r\033[K{:<12}[{:=<{}}{:<{}}] {:3.0f} %  {:.0f} s left", task_, "", done, "",
                   kWidth - done, 100.0 * share, std::ceil(left)));
  std::fflush(stderr);
}

}  // namespace tumble
