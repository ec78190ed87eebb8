#include "app/scene/camera.h"

#include <algorithm>

#include "app/scene/body.h"

namespace tumble {

namespace {

constexpr std::size_t kMostKeys = 1000;

const Range kFov = {1.0, 170.0, false, "deg"};

void complainOfNoSight(Section& section, const Vec3& eye, const Vec3& target) {
  if ((eye - target).norm() < 1e-9)
    section.complain("eye", "stands where the target is; move one of them");
}

CameraKey readKey(const Node& node, const std::string& key, double fov, Findings& findings) {
  CameraKey one;
  one.fov = fov;
  Section section(node, key, findings);
  section.read("at", one.at, notNegative("s"));
  section.read("eye", one.eye, any("m"));
  section.read("target", one.target, any("m"));
  for (const char* needed : {"at", "eye", "target"})
    if (!section.find(needed)) section.complain(needed, "missing");
  section.read("fov", one.fov, kFov);
  if (section.good()) complainOfNoSight(section, one.eye, one.target);
  section.finish();
  return one;
}

// Where the camera goes: at least two instants, one after the other.
void readKeys(Section& section, CameraView& camera) {
  const Array& tables = section.tables("keys");
  if (tables.empty()) return;
  for (const char* other : {"eye", "target", "follow", "ahead"})
    if (section.find(other) && (camera.ahead || other != std::string_view("ahead")))
      section.complain(other, "a camera with `keys` goes where these say; keep one");
  if (tables.size() > kMostKeys)
    return section.complain("keys", "expected 1 to 1000 tables { at, eye, target }");
  for (std::size_t i = 0; i < tables.size(); ++i) {
    const std::string key = section.path("keys") + "." + std::to_string(i);
    camera.keys.push_back(readKey(tables[i], key, camera.fov, section.findings()));
    if (i > 0 && section.good() && !(camera.keys[i].at > camera.keys[i - 1].at))
      section.findings().complain(tables[i].spot, key + ".at", "not after the key before it");
  }
}

CameraView readOneCamera(const Node& node, const std::string& key, Section& root,
                         const std::vector<BodyDef>& bodies) {
  CameraView camera;
  Section section(node, key, root.findings());
  section.read("name", camera.name);
  section.read("follow", camera.follow);
  section.read("eye", camera.eye, any("m"));
  section.read("target", camera.target, any("m"));
  section.read("azimuth", camera.azimuth, any("deg"));
  section.read("elevation", camera.elevation, {-90.0, 90.0, false, "deg"});
  section.read("fov", camera.fov, kFov);
  section.read("ahead", camera.ahead);
  for (const char* other : {"eye", "target", "follow"})
    if (camera.ahead && section.find(other))
      section.complain(other, "a camera that looks `ahead` is placed by the motion; keep one");
  if (camera.eye && camera.target) complainOfNoSight(section, *camera.eye, *camera.target);
  readKeys(section, camera);
  if (!camera.follow.empty()) requireBody(section, "follow", camera.follow, bodies);
  section.finish();
  return camera;
}

}  // namespace

void readCamera(Section& root, Scene& scene) {
  const Node* node = root.find("camera");
  if (!node) return;
  const Array* several = node->as<Array>();
  if (!several) {
    scene.cameras.push_back(readOneCamera(*node, "camera", root, scene.world.bodies));
  } else {
    for (const Node& one : *several) {
      const std::string key = "camera." + std::to_string(scene.cameras.size());
      scene.cameras.push_back(readOneCamera(one, key, root, scene.world.bodies));
      const std::string& name = scene.cameras.back().name;
      const auto same = [&](const CameraView& camera) { return camera.name == name; };
      if (!isName(name))
        root.findings().complain(one.spot, key + ".name",
                                 "each of several cameras needs a name of A-Z a-z 0-9 _ and .");
      else if (std::count_if(scene.cameras.begin(), scene.cameras.end(), same) > 1)
        root.findings().complain(one.spot, key + ".name",
                                 "there is a camera " + inQuotes(name) + " already");
    }
  }
  if (!scene.cameras.empty()) scene.camera = scene.cameras.front();
}

}  // namespace tumble
