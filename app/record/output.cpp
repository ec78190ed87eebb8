#include "app/record/output.h"

#include <fmt/format.h>

#include <initializer_list>
#include <iterator>
#include <nlohmann/json.hpp>

#include "app/record/file.h"

namespace tumble {

namespace {

// 17 significant digits: every double comes back as it was.
void addNumbers(std::string& out, std::initializer_list<double> numbers) {
  for (const double number : numbers) fmt::format_to(std::back_inserter(out), ",{:.17g}", number);
}

void addVector(std::string& out, const Vec3& v) {
  addNumbers(out, {v.x(), v.y(), v.z()});
}

const std::string& nameOf(const Scene& scene, int body) {
  return scene.world.bodies[body].name;
}

bool moves(const BodyDef& body) {
  return !body.fixed && !std::holds_alternative<HalfSpace>(body.shape);
}

}  // namespace

std::string csvQuoted(const std::string& text) {
  std::string out = "\"";
  for (const char c : text) out += c == '"' ? std::string("\"\"") : std::string(1, c);
  return out + "\"";
}

std::string trajectoryCsv(const Recording& recording, const Scene& scene) {
  std::string out = "t,body,x,y,z,qw,qx,qy,qz,vx,vy,vz,wx,wy,wz\n";
  for (const Sample& sample : recording.samples) {
    for (std::size_t i = 0; i < sample.bodies.size(); ++i) {
      if (!moves(scene.world.bodies[i])) continue;
      const BodySample& body = sample.bodies[i];
      out += fmt::format("{:.17g},{}", sample.t, nameOf(scene, static_cast<int>(i)));
      addVector(out, body.x);
      addNumbers(out, {body.q.w(), body.q.x(), body.q.y(), body.q.z()});
      addVector(out, body.v);
      addVector(out, body.omega);
      out += '\n';
    }
  }
  return out;
}

std::string eventsCsv(const Recording& recording, const Scene& scene) {
  std::string out = "t,kind,a,b,px,py,pz,nx,ny,nz,vrel,j\n";
  for (const Event& event : recording.report.events) {
    out += fmt::format("{:.17g},{},{},{}", event.t, eventName(event.kind), nameOf(scene, event.a),
                       nameOf(scene, event.b));
    addVector(out, event.p);
    addVector(out, event.n);
    addNumbers(out, {event.vrel, event.j});
    out += '\n';
  }
  return out;
}

std::string contactsCsv(const Recording& recording, const Scene& scene) {
  std::string out = "t,a,b,px,py,pz,nx,ny,nz,separation,fx,fy,fz\n";
  for (const Sample& sample : recording.samples) {
    for (const ContactSample& contact : sample.contacts) {
      out += fmt::format("{:.17g},{},{}", sample.t, nameOf(scene, contact.a),
                         nameOf(scene, contact.b));
      addVector(out, contact.p);
      addVector(out, contact.n);
      addNumbers(out, {contact.separation});
      addVector(out, contact.force);
      out += '\n';
    }
  }
  return out;
}

std::string summaryJson(const Recording& recording, const Scene& scene) {
  nlohmann::ordered_json json;
  for (const auto& [key, number] : kCertificateFields)
    std::visit([&](auto field) { json[key] = recording.report.certificate.*field; }, number);
  json["cpu_seconds"] = recording.cpuSeconds;
  json["method"] = scene.world.method;
  json["features"] = recording.features;
  json["version"] = TUMBLE_VERSION;
  json["scene"] = scene.line;
  json["stopped"] = recording.report.stopped;
  json["reason"] = recording.report.reason;
  json["notes"] = recording.report.notes;
  return json.dump(2) + "\n";
}

void writeRecording(const std::string& folder, const Recording& recording, const Scene& scene) {
  makeFolder(folder);
  writeFile(folder + "/trajectory.csv", trajectoryCsv(recording, scene));
  writeFile(folder + "/events.csv", eventsCsv(recording, scene));
  writeFile(folder + "/contacts.csv", contactsCsv(recording, scene));
  writeFile(folder + "/summary.json", summaryJson(recording, scene));
}

}  // namespace tumble
