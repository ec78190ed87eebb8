// What a wrong scene file is told; long, for every key has its mistakes here: the place, the key,
// what was expected, the word that was meant.
#include "app/scene/scene.h"
#include "tests/catch.h"

using namespace tumble;

namespace {

// A right scene of seven lines; the wrong part is line 8 and on.
const std::string kRight =
    "[world]\n"
    "[materials.rubber]\n"
    "density = 1000\n"
    "[[body]]\n"
    "name = \"ball\"\n"
    "shape = { sphere = 0.1 }\n"
    "material = \"rubber\"\n";

struct Wrong {
  std::string text;   ///< from line 8 on
  std::string place;  ///< "line:column"
  std::string says;   ///< part of the message
};

std::vector<Diagnostic> complaints(const std::string& text,
                                   const std::vector<std::string>& overrides = {}) {
  try {
    parseScene(text, "s.toml", overrides);
  } catch (const SceneError& error) {
    return error.diagnostics();
  }
  return {};
}

// One complaint alone: each row has one mistake.
void check(const std::string& text, const Wrong& wrong) {
  INFO(text);
  const std::vector<Diagnostic> found = complaints(text);
  REQUIRE(found.size() == 1);
  const std::string line = format(found[0]);
  INFO(line);
  const std::string head = "s.toml:" + wrong.place + ": error: ";
  CHECK(line.substr(0, head.size()) == head);
  CHECK(line.find(wrong.says) != std::string::npos);
}

}  // namespace

TEST_CASE("a wrong value of a body is named with its place and what was expected") {
  const std::vector<Wrong> table = {
      {"mass = 0", "8:8", "body.ball.mass: expected a number [kg] > 0, found 0"},
      {"pivot_body = [0, 1]", "8:14", "body.ball.pivot_body: expected a list of 3 numbers [m]"},
      {"pivot_body = 0.1", "8:14", "body.ball.pivot_body: expected"},
      {"mass = -2.5", "8:8", "body.ball.mass: expected a number [kg] > 0, found -2.5"},
      {"mass = nan", "8:8", "body.ball.mass: expected a number [kg] > 0, found nan"},
      {"mass = inf", "8:8", "body.ball.mass: expected a number [kg] > 0, found inf"},
      {"mass = 1e-40", "8:8", "beyond 1e-30 to 1e30"},
      {"mass = true", "8:8", "body.ball.mass: expected a number [kg] > 0, found true"},
      {"mass = 2024-01-01", "8:8", "found a date or time"},
      {"mass = \"\"", "8:8", "body.ball.mass: expected a number [kg] > 0, found an empty string"},
      {"mass = \"2 kg\"", "8:8", "found the string '2 kg'"},
      {"density = 0", "8:11", "body.ball.density: expected a number [kg/m³] > 0, found 0"},
      {"restitution = 1.5", "8:15",
       "body.ball.restitution: expected a number in [0, 1], found 1.5"},
      {"restitution = -0.1", "8:15", "expected a number in [0, 1], found -0.1"},
      {"friction = -0.1", "8:12", "body.ball.friction: expected a number >= 0, found -0.1"},
      {"inertia = [1, 1, 0]", "8:18", "body.ball.inertia: expected a number [kg m²] > 0, found 0"},
      {"inertia = [1, 1, 3]", "8:11", "larger than the sum of the other two"},
      {"position = [0, 1]", "8:12", "expected a list of 3 numbers [m], found a list of 2 values"},
      {"position = [0, \"1\", 0]", "8:16", "expected a number [m], found the string '1'"},
      {"velocity = 3", "8:12", "expected a list of 3 numbers [m/s], found 3"},
      {"angular_velocity = [0, nan, 0]", "8:24", "expected a number [rad/s], found nan"},
      {"angular_velocity = [0,0,1]\nangular_velocity_body = [0,0,1]", "9:25", "keep one"},
      {"orientation = [0, 0, 0, 0]", "8:15", "[w, x, y, z] that is not zero"},
      {"orientation = [1, 0, 0]", "8:15", "expected a list of 4 numbers"},
      {"orientation = { axis = [0, 0, 0], degrees = 30 }", "8:24", "not all zero"},
      {"orientation = { axis = [0, 1, 0], degree = 30 }", "8:35", "did you mean 'degrees'?"},
      {"fixed = 1", "8:9", "body.ball.fixed: expected true or false, found 1"},
      {"colour = [1, 2, 0]", "8:14", "body.ball.colour: expected a number in [0, 1], found 2"},
      {"label = 7", "8:9", "expected a string in quotes, found 7"},
      {"label = \"" + std::string(201, 'x') + "\"", "8:9", "longer than 200 bytes"},
      {"velocty = [0, 0, 0]", "8:1", "body.ball.velocty: unknown key, did you mean 'velocity'?"},
      {"veloctiy = [0, 0, 0]", "8:1", "did you mean 'velocity'?"},
      {"restitutions = 1", "8:1", "did you mean 'restitution'?"},
      {"xyzzy = 1", "8:1", "unknown key; valid: name, material"},
      {"\"a b\\u001b\" = 1", "8:1", "body.ball.'a b?': unknown key"},
  };
  for (const Wrong& wrong : table) check(kRight + wrong.text + "\n", wrong);
}

