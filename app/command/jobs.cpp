#include "app/command/jobs.h"

#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <system_error>
#include <thread>
#include <vector>

#include "app/command/command.h"

namespace tumble {

namespace {

// The processes share the processors; OpenGL's threads take what is left to each.
void shareProcessors(int count) {
  const int processors = static_cast<int>(std::thread::hardware_concurrency());
  const int threads = processors / count > 1 ? processors / count : 0;
  setenv("LP_NUM_THREADS", std::to_string(threads).c_str(), 0);
}

[[noreturn]] void child(int count, const std::function<int()>& work) {
  shareProcessors(count);
  const int code = guarded(work);
  std::fflush(nullptr);
  ::_exit(code);
}

int waitFor(const std::vector<pid_t>& children) {
  int worst = 0;
  for (const pid_t one : children) {
    int status = 0;
    while (::waitpid(one, &status, 0) < 0 && errno == EINTR) {
    }
    worst = std::max(worst, WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status));
  }
  return worst;
}

}  // namespace

int runJobs(int count, const std::function<int(int, const std::function<void()>&)>& work,
            const std::function<void(long)>& told) {
  int ends[2];
  if (::pipe2(ends, O_CLOEXEC) != 0)
    throw std::system_error(errno, std::generic_category(), "cannot open a pipe");
  std::fflush(nullptr);
  std::vector<pid_t> children;
  for (int i = 0; i < count; ++i) {
    const pid_t one = ::fork();
    if (one == 0) {
      const auto tell = [&] { (void)!::write(ends[1], "+", 1); };
      child(count, [&] { return work(i, tell); });
    }
    if (one < 0) break;  // those that were begun do their part; the next run does the rest
    children.push_back(one);
  }
  ::close(ends[1]);
  char bytes[256];
  long pieces = 0;
  for (ssize_t got; (got = ::read(ends[0], bytes, sizeof bytes)) != 0;) {
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) break;
    told(pieces += got);
  }
  ::close(ends[0]);
  const int worst = waitFor(children);
  if (static_cast<int>(children.size()) < count)
    throw std::system_error(EAGAIN, std::generic_category(), "cannot begin another process");
  return worst;
}

}  // namespace tumble
