// A run that goes on from what the window shows, while its settings change and a hand pulls.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "app/scene/scene.h"
#include "sim/world.h"

namespace tumble {

/// What a hand does: it pulls a point of a body to a point of the world.
struct Hand {
  int body = 0;
  Vec3 point_B = Vec3::Zero();  ///< [m] body frame
  Vec3 target = Vec3::Zero();   ///< [m] world frame
};

/// A scene without an end. Each change makes a world anew from the sample before it, so what is
/// shown hangs on that sample, the settings and the hand alone.
class Live {
 public:
  /// @param rate  [1/s] of samples
  Live(const Scene& scene, double rate);

  /// What the next sample is made by.
  const WorldDef& settings() const { return settings_; }
  void change(WorldDef settings);

  /// Pulls by a spring and damper of kHertz for all that joints hold together; a point of what
  /// bends it leads, no faster than kFastest. Without a hand it lets go.
  void hold(const std::optional<Hand>& hand);
  const std::optional<Hand>& hand() const { return hand_; }

  /// The next sample is to follow another one than that of the call before.
  void leave() { world_.reset(); }

  /// The sample after this one; none if the world refuses or stops.
  std::optional<Sample> next(const Sample& last);
  /// Why there was none, or "".
  const std::string& complaint() const { return complaint_; }

 private:
  bool leads() const;
  WorldDef inHand(const Sample& last) const;

  WorldDef settings_;
  std::vector<double> pulled_;  ///< [kg] per body: what joints hold together with it
  std::vector<bool> bends_;     ///< per body: a point of what bends
  double rate_;
  std::optional<Hand> hand_;
  std::optional<World> world_;
  double start_ = 0.0;  ///< [s] when world_ began
  int made_ = 0;        ///< samples of world_
  std::string complaint_;
};

}  // namespace tumble
