// tumble completion: what Tab offers in a shell.
#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "app/command/command_line.h"
#include "app/command/sheet.h"
#include "app/scene/findings.h"

namespace tumble {

namespace {

std::string words(std::span<const CommandSheet> sheets) {
  std::string text;
  for (const CommandSheet& sheet : sheets) text += (text.empty() ? "" : " ") + sheet.name;
  return text;
}

bool takesShell(const CommandSheet& sheet) {
  return std::any_of(sheet.options.begin(), sheet.options.end(),
                     [](const OptionSheet& option) { return option.names == "SHELL"; });
}

std::string shellWords() {
  return fmt::format("{}", fmt::join(completionShells(), " "));
}

// Inside single quotes.
std::string singleQuoted(const std::string& text) {
  std::string escaped;
  for (const char c : text) escaped += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return escaped;
}

std::string bashScript(std::span<const CommandSheet> sheets) {
  std::string cases, places;
  for (const CommandSheet& sheet : sheets) {
    if (takesShell(sheet))
      places += fmt::format("      {}) mapfile -t COMPREPLY < <(compgen -W '{}' -- \"$word\") ;;\n",
                            sheet.name, shellWords());
    std::string names = "--help";
    for (const OptionSheet& option : sheet.options)
      if (!option.place()) names += " " + option.longName();
    cases += fmt::format("    {}) words='{}' ;;\n", sheet.name, names);
  }
  return fmt::format(
      R"sh(# Completion of tumble for bash: source <(tumble completion bash)
_tumble() {{
  local word=${{COMP_WORDS[COMP_CWORD]}} words=
  if ((COMP_CWORD == 1)); then
    mapfile -t COMPREPLY < <(compgen -W '{}' -- "$word")
    return
  fi
  if [[ $word != -* ]]; then
    case ${{COMP_WORDS[1]}} in
{}      *) mapfile -t COMPREPLY < <(compgen -W "$(tumble list -q 2>/dev/null)" -- "$word"; compgen -f -- "$word") ;;
    esac
    return
  fi
  case ${{COMP_WORDS[1]}} in
{}  esac
  mapfile -t COMPREPLY < <(compgen -W "$words" -- "$word")
}}
complete -o filenames -F _tumble tumble
)sh",
      words(sheets), places, cases);
}

// In a specification of _arguments brackets and colons have a meaning.
std::string zshText(const std::string& text) {
  std::string escaped;
  for (const char c : text) {
    if (c == '[' || c == ']' || c == ':' || c == '\\') escaped += '\\';
    escaped += c;
  }
  return singleQuoted(escaped);
}

std::string zshScript(std::span<const CommandSheet> sheets) {
  std::string commands, cases;
  for (const CommandSheet& sheet : sheets) {
    commands += fmt::format("    '{}:{}'\n", sheet.name, zshText(sheet.summary));
    cases += fmt::format("    {}) _arguments", sheet.name);
    for (const OptionSheet& option : sheet.options)
      if (!option.place())
        cases += fmt::format(
            " \\\n      '*{}[{}]{}'", option.longName(), zshText(option.help),
            option.flag ? ""
                        : ":" + zshText(option.type.empty() ? "value" : option.type) + ":_files");
    cases += takesShell(sheet) ? fmt::format(" \\\n      '1:shell:({})' ;;\n", shellWords())
                               : std::string(" \\\n      '*:scene:_tumble_scenes' ;;\n");
  }
  return fmt::format(R"sh(#compdef tumble
# Completion of tumble for zsh: tumble completion zsh >~/.zfunc/_tumble
_tumble_scenes() {{
  local -a demos
  demos=(${{(f)"$(tumble list -q 2>/dev/null)"}})
  compadd -a demos
  _files
}}
_tumble() {{
  local -a commands
  commands=(
{})
  if ((CURRENT == 2)); then
    _describe command commands
    return
  fi
  shift words
  ((CURRENT--))
  case $words[1] in
{}  esac
}}
_tumble "$@"
)sh",
                     commands, cases);
}

std::string fishScript(std::span<const CommandSheet> sheets) {
  std::string script =
      "# Completion of tumble for fish: tumble completion fish "
      ">~/.config/fish/completions/tumble.fish\n";
  for (const CommandSheet& sheet : sheets) {
    script += fmt::format("complete -c tumble -n __fish_use_subcommand -f -a {} -d '{}'\n",
                          sheet.name, singleQuoted(sheet.summary));
    for (const OptionSheet& option : sheet.options) {
      const std::string here =
          fmt::format("complete -c tumble -n '__fish_seen_subcommand_from {}'", sheet.name);
      if (option.place())
        script += takesShell(sheet) ? fmt::format("{} -f -a '{}'\n", here, shellWords())
                                    : here + " -a '(tumble list -q 2>/dev/null)'\n";
      else
        script += fmt::format("{} -l {}{} -d '{}'\n", here, option.longName().substr(2),
                              option.flag ? "" : " -r", singleQuoted(option.help));
    }
  }
  return script;
}

struct Shell {
  const char* name;
  std::string (*script)(std::span<const CommandSheet>);
};
constexpr std::array kShells = {Shell{"bash", bashScript}, Shell{"zsh", zshScript},
                                Shell{"fish", fishScript}};

}  // namespace

std::vector<std::string> completionShells() {
  std::vector<std::string> names;
  for (const Shell& shell : kShells) names.emplace_back(shell.name);
  return names;
}

std::string completionScript(const std::string& shell, std::span<const CommandSheet> sheets) {
  for (const Shell& row : kShells)
    if (row.name == shell) return row.script(sheets);
  throw UsageError("no completion for the shell '" + shell + "'" + hint(shell, completionShells()));
}

namespace command {

int completion(int argc, char** argv) {
  std::string shell;
  CommandLine line("completion", "What Tab offers in a shell: commands, options, scenes.",
                   {"bash >~/.local/share/bash-completion/completions/tumble",
                    "zsh >~/.zfunc/_tumble", "fish >~/.config/fish/completions/tumble.fish"});
  line.option("SHELL", shell, "bash, zsh or fish", {.required = true});
  if (!line.read(argc, argv)) return kOk;
  fmt::print("{}", completionScript(shell, sheetsOf(commandTable())));
  return kOk;
}

}  // namespace command

}  // namespace tumble
