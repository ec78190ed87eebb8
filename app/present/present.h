// Recording + Scene → Picture: what is drawn of a run, and from where.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "app/claim/claim.h"
#include "app/claim/expect.h"
#include "app/present/arrows.h"
#include "app/present/framing.h"
#include "app/record/recording.h"
#include "render/picture.h"

namespace tumble {

/// Draws one recording; all its pictures share camera, colours and the scale of the arrows.
/// The scene and the recording must outlive it.
class Presenter {
 public:
  /// @param recording with at least one sample
  Presenter(const Scene& scene, const Recording& recording);
  /// The same, framed like others beside it.
  Presenter(const Scene& scene, const Recording& recording, const Framing& framing);

  int count() const;  ///< images of the sequence: one for each sample

  /// The picture of sample k in [0, count()).
  Picture image(int k) const;
  int sampleAt(double t) const;  ///< the sample nearest to t [s]
  /// The picture of that sample.
  Picture still(double t) const;
  /// The whole motion: ghosts every show.strobe seconds, paler the longer ago, and the last pose.
  Picture strobe() const;
  /// The bodies of sample k alone, from where image k is seen.
  Picture bodiesAlone(int k) const;
  /// A body of the scene as a sample has it, whether pictures show it or not.
  Instance body(const Sample& sample, std::size_t number) const;

 private:
  Picture blank(const Framing& framing) const;
  void measureWays();
  void gatherWords();
  void follow();
  Framing framingAt(int k) const;
  std::vector<std::size_t> ghosts() const;
  bool standsStill(std::size_t body) const;
  void addExpectations(Picture& picture) const;
  void addSpike(Picture& picture) const;
  Polyline expectedLine(const Expectation& one) const;
  void finish(Picture& picture) const;
  std::shared_ptr<const Facets> surfaceOf(std::size_t i, const BodySample& body) const;
  void addBodies(const Sample& sample, bool byTime, int layer, Picture& picture) const;
  void addGhosts(bool byTime, Picture& picture) const;
  Colour colourOf(const Sample& sample, std::size_t i) const;
  void addTheory(Picture& picture) const;
  void addAnnotations(const Sample& sample, Picture& picture) const;
  void addLessons(const Sample& sample, Picture& picture) const;

  const Scene& scene_;
  const Recording& recording_;
  std::vector<Colour> colours_;
  std::vector<bool> turns_;      ///< per body: in the run, at all
  std::vector<bool> inSurface_;  ///< per body: drawn as part of a surface that bends
  std::vector<std::shared_ptr<const Facets>> facets_;  // per body; null for simple shapes
  std::vector<Curve> theory_;
  std::vector<Expectation> expectations_;
  Framing framing_;
  std::vector<Eigen::AlignedBox3d> ways_;  ///< [m] per body: where it comes in the run
  Eigen::AlignedBox3d extent_;             ///< [m] of all that are drawn
  Picture words_;                          ///< labels and marks of its start, middle and end
  std::optional<int> followed_;            ///< the body that stays where it is on the image
  Framing following_;                      ///< of it at the start
  std::vector<Camera> ahead_;              ///< per sample, if they hold what is to come
  double strained_ = 0.0;  ///< of the last colour, if what bends is coloured by strain
  double fastest_ = 1.0;   ///< [m/s] speed of the last colour, if bodies are coloured by speed
  ArrowScale arrows_;
};

/// What the dotted lines of a picture are, if it has any and the words with it do not say so of
/// dots; else "".
std::string legendOf(const Picture& picture, const std::string& words);

/// Takes off what is too small to read, or said by the page, when a picture becomes a panel of a
/// sheet.
void stripForPanel(Picture& picture);

}  // namespace tumble
