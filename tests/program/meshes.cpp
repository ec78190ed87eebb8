// Mesh files that bound no solid: one line that says where, exit 3, and nothing half-written.
#include <cmath>

#include "tests/catch.h"
#include "tests/program/program.h"

namespace {

/// Of a cube whose corner k has the bits of k as x, y and z.
constexpr int kFaces[6][4] = {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4},
                              {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}};

/// The unit cube shifted along x, its points counted from `first`; `inside` out or not.
std::string cube(double x, int first, bool inside = false) {
  std::ostringstream text;
  for (int k = 0; k < 8; ++k)
    text << "v " << x + (k & 1) << " " << (k >> 1 & 1) << " " << (k >> 2 & 1) << "\n";
  for (const auto& face : kFaces) {
    text << "f";
    for (int k = 0; k < 4; ++k) text << " " << face[inside ? 3 - k : k] + first;
    text << "\n";
  }
  return text.str();
}

/// A cube that shares the edge from point 4 to point 8 of the unit cube at 0, and no more.
std::string touchingCube() {
  std::ostringstream text;
  const int number[8] = {4, 9, 10, 11, 8, 12, 13, 14};
  for (int k = 1; k < 8; ++k)
    if (k != 4) text << "v " << 1 + (k & 1) << " " << 1 + (k >> 1 & 1) << " " << (k >> 2) << "\n";
  for (const auto& face : kFaces) {
    text << "f";
    for (const int k : face) text << " " << number[k];
    text << "\n";
  }
  return text.str();
}

/// A torus of 2 n² triangles.
std::string torus(int n) {
  std::ostringstream text;
  const double turn = 6.283185307179586 / n;
  for (int i = 0; i < n; ++i)
    for (int k = 0; k < n; ++k) {
      const double r = 2.0 + std::cos(turn * k);
      text << "v " << r * std::cos(turn * i) << " " << r * std::sin(turn * i) << " "
           << std::sin(turn * k) << "\n";
    }
  const auto at = [&](int i, int k) { return i % n * n + k % n + 1; };
  for (int i = 0; i < n; ++i)
    for (int k = 0; k < n; ++k) {
      text << "f " << at(i, k) << " " << at(i + 1, k) << " " << at(i + 1, k + 1) << "\n";
      text << "f " << at(i, k) << " " << at(i + 1, k + 1) << " " << at(i, k + 1) << "\n";
    }
  return text.str();
}

}  // namespace

TEST_CASE("a scene of a mesh that is no solid ends with 3, one line and no file") {
  const Folder scratch;
  scratch.file("bad.toml", R"([world]
duration = 0.1
[[body]]
name = "b"
mass = 1.0
shape = { mesh = "m.obj" }
)");
  const auto refused = [&](const std::string& text, const std::string& where,
                           const std::string& what) {
    scratch.file("m.obj", text);
    const Outcome outcome =
        tumbleRun(scratch, "simulate bad.toml -o out", "export XDG_CACHE_HOME=$PWD/cache");
    CAPTURE(what, outcome.err);
    CHECK(outcome.code == 3);
    CHECK(outcome.lines() == 1);
    CHECK(outcome.says("bad.toml:6:18: error: body.b.shape.mesh: m.obj" + where));
    CHECK(outcome.says(what));
    CHECK(outcome.out.empty());
    CHECK(filesBelow(scratch.path) == 2);
  };
  const std::string solid = cube(0.0, 1);
  refused(solid.substr(0, solid.rfind('f')), ":9: ", "is not closed");
  // An edge of three faces, and one of the four of two cubes that touch along it.
  refused(solid + "f 1 2 3\n", ":15: ", "more than two faces meet there");
  refused(solid + touchingCube(), ":21: ", "more than two faces meet there");
  std::string crossing = solid;  // a corner pushed out through the bottom
  refused(crossing.replace(crossing.find("v 1 1 1"), 7, "v 0.2 -0.5 0.3"),
          ":10: ", "face 2 and face 3 pass through each other");
  refused(cube(0.0, 1, true), ":9: ", "inside out");
  refused(solid + cube(5.0, 9, true), ":23: ", "inside out");
  refused(solid + cube(0.5, 9), ":", "overlaps the shell");
  const std::string sheet = "v 0 0 0\nv 1 0 0.3\nv 0 1 0.7\n";
  refused(sheet + "f 1 2 3\nf 3 2 1\n", ":4: ", "the surface holds no volume");
  refused("v 0.5 0 0\n" + cube(0.0, 2) + "f 2 1 3\n", ":16: ", "has no area");
  refused(solid + "v 0 nan 0\n", ":15:5: ", "expected a finite number, found 'nan'");
}

