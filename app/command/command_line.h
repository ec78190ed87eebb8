// The parser of one command's arguments.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace tumble {

/// What an option is beside its name and help.
struct OptionTraits {
  std::string type = {};                                ///< of its value, as the help names it
  std::optional<std::pair<double, double>> range = {};  ///< refuses numbers outside, NaN too
  bool required = false;
  bool hidden = false;     ///< from the help
  std::string needs = {};  ///< another option that must be given too
};

struct CommandSheet;

/// Options and flags that write into variables of the command, with examples below the help.
class CommandLine {
 public:
  /// @param examples "arguments  # what they do", without the program's name
  CommandLine(const std::string& name, const std::string& summary,
              const std::vector<std::string>& examples);
  ~CommandLine();

  void flag(const std::string& names, bool& value, const std::string& help);

  /// @param names  "-o,--output", or the name of a place: "SCENE"
  /// @param value  string, int, double, optional double or strings: a place takes several, an
  ///               option one each time that it is given. It keeps what it holds if none is.
  template <typename Value>
  void option(const std::string& names, Value& value, const std::string& help,
              const OptionTraits& traits = {});

  /// False if help was asked for and has been printed.
  /// @throws UsageError in one line.
  bool read(int argc, char** argv);

  /// While this is set, `read` leaves there what the line takes, reads nothing and returns false.
  static CommandSheet* listener;

 private:
  struct Parser;
  std::unique_ptr<Parser> parser_;
};

}  // namespace tumble