TEST_CASE("a text that begins off the page is told how large that is") {
  const std::string off = "text.0.page: [";
  check(kRight + "[[text]]\ntext = \"a\"\npage = [1280, 40]\n",
        {"", "10:8", off + "1280, 40] is off the page, which is 1280 px wide and 720 px high"});
  check(kRight + "[[text]]\ntext = \"a\"\npage = [30, -1]\n", {"", "10:8", off + "30, -1] is off"});
  check(kRight + "[[text]]\ntext = \"a\"\npage = [720, 9]\n[image]\nsize = [300, 300]\n",
        {"", "10:8", "which is 720 px wide"});
  CHECK(complaints(kRight + "[[text]]\ntext = \"a\"\npage = [1279, 719]\n").empty());
}

// Oracle: closed form, 1/240 s, or as many steps as tell of a fall.
TEST_CASE("a run too short for the default step has shorter ones, unless the scene gives one") {
  const auto stepOf = [](const std::string& duration, const std::string& more = "") {
    return parseScene("[world]\nduration = " + duration + "\n" + more +
                          "[[body]]\nshape = { sphere = 1 }\nmass = 1\n",
                      "s.toml")
        .world.stepping.step;
  };
  CHECK(stepOf("5") == 1.0 / 240.0);
  CHECK(stepOf("0.1") == 1.0 / 240.0);
  CHECK(stepOf("2.4e-6") == Approx(1e-7).epsilon(1e-15));
  CHECK(stepOf("2.4e-6", "[stepping]\nstep = 0.01\n") == 0.01);
}

