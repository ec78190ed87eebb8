// [[cloth]] and [[soft]]: what becomes of them, and what is refused.
#include <algorithm>
#include <string>
#include <vector>

#include "app/record/recording.h"
#include "app/scene/scene.h"
#include "sim/world.h"
#include "tests/app/complaint.h"
#include "tests/catch.h"

using namespace tumble;

namespace {

const std::string kCloth =
    "[world]\n[[body]]\nname = \"ball\"\nshape = { sphere = 0.3 }\nmass = 1\nposition = [0, -1, "
    "0]\n"
    "[[cloth]]\nname = \"c\"\n";
const std::string kGrid = "columns = 4\nrows = 3\nsize = [0.3, 0.2]\n";
const std::string kSoft = "[world]\n[[soft]]\nname = \"s\"\n";

}  // namespace

TEST_CASE("two cloths of one name are told once, not once a point") {
  const std::string twice =
      kCloth + kGrid + "[[cloth]]\nname = \"c\"\n" + kGrid + "position = [0, 3, 0]\n";
  CAPTURE(twice);
  CHECK(complaint(twice).find("already") != std::string::npos);
  CHECK(countOfComplaints(twice) == 1);
}

// Oracle: what is written, each as the first of the kind and then as the second.
TEST_CASE("a name stands once over all that a scene names") {
  const std::string body =
      "[[body]]\nname = \"n\"\nshape = { sphere = 0.1 }\nmass = 1\nposition = [0, 1, 0]\n";
  const std::string head = "[world]\n[[body]]\nname = \"b\"\nshape = { sphere = 0.3 }\nmass = 1\n";
  const std::string array =
      "[[array]]\nname = \"n\"\nkind = \"row\"\ncount = 2\nstep = [1, 0, 0]\n"
      "body = { shape = { sphere = 0.1 }, mass = 1, position = [3, 0, 0] }\n";
  const std::string cloth = "[[cloth]]\nname = \"n\"\n" + kGrid + "position = [0, 3, 0]\n";
  const std::string soft =
      "[[soft]]\nname = \"n\"\ncells = [1, 1, 1]\nsize = [1, 1, 1]\nyoung = 1e4\nposition = [0, 7, "
      "0]\n";
  const std::string fur = "[[fur]]\nname = \"n\"\non = \"b\"\nstrands = 2\nlength = 0.1\n";
  const std::string joint =
      "[[joint]]\nname = \"n\"\nkind = \"ball\"\na = \"b\"\nanchor = [0, 0, 0]\n";
  struct Pair {
    std::string first, second, is;
  };
  const std::vector<Pair> pairs = {
      {body, array, "body"},  {body, cloth, "body"}, {body, soft, "body"},
      {body, fur, "body"},    {body, joint, "body"}, {array, cloth, "array"},
      {cloth, soft, "cloth"}, {cloth, fur, "cloth"}, {soft, fur, "soft box"},
      {fur, joint, "fur"},
  };
  for (const Pair& pair : pairs) {
    const std::string text = head + pair.first + pair.second;
    const long line =
        2 + std::count(text.begin(), text.end() - static_cast<long>(pair.second.size()), '\n');
    CAPTURE(text, complaint(text));
    CHECK(countOfComplaints(text) == 1);
    CHECK(complaint(text).find(":" + std::to_string(line) + ":8") != std::string::npos);
    CHECK(complaint(text).find("there is a " + pair.is + " 'n' already") != std::string::npos);
    CHECK(complaint(head + pair.first).empty());
    CHECK(complaint(head + pair.second).empty());
  }
}

TEST_CASE("a cloth is points, a force between them and a surface") {
  const Scene scene = parseScene(
      kCloth + kGrid + "density = 0.5\nthickness = 0.02\npins = [[0, 0], [3, 2]]\nfriction = 0.4\n",
      "s.toml");
  REQUIRE(scene.world.bodies.size() == 13);
  double mass = 0.0;
  for (std::size_t i = 1; i < 13; ++i) mass += *scene.world.bodies[i].mass;
  CHECK(mass == Approx(0.5 * 0.3 * 0.2));
  CHECK(scene.world.bodies[1].fixed);
  CHECK(scene.world.bodies[12].fixed);
  CHECK_FALSE(scene.world.bodies[2].fixed);
  CHECK(std::get<Particle>(scene.world.bodies[5].shape).radius == 0.01);
  CHECK(scene.world.bodies[5].friction == 0.4);
  REQUIRE(scene.world.forces.size() == 1);
  CHECK(std::get<Bending>(scene.world.forces[0]).body->bodies.size() == 12);
  REQUIRE(scene.bent.size() == 1);
  CHECK(scene.bent[0].triangles.size() == 12);
  CHECK(World(scene.world).method() == "auto: stepping");
}

