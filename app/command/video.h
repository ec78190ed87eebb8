// A film, written by ffmpeg through a pipe.
#pragma once

#include <sys/types.h>

#include <string>

#include "render/image.h"

namespace tumble {

class Video {
 public:
  /// Starts ffmpeg, which chooses the format by the file's ending.
  /// @throws FileError if there is no ffmpeg.
  Video(std::string path, int width, int height, double rate);
  /// Stops ffmpeg and leaves nothing behind unless `finish` was called.
  ~Video();
  Video(const Video&) = delete;
  Video& operator=(const Video&) = delete;

  /// @throws FileError if ffmpeg no longer listens.
  void add(const Image& image);
  /// Waits until the file is complete and puts it in its place.
  /// @throws FileError with what ffmpeg said.
  void finish();

 private:
  int wait();

  std::string path_, part_;
  pid_t process_ = -1;
  int pipe_ = -1;
};

}  // namespace tumble
