#include "render/png_writer.h"

#include <utility>

namespace tumble {

PngWriter::PngWriter(std::size_t capacity) : capacity_(capacity), thread_([this] { run(); }) {}

PngWriter::~PngWriter() {
  {
    const std::lock_guard lock(mutex_);
    closing_ = true;
  }
  changed_.notify_all();
  thread_.join();
}

void PngWriter::write(std::string path, Image image, std::map<std::string, std::string> text) {
  std::unique_lock lock(mutex_);
  changed_.wait(lock, [this] { return error_ || waiting_.size() < capacity_; });
  if (error_) std::rethrow_exception(error_);
  waiting_.push_back({std::move(path), std::move(image), std::move(text)});
  changed_.notify_all();
}

void PngWriter::finish() {
  std::unique_lock lock(mutex_);
  changed_.wait(lock, [this] { return error_ || (waiting_.empty() && !busy_); });
  if (error_) std::rethrow_exception(error_);
}

void PngWriter::run() {
  std::unique_lock lock(mutex_);
  while (true) {
    changed_.wait(lock, [this] { return closing_ || !waiting_.empty(); });
    if (waiting_.empty() || error_) return;
    const Job job = std::move(waiting_.front());
    waiting_.pop_front();
    busy_ = true;
    lock.unlock();
    std::exception_ptr error;
    try {
      writePng(job.path, job.image, job.text);
    } catch (...) {
      error = std::current_exception();
    }
    lock.lock();
    busy_ = false;
    if (error) error_ = error;
    changed_.notify_all();
  }
}

}  // namespace tumble