TEST_CASE("a wrong second body is named by its number until it has a name") {
  const std::vector<Wrong> table = {
      {"[[body]]", "8:1", "body.1.shape: missing, for example shape = { sphere = 0.1 }"},
      {"[[body]]\nname = \"b\"\nshape = { sphere = 1 }", "8:1",
       "body.b.mass: missing; a moving body needs a mass"},
      {"[[body]]\nname = \"ball\"\nshape = { sphere = 1 }\nmass = 1", "9:8",
       "body.ball.name: there is a body 'ball' already"},
      {"[[body]]\nname = \"no spaces\"\nshape = { sphere = 1 }\nmass = 1", "9:8",
       "body.1.name: expected 1 to 64 of A-Z a-z 0-9 _ and ., found 'no spaces'"},
      {"[[body]]\nshape = { sphere = 1 }\nmaterial = \"ruber\"\nmass = 1", "10:12",
       "body.1.material: unknown material 'ruber', did you mean 'rubber'?"},
      {"[[body]]\nshape = { sphere = 0 }\nmass = 1", "9:20", "expected a number [m] in [1e-09,"},
      {"[[body]]\nshape = { sphere = 1e300 }\nmass = 1", "9:20", "found 1e+300"},
      {"[[body]]\nshape = { box = [1, 0, 1] }\nmass = 1", "9:21", "body.1.shape.box: expected"},
      {"[[body]]\nshape = { cylinder = [1] }\nmass = 1", "9:22", "a list of 2 numbers [m]"},
      {"[[body]]\nshape = { plane = [0, 0, 0, 1] }", "9:19", "a normal that is not zero"},
      {"[[body]]\nshape = { plane = [0, 1, 0, 0] }\nfixed = false", "10:9",
       "body.1.fixed: a plane is always fixed"},
      {"[[body]]\nshape = { plane = [0, 1, 0, 0] }\nposition = [0, 1, 0]", "10:12",
       "body.1.position: a plane stands where"},
      {"[[body]]\nshape = { sphere = 1, box = [1, 1, 1] }\nmass = 1", "9:9",
       "expected one of sphere, box, cylinder, capsule, hull, plane, mesh, compound, ellipsoid, "
       "found 2 of "
       "them"},
      {"[[body]]\nshape = {}\nmass = 1", "9:9", "found 0 of them"},
      {"[[body]]\nshape = { spere = 1 }\nmass = 1", "9:11", "did you mean 'sphere'?"},
      {"[[body]]\nshape = { cone = [1, 2] }\nmass = 1", "9:11",
       "body.1.shape.cone: unknown key; valid: sphere, box, cylinder, capsule, hull, plane"},
      {"[[body]]\nshape = { capsule = 0.5 }\nmass = 1", "9:21",
       "body.1.shape.capsule: expected a list of 2 numbers [m], found 0.5"},
      {"[[body]]\nshape = { capsule = [0.5, 0] }\nmass = 1", "9:27",
       "body.1.shape.capsule: expected a number [m] in [1e-09, 1e+06], found 0"},
      {"[[body]]\nshape = { ellipsoid = [1, 2] }\nmass = 1", "9:23",
       "body.1.shape.ellipsoid: expected a list of 3 numbers [m]"},
      {"[[body]]\nshape = { sphere = 1 }\nmass = 1\nproducts = [0, 0, 0]", "11:12",
       "body.1.products: needs `inertia` beside it"},
      {"[[body]]\nshape = { sphere = 1 }\nmass = 1\ninertia = [1, 1, 1]\nproducts = [0, 0, 2]",
       "11:11", "body.1.inertia: no body has these"},
      {"[[body]]\nshape = { hull = \"ball\" }\nmass = 1", "9:18",
       "body.1.shape.hull: expected a list of points like [[x, y, z], …], found the string"},
      {"[[body]]\nshape = { hull = [[0, 0, 0], [1, 0], [0, 1, 0]] }\nmass = 1", "9:30",
       "body.1.shape.hull: expected a point [x, y, z], found a list of 2 values"},
      {"[[body]]\nshape = { hull = [[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, \"1\", 1]] }\nmass = 1",
       "9:56", "body.1.shape.hull: expected a number [m]"},
      {"[[body]]\nshape = { hull = [[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, nan, 1]] }\nmass = 1",
       "9:56", "body.1.shape.hull: expected a number [m]"},
      {"[[body]]\nshape = { hull = [] }\nmass = 1", "9:18", "four points or more, found 0"},
      {"[[body]]\nshape = { hull = [[0, 0, 0], [1, 0, 0]] }\nmass = 1", "9:18",
       "body.1.shape.hull: a hull takes four points or more, found 2"},
      {"[[body]]\nshape = { hull = [[0, 0, 0], [1, 0, 0], [0, 1, 0], [1, 1, 0]] }\nmass = 1",
       "9:18", "body.1.shape.hull: the points are all in a plane, and their hull has no volume"},
      {"[[body]]\nshape = { compound = [{ hull = [[0, 0, 0], [1, 1, 1], [2, 2, 2], [3, 3, 3]] }] }"
       "\nmass = 1",
       "9:32", "body.1.shape.compound.0.hull: the points are all on a line"},
      {"[[body]]\nshape = \"partikle\"\nmass = 1", "9:9",
       "body.1.shape: expected \"particle\" or a table, found the string"},
      {"[[body]]\nshape = \"particle\"", "8:1", "body.1.mass: missing; a particle needs a mass"},
      {"[[body]]\nshape = \"particle\"\nmaterial = \"rubber\"", "8:1",
       "body.1.mass: missing; a particle needs a mass"},
      {"[[body]]\nshape = \"particle\"\nmass = 1\nradius = -1", "11:10",
       "body.1.radius: expected a number [m]"},
      {"[[body]]\nshape = \"particle\"\nmass = 1\nangular_velocity = [0, 1, 0]", "11:20",
       "body.1.angular_velocity: a particle has no inertia and does not turn"},
      {"[[body]]\nshape = \"particle\"\nmass = 1\norientation = [1, 0, 0, 0]", "11:15",
       "body.1.orientation: a particle has no inertia and does not turn"},
      {"[[body]]\nshape = \"particle\"\nmass = 1\ninertia = [1, 1, 1]", "11:11",
       "body.1.inertia: a particle has no inertia and does not turn"},
      {"[[body]]\nshape = { sphere = 1 }\nmass = 1\nradius = 1", "11:1",
       "body.1.radius: unknown key"},
  };
  for (const Wrong& wrong : table) check(kRight + wrong.text + "\n", wrong);
}

