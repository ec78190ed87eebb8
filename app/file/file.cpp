#include "app/file/file.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>

namespace tumble {

namespace {

[[noreturn]] void fail(const char* verb, const std::string& path, int error) {
  throw FileError(std::string("cannot ") + verb + " '" + path + "': " + std::strerror(error));
}

// The folder that a file is to stand in is made; where that cannot be, opening the file says so.
void makeFolderOf(const std::string& path) {
  std::error_code ignored;
  const std::filesystem::path folder = std::filesystem::path(path).parent_path();
  if (!folder.empty()) std::filesystem::create_directories(folder, ignored);
}

// Whether it is there and nothing that a new file could stand in place of.
bool isPipeOrDevice(const std::string& path) {
  std::error_code none;
  const std::filesystem::file_status status = std::filesystem::status(path, none);
  return std::filesystem::exists(status) && !std::filesystem::is_regular_file(status) &&
         !std::filesystem::is_directory(status);
}

// Where the file stands that a link leads to; any other path as it is.
std::string behindLink(const std::string& path) {
  std::error_code none;
  if (!std::filesystem::is_symlink(path, none)) return path;
  const std::filesystem::path place = std::filesystem::canonical(path, none);
  return none ? path : place.string();
}

// A file in the folder of the path that has no name yet, and so goes with the process; null where
// the file system has none of these.
std::FILE* nameless(const std::string& path) {
  const std::string folder = std::filesystem::path(path).parent_path().string();
  const int file =
      ::open(folder.empty() ? "." : folder.c_str(), O_TMPFILE | O_WRONLY | O_CLOEXEC, 0666);
  return file < 0 ? nullptr : ::fdopen(file, "wb");
}

// Gives it a name that nothing has. Returns 0 or what went wrong.
int giveName(std::FILE* file, const std::string& path) {
  const std::string open = "/proc/self/fd/" + std::to_string(::fileno(file));
  return ::linkat(AT_FDCWD, open.c_str(), AT_FDCWD, path.c_str(), AT_SYMLINK_FOLLOW) == 0 ? 0
                                                                                          : errno;
}

}  // namespace

FileWriter::FileWriter(std::string path)
    : path_(behindLink(path)),
      temporary_(path_ + ".part" + std::to_string(::getpid())),
      straight_(isPipeOrDevice(path_)) {
  if (straight_) {
    file_.reset(std::fopen(path_.c_str(), "wb"));
    if (!file_) fail(errno);
    return;
  }
  makeFolderOf(path_);
  file_.reset(nameless(path_));
  named_ = !file_;
  if (named_) file_.reset(std::fopen(temporary_.c_str(), "wb"));
  if (!file_) fail(errno);
}

FileWriter::~FileWriter() {
  if (!file_) return;
  file_.reset();
  std::remove(temporary_.c_str());
}

void FileWriter::write(std::string_view text) {
  if (std::fwrite(text.data(), 1, text.size(), file_.get()) != text.size()) fail(errno);
}

void FileWriter::finish() {
  if (std::fflush(file_.get()) != 0) fail(errno);
  if (straight_) return file_.reset();
  if (!named_) {
    const int error = giveName(file_.get(), path_);
    if (error == 0) return file_.reset();
    if (const int other = error == EEXIST ? giveName(file_.get(), temporary_) : error; other != 0)
      fail(other);
  }
  if (std::fclose(file_.release()) != 0) fail(errno);
  if (std::rename(temporary_.c_str(), path_.c_str()) != 0) fail(errno);
}

void FileWriter::fail(int error) {
  file_.reset();
  std::remove(temporary_.c_str());
  tumble::fail("write", path_, error);
}

void writeFile(const std::string& path, const std::string& content) {
  FileWriter file(path);
  file.write(content);
  file.finish();
}

void prepareFile(const std::string& path) {
  const std::filesystem::path folder = std::filesystem::path(path).parent_path();
  if (!folder.empty()) makeFolder(folder.string());
  if (std::filesystem::is_directory(path)) fail("write", path, EISDIR);
  if (!isPipeOrDevice(path)) FileWriter opens(path);
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
