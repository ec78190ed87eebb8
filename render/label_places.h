// Where labels stand so that none covers another.
#pragma once

#include <Eigen/Geometry>
#include <optional>
#include <vector>

#include "render/silhouette.h"

namespace tumble {

/// Hands out free places on the page, label by label.
class LabelPlaces {
 public:
  explicit LabelPlaces(const Eigen::Vector2d& page) : page_(page) {}

  /// A place that is given away already.
  void take(const Eigen::AlignedBox2d& ink) { taken_.push_back(ink); }

  /// A place where only labels that keep apart do not stand.
  void cross(const Eigen::AlignedBox2d& ink) { crossed_.push_back(ink); }

  /// A body, on which only labels that keep apart do not stand. What takes a large part of the
  /// page is ground, which they may stand on, but not across its outline: its own name never.
  void cover(const Silhouette& body);

  /// What a label covers: a line of text, and how far others go on below it [px].
  struct Extent {
    double width, below;
    Extent(double wide, double further = 0.0) : width(wide), below(further) {}
  };

  struct Standing {
    Eigen::Vector2d pen;  ///< [px] of the text
    /// Where a line from the anchor meets a label that had to go further away from it.
    std::optional<Eigen::Vector2d> leader = {};
  };
  /// The place of a label next to its anchor: where it wants to be, else up or down by whole lines,
  /// else on a ring about the anchor, the nearest that is free; what keeps apart looks for such a
  /// place off bodies near by first, and a name for one on its body. Where all is taken it stands
  /// where it wants to; a name does not stand.
  /// @param anchor  [px], from which label.offset counts
  /// @param text    [px] that it covers
  std::optional<Standing> place(const Label& label, const Eigen::Vector2d& anchor,
                                const Extent& text);

 private:
  using Box = Eigen::AlignedBox2d;
  /// What a label has to keep off.
  enum class Off { Texts, Arrows, Bodies, Outlines };
  bool isFree(const Box& ink, Off off) const;
  std::optional<Standing> apart(const Label& label, const Eigen::Vector2d& anchor,
                                const Extent& text);
  std::optional<Standing> beside(const Label& label, const Eigen::Vector2d& anchor,
                                 const Extent& text, Off off);
  std::optional<Standing> onBody(const Label& label, const Silhouette& body, const Extent& text);
  std::optional<Standing> onRings(const Label& label, const Eigen::Vector2d& anchor,
                                  const Extent& text, Off off);
  /// The body among those that the label names.
  static const Silhouette* own(const Label& label, const std::vector<Silhouette>& bodies);
  bool isHidden(const Silhouette& body) const;

  Eigen::Vector2d page_;
  std::vector<Box> taken_, crossed_;
  std::vector<Silhouette> bodies_, grounds_;
};

/// What the ink of a line of text covers, about [px].
/// @param text  [px] width of the first line, and how far others go on below it
Eigen::AlignedBox2d inkOf(const Eigen::Vector2d& pen, const LabelPlaces::Extent& text, double size,
                          Align align);

}  // namespace tumble