TEST_CASE("pins to a body are joints with it") {
  const Scene scene = parseScene(kCloth + kGrid + "pins = \"row\"\npin_to = \"ball\"\n", "s.toml");
  REQUIRE(scene.world.joints.size() == 4);
  for (const JointDef& joint : scene.world.joints) CHECK(joint.b == 0);
  for (const BodyDef& body : scene.world.bodies) CHECK_FALSE(body.fixed);
}

TEST_CASE("a soft box weighs what its density says, with a triangle pair for each cell of a side") {
  const Scene scene = parseScene(
      kSoft +
          "cells = [2, 3, 4]\nsize = [0.2, 0.3, 0.4]\ndensity = 900\nyoung = 1e4\npins = \"+y\"\n",
      "s.toml");
  CHECK(scene.world.bodies.size() == 60);
  double mass = 0.0;
  int fixed = 0;
  for (const BodyDef& body : scene.world.bodies) {
    mass += *body.mass;
    fixed += body.fixed;
  }
  CHECK(mass == Approx(900.0 * 0.2 * 0.3 * 0.4));
  CHECK(fixed == 15);
  CHECK(std::get<Bending>(scene.world.forces[0]).body->elements.size() == 5 * 24);
  CHECK(scene.bent[0].triangles.size() == 2 * 2 * (2 * 3 + 3 * 4 + 4 * 2));
}

TEST_CASE("wrong cloths and soft boxes are told where and what to do") {
  CHECK(complaint(kCloth) ==
        "s.toml:7:1: error: cloth.c.columns: missing; how many points there are along it");
  CHECK(complaint(kCloth + "columns = 1\nrows = 3\nsize = [1, 1]\n").find("s.toml:9:11") == 0);
  CHECK(complaint(kCloth + kGrid + "pins = [[4, 0]]\n").find("columns from 0 to 3") !=
        std::string::npos);
  CHECK(complaint(kCloth + kGrid + "pins = \"row\"\npin_to = \"bal\"\n")
            .find("did you mean 'ball'") != std::string::npos);
  CHECK(complaint(kCloth + kGrid + "pin_to = \"ball\"\n").find("say which points with pins") !=
        std::string::npos);
  CHECK(complaint(kCloth + kGrid + "strech = 3\n").find("did you mean 'stretch'") !=
        std::string::npos);
  CHECK(complaint(kCloth + kGrid + "position = [0, -1, 0]\n").find("overlaps") !=
        std::string::npos);
  CHECK(complaint(kCloth + kGrid + "position = [0, -1, 0]\n").find("s.toml:7:1") == 0);
  const std::string box = "cells = [1, 1, 1]\nsize = [1, 1, 1]\n";
  CHECK(complaint(kSoft + box).find("young: missing") != std::string::npos);
  CHECK(complaint(kSoft + box + "young = 1e4\npoisson = 0.5\n").find("s.toml:7:11") == 0);
  CHECK(complaint(kSoft + box + "young = 1e4\nlaw = \"matching\"\npoisson = 0.3\n")
            .find("s.toml:8:11: error: soft.s.poisson: cells that are drawn to their shape") == 0);
  CHECK(complaint(kSoft + box + "young = 1e4\nlaw = \"matchin\"\n").find("matching") !=
        std::string::npos);
  CHECK(complaint(kSoft + "cells = [0, 1, 1]\nsize = [1, 1, 1]\nyoung = 1\n")
            .find("three whole numbers") != std::string::npos);
}

TEST_CASE("what bends and is thicker than wide, too large or stiffer than rounding is told where") {
  const std::string grid = "columns = 3\nrows = 3\nposition = [0, 9, 0]\n";
  const auto cloth = [&](const std::string& keys) { return complaint(kCloth + grid + keys); };
  CHECK(
      cloth("size = [2, 1]\nthickness = 1.5\n") ==
      "s.toml:13:13: error: cloth.c.thickness: 1.5 m is more than the 1 m that the cloth is wide; "
      "take [[soft]] for what is as thick");
  CHECK(cloth("size = [2, 1]\nthickness = 1.0\n") == "");
  CHECK(cloth("size = [1e9, 1e9]\n").find("s.toml:12:") == 0);
  const std::string box = "cells = [1, 1, 1]\nposition = [0, 9, 0]\n";
  const auto soft = [&](const std::string& keys) { return complaint(kSoft + box + keys); };
  CHECK(soft("size = [1, 1, 1]\nyoung = 1.1e15\n").find("s.toml:7:9") == 0);
  CHECK(soft("size = [1e9, 1, 1]\nyoung = 1e4\n").find("s.toml:6:") == 0);
  CHECK(soft("size = [1, 0.1, 1]\nyoung = 1e4\nskin = 0.06\n").find("s.toml:8:8") == 0);
}

