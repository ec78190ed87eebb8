// Files, whole or not at all.
#pragma once

#include <cstdio>
#include <memory>
#include <stdexcept>
#include <string>
#include <string_view>

namespace tumble {

/// A file or folder that cannot be read or written: path and reason.
class FileError : public std::runtime_error {
  using std::runtime_error::runtime_error;
};

struct CloseFile {
  void operator()(std::FILE* file) const { std::fclose(file); }
};
using File = std::unique_ptr<std::FILE, CloseFile>;

/// A file that is written piece by piece and gets its name when it is complete, in place of an
/// older one if there is one. One that is not finished leaves nothing behind; nor does one whose
/// process is killed, unless the file system has no files without a name: then the temporary one
/// beside it. A link stays one, and what it leads to is written; a pipe or a device, as /dev/stdout
/// may be, is written into piece by piece.
class FileWriter {
 public:
  /// @throws FileError
  explicit FileWriter(std::string path);
  ~FileWriter();
  FileWriter(const FileWriter&) = delete;
  FileWriter& operator=(const FileWriter&) = delete;

  /// @throws FileError
  void write(std::string_view text);
  /// @throws FileError
  void finish();

 private:
  [[noreturn]] void fail(int error);

  std::string path_, temporary_;
  File file_;
  bool straight_;       ///< into a pipe or a device
  bool named_ = false;  ///< the temporary one has a name
};

/// Writes the whole file by way of a temporary one beside it that is renamed when complete.
/// @throws FileError; nothing half-written is left.
void writeFile(const std::string& path, const std::string& content);

/// Finds out before long work whether a file of this path can be written; makes its folder.
/// @throws FileError
void prepareFile(const std::string& path);

/// @throws FileError
std::string readFile(const std::string& path);

/// Makes the folder with those above it, unless it is there.
/// @throws FileError
void makeFolder(const std::string& path);

}  // namespace tumble
