#include "app/claim/meter.h"

#include <algorithm>
#include <limits>

#include "app/scene/findings.h"
#include "app/scene/node.h"

namespace tumble {

namespace {

const CertificateField* findField(const std::string& name) {
  const auto field = std::find_if(std::begin(kCertificateFields), std::end(kCertificateFields),
                                  [&](const CertificateField& one) { return one.key == name; });
  return field == std::end(kCertificateFields) ? nullptr : &*field;
}

double valueOf(const CertificateField& field, const Certificate& certificate) {
  return std::visit([&](const auto number) { return static_cast<double>(certificate.*number); },
                    field.number);
}

std::optional<double> settingOf(const Scene& scene, const std::string& name) {
  const auto known = scene.numbers.find(name);
  return known == scene.numbers.end() ? std::nullopt : std::optional(known->second);
}

// Whether each part of a path is near that of another: two keys of one long body are not.
bool isNear(const std::string& path, const std::string& other) {
  const std::vector<std::string> parts = partsOf(path), others = partsOf(other);
  return std::equal(parts.begin(), parts.end(), others.begin(), others.end(),
                    [](const std::string& a, const std::string& b) {
                      return a == b || nearestName(a, {b}) == b;
                    });
}

// The nearest key with a number, or that of the certificate, if it is near; else quantities.
std::string hintOf(const Scene& scene, const std::string& name, bool running) {
  std::vector<std::string> keys;
  for (const auto& [key, number] : scene.numbers) keys.push_back(key);
  for (const CertificateField& field : kCertificateFields)
    if (running) keys.emplace_back(field.key);
  std::erase_if(keys, [&](const std::string& key) { return !isNear(name, key); });
  const std::string near = nearestName(name, keys);
  return near.empty() ? hintOfQuantity(scene, name) : ", did you mean '" + near + "'?";
}

}  // namespace

std::vector<Meter::Fault> Meter::faults(const Scene& scene, const std::string& text, bool running) {
  std::vector<Fault> found;
  try {
    const Formula formula(text);
    for (const std::string& name : formula.names())
      if (!Gauge::named(scene, name) && !(running && findField(name)) && !settingOf(scene, name))
        found.push_back({"unknown quantity " + inQuotes(name) + hintOf(scene, name, running),
                         Formula::placeOf(name, text)});
  } catch (const NotAFormula& error) {
    found.push_back({error.what(), error.at()});
  }
  return found;
}

Meter::Meter(const Scene& scene, const std::string& text) : text_(text), formula_(text) {
  for (const std::string& name : formula_.names())
    sources_.push_back({Gauge::named(scene, name), findField(name), settingOf(scene, name)});
  numbers_.resize(sources_.size());
}

double Meter::operator()(const Sample& sample, const Certificate* soFar) {
  for (std::size_t i = 0; i < sources_.size(); ++i) {
    const Source& source = sources_[i];
    numbers_[i] = source.gauge            ? (*source.gauge)(sample)
                  : soFar && source.field ? valueOf(*source.field, *soFar)
                  : source.setting        ? *source.setting
                                          : std::numeric_limits<double>::quiet_NaN();
  }
  return formula_(numbers_);
}

bool Meter::jumpsAt(const Event& impact) const {
  return std::any_of(sources_.begin(), sources_.end(), [&](const Source& source) {
    if (!source.gauge) return false;
    const std::optional<int> body = source.gauge->body();
    return body ? *body == impact.a || *body == impact.b
                : std::string(source.gauge->quantity().name) != "t";
  });
}

const Gauge* Meter::alone() const {
  const bool one = sources_.size() == 1 && formula_.names().front() == text_;
  return one && sources_.front().gauge ? &*sources_.front().gauge : nullptr;
}

}  // namespace tumble
