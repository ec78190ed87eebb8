// A picture as plain data: what stands where, in which colour, seen from where.
// World units are metres, Y up; sizes in pixels are for an image 720 px high and scale with it.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <array>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace tumble {

/// sRGB in [0, 1].
using Colour = std::array<float, 3>;

/// The surface of a solid as triangles, in its own frame [m], counter-clockwise from outside.
struct Facets {
  struct Corner {
    Eigen::Vector3f position, normal;
    /// Distance [m] to the three edges of its triangle, as far as they are to be drawn; else large.
    Eigen::Vector3f toEdge;
  };
  std::vector<Corner> corners;  ///< three a triangle
  double reach = 0.0;           ///< [m] of the farthest corner from the origin
  double thickness = 0.0;       ///< [m] half of the shortest edge of the box around it
};

enum class Form { Box, Sphere, Cylinder, Ellipsoid, Facets };
enum class Finish { Solid, Ghost, Glass };

/// One drawn body.
struct Instance {
  Form form = Form::Box;
  Eigen::Vector3d position = Eigen::Vector3d::Zero();
  Eigen::Quaterniond orientation = Eigen::Quaterniond::Identity();
  Eigen::Vector3d scale =
      Eigen::Vector3d::Ones();  ///< half extents: box edges/2; (r, r, r); (r, h/2, r); semi-axes
  Colour colour = {0.23f, 0.44f, 0.66f};
  std::optional<Colour> back = {};  ///< of the half with z < 0 in the body frame; none: as in front
  bool banded = true;               ///< a ball or cylinder gets a band that its spin can be seen by
  float alpha = 1.0f;               ///< of a ghost
  /// What has a higher layer hides ghosts of lower ones wherever it stands; within a layer the
  /// nearer hides.
  int layer = 0;
  Finish finish = Finish::Solid;
  std::shared_ptr<const Facets> facets =
      nullptr;  ///< of Form::Facets, drawn `scale` times as large
};

/// Lowest point of a body [m], world.
double lowestPoint(const Instance& instance);

/// Radius of a ball about the body's position that holds it [m].
double reachOf(const Instance& instance);

/// The box around a ball [m].
Eigen::AlignedBox3d boxAround(const Eigen::Vector3d& centre, double radius);

/// Half the shortest edge of the box around a body [m].
double thicknessOf(const Instance& instance);

struct Picture;

/// How high [m] the shadow of contact reaches on a floor: half the mean least half extent of the
/// bodies, within limits that keep it visible and local.
double contactReach(const Picture& picture);

enum class Stroke { Solid, Dotted };

/// A line through world points; the hidden part is drawn fainter.
struct Polyline {
  std::vector<Eigen::Vector3d> points;
  Colour colour = {0.17f, 0.18f, 0.21f};
  float width = 1.8f;  ///< [px]
  Stroke stroke = Stroke::Solid;
};

/// An arrow from base to tip in the world, its thickness in pixels.
struct Arrow {
  Eigen::Vector3d base = Eigen::Vector3d::Zero(), tip = Eigen::Vector3d::UnitY();
  Colour colour = {0.835f, 0.251f, 0.102f};
  float radius = 1.9f;  ///< [px] of the shaft
};

/// A ring of fixed pixel size at a world point, with lines of text under it on a short leader.
struct Mark {
  Eigen::Vector3d position = Eigen::Vector3d::Zero();
  std::vector<std::string> lines;
  Colour colour = {0.835f, 0.251f, 0.102f};
};

enum class Align { Left, Centre, Right };

/// Text at a world point plus a pixel offset, or, without a point, at a pixel of the 720-high page.
struct Label {
  std::optional<Eigen::Vector3d> anchor;
  Eigen::Vector2d offset = Eigen::Vector2d::Zero();  ///< [px] x right, y down
  std::string text;                                  ///< UTF-8
  float size = 14.0f;                                ///< [px]
  bool bold = false;
  Align align = Align::Left;
  Colour colour = {0.17f, 0.18f, 0.21f};
  bool italic = false;
  bool apart = false;  ///< keeps off arrows and bodies, as all labels do off each other
  bool clear = false;  ///< keeps off arrows, but not off bodies
  /// Centre [m] of the body that it names: one that is hidden, or that it finds no room by, goes
  /// without it, and words say how many do.
  std::optional<Eigen::Vector3d> names = {};
};

/// A bar on the page with text behind it, and a leader from a world point: a row of a ladder. It
/// has no head, for what it measures may point anywhere.
struct PageBar {
  std::optional<Eigen::Vector3d> leader;           ///< world point the row belongs to
  Eigen::Vector2d base = Eigen::Vector2d::Zero();  ///< [px]
  double length = 0.0;                             ///< [px] to the right
  std::string text;
  Colour colour = {0.835f, 0.251f, 0.102f};
};

enum class Flat { Line, Rectangle, Disc };

/// A flat shape on the page, below bars and text.
struct PageShape {
  Flat form = Flat::Line;
  Eigen::Vector2d from = Eigen::Vector2d::Zero();  ///< [px] end, corner, or centre
  Eigen::Vector2d to = Eigen::Vector2d::Zero();    ///< [px] other end, or opposite corner
  double width = 1.0;                              ///< [px] of a line; diameter of a disc
  Colour colour = {0.17f, 0.18f, 0.21f};
};

/// Linear colour scale with ticks, at the lower right.
struct ColourBar {
  std::string caption;        ///< "time / s"
  std::vector<Colour> stops;  ///< evenly spaced
  double from = 0.0, to = 1.0;
  std::vector<double> ticks;
};

struct Camera {
  Eigen::Vector3d eye = {0.0, 2.0, 8.0}, target = {0.0, 1.0, 0.0};
  double fov = 24.0;  ///< [deg] vertical
  /// [deg] of one that looks straight up or down: at 0 its right is +X, at 90 −Z
  double azimuth = 0.0;
};

/// The floor y = height, drawn as a disc that fades into the page, with grid and rule.
struct Floor {
  bool visible = true;
  double height = 0.0;                ///< [m]
  double grid = 1.0, fineGrid = 0.2;  ///< [m]
  bool rule = true;                   ///< a measured line with numbers in front of the motion
  Eigen::AlignedBox3d motion = {};    ///< [m] that the rule measures; empty: the bodies
  std::vector<Eigen::AlignedBox3d> ways = {};  ///< [m] of each body in it
  /// Where something is written in some image of the run, for the rule to make room in all of them.
  std::vector<Label> labels = {};
  std::vector<Mark> marks = {};
};

/// A line of words below the title.
struct Remark {
  std::string text;
  Colour colour = {0.36f, 0.39f, 0.44f};
};

struct Picture {
  Camera camera;
  std::vector<Instance> instances;
  std::vector<Polyline> lines;
  std::vector<Arrow> arrows;
  std::vector<Mark> marks;
  std::vector<Label> labels;
  std::vector<PageShape> pageShapes;
  std::vector<PageBar> pageBars;
  std::optional<ColourBar> bar;
  Floor floor;
  Eigen::Vector3d centre =
      Eigen::Vector3d::Zero();  ///< [m] of what is to be lit, shadowed and framed
  double radius = 3.0;          ///< [m] about the centre
  std::string title, subtitle;
  std::vector<Remark> remarks = {};  ///< below these, smaller
};

}  // namespace tumble
