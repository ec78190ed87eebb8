// What other programs are told: glTF, the resolved scene, the page.
#include <cmath>
#include <cstring>
#include <nlohmann/json.hpp>

#include "app/export/drawn.h"
#include "app/export/gltf.h"
#include "app/export/gltf_bent.h"
#include "app/export/pack.h"
#include "app/export/page.h"
#include "app/export/scene_json.h"
#include "app/present/bent.h"
#include "app/scene/demos.h"
#include "tests/catch.h"

using namespace tumble;

namespace {

const std::string kForms = R"(
title = "Three </script> & forms"
[world]
duration = 0.2
[[body]]
name = "floor"
shape = { plane = [0, 1, 0, 0] }
[[body]]
name = "box"
shape = { box = [0.2, 0.4, 0.6] }
mass = 2.0
friction = 0.25
position = [0, 1, 0]
angular_velocity = [0, 0, 2]
[[array]]
name = "ball"
kind = "row"
count = 2
step = [1, 0, 0]
body = { shape = { sphere = 0.1 }, mass = 1.0, position = [1, 1, 0] }
[[body]]
name = "rod"
shape = { capsule = [0.1, 0.5] }
mass = 1.0
position = [-1, 1, 0]
[[expect]]
value = "box.y"
over = "max"
equals = 1.0
)";

struct Glb {
  nlohmann::json json;
  std::string bytes;
  float number(int accessor, std::size_t i) const {
    const auto& view = json["bufferViews"][json["accessors"][accessor]["bufferView"].get<int>()];
    float value = 0.0f;
    std::memcpy(&value, bytes.data() + view["byteOffset"].get<std::size_t>() + 4 * i, 4);
    return value;
  }
};

std::uint32_t wordAt(const std::string& file, std::size_t at) {
  std::uint32_t word = 0;
  std::memcpy(&word, file.data() + at, 4);
  return word;
}

// Header and chunks as §4.4 of the specification lays them out.
Glb readGlb(const std::string& file) {
  REQUIRE(file.substr(0, 4) == "glTF");
  CHECK(wordAt(file, 4) == 2);
  REQUIRE(wordAt(file, 8) == file.size());
  const std::uint32_t text = wordAt(file, 12);
  REQUIRE(file.substr(16, 4) == "JSON");
  CHECK(text % 4 == 0);
  REQUIRE(file.substr(20 + text + 4, 3) == "BIN");
  REQUIRE(wordAt(file, 20 + text) == file.size() - 28 - text);
  return {nlohmann::json::parse(file.substr(20, text)), file.substr(28 + text)};
}

}  // namespace

TEST_CASE(
    "a glTF file moves each body as the recording does, and bodies of one form share a mesh") {
  const Scene scene = parseScene(kForms, "forms");
  const Recording recording = record(scene, 60.0);
  const Glb glb = readGlb(gltfBinary(scene, recording));
  const auto& nodes = glb.json["nodes"];
  // Four bodies, each with a node for its mesh; the floor is none.
  REQUIRE(nodes.size() == 8);
  CHECK(glb.json["meshes"].size() == 3);
  REQUIRE(glb.json["animations"][0]["channels"].size() == 8);
  for (const auto& channel : glb.json["animations"][0]["channels"]) {
    const auto& node = nodes[channel["target"]["node"].get<int>()];
    const auto& sampler = glb.json["animations"][0]["samplers"][channel["sampler"].get<int>()];
    const std::string name = node["name"];
    const std::size_t body = name == "box" ? 1 : name == "rod" ? 2 : name == "ball.0" ? 3 : 4;
    const bool turns = channel["target"]["path"] == "rotation";
    for (const std::size_t k : {std::size_t{0}, recording.samples.size() - 1}) {
      const BodySample& sample = recording.samples[k].bodies[body];
      CHECK(glb.number(sampler["input"], k) == static_cast<float>(recording.samples[k].t));
      for (std::size_t i = 0; i < (turns ? 4u : 3u); ++i)
        CHECK(glb.number(sampler["output"], (turns ? 4 : 3) * k + i) ==
              static_cast<float>(turns ? sample.q.coeffs()[i] : sample.x[i]));
    }
  }
  for (const auto& view : glb.json["bufferViews"]) {
    CHECK(view["byteOffset"].get<std::size_t>() % 4 == 0);
    CHECK(view["byteOffset"].get<std::size_t>() + view["byteLength"].get<std::size_t>() <=
          glb.bytes.size());
  }
}

