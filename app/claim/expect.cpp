#include "app/claim/expect.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "app/claim/meter.h"

namespace tumble {

namespace {

constexpr double kNoNumber = std::numeric_limits<double>::quiet_NaN();

struct Measured {
  double value = kNoNumber;
  const Sample* sample = nullptr;  // where; none: nowhere
};

// At the instant, or the end or start of the run.
const Sample* sampleOf(const ExpectDef& expect, const Recording& recording) {
  const std::vector<Sample>& samples = recording.samples;
  if (!expect.at) {
    if (expect.over == "start") return &samples.front();
    return recording.end ? &*recording.end : &samples.back();
  }
  const auto k = static_cast<std::size_t>(std::lround(*expect.at * recording.rate));
  return k < samples.size() && isSample(*expect.at, recording.rate) ? &samples[k] : nullptr;
}

Measured measure(const ExpectDef& expect, const Recording& recording, Meter& meter) {
  if (recording.samples.empty()) return {};
  if (expect.at || expect.over == "start" || expect.over == "end") {
    const Sample* sample = sampleOf(expect, recording);
    return {sample ? meter(*sample) : kNoNumber, sample};
  }
  const double sign = expect.over == "max" ? 1.0 : -1.0;
  Measured extreme;
  for (const Sample& sample : recording.samples) {
    const double value = meter(sample);
    if (std::isnan(value)) return {};  // it is not known which would be largest
    if (!extreme.sample || sign * value > sign * extreme.value) extreme = {value, &sample};
  }
  return extreme;
}

// What it should come to, at the sample where it was measured.
double targetOf(const Scene& scene, const ExpectDef& expect, const Sample* sample) {
  if (expect.aim.empty()) return expect.target;
  if (!sample) return kNoNumber;
  Meter aim(scene, expect.aim);
  return aim(*sample);
}

// How far the measured value is from where it should be; NaN if either is no number, or has no end.
double errorOf(Relation relation, double measured, double target) {
  if (!std::isfinite(measured) || !std::isfinite(target)) return kNoNumber;
  if (relation == Relation::AtMost) return std::max(0.0, measured - target);
  if (relation == Relation::AtLeast) return std::max(0.0, target - measured);
  return std::abs(measured - target);
}

Expectation judged(const Scene& scene, const ExpectDef& expect, const Recording& recording,
                   Meter& meter) {
  const Measured measured = measure(expect, recording, meter);
  Expectation one;
  const double target = targetOf(scene, expect, measured.sample);
  const double value = std::isnan(measured.value) ? kNoNumber : measured.value;  // of no sign
  one.row = {labelOf(expect), value, target, errorOf(expect.relation, measured.value, target),
             expect.within};
  one.row.relation = expect.relation;
  const Gauge* alone = meter.alone();
  if (!alone || !measured.sample) return one;
  const std::size_t axis = std::string("xyz").find(alone->quantity().name);
  if (axis == std::string::npos) return one;
  one.place = measured.sample->bodies[static_cast<std::size_t>(*alone->body())].x;
  one.axis = static_cast<int>(axis);
  (*one.place)[one.axis] = target;
  return one;
}

const char* keyOf(Relation relation) {
  return relation == Relation::AtMost    ? "at_most"
         : relation == Relation::AtLeast ? "at_least"
                                         : "equals";
}

// A place inside the text of a value, if it was written on one line.
Place within(const Scene& scene, const std::string& where, int bytes) {
  const auto known = scene.places.find(where);
  if (known == scene.places.end()) return {scene.file};
  Place place = known->second;
  if (place.column > 0) place.column += 1 + bytes;
  return place;
}

void addFaults(const Scene& scene, const std::string& key, const std::string& where,
               const std::string& text, bool running, std::vector<Diagnostic>& faults) {
  for (const Meter::Fault& fault : Meter::faults(scene, text, running))
    faults.push_back({within(scene, where, fault.at), key + ": " + fault.what});
}

}  // namespace

std::string labelOf(const ExpectDef& expect) {
  const std::string when = expect.at ? fmt::format("at {:g} s", *expect.at)
                           : expect.over == "max" || expect.over == "min" ? expect.over
                                                                          : "at the " + expect.over;
  return (expect.label.empty() ? expect.value : expect.label) + ", " + when;
}

std::vector<Expectation> expectationsOf(const Scene& scene, const Recording& recording) {
  std::vector<Expectation> all;
  for (std::size_t i = 0; i < scene.expects.size(); ++i) {
    const ExpectDef& expect = scene.expects[i];
    if (expect.at && !isSample(*expect.at, recording.rate)) continue;
    Meter meter(scene, expect.value);
    Expectation one = judged(scene, expect, recording, meter);
    one.index = i;
    all.push_back(std::move(one));
  }
  return all;
}

std::vector<Diagnostic> faultsOfFormulas(const Scene& scene) {
  std::vector<Diagnostic> faults;
  for (std::size_t i = 0; i < scene.expects.size(); ++i) {
    const ExpectDef& expect = scene.expects[i];
    const std::string aim = keyOf(expect.relation);
    addFaults(scene, fmt::format("expect.{}.value", i), fmt::format("expect[{}].value", i),
              expect.value, false, faults);
    if (!expect.aim.empty())
      addFaults(scene, fmt::format("expect.{}.{}", i, aim), fmt::format("expect[{}].{}", i, aim),
                expect.aim, false, faults);
  }
  for (std::size_t g = 0; g < scene.graphs.size(); ++g) {
    if (const std::string& text = scene.graphs[g].against; !text.empty())
      addFaults(scene, fmt::format("graph.{}.against", g), fmt::format("graph[{}].against", g),
                text, true, faults);
    for (std::size_t i = 0; i < scene.graphs[g].curves.size(); ++i)
      if (const std::string& text = scene.graphs[g].curves[i].value; !text.empty())
        addFaults(scene, fmt::format("graph.{}.curves.{}.value", g, i),
                  fmt::format("graph[{}].curves[{}].value", g, i), text, true, faults);
  }
  return faults;
}

}  // namespace tumble
