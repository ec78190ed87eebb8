#include "app/viewer/recorder.h"

#include <chrono>

namespace tumble {

namespace {

struct Unwanted {};

}  // namespace

Recorder::Recorder(const Scene& scene) : thread_([this, scene] { run(scene); }) {}

Recorder::~Recorder() {
  unwanted_ = true;
  thread_.join();
}

void Recorder::run(const Scene& scene) {
  try {
    const auto see = [this](Sample&& sample) {
      const std::lock_guard hold(lock_);
      samples_.push_back(std::move(sample));
    };
    const auto progress = [this](double share) {
      share_ = share;
      if (unwanted_) throw Unwanted();
    };
    Recording end = tumble::run(scene, scene.image.rate, see, progress);
    const std::lock_guard hold(lock_);
    end_ = std::move(end);
    ended_ = true;
  } catch (const Unwanted&) {
  } catch (const std::exception& error) {
    complaint_ = error.what();
  }
  running_ = false;
}

bool Recorder::take(Recording& into) {
  const std::lock_guard hold(lock_);
  if (samples_.empty() && !ended_) return false;
  std::vector<Sample> all = std::move(into.samples);
  if (ended_) into = std::move(end_);
  for (Sample& sample : samples_) all.push_back(std::move(sample));
  into.samples = std::move(all);
  samples_.clear();
  ended_ = false;
  return true;
}

void Recorder::waitFor(double seconds) {
  using Clock = std::chrono::steady_clock;
  const auto end = Clock::now() + std::chrono::duration<double>(seconds);
  while (Clock::now() < end && running_) {
    {
      const std::lock_guard hold(lock_);
      if (!samples_.empty()) return;
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
}

}  // namespace tumble