TEST_CASE("a wrong setting is named with the words and numbers that are valid") {
  const std::vector<Wrong> table = {
      {"[course]\nstep = 0", "9:8", "course.step: expected a number [s] in (0, 1e+06], found 0"},
      {"[course]\nintegrator = \"rk5\"", "9:14",
       "unknown value 'rk5', did you mean 'rk4'? Valid: "},
      {"[course]\norder = 0", "9:9", "course.order: expected a whole number from 1 to 40"},
      {"[course]\norder = 2.5", "9:9", "course.order: expected a whole number from 1 to 40"},
      {"[course]\nattitude = \"matrx\"", "9:12", "unknown value 'matrx', did you mean 'matrix'?"},
      {"[course]\nplan = \"gradua\"", "9:8", "unknown value 'gradua'"},
      {"[course]\ncontact = \"penal\"", "9:11", "unknown value 'penal'"},
      {"[course]\nrepair_steps = 0", "9:16", ""},
      {"[course]\nstiffness = 0.0", "9:13", ""},
      {"[course]\ndamping = -1.0", "9:11", ""},
      {"[stepping]\npreset = \"fats\"", "9:10",
       "stepping.preset: unknown value 'fats', did you mean 'fast'? Valid: auto, exact, balanced, "
       "fast, draft"},
      {"[stepping]\nsolver = \"newtn\"", "9:10", "stepping.solver: unknown value 'newtn'"},
      {"[stepping]\npoints = \"implict\"", "9:10",
       "stepping.points: unknown value 'implict', did you mean 'implicit'? Valid: gradual, "
       "displace, "
       "implicit, constraint"},
      {"[stepping]\ntolerance = -1", "9:13", "stepping.tolerance: expected a number in (0, 1]"},
      {"[pairs]\nrubber = {}", "9:1", "expected two materials, \"A-B\""},
      {"[pairs]\nrubber-wod = {}", "9:1", "unknown material 'wod'"},
      {"[pairs]\nrubber-rubber = { frction = 1 }", "9:19", "did you mean 'friction'?"},
      {"[materials.a]\n[pairs]\nrubber-a = { friction = 1 }\na-rubber = { friction = 2 }", "10:1",
       "pairs.'rubber-a': the row 'a-rubber' says it already"},
      {"[materials.\"a-b\"]", "8:12", "a name is made of A-Z a-z 0-9 _ and ."},
      {"[materials.a]\ndensty = 1", "9:1",
       "materials.a.densty: unknown key, did you mean 'density'"},
      {"[materials.a]\nfriction = -1", "9:12", "materials.a.friction: expected a number >= 0"},
      {"[camera]\nfov = 0.9", "9:7", "camera.fov: expected a number [deg] in [1, 170], found 0.9"},
      {"[camera]\nfov = 171.0", "9:7",
       "camera.fov: expected a number [deg] in [1, 170], found 171"},
      {"[camera]\neye = [1, 2, 3]\ntarget = [1, 2, 3]", "9:7", "camera.eye: stands where"},
      {"[camera]\nelevation = 91", "9:13", "expected a number [deg] in [-90, 90]"},
      {"[image]\nsize = [15, 100]", "9:9", "expected a number [pixels] in [16, 8192], found 15"},
      {"[image]\nsize = [100, 16385]", "9:14", "found 16385"},
      {"[image]\nsize = [100.5, 100]", "9:8",
       "image.size: expected whole numbers, found 100.5 and 100"},
      {"[image]\nrate = 0", "9:8", "image.rate: expected a number [1/s] in (0, 100000]"},
      {"[image]\nantialias = \"msaa8\"", "9:13",
       "did you mean 'msaa4'? Valid: none, msaa4, ssaa2x2"},
      {"[show]\npaths = true", "9:1", "show.paths: unknown key, did you mean 'path'?"},
      {"[show]\npath = \"yes\"", "9:8", "show.path: expected true or false"},
      {"[show]\nslots = [\"a\"]", "9:9", "show.slots: found 'a'; valid: x, v, R, P, L, ?"},
      {"[sweep]\nvalues = [1]", "8:1", "sweep.parameter: expected a key, for example"},
      {"[sweep]\nparameter = \"world.duration\"", "8:1", "sweep.values: expected a list"},
      {"[sweep]\nparameter = \"world.duration\"\nvalues = []", "10:10", "expected a list of 1 to"},
      {"[[joint]]\na = \"ball\"", "8:1", "joint.0.kind: missing; valid: ball, hinge, slider"},
      {"[[joint]]\nkind = \"hing\"", "9:8", "did you mean 'hinge'? Valid: ball, hinge"},
      {"[[joint]]\nkind = \"ball\"\na = \"bal\"\nanchor = [0, 1, 0]", "10:5",
       "joint.0.a: unknown body 'bal', did you mean 'ball'?"},
      {"[[joint]]\nkind = \"ball\"\na = \"ball\"", "8:1", "joint.0.anchor: missing"},
      {"[[joint]]\nkind = \"ball\"\na = \"ball\"\nb = \"ball\"\nanchor = [0, 1, 0]", "11:5",
       "joint.0.b: both ends are on the same body"},
      {"[[joint]]\nkind = \"hinge\"\na = \"ball\"\nanchor = [0, 1, 0]", "8:1",
       "joint.0.axis: missing"},
      {"[[joint]]\nkind = \"hinge\"\na = \"ball\"\nanchor = [0, 1, 0]\naxis = [0, 0, 1]\nmax = 190",
       "13:7", "joint.0.max: expected a number [degrees] in [-180, 180]"},
      {"[[joint]]\nkind = \"ball\"\na = \"ball\"\nanchor = [0, 1, 0]\nmax = 1", "12:1",
       "joint.0.max: unknown key"},
      {"[[joint]]\nkind = \"distance\"\na = \"ball\"\nanchor = [0, 1, 0]", "8:1",
       "joint.0.anchor_b: missing"},
      {"[[joint]]\nname = \"a-b\"\nkind = \"ball\"\na = \"ball\"\nanchor = [0, 1, 0]", "9:8",
       "joint.0.name: expected letters, digits, _ and dots"},
      {"[wrld]", "8:2", "wrld: unknown key, did you mean 'world'?"},
      {"[[force]]\nforce = [0, 0, 1]", "8:1", "force.0.kind: missing; valid: wind, drag, point"},
      {"[[force]]\nkind = \"wnd\"", "9:8", "did you mean 'wind'? Valid: wind, drag, point, spring"},
      {"[[force]]\nkind = \"wind\"", "8:1", "force.0.force: missing"},
      {"[[force]]\nkind = \"wind\"\nforce = [1, 0, 0]\nbody = \"bal\"", "11:8",
       "force.0.body: unknown body 'bal', did you mean 'ball'?"},
      {"[[force]]\nkind = \"drag\"\nlinear = -1", "10:10",
       "force.0.linear: expected a number [N s/m]"},
      {"[[force]]\nkind = \"point\"\nforce = [1, 0, 0]", "8:1", "force.0.body: missing"},
      {"[[force]]\nkind = \"spring\"\na = \"ball\"\nb = \"ball\"\nstiffness = 1", "11:5",
       "force.0.b: both ends are on the same body"},
      {"[[force]]\nkind = \"spring\"\na = \"ball\"", "8:1", "force.0.stiffness: missing"},
      {"[[force]]\nkind = \"spring\"\nstiffness = 1", "8:1", "force.0.a: missing; name the body"},
      {"[[force]]\nkind = \"field\"", "8:1", "force.0.rate: missing"},
      {"[[force]]\nkind = \"field\"\nrate = 1\naxis = [0, 0, 0]", "11:8",
       "force.0.axis: expected three numbers that are not all zero"},
      {"[force]\nkind = \"wind\"", "8:1", "an array of tables, [[force]], found a table"},
  };
  for (const Wrong& wrong : table) check(kRight + wrong.text + "\n", wrong);
}

