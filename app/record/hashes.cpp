#include "app/record/hashes.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <string_view>

#include "app/file/digest.h"
#include "app/file/file.h"

namespace tumble {

namespace {

constexpr std::string_view kFormat = "tumble hashes 1";

// FNV-1a of numbers, byte by byte, lowest first, on any machine.
class Digester {
 public:
  void add(std::uint64_t bits) {
    std::array<char, 8> bytes;
    for (int i = 0; i < 8; ++i) bytes[i] = static_cast<char>(bits >> (8 * i));
    hash_ = digest({bytes.data(), bytes.size()}, hash_);
  }
  void add(int number) { add(static_cast<std::uint64_t>(number)); }
  void add(double number) { add(std::bit_cast<std::uint64_t>(number == 0.0 ? 0.0 : number)); }
  void add(const Vec3& v) {
    for (const double number : v) add(number);
  }
  // Of q and −q the one whose first part that is not zero is positive.
  void add(const Quat& q) {
    const std::array parts = {q.w(), q.x(), q.y(), q.z()};
    double sign = 0.0;
    for (const double part : parts)
      if (sign == 0.0 && part != 0.0) sign = part < 0.0 ? -1.0 : 1.0;
    for (const double part : parts) add(sign * part);
  }
  std::uint64_t hash() const { return hash_; }

 private:
  std::uint64_t hash_ = digest("");
};

std::uint64_t hashOf(const BodySample& body) {
  Digester all;
  all.add(body.x);
  all.add(body.q);
  all.add(body.v);
  all.add(body.omega);
  if (body.R)
    for (int k = 0; k < 3; ++k) all.add(Vec3(body.R->col(k)));
  return all.hash();
}

std::uint64_t namesOf(const Scene& scene) {
  std::uint64_t hash = digest("");
  for (const BodyDef& body : scene.world.bodies) hash = digest(body.name + "\n", hash);
  return hash;
}

// Words of the text one after another, each with its place.
class Words {
 public:
  Words(std::string_view text, const std::string& path) : rest_(text), path_(path) {}

  // Goes on to the next line; the words of it are what follows.
  bool line() {
    if (rest_.empty()) return false;
    const std::size_t end = std::min(rest_.find('\n'), rest_.size());
    line_ = rest_.substr(0, end);
    rest_.remove_prefix(std::min(end + 1, rest_.size()));
    ++number_;
    column_ = 1;
    return true;
  }
  std::string_view whole() const { return line_; }
  bool begins(std::string_view word) const { return line_.starts_with(word); }

  [[noreturn]] void refuse(const std::string& what) const {
    throw FileError(fmt::format("{}:{}:{}: {}; `tumble simulate --hash` writes such files", path_,
                                std::max(number_, 1), column_, what));
  }

  // The next word of the line, between single spaces.
  std::string_view word() {
    const std::size_t start = static_cast<std::size_t>(column_ - 1);
    if (start > line_.size()) refuse("the line ends too early");
    const std::size_t end = std::min(line_.find(' ', start), line_.size());
    next_ = static_cast<int>(end) + 2;
    return line_.substr(start, end - start);
  }
  void take() { column_ = next_; }

  void expect(std::string_view what) {
    if (word() != what) refuse(fmt::format("expected '{}'", what));
    take();
  }
  template <typename Number, typename... Base>
  Number number(const char* what, Base... base) {
    const std::string_view text = word();
    Number value{};
    const auto result = std::from_chars(text.data(), text.data() + text.size(), value, base...);
    if (result.ec != std::errc() || result.ptr != text.data() + text.size())
      refuse(fmt::format("expected {}, found '{}'", what, text));
    take();
    return value;
  }
  std::uint64_t hash() {
    if (word().size() != 16) refuse("expected a hash of 16 hexadecimal digits");
    return number<std::uint64_t>("a hash of 16 hexadecimal digits", 16);
  }
  std::string rest() {
    const std::size_t start = std::min(static_cast<std::size_t>(column_ - 1), line_.size());
    return std::string(line_.substr(start));
  }
  void end() const {
    if (static_cast<std::size_t>(column_ - 1) <= line_.size())
      refuse("expected the end of the line");
  }