// Oracle: the recording. Its first sample is the base, and each key a target that has weight 1
// there and 0 at all others.
TEST_CASE("a glTF file has cloth, solids and strands as meshes that go through the run") {
  const Scene scene = parseScene(R"([world]
duration = 2.0
[[body]]
name = "ball"
shape = { sphere = 0.3 }
fixed = true
[[cloth]]
name = "towel"
columns = 3
rows = 4
size = [0.4, 0.4]
density = 0.3
stretch = 100
shear = 10
bend = 1e-5
damping = 0.1
position = [0, 2, 0]
[[soft]]
name = "jelly"
cells = [2, 2, 2]
size = [0.2, 0.2, 0.2]
density = 500
young = 2e4
poisson = 0.3
position = [1, 1, 0]
[[fur]]
on = "ball"
name = "hair"
strands = 5
length = 0.2
points = 4
thickness = 0.004
density = 0.002
stretch = 20
bend = 1.5e-5
damping = 0.002
)",
                                 "bends");
  const Recording recording = record(scene, 60.0);
  REQUIRE(recording.samples.size() > kMostBentKeys);
  const std::vector<std::size_t> keys = bentKeys(recording);
  REQUIRE(keys.size() == kMostBentKeys);
  CHECK(keys.front() == 0);
  CHECK(keys.back() == recording.samples.size() - 1);
  const Glb glb = readGlb(gltfBinary(scene, recording));
  // The ball, its mesh, and one node for each that bends: their points are no balls.
  REQUIRE(glb.json["nodes"].size() == 2 + scene.bent.size());
  REQUIRE(scene.bent.size() == 3);
  for (std::size_t n = 0; n < 3; ++n) {
    const BentDef& bent = scene.bent[n];
    const auto& node = glb.json["nodes"][2 + n];
    CAPTURE(bent.name);
    CHECK(node["name"] == bent.name);
    const auto& mesh = glb.json["meshes"][node["mesh"].get<int>()];
    CHECK(mesh["primitives"].size() == (bent.columns > 0 ? 2 : 1));
    const auto& primitive = mesh["primitives"][0];
    CHECK(primitive["mode"] == (bent.strand > 0 ? 1 : 4));
    const auto& corners = glb.json["accessors"][primitive["indices"].get<int>()];
    CHECK(corners["count"] == (bent.strand > 0 ? 2 * 5 * 2 : 3 * bent.triangles.size()));
    REQUIRE(primitive["targets"].size() == kMostBentKeys - 1);
    const int base = primitive["attributes"]["POSITION"];
    const std::size_t count = glb.json["accessors"][base]["count"];
    // Points of a cloth and of strands are where they were recorded; strands without their first.
    for (const std::size_t k : {std::size_t{0}, std::size_t{1}, kMostBentKeys - 1})
      for (std::size_t i = 0; i < count; ++i) {
        const std::size_t p = bent.strand == 0 ? i : i / 3 * 4 + i % 3 + 1;
        const std::vector<Vec3> places = surfacePlaces(bent, recording.samples[keys[k]]);
        if (bent.skin > 0.0) continue;
        const Vec3& x = recording.samples[keys[k]].bodies[bent.first + p].x;
        CHECK(places[p] == x);
        for (int axis = 0; axis < 3; ++axis) {
          double sum = glb.number(base, 3 * i + axis);
          if (k > 0) sum += glb.number(primitive["targets"][k - 1]["POSITION"], 3 * i + axis);
          CHECK(sum == Approx(x[axis]).margin(1e-6));
        }
      }
    const auto& channel = glb.json["animations"][0]["channels"][n];
    CHECK(channel["target"]["path"] == "weights");
    const auto& sampler = glb.json["animations"][0]["samplers"][channel["sampler"].get<int>()];
    for (std::size_t k = 0; k < kMostBentKeys; ++k) {
      CHECK(glb.number(sampler["input"], k) == static_cast<float>(recording.samples[keys[k]].t));
      for (std::size_t t = 0; t + 1 < kMostBentKeys; ++t)
        CHECK(glb.number(sampler["output"], k * (kMostBentKeys - 1) + t) == (t + 1 == k ? 1 : 0));
    }
  }
}