TEST_CASE("a wrong array is named by its own name") {
  const std::string head = "[[array]]\nname = \"a\"\n";
  const std::string ball = "body = { shape = { sphere = 0.1 }, mass = 1 }\n";
  const std::string box = "body = { shape = { box = [2, 1, 1] }, mass = 1 }\n";
  const std::vector<Wrong> table = {
      {"[[array]]\nkind = \"row\"\ncount = 1\n" + ball, "8:1", "array.0.name: missing"},
      {head + ball, "8:1", "array.a.kind: missing; valid: row, tower, wall, rain"},
      {head + "kind = \"rowe\"\n", "10:8", "unknown value 'rowe', did you mean 'row'?"},
      {head + "kind = \"row\"\n" + ball, "8:1", "array.a.count: missing"},
      {head + "kind = \"row\"\ncount = 0\n" + ball, "11:9",
       "a whole number from 1 to 100000, found 0"},
      {head + "kind = \"row\"\ncount = 2.5\n" + ball, "11:9", "whole number"},
      {head + "kind = \"row\"\ncount = 100001\n" + ball, "11:9", "found 100001"},
      {head + "kind = \"row\"\ncount = 2\n", "8:1", "array.a.body: expected a template"},
      {head + "kind = \"row\"\ncount = 2\nbase = [0, 0, 0]\n" + ball, "12:1",
       "array.a.base: unknown key"},
      {head + "kind = \"row\"\ncount = 3\nbody = { shape = { sphere = -1 }, mass = 1 }\n", "12:29",
       "array.a.body.shape.sphere: expected a number [m]"},
      {head + "kind = \"row\"\ncount = 3\nbody = { name = \"x\", shape = { sphere = 1 } }\n",
       "12:17", "array.a.body.name: the array itself decides on this"},
      {head + "kind = \"row\"\ncount = 1\nbody = { shape = { plane = [0, 1, 0, 0] } }\n", "12:8",
       "a row is made of bodies, not of planes"},
      {head + "kind = \"tower\"\ncount = 1\nbody = { position = [0, 0, 0] }\n", "12:21",
       "array.a.body.position: the array itself decides on this"},
      {head + "kind = \"tower\"\ncount = 2\nvary = { \"position\" = [[0, 0, 0], [1, 0, 0]] }\n" +
           ball,
       "12:23", "the array itself decides on position"},
      {head + "kind = \"row\"\ncount = 3\nvary = { restitution = [0, 2] }\n" + ball, "12:24",
       "array.a.body.restitution: expected a number in [0, 1], found 2"},
      {head + "kind = \"row\"\ncount = 3\nvary = { restitution = [0] }\n" + ball, "12:24",
       "array.a.vary.restitution: expected [first, last]"},
      {head + "kind = \"row\"\ncount = 3\nvary = { restituton = [0, 1] }\n" + ball, "12:23",
       "array.a.body.restituton: unknown key, did you mean 'restitution'?"},
      {head + "kind = \"row\"\ncount = 3\nvary = { \"a.b.c.d.e.f\" = [0, 1] }\n" + ball, "12:10",
       "no key of a body has so many parts"},
      {head + "kind = \"wall\"\nrows = 2\n" + box, "8:1", "array.a.columns: missing"},
      {head + "kind = \"wall\"\nrows = 2\ncolumns = 2\n" + ball, "13:8", "a wall is made of boxes"},
      {head + "kind = \"wall\"\nrows = 2\ncolumns = 2\nalong = [0, 1, 0]\n" + box, "13:9",
       "expected a level direction"},
      {head + "kind = \"wall\"\nrows = 1000\ncolumns = 1000\n" + box, "11:8",
       "a wall of more than 100000 bricks"},
      {head +
           "kind = \"wall\"\nrows = 2\ncolumns = 2\nvary = { \"shape.box\" = [[1,1,1],[2,2,2]] "
           "}\n" +
           box,
       "14:8", "all bricks of a wall have one size"},
      {head + "kind = \"circle\"\ncount = 3\n" + ball, "8:1", "array.a.radius: missing"},
      {head + "kind = \"circle\"\ncount = 3\nradius = 0\n" + ball, "12:10",
       "array.a.radius: expected a number [m] > 0, found 0"},
      {head + "kind = \"spiral\"\ncount = 3\npitch = 1\n" + ball, "8:1",
       "array.a.spacing: missing"},
      {head + "kind = \"spiral\"\ncount = 3\npitch = -1\nspacing = 1\n" + ball, "12:9",
       "array.a.pitch: expected a number [m] > 0, found -1"},
      {head + "kind = \"spiral\"\ncount = 3\npitch = 1\nspacing = 0.6\n" + ball, "14:8",
       "array.a.body: copy 1 would lie more than half a turn from the one before; give a smaller "
       "spacing, or a larger inner or pitch"},
      {head + "kind = \"rack\"\ncount = 3\nrows = 2\n" + ball, "11:1",
       "array.a.count: unknown key"},
      {head + "kind = \"rack\"\n" + ball, "8:1", "array.a.rows: missing"},
      {head + "kind = \"rack\"\nrows = 2\ngap = -0.1\n" + ball, "12:7",
       "array.a.gap: expected a number [m] >= 0, found -0.1"},
      {head + "kind = \"rack\"\nrows = 2\nalong = [0, 1, 0]\n" + ball, "12:9",
       "array.a.along: expected a level direction"},
      {head + "kind = \"rack\"\nrows = 2\n" + box, "12:8", "array.a.body: a rack is made of balls"},
      {head + "kind = \"rain\"\ncount = 2\nlo = [0, 0, 0]\n" + ball, "8:1", "array.a.hi: missing"},
      {head + "kind = \"rain\"\ncount = 2\nlo = [0, 0, 1]\nhi = [1, 1, 0]\n" + ball, "13:6",
       "expected no coordinate below that of lo"},
      {head + "kind = \"rain\"\ncount = 20\nlo = [0, 0, 0]\nhi = [0.2, 0.2, 0.2]\n" + ball, "14:8",
       "between lo and hi; ask for fewer or for more room"},
      {head + "kind = \"row\"\ncount = 2\n" + ball +
           "[[body]]\nname = \"a.1\"\nshape = { sphere = 1 }\nmass = 1",
       "8:1", "array.a.name: there is a body 'a.1' already"},
      {head + "kind = \"row\"\ncount = 60000\n" + ball +
           "[[array]]\nname = \"b\"\nkind = \"row\"\ncount = 60000\n" + ball,
       "13:1", "more than 100000 bodies"},
  };
  for (const Wrong& wrong : table) check(kRight + wrong.text + "\n", wrong);
}

