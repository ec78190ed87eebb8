#include "app/record/threads.h"

#include <atomic>
#include <exception>
#include <memory>
#include <mutex>
#include <thread>
#include <utility>
#include <vector>

namespace tumble {
namespace {

int inUse = 1;

using Act = std::function<void(int item, int worker)>;

class Team {
 public:
  explicit Team(int count) {
    for (int k = 1; k < count; ++k) others_.emplace_back([this, k] { serve(k); });
  }

  ~Team() {
    act_ = nullptr;
    call();
    for (std::thread& other : others_) other.join();
  }

  Team(const Team&) = delete;
  Team& operator=(const Team&) = delete;

  void forEach(int items, const Act& act) {
    act_ = &act;
    items_ = items;
    next_ = 0;
    busy_ = static_cast<int>(others_.size());
    call();
    serveOnce(0);
    for (int left = busy_; left > 0; left = busy_) busy_.wait(left);
    if (thrown_) std::rethrow_exception(std::exchange(thrown_, nullptr));
  }

 private:
  void call() {
    ++round_;
    round_.notify_all();
  }

  void serve(int k) {
    for (int seen = 0;;) {
      round_.wait(seen);
      ++seen;
      if (!act_) return;
      serveOnce(k);
      if (--busy_ == 0) busy_.notify_one();
    }
  }

  void serveOnce(int k) {
    try {
      for (int item = next_++; item < items_; item = next_++) (*act_)(item, k);
    } catch (...) {
      const std::lock_guard lock(throwing_);
      if (!thrown_) thrown_ = std::current_exception();
    }
  }

  const Act* act_ = nullptr;  // what is done in this round; none: all go
  int items_ = 0;
  std::atomic<int> next_ = 0;  // item that nobody has begun
  std::atomic<int> round_ = 0, busy_ = 0;
  std::mutex throwing_;
  std::exception_ptr thrown_;
  std::vector<std::thread> others_;
};

}  // namespace

Workers makeWorkers(int count) {
  if (count <= 1) return {};
  const auto team = std::make_shared<Team>(count);
  return {.count = count,
          .forEach = [team](int items, const Act& act) { team->forEach(items, act); }};
}

void useThreads(int count) {
  inUse = count;
}

int threadsInUse() {
  return inUse;
}

}  // namespace tumble
