// Who may include whom: the arrows between rooms, and between the chapters of sim, point one way.
#include <algorithm>
#include <array>
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>
#include <vector>

#include "tests/catch.h"
#include "tests/house/pattern.h"
#include "tests/text_of.h"

namespace fs = std::filesystem;
using tumble::test::Pattern;
using tumble::test::textOf;

namespace {

constexpr std::array kChapters = {"math",    "ode",     "shape",   "elastic", "body",   "flight",
                                  "collide", "problem", "contact", "joint",   "method", "audit"};
// The rooms of the program, in the order of its data; the last ones know nothing of each other.
constexpr std::array kRooms = {"file", "scene", "record", "claim", "present", "panel"};
constexpr std::array kLastRooms = {"golden", "report", "viewer"};
constexpr std::array kMethods = {"course", "exact", "stepping"};
// sim neither prints, nor reads files, clocks or the environment, nor starts threads.
constexpr std::array kBannedInSim = {"iostream", "ostream", "istream",    "fstream", "cstdio",
                                     "print",    "chrono",  "ctime",      "thread",  "mutex",
                                     "future",   "atomic",  "filesystem", "random"};

bool startsWith(std::string_view text, std::string_view head) {
  return text.substr(0, head.size()) == head;
}

template <class Names>
bool contains(const Names& names, std::string_view name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

/// Number of the chapter that a path under sim/ belongs to; what lies directly in sim/ is the last.
std::size_t chapter(const fs::path& path) {
  const std::string folder = std::next(path.begin())->string();
  return std::find(kChapters.begin(), kChapters.end(), folder) - kChapters.begin();
}

/// Folder of the method that a path under sim/method/ belongs to, or "".
std::string methodOf(const fs::path& path) {
  const std::string folder = path.parent_path().filename().string();
  return contains(kMethods, folder) ? folder : "";
}

std::string wrongInSim(const fs::path& file, const std::string& included) {
  if (startsWith(included, "sim/")) {
    if (chapter(included) > chapter(file)) return "a later chapter";
    const std::string from = methodOf(file), to = methodOf(included);
    if (!from.empty() && !to.empty() && from != to) return "another method";
    if (*std::next(file.begin()) == "audit" && !to.empty()) return "a method";
    return "";
  }
  if (startsWith(included, "Eigen/") || startsWith(included, "boost/")) return "";
  if (included.find_first_of("./") != std::string::npos) return "not sim, Eigen, Boost or standard";
  return contains(kBannedInSim, included) ? "sim does not print, read files, draw lots or keep time"
                                          : "";
}

std::string wrongInApp(const fs::path& file, const std::string& included) {
  if (!startsWith(included, "app/")) return "";
  const std::string from = file.parent_path().filename().string();
  const std::string to = fs::path(included).parent_path().filename().string();
  if (from == to || from == "app" || from == "command") return "";
  const auto place = [](const std::string& room) {
    return std::find(kRooms.begin(), kRooms.end(), room) - kRooms.begin();
  };
  const bool last = contains(kLastRooms, from);
  if (!last && place(to) > place(from)) return "a later room";
  if (last && !contains(kRooms, to) && !(from == "golden" && to == "viewer")) return "another room";
  return "";
}

/// Why a file may not include a header, or "" if it may. Paths count from the source folder.
std::string wrongArrow(const fs::path& file, const std::string& included) {
  const std::string room = file.begin()->string();
  if (room == "sim") return wrongInSim(file, included);
  const bool own =
      room == "render" ? !startsWith(included, "sim/") && !startsWith(included, "app/") : true;
  if (!own) return "render knows no physics and no program";
  if (startsWith(included, "tests/")) return "a test";
  return room == "app" ? wrongInApp(file, included) : "";
}

std::vector<fs::path> sourcesUnder(const fs::path& root, const std::string& room) {
  std::vector<fs::path> files;
  for (const auto& entry : fs::recursive_directory_iterator(root / room)) {
    const std::string ending = entry.path().extension().string();
    if (ending == ".h" || ending == ".cpp") files.push_back(entry.path().lexically_relative(root));
  }
  return files;
}

/// Every wrong arrow in the rooms below `root`, as "file includes header: reason".
std::vector<std::string> wrongArrows(const fs::path& root) {
  static const Pattern include("(^|\n)[ \t]*#[ \t]*include[ \t]*[<\"]([^>\"]+)[>\"]");
  std::vector<std::string> wrong;
  for (const char* room : {"sim", "render", "app"}) {
    if (!fs::exists(root / room)) continue;
    for (const fs::path& file : sourcesUnder(root, room)) {
      for (const Pattern::Match& match : include.all(textOf(root / file))) {
        const std::string reason = wrongArrow(file, match[2]);
        if (!reason.empty())
          wrong.push_back(file.string() + " includes " + match[2] + ": " + reason);
      }
    }
  }
  return wrong;
}

}  // namespace

TEST_CASE("every file includes its own chapter and earlier ones only") {
  const auto wrong = wrongArrows(TUMBLE_SOURCE_DIR);
  for (const std::string& arrow : wrong) UNSCOPED_INFO(arrow);
  CHECK(wrong.empty());
}

TEST_CASE("a planted wrong arrow is found and a right one is not") {
  struct Plant {
    const char *file, *included;
    bool wrong;
  };
  const Plant plant =
      GENERATE(Plant{"sim/ode/rk4.cpp", "sim/body/rigid_body.h", true},
               Plant{"sim/method/course/course.cpp", "sim/method/stepping/stepping.h", true},
               Plant{"sim/method/course/course.cpp", "sim/world.h", true},
               Plant{"sim/method/books.cpp", "sim/audit/audit.h", true},
               Plant{"sim/world.cpp", "render/picture.h", true},
               Plant{"sim/math/vec.h", "chrono", true}, Plant{"sim/math/vec.h", "sys/time.h", true},
               Plant{"render/renderer.cpp", "sim/world.h", true},
               Plant{"render/renderer.cpp", "app/scene/scene.h", true},
               Plant{"app/main.cpp", "tests/catch.h", true},
               Plant{"app/scene/scene.cpp", "app/record/recording.h", true},
               Plant{"app/claim/orbit.cpp", "app/command/run.h", true},
               Plant{"app/report/study.cpp", "app/golden/golden.h", true},
               Plant{"app/report/study.cpp", "app/panel/chart_run.h", false},
               Plant{"app/golden/draw.cpp", "app/viewer/snapshot.h", false},
               Plant{"app/command/view.cpp", "app/viewer/viewer.h", false},
               Plant{"sim/body/rigid_body.cpp", "sim/ode/system.h", false},
               Plant{"sim/method/course/course.cpp", "sim/method/model.h", false},
               Plant{"sim/audit/audit.cpp", "sim/method/stepping/stepping.h", true},
               Plant{"sim/world.cpp", "sim/method/course/course.h", false},
               Plant{"app/main.cpp", "sim/world.h", false},
               Plant{"render/renderer.cpp", "glad/gl.h", false});
  const fs::path root = fs::path(TUMBLE_BINARY_DIR) / "planted";
  fs::remove_all(root);
  fs::create_directories((root / plant.file).parent_path());
  std::ofstream(root / plant.file) << "// planted\n#include <" << plant.included << ">\n";
  CAPTURE(plant.file, plant.included);
  CHECK(wrongArrows(root).size() == (plant.wrong ? 1u : 0u));
  fs::remove_all(root);
}

TEST_CASE("neither sim nor render nor app/present knows a demo by name") {
  const fs::path root = TUMBLE_SOURCE_DIR;
  if (!fs::exists(root / "assets/demos")) return;
  for (const auto& demo : fs::directory_iterator(root / "assets/demos")) {
    const std::string name = demo.path().stem().string();
    for (const char* room :
         {"sim", "render", "app/scene", "app/record", "app/present", "app/claim"}) {
      if (!fs::exists(root / room)) continue;
      for (const fs::path& file : sourcesUnder(root, room)) {
        CAPTURE(name, file.string());
        CHECK(textOf(root / file).find('"' + name + '"') == std::string::npos);
      }
    }
  }
}
