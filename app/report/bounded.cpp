#include "app/report/bounded.h"

#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cmath>
#include <csignal>
#include <cstring>

#include "app/file/file.h"

namespace tumble {

namespace {

[[noreturn]] void fail(const char* what) {
  throw FileError(std::string("cannot ") + what + " for a run: " + std::strerror(errno));
}

// The copy's life: its limits, the work, and an end that flushes nothing of ours.
[[noreturn]] void live(int out, double seconds, const std::function<void(const Send&)>& work) {
  const rlimit noCore{0, 0};
  ::setrlimit(RLIMIT_CORE, &noCore);
  const auto most = static_cast<rlim_t>(std::ceil(seconds));
  const rlimit time{most, most + 1};
  ::setrlimit(RLIMIT_CPU, &time);
  int code = 0;
  try {
    work([out](std::string_view text) {
      while (!text.empty()) {
        const ssize_t written = ::write(out, text.data(), text.size());
        if (written < 0 && errno != EINTR) ::_exit(1);
        if (written > 0) text.remove_prefix(static_cast<std::size_t>(written));
      }
    });
  } catch (...) {
    code = 1;
  }
  ::_exit(code);
}

std::string readAll(int in) {
  std::string all;
  std::array<char, 65536> part;
  while (true) {
    const ssize_t count = ::read(in, part.data(), part.size());
    if (count > 0) all.append(part.data(), static_cast<std::size_t>(count));
    if (count == 0 || (count < 0 && errno != EINTR)) return all;
  }
}

}  // namespace

Bounded runBounded(double seconds, const std::function<void(const Send&)>& work) {
  int ends[2];
  if (::pipe(ends) != 0) fail("open a pipe");
  const pid_t process = ::fork();
  if (process < 0) fail("start a process");
  if (process == 0) {
    ::close(ends[0]);
    live(ends[1], seconds, work);
  }
  ::close(ends[1]);
  Bounded result{readAll(ends[0])};
  ::close(ends[0]);
  int status = -1;
  while (::waitpid(process, &status, 0) < 0 && errno == EINTR) {
  }
  result.whole = WIFEXITED(status) && WEXITSTATUS(status) == 0;
  result.outOfTime =
      WIFSIGNALED(status) && (WTERMSIG(status) == SIGXCPU || WTERMSIG(status) == SIGKILL);
  return result;
}

}  // namespace tumble
