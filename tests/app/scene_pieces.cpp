// The convex pieces of meshes, as a scene file asks for them and as the cache keeps them.
#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "app/scene/mesh_file.h"
#include "app/scene/piece_store.h"
#include "app/scene/scene.h"
#include "tests/body/notched.h"
#include "tests/catch.h"

using namespace tumble;

namespace fs = std::filesystem;

namespace {

Mesh meshOf(const std::string& keys, const std::string& file = "ell.obj") {
  const Scene scene = parseScene(
      "[world]\ngravity = [0, 0, 0]\nduration = 1\n[[body]]\nname = \"b\"\n"
      "mass = 3.0\nshape = { mesh = \"" +
          file + "\"" + keys + " }\n",
      "s.toml");
  return std::get<Mesh>(scene.world.bodies.at(0).shape);
}

/// A surface as lines of an OBJ file whose points are counted from `first`.
std::string fileOf(const solids::Raw& raw, int first = 1) {
  std::string points, faces;
  for (const Vec3& p : raw.points) points += fmt::format("v {} {} {}\n", p.x(), p.y(), p.z());
  for (std::vector<int> face : raw.faces) {
    for (int& p : face) p += first;
    faces += fmt::format("f {}\n", fmt::join(face, " "));
  }
  return points + faces;
}

std::string boxFile(const Vec3& lo, const Vec3& hi, int first, bool inside = false) {
  const solids::Raw box = solids::box(lo, hi);
  return fileOf(inside ? reversed(box) : box, first);
}

std::string meshRefusal(const std::string& text) {
  try {
    parseMesh(text, "m.obj");
  } catch (const MeshError& error) {
    return error.what();
  }
  return "";
}

std::string whyNoBody(const std::string& keys, const std::string& file = "ell.obj") {
  try {
    meshOf(keys, file);
  } catch (const SceneError& error) {
    return error.what();
  }
  return "";
}

bool same(const Pieces& a, const Pieces& b) {
  if (a.hulls.size() != b.hulls.size() || a.excess != b.excess || a.slack != b.slack) return false;
  for (std::size_t k = 0; k < a.hulls.size(); ++k) {
    const Polyhedron &p = *a.hulls[k].solid, &q = *b.hulls[k].solid;
    if (p.points != q.points || p.faces != q.faces || a.hulls[k].origin != b.hulls[k].origin)
      return false;
  }
  return true;
}

}  // namespace

TEST_CASE("a scene says how a mesh is taken apart") {
  CHECK(meshOf("").pieces->hulls.size() == 2);
  CHECK(meshOf(", pieces = \"hull\"").pieces->hulls.size() == 1);
  CHECK(meshOf(", pieces = \"slivers\"").pieces->hulls.size() == 8);
  CHECK(meshOf(", pieces_tolerance = 0").pieces->slack == 0.0);
  CHECK(whyNoBody(", pieces = \"splinters\"").find("good") != std::string::npos);
  CHECK(whyNoBody(", pieces_tolerance = -1").find("pieces_tolerance") != std::string::npos);
  CHECK(whyNoBody(", pieces_tolerance = nan").find("pieces_tolerance") != std::string::npos);
}

/// A surface turned, and its corners rounded to a number of decimals.
solids::Raw turned(solids::Raw raw, double angle, const Vec3& axis, int decimals) {
  const Quat aslant(Eigen::AngleAxisd(angle, axis.normalized()));
  const double one = std::pow(10.0, decimals);
  for (Vec3& p : raw.points) p = (one * (aslant * p)).array().round().matrix() / one;
  return raw;
}

// Oracle: the star whose corners have all their digits. Where less may be added than its digits
// leave open it is what they say, and needs more pieces.
TEST_CASE("a mesh whose corners have few decimals is taken as it comes") {
  for (const int decimals : {3, 4, 6}) {
    const double grain = std::pow(10.0, -decimals);
    const fs::path path = fs::temp_directory_path() / "tumble-few-decimals.obj";
    std::ofstream(path) << fileOf(turned(solids::star(8), 0.7, {1.0, 2.0, 3.0}, decimals));
    const Pieces& pieces = *meshOf("", path.string()).pieces;
    const Pieces& closer = *meshOf(", pieces_tolerance = 1e-6", path.string()).pieces;
    fs::remove(path);
    CAPTURE(decimals);
    WARN("a star of " << decimals << " decimals: measured " << pieces.hulls.size() << " pieces, "
                      << closer.hulls.size() << " to a millionth");
    CHECK(pieces.hulls.size() <= 8);
    CHECK(closer.hulls.size() > 8);
    CHECK(closer.excess < 1e-5);
    CHECK(pieces.excess > 0.1 * grain);
    CHECK(pieces.excess < kRoughPieces * grain);  // measured 0.5 to 2.4 of the grain
  }
}

