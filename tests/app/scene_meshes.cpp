// Meshes, compounds and how bodies are weighed, as a scene file says it.
#include <algorithm>

#include "app/present/facets.h"
#include "app/present/present.h"
#include "app/record/recording.h"
#include "app/scene/mesh_file.h"
#include "app/scene/obj_lines.h"
#include "app/scene/scene.h"
#include "sim/world.h"
#include "tests/catch.h"

using namespace tumble;

namespace {

std::string bodyWith(const std::string& keys) {
  return "[world]\ngravity = [0, 0, 0]\nduration = 1\n[[body]]\nname = \"b\"\nmass = 3.0\n" + keys +
         "\n";
}

BodyDef bodyFrom(const std::string& keys) {
  return parseScene(bodyWith(keys), "s.toml").world.bodies.at(0);
}

std::string bodyRefusal(const std::string& keys) {
  try {
    const Scene scene = parseScene(bodyWith(keys), "s.toml");
    try {
      World world(scene.world);
    } catch (const Refusal& refusal) {
      return format(locate(scene, refusal));
    }
  } catch (const SceneError& error) {
    return error.what();
  }
  return "";
}

bool says(const std::string& text, const char* part) {
  INFO(text);
  return text.find(part) != std::string::npos;
}

const char* kEll =
    "shape = { compound = [ { box = [1, 1, 1], position = [10.5, 0.5, 0.5] },"
    " { box = [1, 1, 1], position = [11.5, 0.5, 0.5], orientation = [0, 1, 0, 0] },"
    " { box = [1, 1, 1], position = [10.5, 1.5, 0.5] } ] }";

// Why a mesh file is refused; "" if it is not.
std::string whyNoMesh(const std::string& text) {
  try {
    parseMesh(text, "m.obj");
  } catch (const MeshError& error) {
    return error.what();
  }
  return "";
}

const std::string kCorners = "# a tetrahedron\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\n";

}  // namespace

// Oracle: the L of three cubes by hand.
TEST_CASE("a compound stands on its centre of mass and weighs what its parts do") {
  const BodyDef ell = bodyFrom(kEll);
  CHECK((originOf(ell.shape) - Vec3(10.0 + 5.0 / 6.0, 5.0 / 6.0, 0.5)).norm() < 1e-14);
  CHECK(massOf(ell).inertia(0, 1) == Approx(1.0 / 3.0).epsilon(1e-13));
  CHECK(volume(ell.shape) == Approx(3.0));
  const Aabb box = boundingBox(ell.shape, Pose{});
  CHECK((box.hi - Vec3(7.0 / 6.0, 7.0 / 6.0, 0.5)).norm() < 1e-14);
}

// Oracle: the same L, from the program's own mesh.
TEST_CASE("a mesh is read from a file and stands on its centre of mass") {
  const BodyDef mesh = bodyFrom("shape = { mesh = \"ell.obj\" }"), parts = bodyFrom(kEll);
  CHECK((massOf(mesh).inertia - massOf(parts).inertia).norm() < 1e-14);
  const Aabb a = boundingBox(mesh.shape, Pose{}), b = boundingBox(parts.shape, Pose{});
  CHECK((a.lo - b.lo).norm() + (a.hi - b.hi).norm() < 1e-14);
}

