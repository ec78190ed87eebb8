// What `exact` remembers: how every body flies, what is to happen next, and how contacts last.
#pragma once

#include <vector>

#include "sim/contact/contact.h"
#include "sim/flight/flight.h"
#include "sim/flight/top.h"
#include "sim/method/exact/pace.h"
#include "sim/method/report.h"
#include "sim/shape/outline.h"

namespace tumble {

struct ExactMemory {
  /// Per body: its flights, each from the end of the one before; the last has no end yet.
  std::vector<std::vector<Flight>> flights;
  std::vector<HeavyTop> tops;  ///< in place of the flights of bodies with pivots, as Model::pivots
  std::vector<std::vector<Convex>> parts;  ///< per body: what others can touch
  std::vector<Vec3> bookedX, bookedP;      ///< [m], [kg m/s] per body: x and P at `booked`
  std::vector<Vec3> outer;                 ///< [N] per body: constant force, gravity included
  double lookedAt = 0.0;                   ///< [s] end of the advance before this one

  /// One stretch of time that is looked through at once, in a frame that may drift and fall.
  struct Window {
    double t0 = 0.0, t1 = 0.0;        ///< [s]
    double length = 0.0;              ///< [s] what the last one was made for
    Vec3 drift = Vec3::Zero();        ///< [m/s] of the frame at t0
    Vec3 fall = Vec3::Zero();         ///< [m/s²] of the frame
    std::vector<int> finite, planes;  ///< bodies that can touch something
    std::vector<Aabb> swept;          ///< per body of the model: what it can reach until t1
    long renewals = 0;                ///< flights begun inside
  };
  Window window;

  /// Two bodies that will touch unless one of them changes its flight before.
  struct Touch {
    double t = 0.0;  ///< [s]
    int a = 0, b = 0;
    long flightA = 0, flightB = 0;  ///< which flights of theirs this was found for
  };
  std::vector<Touch> queue;       ///< a heap, the earliest first
  std::vector<long> flightCount;  ///< per body
  int stalled = 0;                ///< events in a row that moved time by nothing

  /// The contacts that last from an instant on, with their forces.
  struct Hold {
    double t = 0.0;
    std::vector<Contact> contacts;
  };
  std::vector<Hold> holds;
  std::vector<Event> closing;  ///< rests whose last bounces are under way
  double booked = 0.0;         ///< [s] up to which the books are kept,
  double bookedHold = 0.0;     ///< [s] and what lasting contacts did

  // Of contacts that last while their forces change.
  bool sustained = false;   ///< bodies go on through such a stretch
  bool settled = false;     ///< or stand as it left them: their flights are to begin
  bool modesKnown = false;  ///< which contact sticks, slides or idles
  bool jammed = false;      ///< forces grow beyond all bounds
  bool lawless = false;     ///< no forces were found that obey the laws of contact
  int stretchesLeft = 0;    ///< until closed forms are tried again,
  int patience = 0;         ///< and how many the next time
  Pace pace;                ///< of its events
};

}  // namespace tumble
