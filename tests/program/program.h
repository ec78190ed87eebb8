// Runs the program as a user would and looks at what it says and leaves behind.
#pragma once

#include <sys/wait.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

#include "tests/folder.h"
#include "tests/text_of.h"

using tumble::test::Folder;
using tumble::test::textOf;

struct Outcome {
  int code = -1;  ///< exit code, or 128 + number of the signal that ended it
  std::string out, err;

  /// Lines on the error stream, without those that tell a slow run's progress, or what a mesh was
  /// taken apart into for the first time.
  long lines() const {
    long count = 0;
    std::istringstream text(err);
    for (std::string line; std::getline(text, line);)
      count += line.find(" % after ") == std::string::npos &&
               line.find(" convex piece") == std::string::npos;
    return count;
  }
  bool says(const std::string& text) const { return err.find(text) != std::string::npos; }
};

/// Whether a text has a part.
inline bool holds(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

/// Runs `before; tumble arguments` in a shell inside the scratch folder.
/// @param before shell commands such as "ulimit -f 8; export TUMBLE_GL=x"
inline Outcome tumbleRun(const Folder& scratch, const std::string& arguments,
                         const std::string& before = ":") {
  const std::filesystem::path out = scratch.path / ".out", err = scratch.path / ".err";
  const std::string command = "cd '" + scratch.path.string() + "' && (" + before + "; exec '" +
                              TUMBLE_PROGRAM + "' " + arguments + ") >.out 2>.err";
  const int status = std::system(command.c_str());
  Outcome outcome{WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status), textOf(out),
                  textOf(err)};
  std::filesystem::remove(out);
  std::filesystem::remove(err);
  return outcome;
}

/// Regular files below a folder.
inline long filesBelow(const std::filesystem::path& folder) {
  if (!std::filesystem::exists(folder)) return 0;
  const std::filesystem::recursive_directory_iterator all(folder);
  return std::count_if(begin(all), end(all),
                       [](const auto& entry) { return entry.is_regular_file(); });
}
