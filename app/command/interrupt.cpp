#include "app/command/interrupt.h"

namespace tumble {

namespace {

volatile std::sig_atomic_t wish = 0;
constexpr int kSignals[2] = {SIGINT, SIGTERM};

}  // namespace

Interrupt::Interrupt() {
  struct sigaction action = {};
  action.sa_handler = [](int) { wish = 1; };
  action.sa_flags = SA_RESETHAND | SA_RESTART;
  for (int i = 0; i < 2; ++i) sigaction(kSignals[i], &action, &before_[i]);
}

Interrupt::~Interrupt() {
  for (int i = 0; i < 2; ++i) sigaction(kSignals[i], &before_[i], nullptr);
}

bool Interrupt::asked() {
  return wish != 0;
}

}  // namespace tumble
