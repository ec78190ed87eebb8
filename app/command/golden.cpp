// tumble golden: images and numbers held against those that were approved.
#include <fmt/core.h>

#include <algorithm>
#include <filesystem>

#include "app/command/command.h"
#include "app/command/options.h"
#include "app/file/data.h"
#include "app/file/file.h"
#include "app/golden/draw.h"
#include "app/golden/golden.h"
#include "app/golden/report.h"
#include "app/scene/demos.h"
#include "render/renderer.h"

namespace tumble::command {

namespace {

std::vector<std::string> chosen(const std::vector<std::string>& asked) {
  std::vector<std::string> all = demoNames();
  all.push_back(std::string(kWindowSubject));
  for (const std::string& name : asked)
    if (std::find(all.begin(), all.end(), name) == all.end())
      throw UsageError(
          fmt::format("no golden is kept of '{}'; `tumble golden` holds all demos and '{}'", name,
                      kWindowSubject));
  return asked.empty() ? all : asked;
}

// Leaves what was drawn where it can be looked at.
void writeActual(const Finding& finding, const std::string& folder) {
  if (!finding.actual) return;
  const std::string place = folder + "/" + finding.subject;
  makeFolder(place);
  writePng(place + "/" + finding.name + ".png", *finding.actual);
}

void print(const std::vector<Finding>& findings) {
  for (const Finding& finding : findings)
    fmt::print("{:<5} {:<20} {:<12} {}\n", finding.passes() ? "ok" : "FAIL", finding.subject,
               finding.name, finding.verdict());
}

std::string environment(const Manifest& manifest, const Context& context) {
  return fmt::format("expected: tumble {}, {}, OpenGL {}; actual: tumble {}, {}, OpenGL {}",
                     manifest.program, manifest.glRenderer, manifest.glVersion, TUMBLE_VERSION,
                     context.renderer(), context.version());
}

// Tells what came of the comparison and leaves behind what helps to see why.
int conclude(const std::vector<Finding>& findings, const std::string& folder,
             const std::string& environment) {
  const auto passing = std::count_if(findings.begin(), findings.end(),
                                     [](const Finding& finding) { return finding.passes(); });
  const auto exact = std::count_if(findings.begin(), findings.end(),
                                   [](const Finding& finding) { return finding.exact(); });
  const auto total = static_cast<long>(findings.size());
  fmt::print("{} goldens: {} pass, {} equal to the last bit\n", total, passing, exact);
  if (exact < total) fmt::print("{}\n", environment);
  if (passing == total) return kOk;
  for (const Finding& finding : findings)
    if (!finding.passes()) writeActual(finding, folder);
  makeFolder(folder);
  writeFile(folder + "/report.html", htmlReport(findings, environment));
  fmt::print("see {0}/report.html; `tumble golden --update` accepts what is drawn now\n", folder);
  return kFailed;
}

void refuseOtherRasterisers(const Context& context) {
  if (context.renderer().find("llvmpipe") == std::string::npos)
    throw NoContext(fmt::format(
        "goldens are drawn by llvmpipe and this is {}; try TUMBLE_GL=osmesa", context.renderer()));
}

}  // namespace

int golden(int argc, char** argv) {
  CommandLine line("golden",
                   "Compares small images and numbers of every demo with the approved ones.",
                   {"                       # all of them", "path-of-brick          # one",
                    "--update               # accept what is drawn now"});
  std::vector<std::string> asked;
  std::string out = "out/golden";
  bool update = false;
  line.option("SUBJECT", asked, "demos to look at [all]");
  line.flag("--update", update, "accept what is drawn now");
  line.option("-o,--output", out, "folder for failing images and report.html [out/golden]");
  if (!line.read(argc, argv)) return kOk;

  const std::vector<std::string> subjects = chosen(asked);
  const std::string folder = dataFolder("golden");
  const std::unique_ptr<Context> context = makeContext();
  if (update) refuseOtherRasterisers(*context);
  Renderer renderer(*context, dataFolder("shaders"), dataFolder("fonts"));
  Manifest manifest = readManifest(folder + "/manifest.json");
  std::vector<Finding> findings;
  for (const std::string& subject : subjects) {
    const Golden now = drawGolden(subject, renderer);
    if (update) storeGolden(now, manifest, folder);
    const std::vector<Finding> found = compareGolden(now, manifest, folder);
    print(found);
    findings.insert(findings.end(), found.begin(), found.end());
  }
  if (update) {
    manifest.glRenderer = context->renderer();
    manifest.glVersion = context->version();
    manifest.program = TUMBLE_VERSION;
    writeManifest(folder + "/manifest.json", manifest);
  }
  return conclude(findings, out, environment(manifest, *context));
}

}  // namespace tumble::command
