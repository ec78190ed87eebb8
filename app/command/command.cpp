#include "app/command/command.h"

#include <fmt/core.h>

#include <csignal>
#include <cstdio>
#include <new>
#include <string>

#include "app/command/interrupt.h"
#include "app/command/progress.h"
#include "app/file/file.h"
#include "app/record/recording.h"
#include "app/scene/findings.h"
#include "app/scene/scene.h"
#include "render/context/context.h"

namespace tumble {

namespace {

std::span<const Command> dispatched;

void printHelp(std::span<const Command> table, std::FILE* out) {
  fmt::print(out, "tumble {} draws scenes of rigid bodies that can be trusted.\n\n",
             TUMBLE_VERSION);
  fmt::print(out, "Usage: tumble COMMAND [SCENE] [options]\n\nCommands:\n");
  for (const Command& row : table) fmt::print(out, "  {:<12}{}\n", row.name, row.summary);
  fmt::print(out,
             "\nSCENE is a demo's name or the path of a TOML file.\n"
             "`tumble COMMAND --help` shows options and examples.\n");
}

int runNamed(std::span<const Command> table, int argc, char** argv) {
  if (argc < 2) {
    printHelp(table, stderr);
    return kUsage;
  }
  const std::string_view name = argv[1];
  if (name == "--help" || name == "-h" || name == "help") {
    printHelp(table, stdout);
    return kOk;
  }
  if (name == "--version") {
    fmt::print("tumble {}\n", TUMBLE_VERSION);
    return kOk;
  }
  std::vector<std::string> names;
  for (const Command& row : table) {
    if (row.name == name) return row.run(argc - 1, argv + 1);
    names.emplace_back(row.name);
  }
  throw UsageError(fmt::format("unknown command '{}'{}; `tumble --help` lists the commands", name,
                               hint(name, names)));
}

int complain(int code, const char* what) {
  tell(fmt::format("tumble: {}\n", what));
  return code;
}

}  // namespace

int guarded(const std::function<int()>& work) {
  try {
    return work();
  } catch (const UsageError& error) {
    return complain(kUsage, error.what());
  } catch (const SceneError& error) {
    for (const Diagnostic& diagnostic : error.diagnostics()) tell(format(diagnostic) + "\n");
    return kScene;
  } catch (const NoContext& error) {
    return complain(kNoContext, error.what());
  } catch (const StoppedError& error) {
    return complain(kPhysics, error.what());
  } catch (const Interrupted& error) {
    return complain(kInterrupted, error.what());
  } catch (const std::bad_alloc&) {
    return complain(kFile, "out of memory; try a smaller --size or a lower --rate");
  } catch (const std::exception& error) {
    return complain(kFile, error.what());
  }
}

int dispatch(std::span<const Command> table, int argc, char** argv) {
  // A limit on the size of files is a write that fails, not a reason to die.
  std::signal(SIGXFSZ, SIG_IGN);
  dispatched = table;
  return guarded([&] {
    const int code = runNamed(table, argc, argv);
    if (std::fflush(stdout) != 0 || std::ferror(stdout) != 0)
      throw FileError("cannot write to standard output");
    return code;
  });
}

std::span<const Command> commandTable() {
  return dispatched;
}

}  // namespace tumble
