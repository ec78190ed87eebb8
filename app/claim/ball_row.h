// Balls on a straight line that meet head-on: their velocities in one dimension, by every impact
// law, without the contact problems of the simulator.
#pragma once

#include <string>
#include <vector>

namespace tumble {

/// Balls from left to right. Contact k lies between ball k and ball k + 1.
struct BallRow {
  std::vector<double> m;    ///< [kg] per ball
  std::vector<double> u;    ///< [m/s] per ball, to the right
  std::vector<double> x;    ///< [m] per ball: how far it has come
  std::vector<double> gap;  ///< [m] per contact, ≥ 0; touching below kTouching
  std::vector<double> e;    ///< restitution per contact
  std::string law;          ///< of impact
  bool ended = true;        ///< false once a law came to no end here

  /// Moves and hits until `t` [s] later.
  void advance(double t);

  /// The impact law at the contacts that touch, until none of them approaches:
  ///   sequential     u⁺ of two balls alone, the fastest approach first
  ///   reflections    Newton's law at the contacts that approach, again and again
  ///   simultaneous   Newton's law at all that touch and do not separate
  ///   poisson        common velocities, j; then e j back; then what still approaches stays
  ///   together
  void hit();

 private:
  bool approaches() const;
  void hitTwo();
  void compress(const std::vector<char>& takesPart, const std::vector<double>& rebound,
                std::vector<double>& j);
  void poisson();
};

}  // namespace tumble
