// A command is a row of the program's table; its errors become exit codes in one place.
#pragma once

#include <functional>
#include <span>
#include <string_view>
#include <utility>

#include "app/scene/override.h"

namespace tumble {

/// What the program returns to the shell.
enum Exit : int {
  kOk = 0,
  kFailed = 1,         ///< a check or a golden failed
  kUsage = 2,          ///< the command line is wrong
  kScene = 3,          ///< the scene is refused
  kNoContext = 4,      ///< no OpenGL context, or it fails
  kFile = 5,           ///< a file is not there, or cannot be read or written
  kPhysics = 6,        ///< the physics could not go on
  kInterrupted = 130,  ///< Ctrl-C; run again to go on
};

/// What people are told of them.
inline constexpr std::pair<Exit, std::string_view> kExitMeanings[] = {
    {kOk, "done"},
    {kFailed, "a check or a golden failed"},
    {kUsage, "the command line makes no sense"},
    {kScene, "the scene, or a mesh it names, is refused; the line says where and why"},
    {kNoContext, "no OpenGL context, or one that cannot draw"},
    {kFile, "a file, that of the scene too, is not there or cannot be read or written"},
    {kPhysics, "the physics could not go on; the certificate says why"},
    {kInterrupted, "stopped by Ctrl-C; run again to go on"}};

/// A row of the table of commands. argv[0] is the command's own name.
struct Command {
  std::string_view name, summary;
  int (*run)(int argc, char** argv);
};

/// Finds argv[1] in the table and runs it. Every error becomes one line on stderr and its exit
/// code: UsageError 2 · SceneError 3 · NoContext 4 · FileError and other failures of the system 5 ·
/// Interrupted 130.
int dispatch(std::span<const Command> table, int argc, char** argv);

/// The table that is dispatched.
std::span<const Command> commandTable();

/// The exit code of the work, or that of the error that ends it, after it was told.
int guarded(const std::function<int()>& work);

}  // namespace tumble