// What a terminal might take for a command, and what is no text, is not passed on; the second of
// two bodies of one mesh names the first.
TEST_CASE("a mesh file that is no text is refused in words alone, and for two bodies once") {
  const Folder scratch;
  scratch.file("m.obj", std::string("\xff\xfe\0\x1b[31m\xc2\x9b", 10) + "v 1 2 3\n");
  scratch.file("bad.toml", R"([world]
duration = 0.1
[[body]]
name = "a"
mass = 1.0
shape = { mesh = "m.obj" }
[[body]]
name = "b"
mass = 1.0
shape = { mesh = "m.obj" }
[[body]]
name = "c"
mass = 1.0
shape = { mesh = "m.obj", pieces_tolerance = 0.01 }
)");
  const Outcome outcome = tumbleRun(scratch, "simulate bad.toml -o out");
  CHECK(outcome.code == 3);
  CHECK(
      outcome.says("bad.toml:6:18: error: body.a.shape.mesh: m.obj:1:1: expected v, f or another "
                   "keyword of OBJ files, found '????[31m??v'\n"));
  CHECK(
      outcome.says("bad.toml:10:18: error: body.b.shape.mesh: refused as body.a.shape.mesh is\n"));
  CHECK(outcome.says("bad.toml:14:18: error: body.c.shape.mesh: m.obj:1:1: "));
  CHECK(outcome.lines() == 3);
  CHECK(filesBelow(scratch.path) == 2);
}

// Oracle: an L is two boxes.
TEST_CASE("describe and the summary say how many pieces a mesh has, and what they are off") {
  const Folder scratch;
  scratch.file("two.toml",
               "[world]\nduration = 0.01\ngravity = [0, 0, 0]\n"
               "[[body]]\nname = \"a\"\nmass = 1.0\nshape = { mesh = \"ell.obj\" }\n"
               "[[body]]\nname = \"b\"\nmass = 1.0\nposition = [9, 0, 0]\n"
               "shape = { mesh = \"ell.obj\", pieces = \"hull\" }\n");
  const Outcome described = tumbleRun(scratch, "describe two.toml");
  CAPTURE(described.out, described.err);
  CHECK(holds(described.out, "pieces    a: 2 convex, 0 m out of the mesh, "));
  CHECK(holds(described.out, "pieces    b: 1 convex, 0 m out of the mesh, 0 m over each other\n"));
  CHECK(tumbleRun(scratch, "simulate two.toml -o out").code == 0);
  const std::string summary = textOf(scratch / "out/summary.json");
  CHECK(holds(summary, "\"mesh_pieces\": 3,\n  \"mesh_slack\": "));
}

TEST_CASE("a scene of a mesh that is not there ends with 3, one line and no file") {
  const Folder scratch;
  scratch.file("bad.toml",
               "[world]\nduration = 1\n[[body]]\nname = \"b\"\nmass = 1.0\n"
               "shape = { mesh = \"missing.obj\" }\n");
  const Outcome outcome = tumbleRun(scratch, "simulate bad.toml -o out");
  CHECK(outcome.code == 3);
  CHECK(outcome.lines() == 1);
  CHECK(outcome.says("bad.toml:6:18: error: body.b.shape.mesh: no file '"));
  CHECK(filesBelow(scratch.path) == 1);
}

// Refused by its number of faces, once its surface has been found whole.
TEST_CASE("a mesh of a million faces is refused in one line", "[long]") {
  const Folder scratch;
  scratch.file("bad.toml",
               "[world]\nduration = 1\n[[body]]\nname = \"b\"\nmass = 1.0\n"
               "shape = { mesh = \"m.obj\" }\n");
  scratch.file("m.obj", torus(708));
  const Outcome outcome = tumbleRun(scratch, "simulate bad.toml -o out");
  CAPTURE(outcome.err);
  CHECK(outcome.code == 3);
  CHECK(outcome.lines() == 1);
  CHECK(outcome.says("m.obj: the mesh has 1002528 faces, and at most 20000 are taken apart"));
  CHECK(filesBelow(scratch.path) == 2);
}
