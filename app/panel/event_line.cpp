#include "app/panel/event_line.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "render/axis.h"
#include "render/overlay.h"
#include "render/svg.h"

namespace tumble {

namespace {

using Eigen::Vector2d;

constexpr double kWidth = 1280.0, kLeft = 140.0, kRight = kWidth - 60.0, kTop = 110.0;
constexpr double kLane = 64.0, kStroke = 40.0;  // [px] from lane to lane, of the longest event

struct Lane {
  EventKind kind;
  Colour colour;
};
// Impacts as forces are, what begins to hold in ink, what lets go in the colour of velocities.
const std::array<Lane, 5> kLanes = {{{EventKind::Impact, {0.835f, 0.251f, 0.102f}},
                                     {EventKind::Rest, ink::text},
                                     {EventKind::Separate, {0.039f, 0.388f, 0.690f}},
                                     {EventKind::Stick, ink::text},
                                     {EventKind::Slip, {0.039f, 0.388f, 0.690f}}}};

void drawAxis(const Scale& time, double bottom, Drawing& drawing) {
  const double unit = std::pow(10.0, time.power());
  drawing.stroke({kLeft, bottom}, {kRight, bottom}, 1.4, ink::secondary);
  for (const Tick& tick : time.ticks()) {
    const double x = time.at(tick.value);
    if (x > kRight + 1.0) continue;
    drawing.stroke({x, kTop - 8.0}, {x, bottom}, 1.0, ink::frame);
    drawing.stroke({x, bottom}, {x, bottom + 5.0}, 1.2, ink::secondary);
    drawing.text({x, bottom + 21.0}, formatTick(tick.value / unit, time.step() / unit),
                 {13.0, Face::Regular, Align::Centre, ink::secondary});
  }
  const std::string factor = factorText(time.power(), 0.0);
  drawing.text({kRight, bottom + 44.0}, factor.empty() ? "time / s" : "time / s  " + factor,
               {14.0, Face::Regular, Align::Right, ink::text});
}

void drawLane(const Lane& lane, const std::vector<Event>& events, const Scale& time, double foot,
              Drawing& drawing) {
  double largest = 0.0;
  for (const Event& event : events)
    if (event.kind == lane.kind) largest = std::max(largest, event.j);
  for (const Event& event : events) {
    if (event.kind != lane.kind) continue;
    const double share =
        lane.kind == EventKind::Impact && largest > 0.0 ? std::sqrt(event.j / largest) : 0.4;
    const double x = time.at(event.t);
    drawing.stroke({x, foot}, {x, foot - std::max(3.0, kStroke * share)}, 1.4, lane.colour);
  }
  drawing.stroke({kLeft, foot}, {kRight, foot}, 1.0, ink::leader);
  const auto count = std::count_if(events.begin(), events.end(),
                                   [&](const Event& event) { return event.kind == lane.kind; });
  drawing.text({kLeft - 14.0, foot - 16.0}, eventName(lane.kind),
               {14.0, Face::Bold, Align::Right, lane.colour});
  drawing.text({kLeft - 14.0, foot}, std::to_string(count),
               {13.0, Face::Regular, Align::Right, ink::secondary});
}

}  // namespace

std::string eventLineSvg(const Scene& scene, const Recording& recording, Fonts& fonts) {
  const std::vector<Event>& events = recording.report.events;
  std::vector<Lane> lanes;
  for (const Lane& lane : kLanes)
    if (std::any_of(events.begin(), events.end(),
                    [&](const Event& event) { return event.kind == lane.kind; }))
      lanes.push_back(lane);
  const double bottom = kTop + kLane * static_cast<double>(std::max<std::size_t>(1, lanes.size()));
  SvgDrawing drawing(kWidth, bottom + 60.0, fonts);
  drawing.fill({0.0, 0.0}, {kWidth, bottom + 60.0}, ink::page);
  const std::array<double, 2> ends = {0.0, recording.samples.back().t};
  const Scale time({"", false}, ends, kLeft, kRight, 90.0);
  drawAxis(time, bottom, drawing);
  for (std::size_t i = 0; i < lanes.size(); ++i)
    drawLane(lanes[i], events, time, kTop + kLane * static_cast<double>(i + 1) - 14.0, drawing);
  const Drawing::TextStyle title{22.0, Face::Bold, Align::Left, ink::text};
  drawing.text({32.0, 46.0}, drawing.fitted(scene.title, kWidth - 64.0, 1, title, 13.0), 0.0,
               title);
  drawing.text({32.0, 70.0},
               events.empty() ? "Nothing touches."
                              : "All events; an impact is as high as the root of its impulse.",
               {15.0, Face::Regular, Align::Left, ink::secondary});
  return drawing.document();
}

}  // namespace tumble
