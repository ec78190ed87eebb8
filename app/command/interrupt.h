// Ctrl-C, and what a job scheduler sends, end a long command between two pieces of its work.
#pragma once

#include <csignal>
#include <stdexcept>

namespace tumble {

/// The user stopped the command; the message says how far it came: exit 130.
class Interrupted : public std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// While one lives SIGINT and SIGTERM only leave a wish and say so; a second one ends the
/// process.
class Interrupt {
 public:
  Interrupt();
  ~Interrupt();
  Interrupt(const Interrupt&) = delete;
  Interrupt& operator=(const Interrupt&) = delete;

  /// Whether the process was asked to stop.
  static bool asked();

 private:
  struct sigaction before_[2];
};

}  // namespace tumble