// Oracle: the same box as a box; hulls as parts keep the place that their points say.
TEST_CASE("a hull stands on its centre of mass, and as a part where its points stand") {
  const std::string corners =
      "[[3, 0, 0], [5, 0, 0], [3, 1, 0], [5, 1, 0], [3, 0, 4], [5, 0, 4], [3, 1, 4], [5, 1, 4], "
      "[4, 0.5, 2]]";
  const BodyDef hull = bodyFrom("shape = { hull = " + corners + " }");
  const BodyDef box = bodyFrom("shape = { box = [2, 1, 4] }");
  CHECK((massOf(hull).inertia - massOf(box).inertia).norm() < 1e-13);
  const Aabb around = boundingBox(hull.shape, Pose{});
  CHECK((around.hi - Vec3(1.0, 0.5, 2.0)).norm() < 1e-14);
  CHECK((around.lo + Vec3(1.0, 0.5, 2.0)).norm() < 1e-14);
  CHECK(std::get<Hull>(hull.shape).solid->faces.size() == 6);

  // A capsule of 2 m from end to end beside it, 3 m to the left of the hull's middle.
  const BodyDef both =
      bodyFrom("shape = { compound = [ { hull = " + corners +
               ", position = [0, 10, 0] }, { capsule = [0.5, 1], position = "
               "[1, 10.5, 2], orientation = { axis = [0, 0, 1], degrees = 90 } } ] }");
  const double V = 8.0, v = volume(Capsule{0.5, 1.0});
  CHECK(volume(both.shape) == Approx(V + v).epsilon(1e-14));
  const Vec3 centre = (V * Vec3(4, 10.5, 2) + v * Vec3(1, 10.5, 2)) / (V + v);
  CHECK((originOf(both.shape) - centre).norm() < 1e-14);
  const std::vector<PosedPart> parts = convexParts(both.shape);
  REQUIRE(parts.size() == 2);
  const Aabb first = boundingBox(parts[0].solid, parts[0].pose);
  CHECK((first.lo - (Vec3(3, 10, 0) - centre)).norm() < 1e-14);
  const Aabb second = boundingBox(parts[1].solid, parts[1].pose);
  CHECK((second.lo - (Vec3(0, 10, 1.5) - centre)).norm() < 1e-14);
  CHECK(says(bodyRefusal("shape = { compound = [ { hull = " + corners +
                         " }, { capsule = [0.51, 1], position = [2.5, 0.5, 2] } ] }"),
             "parts 1 and 2 of \"b\" overlap"));
}

// Oracle: the corners that the file and the scene list, turned by hand.
TEST_CASE("origin puts the coordinates of a mesh, a hull or a compound where it says") {
  const auto box = [](const BodyDef& def) {
    return boundingBox(def.shape, Pose{def.position, def.orientation});
  };
  const std::string hull =
      "shape = { hull = [[3,0,0],[5,0,0],[3,1,0],[5,1,0],[3,0,4],[5,0,4],"
      "[3,1,4],[5,1,4]] }\n";
  const Aabb asGiven = box(bodyFrom(hull + "origin = [0, 0, 0]"));
  CHECK((asGiven.lo - Vec3(3, 0, 0)).norm() + (asGiven.hi - Vec3(5, 1, 4)).norm() < 1e-14);
  const Aabb turned =
      box(bodyFrom(hull + "origin = [10, 0, 0]\norientation = { axis = [0, 1, 0], degrees = 90 }"));
  CHECK((turned.lo - Vec3(10, 0, -5)).norm() + (turned.hi - Vec3(14, 1, -3)).norm() < 1e-13);
  const Aabb ell = box(bodyFrom(std::string(kEll) + "\norigin = [-10, 0, 0]"));
  CHECK((ell.lo - Vec3(0, 0, 0)).norm() + (ell.hi - Vec3(2, 2, 1)).norm() < 1e-13);
  const Aabb mesh = box(bodyFrom("shape = { mesh = \"ell.obj\" }\norigin = [1, 2, 3]"));
  CHECK((mesh.lo - Vec3(1, 2, 2.5)).norm() + (mesh.hi - Vec3(3, 4, 3.5)).norm() < 1e-13);

  CHECK(says(bodyRefusal(hull + "origin = [0, 0, 0]\nposition = [0, 0, 0]"),
             "origin: position is given too; keep one"));
  CHECK(says(bodyRefusal("shape = { box = [1, 1, 1] }\norigin = [0, 0, 0]"),
             "only a hull, a mesh or a compound has coordinates of its own"));
}