// Oracle: an L is two convex pieces. Taken for what their corners say, turned ones come apart into
// up to eleven, of which slivers cover corners of the others.
TEST_CASE("an L whose corners have few decimals is two pieces, however it is turned") {
  for (const int decimals : {3, 4, 6})
    for (int turn = 1; turn <= 12; ++turn) {
      const Vec3 axis(std::cos(turn), std::sin(2.0 * turn), std::sin(turn));
      const fs::path path = fs::temp_directory_path() / "tumble-turned-ell.obj";
      std::ofstream(path) << fileOf(turned(solids::ell(), 0.5 * turn, axis, decimals));
      CAPTURE(decimals, turn);
      CHECK(meshOf("", path.string()).pieces->hulls.size() == 2);
      fs::remove(path);
    }
}

// Oracle: by construction. Corners of two boxes that stand side by side are off by half of the last
// digit; boxes that share ten of it are not.
TEST_CASE("shells that touch still do when their corners have few decimals") {
  for (const int decimals : {3, 4})
    for (const double shared : {0.0, 10.0}) {
      const double grain = std::pow(10.0, -decimals);
      const solids::Raw both = together(solids::box({0, 0, 0}, {1.0 + shared * grain, 1, 1}),
                                        solids::box({1.0, -0.5, -0.5}, {2, 1.5, 1.5}));
      for (int turn = 1; turn <= 6; ++turn) {
        const Vec3 axis(std::cos(turn), std::sin(2.0 * turn), std::sin(turn));
        const fs::path path = fs::temp_directory_path() / "tumble-side-by-side.obj";
        std::ofstream(path) << fileOf(turned(both, 0.5 * turn, axis, decimals));
        CAPTURE(decimals, turn, shared);
        if (shared == 0.0)
          CHECK(meshOf("", path.string()).pieces->hulls.size() == 2);
        else
          CHECK(whyNoBody("", path.string()).find("overlaps") != std::string::npos);
        fs::remove(path);
      }
    }
}

// Oracle: closed form. A mesh that is written by hand has few digits, and means them: a step of the
// last one stays.
TEST_CASE("a mesh whose faces are flat as they are written is what its corners say") {
  solids::Raw stairs = solids::ell();
  for (Vec3& p : stairs.points) p.x() = p.x() > 1.5 ? 1.001 : p.x() > 0.5 ? 1.0 : 0.0;
  const fs::path path = fs::temp_directory_path() / "tumble-hand-made.obj";
  std::ofstream(path) << fileOf(stairs);
  const Pieces& pieces = *meshOf("", path.string()).pieces;
  fs::remove(path);
  CHECK(pieces.hulls.size() == 2);
  CHECK(pieces.excess == 0.0);
}

// Oracle: how the numbers were written.
TEST_CASE("a mesh file tells by its digits how far its corners may be off") {
  const auto grain = [](const std::string& first) {
    const auto digits = [&](double x) { return fmt::format(fmt::runtime(first), x); };
    const solids::Raw raw = turned(solids::box({0, 0, 0}, {1, 2, 3}), 0.7, {1.0, 2.0, 3.0}, 17);
    std::string text;
    for (const Vec3& p : raw.points)
      text += fmt::format("v {} {} {}\n", digits(p.x()), digits(p.y()), digits(p.z()));
    for (std::vector<int> face : raw.faces) {
      for (int& p : face) ++p;
      text += fmt::format("f {}\n", fmt::join(face, " "));
    }
    return parseMesh(text, "m.obj").grain;
  };
  CHECK(grain("{:.6f}") == Approx(1e-6));
  CHECK(grain("{:.4f}") == Approx(1e-4));
  CHECK(grain("{:.6g}") == Approx(1e-5));
  CHECK(grain("{:.4e}") == Approx(1e-4));
  CHECK(grain("{:.9g}") < 5e-7);  // all that single precision holds
  CHECK(grain("{}") < 5e-7);
}

