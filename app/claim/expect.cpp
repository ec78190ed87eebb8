#include "app/claim/expect.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "app/claim/formula.h"
#include "app/claim/quantity.h"
#include "app/scene/findings.h"

namespace tumble {

namespace {

constexpr double kNoNumber = std::numeric_limits<double>::quiet_NaN();

/// A formula with what it reads.
class Meter {
 public:
  Meter(const Scene& scene, const std::string& text) : text_(text), formula_(text) {
    for (const std::string& name : formula_.names())
      if (const std::optional<Gauge> gauge = Gauge::named(scene, name)) gauges_.push_back(*gauge);
    numbers_.resize(gauges_.size());
  }
  double operator()(const Sample& sample) {
    for (std::size_t i = 0; i < gauges_.size(); ++i) numbers_[i] = gauges_[i](sample);
    return formula_(numbers_);
  }
  const std::vector<Gauge>& gauges() const { return gauges_; }
  /// Whether the formula is one quantity and nothing else.
  bool isName() const { return formula_.names().size() == 1 && formula_.names().front() == text_; }

 private:
  std::string text_;
  Formula formula_;
  std::vector<Gauge> gauges_;
  std::vector<double> numbers_;
};

struct Measured {
  double value = kNoNumber;
  int sample = -1;
};

// At the instant, or the end or start of the run.
int sampleOf(const ExpectDef& expect, const Recording& recording) {
  const int last = static_cast<int>(recording.samples.size()) - 1;
  if (!expect.at) return expect.over == "start" ? 0 : last;
  const int k = static_cast<int>(std::lround(*expect.at * recording.rate));
  return k <= last && isSample(*expect.at, recording.rate) ? k : -1;
}

Measured measure(const ExpectDef& expect, const Recording& recording, Meter& meter) {
  if (recording.samples.empty()) return {};
  if (expect.at || expect.over == "start" || expect.over == "end") {
    const int k = sampleOf(expect, recording);
    return {k < 0 ? kNoNumber : meter(recording.samples[k]), k};
  }
  const double sign = expect.over == "max" ? 1.0 : -1.0;
  Measured extreme;
  for (std::size_t k = 0; k < recording.samples.size(); ++k) {
    const double value = meter(recording.samples[k]);
    if (std::isnan(value)) return {};  // it is not known which would be largest
    if (extreme.sample < 0 || sign * value > sign * extreme.value)
      extreme = {value, static_cast<int>(k)};
  }
  return extreme;
}

std::string labelOf(const ExpectDef& expect) {
  const std::string when = expect.at ? fmt::format("at {:g} s", *expect.at)
                           : expect.over == "max" || expect.over == "min" ? expect.over
                                                                          : "at the " + expect.over;
  return (expect.label.empty() ? expect.value : expect.label) + ", " + when;
}

// How far the measured value is from where it should be.
double errorOf(const ExpectDef& expect, double measured) {
  if (expect.relation == Relation::AtMost) return std::max(0.0, measured - expect.target);
  if (expect.relation == Relation::AtLeast) return std::max(0.0, expect.target - measured);
  return std::abs(measured - expect.target);
}

Expectation judged(const ExpectDef& expect, const Recording& recording, Meter& meter) {
  const Measured measured = measure(expect, recording, meter);
  Expectation one;
  one.sample = measured.sample;
  const double error = std::isnan(measured.value) ? kNoNumber : errorOf(expect, measured.value);
  one.row = {labelOf(expect), measured.value, expect.target, error, expect.within};
  one.row.relation = expect.relation;
  if (!meter.isName()) return one;
  const std::size_t axis = std::string("xyz").find(meter.gauges().front().quantity().name);
  if (axis == std::string::npos) return one;
  one.body = meter.gauges().front().body();
  one.axis = static_cast<int>(axis);
  return one;
}

// A place inside the text of a value, if it was written on one line.
Place within(const Scene& scene, const std::string& where, int bytes) {
  const auto known = scene.places.find(where);
  if (known == scene.places.end()) return {scene.file};
  Place place = known->second;
  if (place.column > 0) place.column += 1 + bytes;
  return place;
}

}  // namespace

std::vector<Expectation> expectationsOf(const Scene& scene, const Recording& recording) {
  std::vector<Expectation> all;
  for (const ExpectDef& expect : scene.expects) {
    Meter meter(scene, expect.value);
    Expectation one = judged(expect, recording, meter);
    if (expect.at && !isSample(*expect.at, recording.rate)) continue;
    all.push_back(std::move(one));
  }
  return all;
}

std::vector<Diagnostic> faultsOfExpectations(const Scene& scene) {
  std::vector<Diagnostic> faults;
  for (std::size_t i = 0; i < scene.expects.size(); ++i) {
    const std::string key = fmt::format("expect.{}.value", i);
    const std::string where = fmt::format("expect[{}].value", i);
    const std::string& text = scene.expects[i].value;
    try {
      const Formula formula(text);
      for (const std::string& name : formula.names())
        if (!Gauge::named(scene, name))
          faults.push_back(
              {within(scene, where, static_cast<int>(text.find(name))),
               key + ": unknown quantity " + inQuotes(name) + hintOfQuantity(scene, name)});
    } catch (const NotAFormula& error) {
      faults.push_back({within(scene, where, error.at()), key + ": " + error.what()});
    }
  }
  return faults;
}

}  // namespace tumble