TEST_CASE("a wrong world, or none, is named") {
  const std::string body = "[[body]]\nshape = { sphere = 1 }\nmass = 1\n";
  const std::vector<Wrong> table = {
      {body, "1:1", "world: missing; a scene needs a [world] table"},
      {"[world]\n", "1:1",
       "body: missing; a scene needs at least one [[body]], [[array]], [[cloth]] or [[soft]]"},
      {"world = 3\n" + body, "1:9", "world: expected a table, found 3"},
      {"[world]\ngravity = -9.81\n" + body, "2:11",
       "world.gravity: expected a list of 3 numbers [m/s²]"},
      {"[world]\nmethod = \"magic\"\n" + body, "2:10",
       "world.method: unknown value 'magic'; valid: auto, course, exact, stepping"},
      {"[world]\nmethod = \"steping\"\n" + body, "2:10", "did you mean 'stepping'?"},
      {"[world]\nmethod = \"rk4\"\n" + body, "2:10",
       "'rk4' is an integrator: set world.method = 'course' and course.integrator = 'rk4'"},
      {"[world]\nimpact = \"bouncy\"\n" + body, "2:10",
       "valid: auto, reflections, crowd, simultaneous, sequential, poisson"},
      {"[world]\nduration = 0\n" + body, "2:12",
       "world.duration: expected a number [s] in (0, 1e+06]"},
      {"[world]\nduration = 1e7\n" + body, "2:12", "found 1e+07"},
      {"[world]\nduration = \"long\"\n" + body, "2:12", "found the string 'long'"},
      {"[world]\nseed = -1\n" + body, "2:8", "world.seed: expected a whole number >= 0, found -1"},
      {"[world]\nseed = 1.5\n" + body, "2:8",
       "world.seed: expected a whole number >= 0, found 1.5"},
      {"title = 3\n[world]\n" + body, "1:9", "title: expected a string in quotes, found 3"},
      {"checks = \"a\"\n[world]\n" + body, "1:10", "checks: expected a list of strings"},
      {"[world]\nduration = \n", "2:12", "not valid TOML"},
      {"[world]\n[world]\n", "2:1", "cannot redefine existing table"},
      {"[world\n", "1:7", "not valid TOML"},
      {"[[[world]]]\n", "1:3", "not valid TOML"},
      {"[world]\nduration = 1é\n", "2:13", "not valid TOML"},
      {"[world]\né = 1\n", "2:1", "not valid TOML"},
      {"a" + std::string(40, '.') + "b = 1\n", "1:33", "a key of more than 32 parts"},
  };
  for (const Wrong& wrong : table) check(wrong.text, wrong);
}

