// Model only what a scene needs: what a scene does not use changes no bit of it. Every scene of
// needs/scenes with every addition of needs/features, which stands far from all that the scene
// moves; needs.sh counts what it costs.
//
// The first lines of an addition say where this does not hold, one each: "# refused by METHOD", "#
// used by SCENE-OR-METHOD …", "# changed in SCENE-OR-METHOD: why"; and "# set KEY=VALUE" what else
// it sets.
#include <filesystem>
#include <map>
#include <set>
#include <sstream>

#include "app/file/file.h"
#include "app/record/hashes.h"
#include "app/scene/scene.h"
#include "tests/catch.h"

using namespace tumble;

namespace {

const std::string kNeeds = TUMBLE_SOURCE_DIR "/tests/stability/needs/";

/// Names of the scenes or features, in the order of the alphabet.
std::vector<std::string> namesIn(const std::string& folder) {
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(kNeeds + folder))
    names.push_back(entry.path().stem().string());
  std::sort(names.begin(), names.end());
  return names;
}

struct Feature {
  std::string name, text;
  std::vector<std::string> overrides;
  std::set<std::string> usedBy, refusedBy, changedIn;  ///< scenes or methods

  explicit Feature(const std::string& of) : name(of) {
    text = readFile(kNeeds + "features/" + of + ".toml");
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line) && line.starts_with("# ");) {
      std::istringstream words(line.substr(2));
      std::string verb, preposition, word;
      words >> verb;
      if (verb == "set" && words >> word) overrides.push_back(word);
      for (words >> preposition; words >> word;) {
        const bool last = word.back() == ':';
        if (last) word.pop_back();
        if (verb == "used") usedBy.insert(word);
        if (verb == "refused") refusedBy.insert(word);
        if (verb == "changed") changedIn.insert(word);
        if (last) break;
      }
    }
  }
};

/// What became of the bodies of a scene, by name: the bits of each sample, and of all forces and
/// events between them.
struct Motion {
  std::map<std::string, std::vector<double>> bodies;
  std::vector<double> contacts, events;
  std::string runs;
};

void append(std::vector<double>& to, const auto& vector) {
  to.insert(to.end(), vector.data(), vector.data() + vector.size());
}

/// Of the bodies that `among` has, or of all.
Motion motionOf(const Scene& scene, const Motion* among = nullptr) {
  Motion motion;
  const auto& defs = scene.world.bodies;
  const auto counts = [&](int body) { return !among || among->bodies.count(defs[body].name) > 0; };
  const Recording recording = record(scene, 60.0);
  for (const Sample& sample : recording.samples) {
    for (std::size_t i = 0; i < sample.bodies.size(); ++i) {
      if (!counts(static_cast<int>(i))) continue;
      std::vector<double>& numbers = motion.bodies[defs[i].name];
      const BodySample& body = sample.bodies[i];
      for (const Vec3& part : {body.x, body.v, body.omega}) append(numbers, part);
      append(numbers, body.q.coeffs());
    }
    for (const ContactSample& c : sample.contacts) {
      if (!counts(c.a) || !counts(c.b)) continue;
      for (const Vec3& part : {c.p, c.n, c.force}) append(motion.contacts, part);
    }
  }
  for (const Event& event : recording.report.events)
    if (counts(event.a) && counts(event.b))
      motion.events.insert(motion.events.end(), {event.t, event.vrel, event.j});
  motion.runs = recording.runs;
  return motion;
}

/// Largest distance of any number of the bodies' states.
double distance(const Motion& one, const Motion& other) {
  double largest = 0.0;
  for (const auto& [name, numbers] : one.bodies)
    for (std::size_t k = 0; k < numbers.size(); ++k)
      largest = std::max(largest, std::abs(numbers[k] - other.bodies.at(name)[k]));
  return largest;
}

}  // namespace

// Oracle: the scene without it, bit for bit: states, contact forces, events.
TEST_CASE("what a scene does not use changes no bit of it") {
  const std::vector<std::string> features = namesIn("features");
  REQUIRE(features.size() >= 15);
  for (const std::string& name : namesIn("scenes")) {
    const std::string text = readFile(kNeeds + "scenes/" + name + ".toml");
    const Scene scene = parseScene(text, name);
    const std::string& method = scene.world.method;
    const Motion alone = motionOf(scene);
    for (const std::string& added : features) {
      const Feature feature(added);
      CAPTURE(name, added);
      const auto isOne = [&](const std::set<std::string>& of) {
        return of.count(name) + of.count(method) > 0;
      };
      if (isOne(feature.usedBy)) continue;
      const auto both = [&] {
        return motionOf(parseScene(text + "\n" + feature.text, name, feature.overrides), &alone);
      };
      if (isOne(feature.refusedBy)) {
        CHECK_THROWS_AS(both(), SceneError);
        continue;
      }
      const Motion with = both();
      CHECK(with.runs == alone.runs);
      if (isOne(feature.changedIn)) {
        CHECK(distance(alone, with) > 0.0);  // else its line is to go
        continue;
      }
      CHECK(distance(alone, with) == 0.0);
      CHECK(with.contacts == alone.contacts);
      CHECK(with.events == alone.events);
    }
  }
}
