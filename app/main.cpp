// The program: a table of commands, nothing else.
#include "app/command/command.h"

namespace tumble::command {
int check(int argc, char** argv);
int completion(int argc, char** argv);
int converge(int argc, char** argv);
int describe(int argc, char** argv);
int doctor(int argc, char** argv);
int exportRun(int argc, char** argv);
int gallery(int argc, char** argv);
int golden(int argc, char** argv);
int list(int argc, char** argv);
int man(int argc, char** argv);
int render(int argc, char** argv);
int report(int argc, char** argv);
int simulate(int argc, char** argv);
int sweep(int argc, char** argv);
int verify(int argc, char** argv);
int view(int argc, char** argv);
}  // namespace tumble::command

int main(int argc, char** argv) {
  using namespace tumble;
  constexpr Command table[] = {
      {"list", "the demos, by chapter", command::list},
      {"describe", "what a scene contains, which method and features it uses, its claim",
       command::describe},
      {"simulate", "numbers only: trajectory, events, contacts, summary", command::simulate},
      {"render", "numbered images; or a still, a strobe, a sheet, a film", command::render},
      {"export", "a run for other programs: glTF 2.0", command::exportRun},
      {"sweep", "one run for each value of the scene's [sweep]: images, a sheet, a table",
       command::sweep},
      {"gallery", "the key pictures of every demo and a page to leaf through", command::gallery},
      {"check", "hold scenes to their closed forms", command::check},
      {"converge", "halved steps and all methods: differences, order, error, cost",
       command::converge},
      {"golden", "hold small images and numbers against the approved ones", command::golden},
      {"verify", "hold a run to the bits of another", command::verify},
      {"report", "speed against error: numbers, figures, a table", command::report},
      {"view", "the window: play, step, scrub, turn", command::view},
      {"doctor", "what this machine offers for drawing, and what is missing", command::doctor},
      {"completion", "what Tab offers in bash, zsh and fish", command::completion},
      {"man", "the manual page", command::man},
  };
  return dispatch(table, argc, argv);
}