// What is no table lacks its keys, too, and what is no string says nothing.
TEST_CASE("a value of a wrong kind is one mistake, told once") {
  const std::string wrong = GENERATE(
      "[camera]\nkeys = [1]", "[[text]]\npoint = [0, 0, 0]\ntext = 1",
      "[[expect]]\nequals = 1.0\nvalue = []", "[[graph]]\ncurves = [{ label = \"a\" }]\nbody = 1",
      "[[graph]]\nbody = \"ball\"\ncurves = 1");
  CAPTURE(wrong);
  const std::string text =
      "[world]\n[[body]]\nname = \"ball\"\nshape = { sphere = 0.1 }\n"
      "mass = 1.0\n" +
      wrong + "\n";
  try {
    parseScene(text, "scene");
    FAIL("it is not refused");
  } catch (const SceneError& error) {
    CHECK(error.diagnostics().size() == 1);
  }
}

TEST_CASE("all mistakes of a file are told together in the order of their places") {
  const std::vector<Diagnostic> found = complaints(
      "[world]\n"
      "gravty = [0, 0, 0]\n"
      "[[body]]\n"
      "mass = -1\n"
      "shape = { sphere = 0 }\n"
      "[camera]\n"
      "fov = 0\n"
      "[materials.a]\n"
      "density = 0\n");
  std::vector<int> lines;
  for (const Diagnostic& diagnostic : found) lines.push_back(diagnostic.place.line);
  CHECK(lines == std::vector<int>{2, 4, 5, 7, 9});
}

