// A scene with some keys changed: what panels, points of a chart and values of a sweep have in
// common.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "app/scene/node.h"

namespace tumble {

/// A key and its value, "key.path=value" as behind --set, and where they were written.
struct Setting {
  std::string text;
  Spot spot;
};

/// The scene of the same file with settings changed and, if bodies are named, only these alive.
struct Variant {
  std::string title;
  std::vector<Setting> set;         ///< in this order, after every --set
  std::vector<std::string> bodies;  ///< names of [[body]], [[array]], [[cloth]] …; none: all live
};

/// What the inner variant says on top of the outer one.
Variant joined(const Variant& outer, const Variant& inner);

/// One run for each value of a key.
struct Sweep {
  std::string parameter;            ///< key path, as for --set
  std::vector<std::string> values;  ///< TOML values as text
  Spot spot;                        ///< of the parameter
  Setting setting(std::size_t k) const { return {parameter + "=" + values[k], spot}; }
};

/// A [[panel]]: one picture of a page.
struct PanelDef {
  Variant variant;
  std::string subtitle;             ///< one line below its title
  std::string picture = "strobe";   ///< strobe | still | state
  double at = 0.0;                  ///< [s] of a still
  std::vector<std::string> slides;  ///< of the lectures that it shows
  Spot spot;
};

/// One curve of a chart: a variant for each value of a key.
struct CurveDef {
  Variant variant;
  Sweep along;  ///< the chart's key and values, or its own
};

/// A [[chart]]: the error of a check against the cost of the run, for each value of a key.
struct ChartDef {
  Variant variant;  ///< of all its runs
  std::string subtitle;
  std::string error;  ///< name of a check: the largest error of its rows is drawn
  std::string row;    ///< only of rows that have this in their label
  Sweep along;
  std::string cost = "evaluations";  ///< evaluations | cpu | value, of the key itself
  std::optional<double> floor;       ///< the error that rounding leaves
  std::vector<std::string> slides;   ///< of the lectures that it shows
  std::vector<CurveDef> curves;
};

/// One curve of a graph.
struct GraphCurve {
  Variant variant;
  std::string value;  ///< a formula over quantities of the run, or ""
};

/// A [[graph]]: what one body does, or what formulas come to, against time, in variants of the
/// scene.
struct GraphDef {
  Variant variant;  ///< of all its runs
  std::string subtitle;
  std::string body;  ///< its name; of planes and formulas none
  /// height | velocity | force | joint | energy | planes | pairs | holds | values
  std::string shows = "height";
  std::string axis;             ///< caption of the upright axis of values
  std::string against, across;  ///< of values: a formula that is no time, and its caption; or ""
  std::vector<std::string> slides;  ///< of the lectures that it shows
  std::vector<GraphCurve> curves;
};

}  // namespace tumble
