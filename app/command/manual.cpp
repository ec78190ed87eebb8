// tumble man: the manual page.
#include <fmt/core.h>

#include "app/command/command_line.h"
#include "app/command/sheet.h"

namespace tumble {

namespace {

// Text for roff: a backslash and a hyphen are themselves, and no line begins with a control.
std::string roff(const std::string& text) {
  std::string escaped;
  for (const char c : text) {
    if (c == '\\')
      escaped += "\\e";
    else if (c == '-')
      escaped += "\\-";
    else
      escaped += c;
  }
  const bool control = escaped.starts_with('.') || escaped.starts_with('\'');
  return control ? "\\&" + escaped : escaped;
}

std::string sectionOf(const CommandSheet& sheet) {
  std::string synopsis;
  for (const OptionSheet& option : sheet.options)
    if (option.place())
      synopsis += option.required ? " " + option.names : " [" + option.names + "]";
  std::string text = fmt::format(".SS tumble {}{} [options]\n{}\n", roff(sheet.name),
                                 roff(synopsis), roff(sheet.summary));
  for (const OptionSheet& option : sheet.options) {
    std::string names = option.names;
    if (const std::size_t comma = names.find(','); comma != std::string::npos)
      names.replace(comma, 1, ", ");
    text += fmt::format(".TP\n.B {}{}\n{}\n", roff(names),
                        option.type.empty() ? "" : " " + roff(option.type), roff(option.help));
  }
  text += ".PP\n.nf\n";
  for (const std::string& example : sheet.examples)
    text += roff("    tumble " + sheet.name + " " + example) + "\n";
  return text + ".fi\n";
}

}  // namespace

std::string manualPage(std::span<const CommandSheet> sheets) {
  std::string page = fmt::format(
      ".TH TUMBLE 1 \"\" \"tumble {}\"\n.SH NAME\ntumble \\- draws scenes of rigid bodies that can "
      "be trusted\n.SH SYNOPSIS\n.B tumble\n.I COMMAND\n[\\fISCENE\\fR] "
      "[\\fIoptions\\fR]\n.SH DESCRIPTION\nA scene is a demo's name or the path of a TOML file. "
      "Units are SI, Y is up.\n.SH COMMANDS\n",
      TUMBLE_VERSION);
  for (const CommandSheet& sheet : sheets) page += sectionOf(sheet);
  page += ".SH EXIT STATUS\n";
  for (const auto& [code, meaning] : kExitMeanings)
    page += fmt::format(".TP\n.B {}\n{}\n", static_cast<int>(code), roff(std::string(meaning)));
  return page +
         ".SH ENVIRONMENT\n.TP\n.B TUMBLE_GL\nosmesa or egl: what draws\n.TP\n.B "
         "TUMBLE_DATA\nfolder of demos, shaders, fonts and goldens\n";
}

namespace command {

int man(int argc, char** argv) {
  CommandLine line("man", "The manual page.", {"| man -l -", ">~/.local/share/man/man1/tumble.1"});
  if (!line.read(argc, argv)) return kOk;
  fmt::print("{}", manualPage(sheetsOf(commandTable())));
  return kOk;
}

}  // namespace command

}  // namespace tumble