TEST_CASE("the physics extensions tell mass, inertia, form and surface of each body") {
  const Scene scene = parseScene(kForms, "forms");
  const Glb glb = readGlb(gltfBinary(scene, record(scene, 60.0)));
  const auto& node = glb.json["nodes"][1];
  REQUIRE(node["name"] == "box");
  const auto& body = node["extensions"]["KHR_physics_rigid_bodies"];
  CHECK(body["motion"]["mass"] == 2.0);
  // m (b² + c²)/12 about each axis of the box.
  CHECK(body["motion"]["inertiaDiagonal"][0].get<double>() == Approx(2.0 * 0.52 / 12.0));
  CHECK(body["motion"]["angularVelocity"][2] == 2.0);
  const auto& shapes = glb.json["extensions"]["KHR_implicit_shapes"]["shapes"];
  REQUIRE(shapes.size() == 3);
  const auto& shape = shapes[body["collider"]["geometry"]["shape"].get<int>()];
  CHECK(shape["box"]["size"][2].get<double>() == Approx(0.6));
  const auto& surfaces = glb.json["extensions"]["KHR_physics_rigid_bodies"]["physicsMaterials"];
  const auto& surface = surfaces[body["collider"]["physicsMaterial"].get<int>()];
  CHECK(surface["dynamicFriction"].get<double>() == Approx(0.5));  // √0.25
}

TEST_CASE("a mesh that many bodies share is closed, faces outward and has the size of its form") {
  for (const Form form : {Form::Box, Form::Sphere, Form::Cylinder}) {
    Instance instance;
    instance.form = form;
    const IndexedMesh mesh = meshOf(instance);
    double volume = 0.0;
    for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
      const Eigen::Vector3f &a = mesh.positions[mesh.indices[i]],
                            &b = mesh.positions[mesh.indices[i + 1]],
                            &c = mesh.positions[mesh.indices[i + 2]];
      volume += a.dot(b.cross(c)) / 6.0;
    }
    // 8, 4π/3, 2π; facets of a 48-gon lack 0.3 % and 0.9 %.
    const double exact = form == Form::Box ? 8.0 : form == Form::Sphere ? 4.18879 : 6.28319;
    CHECK(volume == Approx(exact).epsilon(0.012));
    CHECK(mesh.positions.size() < mesh.indices.size());
  }
}

TEST_CASE("scene.json has arrays expanded, colours, mass and inertia") {
  const auto json = nlohmann::json::parse(sceneJson(parseScene(kForms, "forms")));
  REQUIRE(json["bodies"].size() == 5);
  CHECK(json["bodies"][0]["shape"]["type"] == "half-space");
  CHECK(json["bodies"][0]["moves"] == false);
  CHECK(json["bodies"][1]["shape"]["edges"][2] == 0.6);
  CHECK(json["bodies"][1]["mass"] == 2.0);
  CHECK(json["bodies"][1]["inertia"][0][0].get<double>() == Approx(2.0 * 0.52 / 12.0));
  CHECK(json["bodies"][2]["shape"]["radius"] == 0.1);
  CHECK(json["bodies"][3]["name"] == "ball.0");
  CHECK(json["bodies"][4]["position"][0] == 2.0);
}

TEST_CASE("series are packed as differences, and values to one part in 65535") {
  CHECK(sixteenBits(1.0, 1.0, 2.0) == 0);
  CHECK(sixteenBits(3.0, 1.0, 2.0) == 65535);
  CHECK(sixteenBits(7.0, 7.0, 0.0) == 0);
  CHECK(differences({{1, 258, 0}}) == std::string("\2\2\3\0\2\2", 6));
}