 private:
  std::string_view rest_, line_;
  const std::string& path_;
  int number_ = 0, column_ = 1, next_ = 1;
};

// "rate R bodies N HASH NAME": what was run. The name may have spaces.
RunHashes readHead(Words& in, const Scene& scene) {
  RunHashes hashes = hashesFor(scene, 0.0);
  in.expect("rate");
  hashes.rate = in.number<double>("a rate [1/s]");
  if (!(hashes.rate >= 1e-3 && hashes.rate <= 1e5))
    in.refuse("expected a rate from 1e-3 to 1e5 [1/s]");
  in.expect("bodies");
  const std::size_t bodies = in.number<std::size_t>("a number of bodies");
  const std::uint64_t names = in.hash();
  hashes.scene = in.rest();
  if (names != hashes.names || bodies != hashes.bodies)
    in.refuse(
        fmt::format("these are hashes of '{}' with {} bodies; those of '{}' are {}, or have "
                    "other names",
                    hashes.scene, bodies, scene.name, hashes.bodies));
  return hashes;
}

SampleHash readSample(Words& in, double expected) {
  SampleHash sample;
  const std::string text(in.word());
  if (fmt::format("{}", expected) != text)
    in.refuse(fmt::format("expected the sample at t = {} s, found '{}'", expected, text));
  sample.t = expected;
  in.take();
  sample.state = in.hash();
  sample.place = in.hash();
  sample.forces = in.hash();
  in.end();
  return sample;
}

// The one body whose hash explains how two samples differ, or -1.
int bodyThatDiffers(const SampleHash& expected, const SampleHash& actual, std::size_t bodies) {
  const std::uint64_t state = actual.state - expected.state, place = actual.place - expected.place;
  int found = -1;
  for (std::size_t i = 0; i < bodies; ++i) {
    if ((i + 1) * state != place) continue;
    if (found >= 0) return -1;
    found = static_cast<int>(i);
  }
  return found;
}

}  // namespace

SampleHash hashOf(const Sample& sample) {
  SampleHash all;
  all.t = sample.t;
  for (std::size_t i = 0; i < sample.bodies.size(); ++i) {
    const std::uint64_t body = hashOf(sample.bodies[i]);
    all.state += body;
    all.place += (i + 1) * body;
  }
  Digester forces;
  for (const ContactSample& contact : sample.contacts) {
    for (const int number : {contact.a, contact.b}) forces.add(number);
    for (const Vec3& v : {contact.p, contact.n, contact.force}) forces.add(v);
    forces.add(contact.separation);
  }
  for (const JointForce& joint : sample.joints) {
    forces.add(joint.joint);
    for (const Vec3& v : {joint.p, joint.force, joint.torque}) forces.add(v);
  }
  all.forces = forces.hash();
  return all;
}

RunHashes hashesFor(const Scene& scene, double rate) {
  RunHashes hashes;
  hashes.scene = scene.name;
  hashes.rate = rate;
  hashes.bodies = scene.world.bodies.size();
  hashes.names = namesOf(scene);
  return hashes;
}

void addEvents(RunHashes& hashes, const Report& report) {
  Digester all;
  for (const Event& event : report.events) {
    all.add(event.t);
    for (const int number : {static_cast<int>(event.kind), event.a, event.b}) all.add(number);
    for (const Vec3& v : {event.p, event.n}) all.add(v);
    for (const double number : {event.vrel, event.j}) all.add(number);
  }
  hashes.eventCount = report.events.size();
  hashes.events = all.hash();
}

std::string hashText(const RunHashes& hashes) {
  std::string text = fmt::format("{}\nrate {} bodies {} {:016x} {}\n", kFormat, hashes.rate,
                                 hashes.bodies, hashes.names, hashes.scene);
  for (const SampleHash& sample : hashes.samples)
    text += fmt::format("{} {:016x} {:016x} {:016x}\n", sample.t, sample.state, sample.place,
                        sample.forces);
  return text + fmt::format("events {} {:016x}\n", hashes.eventCount, hashes.events);
}

RunHashes readHashes(const std::string& text, const std::string& path, const Scene& scene) {
  Words in(text, path);
  if (!in.line() || in.whole() != kFormat)
    in.refuse(in.begins("tumble hashes ")
                  ? fmt::format("hashes of another version: expected '{}'", kFormat)
                  : fmt::format("no file of hashes: expected '{}'", kFormat));
  if (!in.line()) in.refuse("the file ends before its line of the rate and bodies");
  RunHashes hashes = readHead(in, scene);
  const auto most = static_cast<std::size_t>(sampleCount(scene, hashes.rate));
  for (;;) {
    if (!in.line()) in.refuse("the file ends before its line of events");
    if (in.begins("events")) break;
    if (hashes.samples.size() == most)
      in.refuse(fmt::format("expected the line of events: '{}' has {} samples", scene.name, most));
    hashes.samples.push_back(
        readSample(in, static_cast<double>(hashes.samples.size()) / hashes.rate));
  }
  in.expect("events");
  hashes.eventCount = in.number<std::size_t>("a number of events");
  hashes.events = in.hash();
  in.end();
  if (in.line()) in.refuse("expected the end of the file");
  return hashes;
}

std::optional<std::string> firstDifference(const RunHashes& expected, const RunHashes& actual,
                                           const Scene& scene) {
  const std::size_t both = std::min(expected.samples.size(), actual.samples.size());
  for (std::size_t k = 0; k < both; ++k) {
    const SampleHash &e = expected.samples[k], &a = actual.samples[k];
    if (e.state != a.state || e.place != a.place) {
      const int body = bodyThatDiffers(e, a, actual.bodies);
      return fmt::format("t = {} s: {}", a.t,
                         body < 0 ? "several bodies are in other states"
                                  : fmt::format("'{}' is in another state, and it alone",
                                                scene.world.bodies[body].name));
    }
    if (e.forces != a.forces)
      return fmt::format("t = {} s: contacts or forces differ; bodies are in the same states", a.t);
  }
  if (expected.samples.size() != actual.samples.size())
    return fmt::format("the run has {} samples, expected {}", actual.samples.size(),
                       expected.samples.size());
  if (expected.eventCount != actual.eventCount || expected.events != actual.events)
    return fmt::format("samples are the same, but of {} events, expected {}, some differ",
                       actual.eventCount, expected.eventCount);
  return {};
}

}  // namespace tumble
