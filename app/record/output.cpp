#include "app/record/output.h"

#include <charconv>
#include <initializer_list>
#include <nlohmann/json.hpp>

#include "app/file/file.h"
#include "app/record/bodies.h"
#include "sim/shape/pieces.h"

namespace tumble {

namespace {

constexpr char kTrajectory[] = "t,body,x,y,z,qw,qx,qy,qz,vx,vy,vz,wx,wy,wz\n";
constexpr char kNodes[] = "t,body,x,y,z,vx,vy,vz\n";
constexpr char kJoints[] = "t,joint,a,b,px,py,pz,fx,fy,fz,tx,ty,tz\n";
constexpr char kContacts[] = "t,a,b,px,py,pz,nx,ny,nz,separation,fx,fy,fz\n";

// 17 significant digits, as printf's %.17g: every double comes back as it was.
void addNumber(std::string& out, double number) {
  char text[32];
  const auto end = std::to_chars(text, text + sizeof text, number, std::chars_format::general, 17);
  out.append(text, end.ptr);
}

void addNumbers(std::string& out, std::initializer_list<double> numbers) {
  for (const double number : numbers) {
    out += ',';
    addNumber(out, number);
  }
}

void addVector(std::string& out, const Vec3& v) {
  addNumbers(out, {v.x(), v.y(), v.z()});
}

const std::string& nameOf(const Scene& scene, int body) {
  return scene.world.bodies[body].name;
}

void addNames(std::string& out, const Scene& scene, std::initializer_list<int> bodies) {
  for (const int body : bodies) {
    out += ',';
    out += nameOf(scene, body);
  }
}

// Per body whether it is a point of what bends; of fur only those of strands between every so many.
std::vector<char> pointsOf(const Scene& scene, int every = 0) {
  std::vector<char> points(scene.world.bodies.size(), 0);
  for (const BentDef& bent : scene.bent)
    for (int p = 0; p < bent.count && (every == 0 || bent.strand > 0); ++p)
      points[static_cast<std::size_t>(bent.first + p)] = every == 0 || p / bent.strand % every != 0;
  return points;
}

// Rows of the bodies that are not left out.
void addTrajectory(std::string& out, const Sample& sample, const Scene& scene,
                   const std::vector<char>& left) {
  std::string t;
  addNumber(t, sample.t);
  for (std::size_t i = 0; i < sample.bodies.size(); ++i) {
    if (!moves(scene.world.bodies[i]) || left[i]) continue;
    const BodySample& body = sample.bodies[i];
    out += t;
    addNames(out, scene, {static_cast<int>(i)});
    addVector(out, body.x);
    addNumbers(out, {body.q.w(), body.q.x(), body.q.y(), body.q.z()});
    addVector(out, body.v);
    addVector(out, body.omega);
    out += '\n';
  }
}

void addNodes(std::string& out, const Sample& sample, const Scene& scene,
              const std::vector<char>& points) {
  std::string t;
  addNumber(t, sample.t);
  for (std::size_t i = 0; i < sample.bodies.size(); ++i) {
    if (!points[i] || !moves(scene.world.bodies[i])) continue;
    out += t;
    addNames(out, scene, {static_cast<int>(i)});
    addVector(out, sample.bodies[i].x);
    addVector(out, sample.bodies[i].v);
    out += '\n';
  }
}

void addContacts(std::string& out, const Sample& sample, const Scene& scene) {
  for (const ContactSample& contact : sample.contacts) {
    addNumber(out, sample.t);
    addNames(out, scene, {contact.a, contact.b});
    addVector(out, contact.p);
    addVector(out, contact.n);
    addNumbers(out, {contact.separation});
    addVector(out, contact.force);
    out += '\n';
  }
}

void addJoints(std::string& out, const Sample& sample, const Scene& scene) {
  for (const JointForce& force : sample.joints) {
    const JointDef& joint = scene.world.joints[force.joint];
    addNumber(out, sample.t);
    out += ',' + joint.name;
    addNames(out, scene, {joint.a});
    out += ',';
    if (joint.b != kNoBody) out += nameOf(scene, joint.b);
    addVector(out, force.p);
    addVector(out, force.force);
    addVector(out, force.torque);
    out += '\n';
  }
}

}  // namespace

std::string csvQuoted(const std::string& text) {
  std::string out = "\"";
  for (const char c : text) out += c == '"' ? std::string("\"\"") : std::string(1, c);
  return out + "\"";
}

std::string trajectoryCsv(const Recording& recording, const Scene& scene) {
  constexpr int kStrands = 50;  // one of so many is told
  std::string out = kTrajectory;
  const std::vector<char> untold = pointsOf(scene, kStrands);
  for (const Sample& sample : recording.samples) addTrajectory(out, sample, scene, untold);
  return out;
}

std::string eventsCsv(const Recording& recording, const Scene& scene) {
  std::string out = "t,kind,a,b,px,py,pz,nx,ny,nz,vrel,j\n";
  for (const Event& event : recording.report.events) {
    addNumber(out, event.t);
    out += ',';
    out += eventName(event.kind);
    addNames(out, scene, {event.a, event.b});
    addVector(out, event.p);
    addVector(out, event.n);
    addNumbers(out, {event.vrel, event.j});
    out += '\n';
  }
  return out;
}

std::string contactsCsv(const Recording& recording, const Scene& scene) {
  std::string out = kContacts;
  for (const Sample& sample : recording.samples) addContacts(out, sample, scene);
  return out;
}

std::string jointsCsv(const Recording& recording, const Scene& scene) {
  std::string out = kJoints;
  for (const Sample& sample : recording.samples) addJoints(out, sample, scene);
  return out;
}

namespace {

// How many convex pieces the meshes of all bodies have, and how much those of one overlap at most.
std::pair<std::size_t, double> piecesOf(const Scene& scene) {
  std::size_t count = 0;
  double slack = 0.0;
  for (const BodyDef& body : scene.world.bodies)
    if (const Mesh* mesh = std::get_if<Mesh>(&body.shape); mesh && mesh->pieces) {
      count += mesh->pieces->hulls.size();
      slack = std::max(slack, mesh->pieces->slack);
    }
  return {count, slack};
}

}  // namespace

std::string summaryJson(const Recording& recording, const Scene& scene) {
  nlohmann::ordered_json json;
  for (const auto& [key, number] : kCertificateFields)
    std::visit([&, key = key](auto field) { json[key] = recording.report.certificate.*field; },
               number);
  const auto [pieces, slack] = piecesOf(scene);
  json["mesh_pieces"] = pieces;
  json["mesh_slack"] = slack;
  json["cpu_seconds"] = recording.cpuSeconds;
  json["method"] = recording.method;
  json["features"] = recording.features;
  json["version"] = TUMBLE_VERSION;
  json["scene"] = scene.line;
  json["stopped"] = recording.report.stopped;
  json["reason"] = recording.report.reason;
  json["notes"] = recording.report.notes;
  return json.dump(2) + "\n";
}

namespace {

const std::string& made(const std::string& folder) {
  makeFolder(folder);
  return folder;
}

}  // namespace

OutputFiles::OutputFiles(const std::string& folder, const Scene& scene, bool nodes)
    : folder_(made(folder)),
      scene_(scene),
      trajectory_(folder + "/trajectory.csv"),
      contacts_(folder + "/contacts.csv"),
      points_(pointsOf(scene)) {
  trajectory_.write(kTrajectory);
  contacts_.write(kContacts);
  if (nodes) {
    nodes_.emplace(folder + "/nodes.csv");
    nodes_->write(kNodes);
  }
  if (scene.world.joints.empty()) return;
  joints_.emplace(folder + "/joints.csv");
  joints_->write(kJoints);
}

void OutputFiles::add(const Sample& sample) {
  text_.clear();
  addTrajectory(text_, sample, scene_, points_);
  trajectory_.write(text_);
  text_.clear();
  addContacts(text_, sample, scene_);
  contacts_.write(text_);
  if (nodes_) {
    text_.clear();
    addNodes(text_, sample, scene_, points_);
    nodes_->write(text_);
  }
  if (!joints_) return;
  text_.clear();
  addJoints(text_, sample, scene_);
  joints_->write(text_);
}

void OutputFiles::finish(const Recording& recording) {
  trajectory_.finish();
  writeFile(folder_ + "/events.csv", eventsCsv(recording, scene_));
  contacts_.finish();
  if (joints_) joints_->finish();
  if (nodes_) nodes_->finish();
  writeFile(folder_ + "/summary.json", summaryJson(recording, scene_));
}

}  // namespace tumble