// What is wrong, and in which line of the file.
TEST_CASE("a mesh that is no solid is refused in one line that says where") {
  const std::string box = boxFile({0, 0, 0}, {1, 1, 1}, 1);
  CHECK(meshRefusal(box).empty());
  CHECK(meshRefusal(box + boxFile({2, 0, 0}, {3, 1, 1}, 9)).empty());
  const auto says = [](const std::string& text, const std::string& line, const std::string& what) {
    const std::string found = meshRefusal(text);
    CAPTURE(found);
    CHECK(found.starts_with("m.obj:" + line + ": "));
    CHECK(found.find(what) != std::string::npos);
    CHECK(found.find('\n') == std::string::npos);
  };
  says(box.substr(0, box.rfind('f')), "9", "is not closed");
  says(box + boxFile({0.5, 0.5, -1}, {0.8, 0.8, 2}, 9), "23", "overlaps the shell");
  says(box + "f 1 2 2\n", "15", "has no length");
  says("v 0.5 0 0\n" + boxFile({0, 0, 0}, {1, 1, 1}, 2) + "f 2 1 3\n", "16", "has no area");
  says(boxFile({0, 0, 0}, {1, 1, 1}, 1, true), "9", "inside out");
  says(box + boxFile({5, 5, 5}, {6, 6, 6}, 9, true), "23", "inside out");
  says(box + "v 0 nan 0\n", "15:5", "expected a finite number, found 'nan'");
}

// Oracle: the file itself. 511 boxes, of which the first has faces that are not flat and is cut
// into triangles, and an L: the L is met first, and makes it one piece too many.
TEST_CASE("a mesh of too many pieces is refused at the line of a face at a notch") {
  solids::Raw bent = solids::box({0, 0, 0}, {1, 1, 1});
  bent.points[7] = {1.1, 1.2, 1.3};
  std::string text = fileOf(bent);
  for (int k = 1; k < 511; ++k) text += boxFile({3.0 * k, 0, 0}, {3.0 * k + 1, 1, 1}, 8 * k + 1);
  const auto lines = std::count(text.begin(), text.end(), '\n');
  solids::Raw ell = solids::ell();
  for (Vec3& p : ell.points) p.y() -= 5.0;
  const int first = 8 * 511 + 1;
  text += fileOf(ell, first);
  const fs::path path = fs::temp_directory_path() / "tumble-many-pieces.obj";
  std::ofstream(path) << text;
  const std::string found = whyNoBody("", path.string());
  fs::remove(path);
  CAPTURE(found);
  // Its points 4 and 10 are the notch, and its third face, after twelve points, runs from 4 to 10.
  CHECK(found.find(fmt::format(
            "many-pieces.obj:{}: the mesh needs more than 512 convex pieces, as at the notch from "
            "point {} to point {};",
            lines + 12 + 3, first + 3, first + 9)) != std::string::npos);
}

TEST_CASE("pieces as text are the same to the last bit, and a broken text is none") {
  const Mesh mesh = meshOf("");
  const std::string text = textOf(*mesh.pieces);
  const auto again = piecesFrom(text);
  REQUIRE(again);
  CHECK(same(*again, *mesh.pieces));
  CHECK(!piecesFrom(""));
  CHECK(!piecesFrom(text.substr(0, text.size() / 2)));
  std::string changed = text;
  changed[text.size() / 2] = changed[text.size() / 2] == '0' ? '1' : '0';
  CHECK(!piecesFrom(changed));
}

TEST_CASE("pieces are kept in the user's cache; a broken file is made anew, none is no error") {
  const fs::path folder = fs::temp_directory_path() / "tumble-pieces-test";
  fs::remove_all(folder);
  const char* before = std::getenv("XDG_CACHE_HOME");
  const std::string old = before ? before : "";
  setenv("XDG_CACHE_HOME", folder.c_str(), 1);
  const Mesh mesh = meshOf("");
  const auto files = [&] {
    std::vector<fs::path> found;
    if (fs::exists(folder / "tumble"))
      for (const auto& entry : fs::directory_iterator(folder / "tumble"))
        found.push_back(entry.path());
    return found;
  };
  // Another tolerance each time: the program remembers what it has found before.
  const auto first = storedPieces(*mesh.solid, PieceKind::Good, 1.25e-6, 0.0, "ell.obj");
  REQUIRE(files().size() == 1);
  CHECK(same(*first, *mesh.pieces) == (first->slack == mesh.pieces->slack));
  const fs::path file = files()[0];
  std::ofstream(file) << "nonsense";
  CHECK(storedPieces(*mesh.solid, PieceKind::Good, 1.5e-6, 0.0, "ell.obj"));
  setenv("XDG_CACHE_HOME", "/proc/nowhere", 1);
  CHECK(storedPieces(*mesh.solid, PieceKind::Good, 1.75e-6, 0.0, "ell.obj"));
  old.empty() ? unsetenv("XDG_CACHE_HOME") : setenv("XDG_CACHE_HOME", old.c_str(), 1);
  fs::remove_all(folder);
}
