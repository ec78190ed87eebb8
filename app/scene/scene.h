// A scene as plain data: what the TOML file says, checked, with every default filled in.
#pragma once

#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "app/scene/variant.h"
#include "sim/method/model.h"

namespace tumble {

using Rgb = std::array<double, 3>;  ///< sRGB in [0, 1]

/// A place in a text file; line and column count from 1, 0 = unknown.
struct Place {
  std::string file;
  int line = 0, column = 0;
};

/// A text for pictures, as it was written. The fonts may lack some of its letters.
struct Wording {
  Place place;
  std::string key, text;
};

/// One complaint: where, what was expected, what to do.
struct Diagnostic {
  Place place;
  std::string message;
};

/// "file:line:column: error: message"
std::string format(const Diagnostic& diagnostic);

/// A scene that is refused, with all its complaints, first first.
class SceneError : public std::runtime_error {
 public:
  explicit SceneError(std::vector<Diagnostic> diagnostics);
  const std::vector<Diagnostic>& diagnostics() const { return diagnostics_; }

 private:
  std::vector<Diagnostic> diagnostics_;
};

/// Where a camera is at an instant.
struct CameraKey {
  double at = 0.0;                        ///< [s]
  Vec3 eye = Vec3::Zero(), target = eye;  ///< [m]
  double fov = 24.0;                      ///< [deg] vertical
};

struct CameraView {
  std::string name = "";             ///< of one of several
  std::string follow = "";           ///< a body that stays where it is on the image, or ""
  std::optional<Vec3> eye, target;   ///< [m]; without them the camera frames the whole motion
  double fov = 24.0;                 ///< [deg] vertical
  double azimuth = 20.0;             ///< [deg] of the eye about the vertical; 0 looks along −Z
  double elevation = 12.0;           ///< [deg] of the eye above the horizon
  bool ahead = false;                ///< images hold what is still to come, not the whole motion
  std::vector<CameraKey> keys = {};  ///< that it goes through, in the order of time, or none
};

/// A [[text]]: words on the pictures, beside a body, at a point or on the page.
struct TextDef {
  std::string text;
  std::string body;                                  ///< that it goes with, or ""
  std::optional<Vec3> point;                         ///< [m] or, without it and a body,
  std::array<double, 2> page = {32.0, 690.0};        ///< [px] of a page 720 high
  std::optional<std::array<double, 2>> offset = {};  ///< [px] from the body's centre or the point
  double size = 16.0;                                ///< [px]
  bool bold = false;
  double from = 0.0, until = 1e6;  ///< [s] when it is seen
  std::optional<Rgb> colour = {};
};

struct ImageFormat {
  int width = 1280, height = 720;
  double rate = 60.0;              ///< [1/s] samples and images
  std::string antialias = "";      ///< none | msaa4 | ssaa2x2, or "" as the quality has it
  std::string quality = "normal";  ///< low | normal | high
  bool transparent = false;        ///< nothing behind what is drawn
  std::optional<double> still;     ///< [s] the instant worth a picture of its own
};

/// Whether a recording at that rate [1/s] has a sample at the instant [s].
inline bool isSample(double t, double rate) {
  return std::abs(t * rate - std::round(t * rate)) <= 1e-6;
}

/// What is drawn besides the bodies.
struct ShowFlags {
  bool floor = true, ruler = true, title = true;  ///< what frames the bodies
  bool path = false;                              ///< path of each centre of mass
  bool theory = true;  ///< the curves that the scene's checks expect, dotted
  bool contact_forces = false;
  bool ladder = true;         ///< beside contact forces, bars of what each level carries
  bool matrix = false;        ///< the matrix A of the contact problem, a colour each number
  bool either_or = false;     ///< force against acceleration of each contact, on the page
  bool joint_forces = false;  ///< arrows of what joints exert, with numbers
  double force_scale = 0.0;   ///< [m/N] of arrows of contacts and joints; 0: as the run has them
  bool normals = false;
  bool velocities = false;
  bool forces = false;     ///< arrows of wind and point forces
  bool impacts = false;    ///< rings at impacts with t and j
  bool labels = false;     ///< names of bodies
  bool boxes = false;      ///< bounding boxes
  int tree = -1;           ///< level of the tree of boxes over faces or parts; 0: root; < 0: none
  bool samples = false;    ///< the points inside that bodies are weighed by
  bool planes = false;     ///< planes between bodies near each other
  bool energy = false;     ///< energy in the subtitle
  bool glass = false;      ///< see-through bodies
  bool ellipsoid = false;  ///< the solid ellipsoid that weighs and turns like each body
  bool polhode = false;    ///< Poinsot's ellipsoid with the way of the angular velocity on it
  bool body_box = false;   ///< bounding boxes that turn with the bodies
  bool speed = false;      ///< bodies coloured by their speed
  bool strain = false;     ///< what bends coloured by its strain
  bool momenta = false;    ///< arrows of linear and angular momentum and angular velocity
  bool missteps = false;   ///< poses that the plan of the course did not let stand, in red
  bool motion = false;     ///< named arrows x, v and F of bodies
  bool field = false;      ///< arrows of a circular field's derivative about the body in it
  bool axes = false;       ///< axes of the world, and of bodies as they turn
  bool tensors = false;    ///< inertia tensors of the first body, in its frame and in the world's
  bool centres = false;  ///< a cross at each centre of mass, with r to the points it is weighed by
  bool resultant = false;           ///< with forces: their names, their sum and its torque
  bool contact_velocities = false;  ///< named arrows of n and of the point velocity at contacts
  bool impulses = false;            ///< arrows j n at impacts, and velocities before and after
  bool springs = false;             ///< coils where springs of the contact model push
  double gel = 0.0;                 ///< [m] of a see-through slab drawn in place of the floor
  std::string diagram;              ///< state | solver | flow, on the page below, or ""
  std::vector<std::string> slots;   ///< what the diagram of the state knows of it: "x", "?", …
  double strobe = 0.1;              ///< [s] between ghosts of a strobe image
};

enum class Relation { Equal, AtMost, AtLeast };

/// An [[expect]]: what a formula over quantities of the run comes to.
struct ExpectDef {
  std::string label, value;  ///< text for people, or ""; the formula
  std::optional<double> at;  ///< [s] measured then; else over what `over` says
  std::string over = "end";  ///< start | end | max | min
  Relation relation = Relation::Equal;
  double target = 0.0, within = 0.0;  ///< what it comes to, and what it may be off
  std::string aim;                    ///< a formula of what it comes to, in place of target, or ""
};

/// Points that something bends joins, and the surface that they are drawn by in place of balls.
struct BentDef {
  std::string name;
  int first = 0, count = 0;                        ///< bodies
  std::vector<std::array<int, 3>> triangles = {};  ///< points, counter-clockwise from the front
  int columns = 0;              ///< points of a row, if they are a grid: a cloth's; else 0
  std::vector<int> sides = {};  ///< per triangle: each is shaded smoothly on its own; none: one
  double thickness = 0.0;       ///< [m] of a cloth, which has two faces
  double skin = 0.0;            ///< [m] that the surface of a solid is off its points
  int strand = 0;               ///< points of each strand of fur, drawn as thick as `thickness`
  std::optional<Rgb> colour = {}, back = {};
};

struct Scene {
  std::string name;  ///< file name without folder and ending
  std::string file;  ///< path it was read from
  std::string line;  ///< "name key=value …": what made it, for the PNG text chunk
  std::vector<std::string> overrides;  ///< "key.path=value" that it was read with
  std::string title, subtitle, chapter, claim;
  std::vector<std::string> checks;
  std::vector<std::string> slides;  ///< of the lectures that its strobe and still show
  WorldDef world;
  std::uint64_t seed = 42;
  std::vector<std::optional<Rgb>> colours;  ///< per body; empty = by palette
  std::vector<std::optional<Rgb>> backs;    ///< per body; of the half with z < 0 in its frame
  std::vector<std::string> labels;          ///< per body; text drawn beside it, or ""
  std::vector<BentDef> bent;                ///< cloths, soft bodies and furs
  CameraView camera;                        ///< the first of `cameras`, unless another is chosen
  std::vector<CameraView> cameras;          ///< as the scene names them; none: the default one
  std::vector<ExpectDef> expects;
  std::vector<TextDef> texts;
  ImageFormat image;
  ShowFlags show;
  std::optional<Sweep> sweep;
  std::vector<PanelDef> panels;
  std::vector<GraphDef> graphs;
  std::vector<ChartDef> charts;
  std::vector<Wording> wordings;  ///< texts of pictures with letters beyond ASCII
  std::map<std::string, double>
      numbers;  ///< of the text, by key; kept where formulas may read them
  std::map<std::string, Place>
      places;  ///< path into the world ("bodies[3].mass") → where it was written
};

/// Reads a scene from a file. Overrides are "key.path=value" with a TOML value; a value that is not
/// TOML is taken as a string. Arrays of tables are addressed by name or number: "body.brick.mass".
/// A variant is put on top; it has no panels, charts or sweep of its own.
/// @throws SceneError with every complaint of the file; FileError if there is none to read.
Scene readScene(const std::string& path, const std::vector<std::string>& overrides = {},
                const Variant* variant = nullptr);

/// The same from text, for tests; `file` is the name that complaints use.
Scene parseScene(const std::string& text, const std::string& file,
                 const std::vector<std::string>& overrides = {}, const Variant* variant = nullptr);

/// A complaint about the world itself, placed where the scene says it was written.
Diagnostic locate(const Scene& scene, const Refusal& refusal);

}  // namespace tumble
