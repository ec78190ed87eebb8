#include "app/command/video.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <vector>

#include "app/file/file.h"

extern char** environ;

namespace tumble {

namespace {

// "film.mp4" → ".film.part.mp4" in the same folder: ffmpeg reads the format off the ending.
std::string partOf(const std::string& path) {
  const std::filesystem::path file = path;
  const std::string name =
      fmt::format(".{}.part{}", file.stem().string(), file.extension().string());
  return (file.parent_path() / name).string();
}

// A GIF has a palette of its own, one for the film, and hundredths of a second between images. Page
// and floor take part in the palette: then dots against banding leave more error than they take.
// Players of films want even sizes and colour at half resolution.
std::vector<std::string> formatOf(const std::string& path, double rate) {
  if (!path.ends_with(".gif"))
    return {"-vf", "pad=ceil(iw/2)*2:ceil(ih/2)*2", "-pix_fmt", "yuv420p"};
  return {"-filter_complex",
          fmt::format("fps={:.17g},split[a][b];[a]palettegen=stats_mode=full[p];[b][p]paletteuse="
                      "dither=none:diff_mode=rectangle",
                      std::min(rate, 25.0))};
}

pid_t spawnFfmpeg(std::vector<std::string> words, int input, int other) {
  std::vector<char*> arguments;
  for (std::string& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_adddup2(&actions, input, STDIN_FILENO);
  posix_spawn_file_actions_addclose(&actions, other);
  posix_spawn_file_actions_addclose(&actions, input);
  // In a group of its own, for Ctrl-C to reach this process alone, which then ends it.
  posix_spawnattr_t attributes;
  posix_spawnattr_init(&attributes);
  posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETPGROUP);
  pid_t process = -1;
  const int error =
      posix_spawnp(&process, words[0].c_str(), &actions, &attributes, arguments.data(), environ);
  posix_spawnattr_destroy(&attributes);
  posix_spawn_file_actions_destroy(&actions);
  if (error == 0) return process;
  throw FileError(
      fmt::format("cannot run ffmpeg, which --video needs: {}; install the package "
                  "ffmpeg or leave --video out",
                  std::strerror(error)));
}

}  // namespace

Video::Video(std::string path, int width, int height, double rate)
    : path_(std::move(path)), part_(partOf(path_)) {
  std::signal(SIGPIPE, SIG_IGN);
  int ends[2];
  if (::pipe2(ends, O_CLOEXEC) != 0) throw FileError("cannot open a pipe to ffmpeg");
  try {
    std::vector<std::string> words = {"ffmpeg",    "-y",
                                      "-loglevel", "error",
                                      "-f",        "rawvideo",
                                      "-pix_fmt",  "rgb24",
                                      "-s",        fmt::format("{}x{}", width, height),
                                      "-r",        fmt::format("{:.17g}", rate),
                                      "-i",        "-"};
    for (const std::string& word : formatOf(path_, rate)) words.push_back(word);
    words.push_back(part_);
    process_ = spawnFfmpeg(std::move(words), ends[0], ends[1]);
  } catch (...) {
    ::close(ends[0]);
    ::close(ends[1]);
    throw;
  }
  ::close(ends[0]);
  pipe_ = ends[1];
}

Video::~Video() {
  if (process_ < 0) return;
  ::kill(process_, SIGTERM);
  wait();
  std::remove(part_.c_str());
}

void Video::add(const Image& image) {
  const char* data = reinterpret_cast<const char*>(image.rgb.data());
  std::size_t left = image.rgb.size();
  while (left > 0) {
    const ssize_t count = ::write(pipe_, data, left);
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0)
      throw FileError("ffmpeg stopped while it wrote '" + path_ + "'; see its words above");
    data += count;
    left -= static_cast<std::size_t>(count);
  }
}

void Video::finish() {
  const int status = wait();
  if (status != 0 || std::rename(part_.c_str(), path_.c_str()) != 0) {
    std::remove(part_.c_str());
    throw FileError(
        fmt::format("ffmpeg could not write '{}' (status {}); see its words above", path_, status));
  }
}

// Closes the pipe and reaps the process.
int Video::wait() {
  ::close(pipe_);
  int status = -1;
  while (::waitpid(process_, &status, 0) < 0 && errno == EINTR) {
  }
  process_ = -1;
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

}  // namespace tumble