TEST_CASE("copies of a hull share its points, and of a hull or a capsule the surface drawn") {
  const Scene scene = parseScene(
      "[world]\ngravity = [0, 0, 0]\nduration = 1\n"
      "[[array]]\nname = \"a\"\nkind = \"row\"\nstep = [3, 0, 0]\ncount = 3\n"
      "body = { mass = 1, shape = { hull = [[0,0,0],[1,0,0],[0,1,0],[0,0,1]] } }\n"
      "[[array]]\nname = \"c\"\nkind = \"row\"\nstep = [3, 0, 0]\ncount = 3\n"
      "vary = { shape = { capsule = [[0.5, 1], [0.5, 1]] } }\n"
      "body = { mass = 1, position = [0, 5, 0], shape = { capsule = [0.1, 2] } }\n",
      "s.toml");
  const std::vector<BodyDef>& bodies = scene.world.bodies;
  REQUIRE(bodies.size() == 6);
  CHECK(std::get<Hull>(bodies[0].shape).solid == std::get<Hull>(bodies[2].shape).solid);
  CHECK(std::get<Capsule>(bodies[4].shape).r == 0.5);
  const auto facets = facetsOfBodies(bodies);
  CHECK(facets[0] == facets[2]);
  CHECK(facets[3] == facets[5]);
  CHECK(facets[0] != facets[3]);
  CHECK(facets[3]->reach == Approx(1.0).epsilon(1e-2));
  CHECK(facets[3]->thickness == Approx(0.5).epsilon(1e-2));
}

// Oracle: D6 by hand: the box of the L is 2 m by 2 m by 1 m, 0.236 m beside its centre of mass.
TEST_CASE("a body is weighed as inertia_by says") {
  const std::string mesh = "shape = { mesh = \"ell.obj\" }\ninertia_by = ";
  const BodyDef exact = bodyFrom(mesh + "\"surface\""), box = bodyFrom(mesh + "\"box\"");
  CHECK(massOf(box).inertia(2, 2) == Approx(2.0).epsilon(1e-14));
  CHECK((originOf(box.shape) - originOf(exact.shape)).norm() ==
        Approx(std::sqrt(2.0) / 6.0).epsilon(1e-14));
  const BodyDef few = bodyFrom(mesh + "\"quasi\"\nsamples = 100");
  const BodyDef many = bodyFrom(mesh + "\"quasi\"\nsamples = 100000");
  const auto error = [&](const BodyDef& body) {
    return (massOf(body).inertia - massOf(exact).inertia).norm();
  };
  CHECK(error(many) < 0.1 * error(few));
}

// Oracle: the laws of momentum:  v = J/m,  ω = I⁻¹ (r × J).
TEST_CASE("a kick sets a body moving and turning") {
  const BodyDef ell =
      bodyFrom(std::string(kEll) + "\nkick = { impulse = [0, 0, 6], point = [0.5, 0, 0] }\n" +
               "velocity = [1, 0, 0]");
  CHECK((ell.velocity - Vec3(1.0, 0.0, 2.0)).norm() < 1e-14);
  CHECK((massOf(ell).inertia * ell.angularVelocity - Vec3(0.0, -3.0, 0.0)).norm() < 1e-14);
  CHECK(says(bodyRefusal("fixed = true\nshape = { sphere = 1 }\nkick = { impulse = [1, 0, 0] }"),
             "b.kick: the body is fixed"));
}

TEST_CASE("what cannot be weighed is refused where it is written") {
  CHECK(says(bodyRefusal("shape = { mesh = \"missing.obj\" }"),
             "s.toml:7:18: error: body.b.shape.mesh: no file 'missing.obj' or '"));
  CHECK(says(bodyRefusal("shape = { mesh = \"/missing.obj\" }"), "mesh: no file '/missing.obj'"));
  CHECK_FALSE(says(bodyRefusal("shape = { mesh = \"/missing.obj\" }"), " or "));
  CHECK(says(bodyRefusal("shape = { mesh = \"/tmp\" }"),
             "expected an OBJ file, found a folder '/tmp'"));
  CHECK(says(bodyRefusal("shape = { mesh = \"/dev/null\" }"),
             "expected an OBJ file, found a device '/dev/null'"));
  CHECK(says(bodyRefusal("shape = { compound = [] }"), "expected a list of parts"));
  CHECK(says(bodyRefusal("shape = { compound = [ { plane = [0, 1, 0, 0] } ] }"), "plane"));
  CHECK(says(bodyRefusal("shape = { compound = [ { box = [1, 1, 1], sphere = 1 } ] }"),
             "expected one of sphere, box, cylinder, capsule, hull, found 2 of them"));
  CHECK(says(bodyRefusal("shape = { compound = [ { box = [1, 1, 1] }, { sphere = 0.6 } ] }"),
             "parts 1 and 2 of \"b\" overlap"));
  CHECK(
      says(bodyRefusal("shape = { sphere = 1 }\ninertia_by = \"quasy\""), "did you mean 'quasi'?"));
  CHECK(says(bodyRefusal("shape = { mesh = \"dumbbell.obj\" }\ninertia_by = \"grid\"\nsamples = 1"),
             "lie on a line"));
}

