#include "app/command/interrupt.h"

#include <sys/mman.h>
#include <unistd.h>

#include <cerrno>
#include <new>
#include <string_view>

namespace tumble {

namespace {

// One for all processes that draw for one, so that whichever is asked to stop, all do.
volatile std::sig_atomic_t own = 0;
volatile std::sig_atomic_t* wish = &own;
constexpr int kSignals[2] = {SIGINT, SIGTERM};
pid_t owner = 0;  // processes that draw for it are asked too, and it speaks for them

// Only calls that a signal may interrupt anywhere.
void leaveWish(int) {
  constexpr std::string_view kWords =
      "\ntumble: stops after the sample or image at hand; Ctrl-C again ends it at once\n";
  const int before = errno;
  if (::getpid() == owner) (void)!::write(STDERR_FILENO, kWords.data(), kWords.size());
  *wish = 1;
  errno = before;
}

void shareWish() {
  if (wish != &own) return;
  void* shared =
      ::mmap(nullptr, sizeof own, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
  if (shared != MAP_FAILED) wish = new (shared) std::sig_atomic_t(own);
}

}  // namespace

Interrupt::Interrupt() {
  shareWish();
  owner = ::getpid();
  struct sigaction action = {};
  action.sa_handler = leaveWish;
  action.sa_flags = SA_RESETHAND | SA_RESTART;
  for (int i = 0; i < 2; ++i) sigaction(kSignals[i], &action, &before_[i]);
}

Interrupt::~Interrupt() {
  for (int i = 0; i < 2; ++i) sigaction(kSignals[i], &before_[i], nullptr);
}

bool Interrupt::asked() {
  return *wish != 0;
}

}  // namespace tumble
