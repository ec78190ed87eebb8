// A command is a row of the program's table; its errors become exit codes in one place.
#pragma once

#include <span>
#include <string_view>

#include "app/scene/override.h"

namespace tumble {

/// What the program returns to the shell.
enum Exit : int {
  kOk = 0,
  kFailed = 1,     ///< a check or a golden failed
  kUsage = 2,      ///< the command line is wrong
  kScene = 3,      ///< the scene is refused
  kNoContext = 4,  ///< no OpenGL context, or it fails
  kFile = 5,       ///< a file cannot be read or written
  kPhysics = 6,    ///< the physics could not go on
};

/// A row of the table of commands. argv[0] is the command's own name.
struct Command {
  std::string_view name, summary;
  int (*run)(int argc, char** argv);
};

/// Finds argv[1] in the table and runs it. Every error becomes one line on stderr and its exit
/// code: UsageError 2 · SceneError 3 · NoContext 4 · FileError and other failures of the system 5.
int dispatch(std::span<const Command> table, int argc, char** argv);

}  // namespace tumble