// Oracle: closed form, a rigid cube that fell 25 cm and lies still. Of the points' places rounding
// takes E ε h/ρ of their speed: measured 1.2e-6 m/s and 2e-9 m, allowed 1e-5 and 1e-7.
TEST_CASE("the stiffest soft box is a rigid one, to rounding") {
  const Scene scene = parseScene(
      "[world]\nduration = 0.5\n[[body]]\nname = \"floor\"\nshape = { plane = [0, 1, 0, 0] }\n"
      "[[soft]]\nname = \"s\"\ncells = [2, 2, 2]\nsize = [0.3, 0.3, 0.3]\n"
      "position = [0, 0.4, 0]\nyoung = 1e15\n",
      "s.toml");
  const Recording recording = record(scene, 60.0);
  REQUIRE(!recording.report.stopped);
  const std::vector<BodySample>& end = recording.samples.back().bodies;
  const Vec3& corner = end[1].x;
  CHECK(corner.y() == Approx(0.005).margin(1e-7));
  CHECK((end.back().x - corner - Vec3::Constant(0.3)).norm() < 1e-7);
  for (std::size_t i = 1; i < end.size(); ++i) CHECK(end[i].v.norm() < 1e-5);
}

TEST_CASE("what cannot follow what bends refuses it by name") {
  const auto with = [](const std::string& keys) {
    std::string text = kCloth + kGrid;
    text.replace(text.find("[world]\n"), 8, keys);
    return complaint(text);
  };
  for (const char* method : {"exact", "course"})
    CHECK(with(std::string("[world]\nmethod = \"") + method + "\"\n")
              .find("as \"c\" does; take \"stepping\"") != std::string::npos);
  CHECK(with("[world]\n[stepping]\nsolver = \"pgs\"\n").find("take \"newton\"") !=
        std::string::npos);
  // No remedy is a method that refuses what bends in its turn.
  const std::string drag = with("[world]\n[[force]]\nkind = \"drag\"\nlinear = 1\n");
  CHECK(drag.find("by gravity and wind alone") != std::string::npos);
  CHECK(drag.find("course") == std::string::npos);
  const std::string top = with(
      "[world]\n[[body]]\nname = \"top\"\nshape = { sphere = 0.1 }\nmass = 1\n"
      "position = [9, 9, 9]\npivot_body = [0, -0.1, 0]\n");
  CHECK(top.find("knows no pivots; leave it out, a ball joint to the world") != std::string::npos);
  CHECK(top.find("course") == std::string::npos);
  CHECK(with("[world]\n") == "");
}

// Oracle: the certificate. Without friction too, each step of a cloth that meets a bar is solved.
TEST_CASE("a cloth slides off a bar, with friction and without") {
  for (const char* friction : {"0.0", "0.4"}) {
    const Scene scene = parseScene(
        "[world]\nduration = 0.3\n[[body]]\nname = \"bar\"\nfixed = true\nfriction = 0.5\n"
        "shape = { capsule = [0.1, 1.0] }\nposition = [0, 0.8, 0]\n"
        "orientation = { axis = [0, 0, 1], degrees = 90 }\n"
        "[[cloth]]\nname = \"towel\"\ncolumns = 15\nrows = 9\nsize = [1.0, 0.5]\n"
        "density = 0.3\nstretch = 500\nshear = 50\nbend = 1e-5\ndamping = 0.1\n"
        "position = [0.0, 1.2, 0.1]\nfriction = " +
            std::string(friction) + "\n",
        "s.toml");
    World world(scene.world);
    world.advance(scene.world.duration);
    CAPTURE(friction);
    const Certificate& books = world.report().certificate;
    CHECK(books.max_complementarity < 1e-11);  // measured 8e-13
    CHECK(books.max_penetration < 1e-13);      // measured 1e-15
    CHECK(books.energy_lost_impact > 0.1);
  }
}
