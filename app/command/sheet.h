// What the commands take, as data: completions and the manual page are made of it.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "app/command/command.h"

namespace tumble {

/// An option, a flag or a place of a command line.
struct OptionSheet {
  std::string names;  ///< "-o,--output", or "SCENE" of a place
  std::string type;   ///< of its value, "" if it has none or the help names none
  std::string help;
  bool flag = false;      ///< takes no value
  bool required = false;  ///< the command does nothing without it
  bool place() const { return !names.starts_with('-'); }
  /// "--output" of "-o,--output".
  std::string longName() const { return names.substr(names.find("--")); }
};

/// A command line before it has read anything.
struct CommandSheet {
  std::string name, summary;
  std::vector<std::string> examples;
  std::vector<OptionSheet> options;
};

/// The sheets of all commands, each asked for without being run.
std::vector<CommandSheet> sheetsOf(std::span<const Command> table);

/// Shells that completions are written for.
std::vector<std::string> completionShells();
/// The script that completes commands, options and scenes. @param shell of completionShells()
std::string completionScript(const std::string& shell, std::span<const CommandSheet> sheets);

/// The manual page, section 1, in the macros of man(7).
std::string manualPage(std::span<const CommandSheet> sheets);

}  // namespace tumble
