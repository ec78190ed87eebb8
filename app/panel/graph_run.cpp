#include "app/panel/graph_run.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "app/claim/holds.h"
#include "app/claim/meter.h"
#include "app/claim/parting.h"
#include "app/present/palette.h"
#include "app/record/output.h"

namespace tumble {

namespace {

int bodyNamed(const Scene& scene, const std::string& name) {
  const std::vector<BodyDef>& bodies = scene.world.bodies;
  for (std::size_t i = 0; i < bodies.size(); ++i)
    if (bodies[i].name == name) return static_cast<int>(i);
  throw SceneError({{{scene.file}, "[[graph]]: there is no body '" + name + "' in this variant"}});
}

std::string captionOf(const std::string& shows) {
  if (shows == "velocity") return "velocity / (m/s)";
  if (shows == "planes") return "planes sought";
  if (shows == "pairs") return "pairs of parts asked about";
  if (shows == "holds") return "residual, relative";
  if (shows == "force") return "contact force / N";
  if (shows == "joint") return "joint force upward / N";
  return shows == "energy" ? "energy / J" : "height / m";
}

}  // namespace

double shownOf(const std::string& shows, const Sample& sample, int body) {
  if (shows == "energy") return sample.kinetic + sample.potential;
  const BodySample& shown = sample.bodies[static_cast<std::size_t>(body)];
  if (shows == "velocity") return shown.v.y();
  if (shows == "height") return shown.x.y();
  Vec3 sum = Vec3::Zero();
  if (shows == "joint") {
    for (const JointForce& joint : sample.joints) {
      if (joint.a == body) sum += joint.force;
      if (joint.b == body) sum -= joint.force;
    }
    return sum.y();
  }
  for (const ContactSample& contact : sample.contacts) {
    if (contact.a == body) sum += contact.force;
    if (contact.b == body) sum -= contact.force;
  }
  return sum.norm();
}

namespace {

// Planes sought where those of the sample before are asked first, or where not: one for each pair.
// Of planes both.
void addPlaneCounts(const Scene& scene, const GraphDef& graph, const std::string& label,
                    std::vector<GraphSeries>& all) {
  const bool pairs = graph.shows == "pairs";
  GraphSeries asked{.label = label}, anew{.label = pairs ? label : "seeking each anew"};
  Coherence coherence(scene);
  run(scene, scene.image.rate, [&](Sample&& sample) {
    coherence.look(sample);
    asked.points.emplace_back(sample.t, static_cast<double>(coherence.searches()));
    anew.points.emplace_back(sample.t, static_cast<double>(coherence.pairs()));
  });
  if (!pairs) all.push_back(std::move(asked));
  all.push_back(std::move(anew));
}

// Runs a scene and reads a curve off it: at every sample, and on both sides of each impact that it
// jumps at.
template <class Jumps, class Read>
void readCurve(const Scene& scene, const Jumps& jumps, const Read& read, GraphSeries& series) {
  World world = makeWorld(scene);
  const int count = sampleCount(scene, scene.image.rate);
  std::size_t known = 0;  // events
  double last = 0.0;      // instant that was read
  for (int k = 0; k < count; ++k) {
    const double t = k / scene.image.rate;
    world.advance(t);
    if (world.report().stopped) break;
    const auto readAt = [&](double when) {
      last = when;
      series.curve.push_back(read(world.sample(when), world.report().certificate));
    };
    const std::vector<Event>& events = world.report().events;
    for (; known < events.size() && events[known].t <= t; ++known) {
      const Event& event = events[known];
      if (event.kind != EventKind::Impact || !jumps(event)) continue;
      if (!(event.t > last)) continue;
      readAt(std::nextafter(event.t, 0.0));
      readAt(event.t);
    }
    readAt(t);
    series.points.push_back(series.curve.back());
  }
}

// What a formula comes to, with the certificate as it stands at each sample.
void addValues(const Scene& scene, const GraphDef& graph, const GraphCurve& curve,
               std::vector<GraphSeries>& all) {
  const std::string against = graph.against.empty() ? "t" : graph.against;
  for (const std::string& text : {against, curve.value})
    for (const Meter::Fault& fault : Meter::faults(scene, text, true))
      throw SceneError({{{scene.file}, "[[graph]]: " + fault.what + " in this variant"}});
  Meter across(scene, against), upward(scene, curve.value);
  GraphSeries& series = all.emplace_back();
  series.label = curve.variant.title;
  readCurve(
      scene, [&](const Event& impact) { return across.jumpsAt(impact) || upward.jumpsAt(impact); },
      [&](const Sample& sample, const Certificate& soFar) {
        return Eigen::Vector2d(across(sample, &soFar), upward(sample, &soFar));
      },
      series);
}

// What each way to hold points leaves of the step in which most are held, the more the less is
// asked of it: against its steps.
void addHolds(const Scene& scene, std::vector<GraphSeries>& all) {
  const Recording recording = record(scene, scene.image.rate);
  const Sample* at = mostHeld(scene, recording);
  const HeldProblem problem = at ? heldStep(scene, *at) : HeldProblem{};
  if (problem.holds.empty())
    throw SceneError({{{scene.file}, "[[graph]]: nothing that bends is held in this variant"}});
  for (const HeldSolver& solver : heldSolvers()) {
    GraphSeries& series = all.emplace_back();
    series.label = solver.name;
    for (double tolerance = 1.0; tolerance > 1e-13; tolerance *= 0.1) {
      const HeldAnswer answer = solver.solve(problem, tolerance);
      if (series.points.empty() || answer.count > series.points.back().x())
        series.points.emplace_back(answer.count, answer.residual);
    }
  }
}

// Whether impacts make it jump or turn.
bool movesBy(const std::string& shows) {
  return shows == "height" || shows == "velocity";
}

void addShown(const Scene& scene, const GraphDef& graph, const std::string& label,
              std::vector<GraphSeries>& all) {
  const int body = graph.body.empty() ? kNoBody : bodyNamed(scene, graph.body);
  const bool whole = graph.shows == "energy", moved = movesBy(graph.shows);
  GraphSeries& series = all.emplace_back();
  series.label = label;
  readCurve(
      scene,
      [&](const Event& impact) {
        const bool own = impact.a == body || impact.b == body;
        if (own) series.impacts.push_back(impact);
        return whole || (own && moved);
      },
      [&](const Sample& sample, const Certificate&) {
        return Eigen::Vector2d(sample.t, shownOf(graph.shows, sample, body));
      },
      series);
}

}  // namespace

std::vector<GraphSeries> runGraph(const Scene& scene, const GraphDef& graph, const RunDone& done) {
  std::vector<GraphSeries> all;
  for (const GraphCurve& curve : graph.curves) {
    const Scene changed = sceneOf(scene, joined(graph.variant, curve.variant));
    if (graph.shows == "planes" || graph.shows == "pairs")
      addPlaneCounts(changed, graph, curve.variant.title, all);
    else if (graph.shows == "values")
      addValues(changed, graph, curve, all);
    else if (graph.shows == "holds")
      addHolds(changed, all);
    else
      addShown(changed, graph, curve.variant.title, all);
    done();
  }
  return all;
}

std::string graphCsv(const std::vector<GraphSeries>& series, int rows) {
  std::string csv = "curve,t,value\n";
  for (const GraphSeries& one : series)
    for (int k = 0; k <= rows && !one.points.empty(); ++k) {
      const Eigen::Vector2d& point = one.points[(one.points.size() - 1) * k / rows];
      csv += fmt::format("{},{:.17g},{:.17g}\n", csvQuoted(one.label), point.x(), point.y());
    }
  return csv;
}

namespace {

// Whether an energy changes by so much that the axis may leave 0 out, and by so little that it has
// to, for the change to be seen; what is lost or gained otherwise is seen as a share of it.
bool changesVisibly(const std::vector<GraphSeries>& series) {
  double least = 0.0, most = 0.0;
  for (const GraphSeries& one : series)
    for (const Eigen::Vector2d& point : one.points) {
      const bool first = &one == &series.front() && &point == &one.points.front();
      least = first ? point.y() : std::min(least, point.y());
      most = first ? point.y() : std::max(most, point.y());
    }
  return least > 0.5 * most && least < 0.95 * most;
}

// Whether all heights are below ten centimetres: then they are told in millimetres.
bool isSmall(const std::vector<GraphSeries>& series) {
  constexpr double kSmall = 0.1;  // m
  for (const GraphSeries& one : series)
    for (const Eigen::Vector2d& point : one.points)
      if (std::abs(point.y()) > kSmall) return false;
  return true;
}

}  // namespace

Chart graphOf(const GraphDef& graph, const std::vector<GraphSeries>& series) {
  Chart plot;
  plot.title = graph.variant.title;
  plot.subtitle = graph.subtitle;
  const bool holds = graph.shows == "holds";
  const std::string time = holds ? "steps" : "time / s";
  plot.x = {graph.across.empty() ? time : graph.across, false};
  plot.y = {graph.shows == "values" ? graph.axis : captionOf(graph.shows), holds,
            graph.shows == "energy" && !changesVisibly(series), graph.shows == "energy"};
  const bool small = graph.shows == "height" && isSmall(series);
  if (small) plot.y.caption = "height / mm";
  for (std::size_t i = 0; i < series.size(); ++i) {
    ChartCurve& curve = plot.curves.emplace_back();
    curve.label = series[i].label;
    curve.colour = seriesColour(i);
    curve.marked = holds;
    curve.points = series[i].curve.empty() ? series[i].points : series[i].curve;
    if (small)
      for (Eigen::Vector2d& point : curve.points) point.y() *= 1e3;
    if (graph.shows != "force") continue;
    for (const Event& hit : series[i].impacts) plot.guides.push_back({true, hit.t, ""});
    if (!series[i].impacts.empty())
      curve.note = fmt::format("f = ∞, j = {:.3g} N·s", series[i].impacts.front().j);
  }
  return plot;
}

}  // namespace tumble