TEST_CASE("a mesh file that bounds no solid is refused with its line") {
  const std::string points = kCorners;
  CHECK(whyNoMesh(points + "f 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n").empty());
  CHECK(whyNoMesh(points + "f 1/1/1 3//2 2\nf -4 -3 -1\ng other\nf 1 4 3\nf 2 3 4\n").empty());
  CHECK(says(whyNoMesh(points + "f 1 3 2\nf 1 2 4\nf 1 4 3\n"),
             "m.obj:7: the edge from point 2 (1, 0, 0) to point 4 (0, 0, 1) has a face on one"));
  CHECK(says(whyNoMesh(points + "f 1 3 2\n\n# turned\nf 1 4 2\nf 1 4 3\nf 2 3 4\n"), "m.obj:9: "));
  CHECK(says(whyNoMesh(points), "no faces"));
}

TEST_CASE("a word of a mesh file that is no number is refused where it stands") {
  const std::string number = "expected a finite number, found '";
  for (const std::string word : {"1,5", "1.0.0", "1d0", "1e3x", "nan", "inf", "-inf", "a", "0x0",
                                 "1e999", "+-1", "+", "1/2"})
    CHECK(whyNoMesh("v 0 " + word + " 1\n") == "m.obj:1:5: " + number + word + "'");
  CHECK(whyNoMesh("v 0 0 0\n\tv 0 0\n") == "m.obj:2:2: expected three numbers or more, found 2");
  const std::string shape = "expected the number of a point, like 3, 3/1, 3//2 or 3/1/2, found '";
  for (const std::string word : {"1.5", "1x", "99999999999999999999", "x", "1/", "1//", "1/2/",
                                 "/1", "1/x", "1//1.5", "1/2/3/4", "--1"})
    CHECK(whyNoMesh(kCorners + "f 2 " + word + " 4 3\n") == "m.obj:6:5: " + shape + word + "'");
  for (const std::string word : {"0", "5", "-5", "4294967297", "5/1"})
    CHECK(whyNoMesh(kCorners + "f " + word + " 2 4 3\n") ==
          "m.obj:6:3: expected a point from 1 to 4, or from -1 back to -4, found '" + word + "'");
  CHECK(whyNoMesh("f 1 2 3\n") == "m.obj:1:3: expected points above the first face, found '1'");
  CHECK(whyNoMesh(kCorners + "f\n") == "m.obj:6:1: expected three points or more, found 0");
  CHECK(whyNoMesh(kCorners + "hello world\n") ==
        "m.obj:6:1: expected v, f or another keyword of OBJ files, found 'hello'");
}

TEST_CASE("a surface that weighs like no solid is refused at the shape of its body") {
  Polyhedron apart;  // a cube, and one inside out where no mass is
  for (int k = 0; k < 16; ++k)
    apart.points.push_back((k < 8 ? 1.0 : 0.5) * Vec3(k & 1, k >> 1 & 1, k >> 2 & 1) +
                           Vec3(k < 8 ? 0.0 : 5.0, 0.0, 0.0));
  for (std::vector<int> face : std::vector<std::vector<int>>{
           {0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}}) {
    apart.faces.push_back(face);
    std::reverse(face.begin(), face.end());
    for (int& i : face) i += 8;
    apart.faces.push_back(face);
  }
  Scene scene = parseScene(bodyWith("shape = { sphere = 1 }"), "s.toml");
  scene.world.bodies[0].shape = Mesh{std::make_shared<const Polyhedron>(apart), Vec3::Zero()};
  try {
    World world(scene.world);
    FAIL("not refused");
  } catch (const Refusal& refusal) {
    CHECK(format(locate(scene, refusal)) ==
          "s.toml:7:9: error: \"b\" is no solid: inertia: must be symmetric and positive definite");
  }
}