TEST_CASE("a file with mistakes without end is left after a hundred") {
  std::string text = "[world]\n";
  for (int i = 0; i < 1000; ++i) text += "[[body]]\n";
  CHECK(complaints(text).size() == 100);
}

TEST_CASE("a column counts letters, not bytes") {
  check("checks = [\"é\", 7]\n" + kRight, {"", "1:16", "expected a string in quotes, found 7"});
}

TEST_CASE("a refusal by the world points at the key, or at the nearest thing above it") {
  const Scene scene = parseScene(kRight + "[course]\nstep = 0.01\n", "s.toml");
  const auto placed = [&scene](const std::string& where) {
    return format(locate(scene, Refusal(where, "no")));
  };
  CHECK(placed("bodies[0].shape") == "s.toml:6:9: error: no");
  CHECK(placed("bodies[0].mass") == "s.toml:4:1: error: no");
  CHECK(placed("bodies[0]") == "s.toml:4:1: error: no");
  CHECK(placed("course.step") == "s.toml:9:8: error: no");
  CHECK(placed("course.plan") == "s.toml:8:1: error: no");
  CHECK(placed("gravity") == "s.toml: error: no");

  const Scene changed = parseScene(kRight, "s.toml", {"body.ball.mass=2", "world.gravity=[0,0,0]"});
  CHECK(format(locate(changed, Refusal("bodies[0].mass", "no"))) ==
        "--set body.ball.mass=2: error: no");
  CHECK(format(locate(changed, Refusal("gravity", "no"))) ==
        "--set world.gravity=[0,0,0]: error: no");
}
