#include "app/file/file.h"

#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>

namespace tumble {

namespace {

[[noreturn]] void fail(const char* verb, const std::string& path, int error) {
  throw FileError(std::string("cannot ") + verb + " '" + path + "': " + std::strerror(error));
}

}  // namespace

FileWriter::FileWriter(std::string path)
    : path_(std::move(path)), temporary_(path_ + ".part" + std::to_string(::getpid())) {
  file_.reset(std::fopen(temporary_.c_str(), "wb"));
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