// Oracle: the same tetrahedron plainly written.
// Oracle: the compiler's reading of the same numbers.
TEST_CASE("points of a mesh file are the numbers nearest to those written") {
  const ObjFile obj = readObj(
      "v 0.75 .1 1e-3\nv 1.75 .1 1e-3\nv 0.75 1.1 0.30000000000000004\n"
      "v 0.7 0.123456789012345678 1.001\nf 1 3 2\n",
      "m.obj");
  CHECK(obj.points[0] == Vec3(0.75, .1, 1e-3));
  CHECK(obj.points[2] == Vec3(0.75, 1.1, 0.30000000000000004));
  CHECK(obj.points[3] == Vec3(0.7, 0.123456789012345678, 1.001));
  CHECK(obj.lines == std::vector<int>{5});
}

TEST_CASE("a mesh file may hold comments, joined lines and what a solid does not need") {
  const std::string plain = kCorners + "f 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n";
  const std::string rich =
      "\xEF\xBB\xBFmtllib a b.mtl\r\no thing # 1\r\nv 0. 0 +0 1.0\r\nv 1 0 0 .5 .5 .5\r\n"
      "v 0 1e0 \\\r\n 0\r\n\tv 0 0 1#up\r\nvt 0 0\r\nvn 0 0 1\r\ng a\r\ns off\r\nusemtl m\r\n"
      "f 1/1/1 3//1 \\\r\n2/1 # below\r\nf -4 -3 -1\r\nf 1 4\\\r\n3\r\nl 1 2\r\np 1\r\nf 2 3 4";
  CHECK(whyNoMesh(rich).empty());
  CHECK(parseMesh(rich, "m.obj").solid->points == parseMesh(plain, "m.obj").solid->points);
  CHECK(parseMesh(rich, "m.obj").solid->faces == parseMesh(plain, "m.obj").solid->faces);
  CHECK(says(whyNoMesh(kCorners + "f 1 \\\n 3 2\nf 1 2 4\nf 1 4 3\n"), "m.obj:8: the edge"));
  CHECK(says(whyNoMesh(kCorners + "f 1 \\\n 3 x\n"), "m.obj:7:4: "));
}

// Oracle: the parts' own areas; cosines of smooth and sharp edges.
TEST_CASE("facets close around a compound, with lines where it is sharp") {
  const std::shared_ptr<const Facets> facets = facetsOf(bodyFrom(kEll).shape);
  double area = 0.0;
  for (std::size_t k = 0; k < facets->corners.size(); k += 3) {
    const Eigen::Vector3f a = facets->corners[k].position, b = facets->corners[k + 1].position,
                          c = facets->corners[k + 2].position;
    const Eigen::Vector3f n = (b - a).cross(c - a);
    area += 0.5 * n.norm();
    CHECK(n.normalized().dot(facets->corners[k].normal) > 0.999f);
  }
  CHECK(area == Approx(18.0).epsilon(1e-6));  // three cubes whole
  const auto lines = [](const Facets& drawn) {
    return std::count_if(drawn.corners.begin(), drawn.corners.end(),
                         [](const Facets::Corner& c) { return c.toEdge.minCoeff() < 1e5f; });
  };
  CHECK(lines(*facets) == 3 * 36);
  CHECK(lines(*facetsOf(bodyFrom("shape = { mesh = \"torus.obj\" }").shape)) == 0);
  CHECK(facetsOf(Box{}) == nullptr);
}

// Oracle: the points themselves, and the share of the L in its box.
TEST_CASE("the points by which a body is weighed are drawn inside it") {
  const Scene scene =
      parseScene(bodyWith("shape = { mesh = \"ell.obj\" }\ninertia_by = \"grid\"\nsamples = 500\n"
                          "position = [5, 0, 0]\n[show]\nsamples = true"),
                 "s.toml");
  const Recording recording = record(scene, 1.0);
  const Picture picture = Presenter(scene, recording).image(0);
  int dots = 0;
  for (const Instance& instance : picture.instances) {
    if (instance.form != Form::Sphere) continue;
    ++dots;
    CHECK((instance.position - Vec3(5.0, 0.0, 0.0)).norm() <
          boundingRadius(scene.world.bodies[0].shape));
  }
  CHECK(dots == Approx(375).margin(40));
}
