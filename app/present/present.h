// Recording + Scene → Picture: what is drawn of a run, and from where.
#pragma once

#include <vector>

#include "app/claim/claim.h"
#include "app/record/recording.h"
#include "render/camera.h"
#include "render/picture.h"

namespace tumble {

/// Draws one recording; all its pictures share camera, colours and the scale of the arrows.
/// The scene and the recording must outlive it.
class Presenter {
 public:
  /// @param recording with at least one sample
  Presenter(const Scene& scene, const Recording& recording);

  int count() const;  ///< images of the sequence: one for each sample

  /// The picture of sample k in [0, count()).
  Picture image(int k) const;
  /// The picture of the sample nearest to t [s].
  Picture still(double t) const;
  /// The whole motion: ghosts every show.strobe seconds, paler the longer ago, and the last pose.
  Picture strobe() const;

 private:
  Picture blank() const;
  void addBodies(const Sample& sample, Picture& picture) const;
  void addGhosts(Picture& picture) const;
  void addPaths(std::size_t last, Picture& picture) const;
  void addTheory(Picture& picture) const;
  void addLabels(const Sample& sample, Picture& picture) const;
  void addAnnotations(const Sample& sample, Picture& picture) const;

  const Scene& scene_;
  const Recording& recording_;
  std::vector<Colour> colours_;
  std::vector<Curve> theory_;
  Camera camera_;
  Eigen::Vector3d centre_;
  double radius_ = 1.0;
};

}  // namespace tumble