TEST_CASE(
    "the page holds its run and asks for nothing outside itself, whatever the scene's texts") {
  const Scene scene = parseScene(kForms, "forms");
  const std::string page = pageHtml(scene, record(scene, 60.0));
  CHECK(page.find("Three </script>") == std::string::npos);
  CHECK(page.find("\\u003c/script> & forms") != std::string::npos);
  CHECK(page.find("http") == std::string::npos);
  CHECK(page.find("src=") == std::string::npos);
  CHECK(page.find("/*DATA*/") == std::string::npos);
  CHECK(page.find("box.y, max") != std::string::npos);
}

// Oracle: the scene's own numbers. What moves is carried with its body; what does not, stands.
TEST_CASE("the page has each joint by its ends in the frames of the bodies that carry them") {
  const Scene scene = parseScene(R"([world]
duration = 0.2
[[body]]
name = "post"
shape = { box = [0.1, 1, 0.1] }
position = [0, 3, 0]
fixed = true
[[body]]
name = "arm"
shape = { box = [0.2, 0.2, 0.2] }
mass = 1.0
position = [1, 2, 0]
orientation = { axis = [0, 0, 1], degrees = 90 }
[[body]]
name = "bob"
shape = { sphere = 0.1 }
mass = 1.0
position = [2, 1, 0]
[[joint]]
kind = "hinge"
a = "arm"
b = "post"
anchor = [0, 2, 0]
axis = [0, 0, 2]
[[joint]]
kind = "distance"
a = "bob"
b = "arm"
anchor = [2, 1, 0]
anchor_b = [1.1, 2, 0]
)",
                                 "two");
  const std::string page = pageHtml(scene, record(scene, 60.0));
  const std::size_t at = page.find("\"joints\":");
  REQUIRE(at != std::string::npos);
  const std::string rest = page.substr(at + 9);
  const auto joints = nlohmann::json::parse(rest.substr(0, rest.find(",\"pin\"")));
  const auto vector = [](const nlohmann::json& list) {
    return Vec3(list[0].get<double>(), list[1].get<double>(), list[2].get<double>());
  };
  REQUIRE(joints.size() == 2);
  CHECK(joints[0]["kind"] == "hinge");
  CHECK(joints[0]["a"][0] == 1);
  CHECK((vector(joints[0]["a"][1]) - Vec3(0, 1, 0)).norm() < 1e-6);
  CHECK(joints[0]["b"][0] == -1);
  CHECK((vector(joints[0]["b"][1]) - Vec3(0, 2, 0)).norm() < 1e-6);
  CHECK((vector(joints[0]["axis"]) - Vec3(0, 0, 1)).norm() < 1e-6);
  CHECK(joints[0]["half"].get<double>() > 0.1);  // through the arm
  CHECK(joints[0]["levers"] == nlohmann::json{true, false});
  CHECK(joints[1]["kind"] == "distance");
  CHECK((vector(joints[1]["a"][1]) - Vec3(0, 0, 0)).norm() < 1e-6);
  CHECK((vector(joints[1]["b"][1]) - Vec3(0, -0.1, 0)).norm() < 1e-6);
  CHECK(joints[1]["levers"] == nlohmann::json{false, false});
}

// The page's key, in square brackets.
nlohmann::json listOf(const std::string& page, const std::string& key) {
  const std::size_t at = page.find("\"" + key + "\":[");
  REQUIRE(at != std::string::npos);
  const std::size_t from = page.find('[', at), to = page.find(",\"", from);
  return nlohmann::json::parse(page.substr(from, to - from));
}

// A heap that falls from 3.8 m, seen by keys that show where it comes to lie.
TEST_CASE("the page is told all that its camera has to hold, unless the scene places it by hand") {
  Scene scene = readScene(scenePath("pile"));
  scene.world.duration = 0.1;
  const Recording recording = record(scene, 30.0);
  double highest = 0.0, held = 0.0;
  for (const BodySample& body : recording.samples.front().bodies)
    highest = std::max(highest, body.x.y());
  for (const nlohmann::json& point : listOf(pageHtml(scene, recording), "hold"))
    held = std::max(held, point[1].get<double>());
  CHECK(held > highest);
  scene.camera.keys.clear();
  scene.camera.eye = Vec3(0.0, 1.0, 5.0);
  CHECK(listOf(pageHtml(scene, recording), "hold").empty());
}
