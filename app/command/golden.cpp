// tumble golden: images and numbers held against those that were approved.
#include <fmt/core.h>

#include <algorithm>
#include <filesystem>
#include <iterator>
#include <map>
#include <optional>

#include "app/command/command.h"
#include "app/command/letters.h"
#include "app/command/options.h"
#include "app/command/progress.h"
#include "app/file/data.h"
#include "app/file/file.h"
#include "app/golden/draw.h"
#include "app/golden/formats.h"
#include "app/golden/golden.h"
#include "app/golden/report.h"
#include "app/scene/demos.h"
#include "render/renderer.h"

namespace tumble::command {

namespace {

namespace fs = std::filesystem;

struct Options {
  std::vector<std::string> subjects, folders;
  std::string out = "out/golden", junit;
  bool update = false, json = false;
};

bool readOptions(int argc, char** argv, Options& options) {
  CommandLine line("golden", "Compares small images and numbers of scenes with the approved ones.",
                   {"                       # all demos", "path-of-brick          # one",
                    "--update               # accept what is drawn now",
                    "--folder goldens --update scenes/*.toml # begin goldens of your own scenes",
                    "--folder goldens --junit goldens.xml scenes/*.toml # hold them, for a CI"});
  line.option("SUBJECT", options.subjects,
              "demos to look at [all]; with --folder any scenes, by name or path");
  line.option("--folder", options.folders, "keep goldens there; repeatable [the program's own]",
              {.type = "DIR"});
  line.flag("--update", options.update, "accept what is drawn now");
  line.option("-o,--output", options.out,
              "folder for failing images and report.html [out/golden, with --folder one in it]");
  line.option("--junit", options.junit, "write what came of it as JUnit's XML", {.type = "FILE"});
  line.flag("--json", options.json, "say what came of it as JSON");
  return line.read(argc, argv);
}

/// What is drawn: one of the program's own subjects by name, or a scene.
struct Subject {
  std::string name;
  std::optional<Scene> scene = {};
};

std::vector<Subject> ownSubjects(const std::vector<std::string>& asked) {
  std::vector<std::string> all = demoNames();
  all.push_back(std::string(kWindowSubject));
  for (const std::string& name : asked)
    if (std::find(all.begin(), all.end(), name) == all.end())
      throw UsageError(
          fmt::format("no golden is kept of '{}'; `tumble golden` holds all demos and '{}', "
                      "`tumble golden --folder DIR SCENE…` scenes of your own",
                      name, kWindowSubject));
  std::vector<Subject> subjects;
  for (const std::string& name : asked.empty() ? all : asked) subjects.push_back({name});
  return subjects;
}

// All scenes are read before the first is drawn: what is misspelt is told at once.
std::vector<Subject> scenesOf(const std::vector<std::string>& asked) {
  if (asked.empty())
    throw UsageError(
        "--folder: name the scenes too, for example tumble golden --folder goldens "
        "scenes/*.toml");
  std::vector<Subject> subjects;
  std::map<std::string, std::string> files;
  for (const std::string& name : asked) {
    Scene scene = load({name, {}});
    noteLackingLetters(scene);
    const auto [other, isNew] = files.emplace(scene.name, scene.file);
    if (!isNew)
      throw UsageError(fmt::format("'{}' and '{}' would both keep goldens as '{}'", other->second,
                                   scene.file, scene.name));
    const std::string subject = scene.name;
    subjects.push_back({subject, std::move(scene)});
  }
  return subjects;
}

std::string inShell(const std::string& word) {
  constexpr std::string_view kPlain =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789_./-";
  if (word.find_first_not_of(kPlain) == std::string::npos) return word;
  std::string quoted = "'";
  for (const char c : word) quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return quoted + "'";
}

// One folder of goldens, and where its failures go.
struct Shelf {
  Holding holding;
  Manifest manifest;
  std::string out;
};

Shelf ownShelf(const Options& options) {
  Shelf shelf;
  shelf.holding.folder = dataFolder("golden");
  shelf.holding.approve = "tumble golden --update";
  shelf.out = options.out;
  return shelf;
}

std::vector<Shelf> shelvesOf(const Options& options, const std::vector<Subject>& subjects) {
  std::vector<Shelf> shelves;
  if (options.folders.empty()) shelves.push_back(ownShelf(options));
  std::map<std::string, int> names;
  for (const std::string& folder : options.folders) {
    if (!options.update && !fs::is_directory(folder))
      throw FileError(
          fmt::format("there is no folder '{}' of goldens; --update begins one", folder));
    Shelf shelf;
    shelf.holding.folder = folder;
    shelf.holding.approve = "tumble golden --folder " + inShell(folder) + " --update";
    for (const Subject& subject : subjects)
      shelf.holding.scenes[subject.name] = inShell(subject.scene->file);
    std::string name = fs::absolute(folder + "/.").parent_path().filename().string();
    if (const int earlier = names[name]++) name += fmt::format("-{}", earlier + 1);
    shelf.out = options.out + "/" + name;
    shelves.push_back(std::move(shelf));
  }
  for (Shelf& shelf : shelves)
    shelf.manifest = readManifest(shelf.holding.folder + "/manifest.json");
  return shelves;
}

void print(const std::vector<Finding>& findings) {
  for (const Finding& finding : findings)
    if (!finding.passes() || !quiet())
      fmt::print("{:<5} {:<20} {:<12} {}\n", finding.passes() ? "ok" : "FAIL", finding.subject,
                 finding.name, finding.verdict());
}

void print(const std::vector<Renewal>& renewals) {
  if (quiet()) return;
  for (const Renewal& one : renewals)
    fmt::print("{:<7} {:<20} {:<12} {}\n", one.word, one.subject, one.name, one.how);
}

std::string drawnBy(const Manifest& manifest) {
  return fmt::format("tumble {}, {}, OpenGL {}", manifest.program, manifest.glRenderer,
                     manifest.glVersion);
}

// Replaces the goldens of a subject in a folder by what is drawn now.
std::vector<Finding> update(Shelf& shelf, const Golden& now, bool json, const Context& context) {
  Holding& holding = shelf.holding;
  const std::vector<Renewal> renewals = storeGolden(now, shelf.manifest, holding.folder);
  if (!json) print(renewals);
  holding.renewals.insert(holding.renewals.end(), renewals.begin(), renewals.end());
  Manifest entry{context.renderer(), context.version(), TUMBLE_VERSION, {}};
  entry.images[now.subject] = shelf.manifest.images[now.subject];
  enterInManifest(holding.folder, entry);
  return findingsOfStored(now);
}

// Holds a subject against the goldens of a folder.
std::vector<Finding> hold(const Shelf& shelf, const Golden& now, bool json) {
  const std::vector<Finding> found = compareGolden(now, shelf.manifest, shelf.holding.folder);
  if (!json) print(found);
  return found;
}

// Leaves what was drawn where it can be looked at, and takes away what an earlier failure left.
void leaveActual(const Finding& finding, const std::string& folder) {
  const std::string place = folder + "/" + finding.subject;
  const std::string file = place + "/" + finding.name + ".png";
  if (finding.passes() || !finding.actual) {
    std::error_code ignored;
    fs::remove(file, ignored);
    return;
  }
  makeFolder(place);
  writePng(file, *finding.actual);
}

// "2 new, 1 changed, 3 ok".
std::string told(const std::vector<Renewal>& renewals) {
  std::string text;
  for (const char* word : {"new", "changed", "gone", "ok"}) {
    const auto count = std::count_if(renewals.begin(), renewals.end(),
                                     [&](const Renewal& one) { return one.word == word; });
    if (count > 0) text += fmt::format("{}{} {}", text.empty() ? "" : ", ", count, word);
  }
  return text;
}

// Tells what came of the comparison and leaves behind what helps to see why.
int conclude(const Shelf& shelf, bool json) {
  const Holding& holding = shelf.holding;
  const auto total = static_cast<long>(holding.findings.size());
  const std::string where = holding.scenes.empty() ? "" : holding.folder + ": ";
  if (!json && holding.renewals.empty())
    fmt::print("{}{} goldens: {} pass, {} equal to the last bit\n", where, total, holding.passing(),
               holding.exact());
  else if (!json)
    fmt::print("{}{} goldens: {}\n", where, total, told(holding.renewals));
  if (!json && holding.exact() < total && holding.expectedBy != holding.actualBy)
    fmt::print("{}\n", holding.environment());
  for (const Finding& finding : holding.findings) leaveActual(finding, shelf.out);
  const std::string report = shelf.out + "/report.html";
  if (holding.passing() == total) {
    std::error_code ignored;
    fs::remove(report, ignored);
    return kOk;
  }
  makeFolder(shelf.out);
  writeFile(report, htmlReport(holding));
  if (!json) fmt::print("see {}; `{}` accepts what is drawn now\n", report, holding.approval());
  return kFailed;
}

void writeForPrograms(const Options& options, const std::vector<Shelf>& shelves) {
  std::vector<Holding> holdings;
  for (const Shelf& shelf : shelves) holdings.push_back(shelf.holding);
  if (!options.junit.empty()) writeFile(options.junit, junitXml(holdings));
  if (options.json) fmt::print("{}", goldenJson(holdings));
}

void refuseOtherRasterisers(const Context& context) {
  if (context.renderer().find("llvmpipe") == std::string::npos)
    throw NoContext(fmt::format(
        "goldens are drawn by llvmpipe and this is {}; try TUMBLE_GL=osmesa", context.renderer()));
}

}  // namespace

int golden(int argc, char** argv) {
  Options options;
  if (!readOptions(argc, argv, options)) return kOk;
  const std::vector<Subject> subjects =
      options.folders.empty() ? ownSubjects(options.subjects) : scenesOf(options.subjects);
  std::vector<Shelf> shelves = shelvesOf(options, subjects);

  const std::unique_ptr<Context> context = makeContext();
  if (options.update) refuseOtherRasterisers(*context);
  Renderer renderer(*context, dataFolder("shaders"), dataFolder("fonts"));
  for (const Subject& subject : subjects) {
    const Golden now =
        subject.scene ? drawGolden(*subject.scene, renderer) : drawGolden(subject.name, renderer);
    for (Shelf& shelf : shelves) {
      std::vector<Finding> found = options.update ? update(shelf, now, options.json, *context)
                                                  : hold(shelf, now, options.json);
      std::move(found.begin(), found.end(), std::back_inserter(shelf.holding.findings));
    }
  }

  int code = kOk;
  for (Shelf& shelf : shelves) {
    const std::string file = shelf.holding.folder + "/manifest.json";
    shelf.holding.expectedBy = drawnBy(options.update ? readManifest(file) : shelf.manifest);
    shelf.holding.actualBy = drawnBy({context->renderer(), context->version(), TUMBLE_VERSION, {}});
    code = std::max(code, conclude(shelf, options.json));
  }
  writeForPrograms(options, shelves);
  return code;
}

}  // namespace tumble::command
