#include "app/record/file.h"

#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <memory>

namespace tumble {

namespace {

struct Close {
  void operator()(std::FILE* file) const { std::fclose(file); }
};
using File = std::unique_ptr<std::FILE, Close>;

[[noreturn]] void fail(const char* verb, const std::string& path, int error) {
  throw FileError(std::string("cannot ") + verb + " '" + path + "': " + std::strerror(error));
}

// 0, or the errno of the first call that failed.
int writeAll(const std::string& path, const std::string& content) {
  File file(std::fopen(path.c_str(), "wb"));
  if (!file) return errno;
  if (std::fwrite(content.data(), 1, content.size(), file.get()) != content.size()) return errno;
  if (std::fflush(file.get()) != 0) return errno;
  return std::fclose(file.release()) == 0 ? 0 : errno;
}

}  // namespace

void writeFile(const std::string& path, const std::string& content) {
  const std::string temporary = path + ".part" + std::to_string(::getpid());
  int error = writeAll(temporary, content);
  if (error == 0 && std::rename(temporary.c_str(), path.c_str()) != 0) error = errno;
  if (error != 0) {
    std::remove(temporary.c_str());
    fail("write", path, error);
  }
}

std::string readFile(const std::string& path) {
  File file(std::fopen(path.c_str(), "rb"));
  if (!file) fail("read", path, errno);
  std::string content;
  char block[1 << 16];
  while (const std::size_t count = std::fread(block, 1, sizeof block, file.get()))
    content.append(block, count);
  if (std::ferror(file.get())) fail("read", path, errno);
  return content;
}

void makeFolder(const std::string& path) {
  std::error_code error;
  std::filesystem::create_directories(path, error);
  if (!error && !std::filesystem::is_directory(path))
    error = std::make_error_code(std::errc::not_a_directory);
  if (error) throw FileError("cannot make the folder '" + path + "': " + error.message());
}

}  // namespace tumble
