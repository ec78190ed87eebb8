// Writes images to PNG files on a thread of its own, so that drawing need not wait for packing.
#pragma once

#include <condition_variable>
#include <deque>
#include <exception>
#include <map>
#include <mutex>
#include <string>
#include <thread>

#include "render/image.h"

namespace tumble {

class PngWriter {
 public:
  /// @param capacity  images that may wait; `write` blocks while as many do
  explicit PngWriter(std::size_t capacity = 3);
  /// Writes what waits, unless an error came before; says nothing of errors. Call `finish` first.
  ~PngWriter();

  /// Hands over an image, as for `writePng`.
  /// @throws the first error of any earlier image; nothing is written after it.
  void write(std::string path, Image image, std::map<std::string, std::string> text = {});

  /// Waits until everything is on disk.
  /// @throws the first error of any image.
  void finish();

 private:
  struct Job {
    std::string path;
    Image image;
    std::map<std::string, std::string> text;
  };
  void run();

  const std::size_t capacity_;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<Job> waiting_;
  bool busy_ = false, closing_ = false;
  std::exception_ptr error_;
  std::thread thread_;  // last: it uses all the others
};

}  // namespace tumble
