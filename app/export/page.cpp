#include "app/export/page.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>

#include "app/claim/verdict.h"
#include "app/export/drawn.h"
#include "app/export/pack.h"
#include "app/export/page_bent.h"
#include "app/export/page_view.h"
#include "app/file/data.h"
#include "app/file/file.h"
#include "app/present/arrows.h"
#include "app/present/bent.h"
#include "app/present/bodies.h"
#include "app/present/joints.h"
#include "app/present/present.h"
#include "app/record/bodies.h"

namespace tumble {

namespace {

using Json = nlohmann::ordered_json;

// Four digits are more than a screen shows; the page stays small.
double brief(double value) {
  return std::strtod(fmt::format("{:.7g}", value).c_str(), nullptr);
}

Json list(const Vec3& v) {
  return {brief(v.x()), brief(v.y()), brief(v.z())};
}

Json rgb(const Colour& c) {
  return {brief(c[0]), brief(c[1]), brief(c[2])};
}

void addFloat(std::string& bytes, float value) {
  bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
}

void addWord(std::string& bytes, std::uint16_t value) {
  bytes += static_cast<char>(value & 255);
  bytes += static_cast<char>(value >> 8);
}

// The shaders that the page compiles, with what they include in its place.
std::string shader(const std::filesystem::path& folder, const std::string& name) {
  const std::string text = readFile((folder / name).string()), include = "#include \"";
  std::string whole;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find('\n', at), text.size());
    const std::string line = text.substr(at, end - at);
    whole += line.starts_with(include)
                 ? shader(folder, line.substr(include.size(), line.rfind('"') - include.size()))
                 : line + "\n";
    at = end + 1;
  }
  return whole;
}

Json shaders() {
  const std::filesystem::path folder = dataFolder("shaders");
  Json json;
  for (const char* name :
       {"body.vert", "body.frag", "depth.frag", "above.frag", "screen.vert", "blur.frag",
        "background.frag", "floor.vert", "floor.frag", "arrow.vert", "arrow.frag"})
    json[name] = shader(folder, name);
  return json;
}

/// What the page's script reads.
class Writer {
 public:
  Writer(const Scene& scene, const Recording& recording)
      : scene_(scene),
        recording_(recording),
        presenter_(scene, recording),
        drawn_(drawnBodies(scene, recording)),
        inSurface_(partsOfSurfaces(scene)) {
    dropPoints();
    findBounds();
    describe();
    addBodies();
    addJoints();
    addPoses();
    addContacts();
    addEvents();
    addClaims();
    if (!scene.bent.empty()) json_["bent"] = bentJson(scene, recording, json_["radius"]);
  }
  const Json& json() const { return json_; }

 private:
  // Of what bends only the points that joints hold are bodies here.
  void dropPoints() {
    const auto isHeld = [&](int body) {
      return std::any_of(scene_.world.joints.begin(), scene_.world.joints.end(),
                         [&](const JointDef& joint) {
                           return !isSeam(scene_, joint) && (joint.a == body || joint.b == body);
                         });
    };
    std::erase_if(drawn_, [&](const DrawnBody& one) {
      return inSurface_[static_cast<std::size_t>(one.body)] && !isHeld(one.body);
    });
  }

  // The box that holds every centre and contact.
  void findBounds() {
    low_ = high_ = recording_.samples.front().bodies.empty() ? Vec3::Zero().eval()
                   : drawn_.empty()                          ? Vec3::Zero().eval()
                                                             : drawn_.front().instance.position;
    const auto see = [&](const Vec3& p) {
      low_ = low_.cwiseMin(p);
      high_ = high_.cwiseMax(p);
    };
    for (const Sample& sample : recording_.samples) {
      for (const DrawnBody& body : drawn_)
        if (body.moves) see(sample.bodies[static_cast<std::size_t>(body.body)].x);
      for (const ContactSample& contact : sample.contacts) see(contact.p);
    }
    json_["low"] = {low_.x(), low_.y(), low_.z()};
    const Vec3 span = high_ - low_;
    json_["span"] = {span.x(), span.y(), span.z()};
  }

  void describe() {
    const Picture picture = presenter_.image(0);
    json_["title"] = scene_.title.empty() ? scene_.name : scene_.title;
    json_["subtitle"] = scene_.subtitle;
    json_["rate"] = recording_.rate;
    json_["count"] = recording_.samples.size();
    addCamera(picture.camera);
    json_["centre"] = list(picture.centre);
    json_["origin"] = list({picture.centre.x(), picture.floor.height, picture.centre.z()});
    json_["radius"] = brief(picture.radius);
    json_["floor"] = {{"visible", picture.floor.visible},
                      {"height", brief(picture.floor.height)},
                      {"grid", picture.floor.grid},
                      {"fine", picture.floor.fineGrid}};
    json_["contactReach"] = brief(contactReach(picture));
    json_["strobe"] = std::max(1L, std::lround(scene_.show.strobe * recording_.rate));
    json_["single"] = movingCount(scene_) == 1;
    json_["show"] = {{"forces", scene_.show.contact_forces},
                     {"glass", scene_.show.glass},
                     {"strobe", false},
                     {"paths", scene_.show.path}};
  }

  // Where the scene puts it by hand; else its direction and the points that it is to hold, in a
  // window of any shape.
  void addCamera(const Camera& atStart) {
    const bool byHand = scene_.camera.eye || scene_.camera.target;
    const PageView view = byHand ? PageView{atStart, {}} : pageView(scene_, recording_);
    json_["camera"] = {{"eye", list(view.camera.eye)},
                       {"target", list(view.camera.target)},
                       {"fov", view.camera.fov},
                       {"aspect", aspectOf(scene_)},
                       {"azimuth", view.camera.azimuth}};
    Json hold = Json::array();
    for (const Vec3& point : view.hold) hold.push_back(list(point));
    json_["hold"] = std::move(hold);
  }

  // Bodies as the first image has them: shape 0 box, 1 cylinder, 2 ellipsoid, 3 ball, 4 … meshes;
  // −1 is not drawn.
  void addBodies() {
    std::map<const Facets*, int> meshes;
    Json bodies = Json::array(), ranges = Json::array();
    std::string facets;
    std::size_t corners = 0;
    for (std::size_t i = 0; i < drawn_.size(); ++i) {
      const Instance instance =
          presenter_.body(recording_.samples.front(), static_cast<std::size_t>(drawn_[i].body));
      int shape = 0;
      if (instance.form == Form::Facets) {
        const auto [mesh, isNew] =
            meshes.emplace(instance.facets.get(), 4 + static_cast<int>(meshes.size()));
        shape = mesh->second;
        if (isNew) {
          ranges.push_back({corners, instance.facets->corners.size()});
          corners += instance.facets->corners.size();
          for (const Facets::Corner& corner : instance.facets->corners)
            for (const Eigen::Vector3f* v : {&corner.position, &corner.normal, &corner.toEdge})
              for (int axis = 0; axis < 3; ++axis) addFloat(facets, (*v)[axis]);
        }
      } else {
        shape = instance.form == Form::Box         ? 0
                : instance.form == Form::Cylinder  ? 1
                : instance.form == Form::Ellipsoid ? 2
                                                   : 3;
      }
      if (inSurface_[static_cast<std::size_t>(drawn_[i].body)]) shape = -1;
      bodies.push_back(jsonOf(drawn_[i], instance, shape));
    }
    json_["bodies"] = std::move(bodies);
    json_["meshes"] = std::move(ranges);
    json_["facets"] = packed(facets);
  }

  Json jsonOf(const DrawnBody& drawn, const Instance& instance, int shape) const {
    const BodyDef& body = scene_.world.bodies[static_cast<std::size_t>(drawn.body)];
    const Colour& back = instance.back ? *instance.back : instance.colour;
    Json json = {{"name", body.name},
                 {"shape", shape},
                 {"half", list(instance.scale)},
                 {"colour", rgb(instance.colour)},
                 {"back", rgb(back)},
                 {"thickness", brief(thicknessOf(instance))},
                 {"banded", instance.banded ? 1 : 0},
                 {"free", moves(body)},
                 {"pane", !moves(body) && instance.finish == Finish::Glass},
                 {"moves", drawn.moves}};
    if (drawn.moves) return json;
    const Quat& q = instance.orientation;
    const Vec3& x = instance.position;
    json["pose"] = {brief(x.x()), brief(x.y()), brief(x.z()), q.w(), q.x(), q.y(), q.z()};
    return json;
  }

  // Each by its ends, which the page carries with the bodies: the number there, or −1 for what
  // stays, and the anchor in the body's frame, or in the world's.
  void addJoints() {
    const BodySample* start = recording_.samples.front().bodies.data();
    const JointLooks looks =
        jointLooks(scene_, recording_.samples.front(), presenter_.image(0).radius);
    const auto numberOf = [&](int body) {
      const auto at = std::find_if(drawn_.begin(), drawn_.end(), [&](const DrawnBody& one) {
        return one.body == body && one.moves;
      });
      return at == drawn_.end() ? -1 : static_cast<int>(at - drawn_.begin());
    };
    Json joints = Json::array();
    for (const JointLook& look : looks.joints) {
      const auto end = [&](int body, const Vec3& p) {
        const int number = numberOf(body);
        if (number >= 0 || body == kNoBody) return Json{number, list(p)};
        return Json{-1, list(start[body].x + start[body].q * p)};
      };
      const bool turned = look.b != kNoBody && numberOf(look.b) < 0;
      joints.push_back({{"kind", jointName(look.kind).name},
                        {"a", end(look.a, look.pa)},
                        {"b", end(look.b, look.pb)},
                        {"axis", list(turned ? start[look.b].q * look.axis : look.axis)},
                        {"half", brief(look.half)},
                        {"levers", {look.leverToA, look.leverToB}}});
    }
    json_["joints"] = std::move(joints);
    json_["pin"] = {brief(looks.pin), rgb(looks.pinColour)};
    json_["rod"] = {brief(looks.rod), rgb(looks.rodColour)};
    json_["rail"] = brief(looks.rail);
  }

  void addPoses() {
    std::vector<std::vector<std::uint16_t>> series;
    for (const DrawnBody& drawn : drawn_) {
      if (!drawn.moves) continue;
      std::vector<std::vector<std::uint16_t>> seven(7);
      for (const Sample& sample : recording_.samples) {
        const BodySample& body = sample.bodies[static_cast<std::size_t>(drawn.body)];
        const Quat q = body.q.normalized();
        for (int axis = 0; axis < 3; ++axis)
          seven[axis].push_back(sixteenBits(body.x[axis], low_[axis], high_[axis] - low_[axis]));
        const double four[] = {q.w(), q.x(), q.y(), q.z()};
        for (int i = 0; i < 4; ++i)
          seven[3 + i].push_back(
              static_cast<std::uint16_t>(32768 + std::lround(32767.0 * four[i])));
      }
      for (std::vector<std::uint16_t>& one : seven) series.push_back(std::move(one));
    }
    json_["poses"] = packed(differences(series));
  }

  // Of each sample how many, then the point, and the force as a share of the longest arrow.
  void addContacts() {
    const double largest = largestContactForce(recording_);
    const double length = scene_.show.force_scale > 0.0 ? scene_.show.force_scale * largest
                                                        : 0.88 * typicalHeight(scene_);
    std::string bytes;
    for (const Sample& sample : recording_.samples) {
      std::vector<const ContactSample*> pushing;
      for (const ContactSample& contact : sample.contacts)
        if (contact.force.norm() >= 1e-3 * largest && pushing.size() < 65535)
          pushing.push_back(&contact);
      addWord(bytes, static_cast<std::uint16_t>(pushing.size()));
      for (const ContactSample* contact : pushing) {
        const Vec3 share = contact->force / std::max(largest, contact->force.norm());
        for (int axis = 0; axis < 3; ++axis)
          addWord(bytes, sixteenBits(contact->p[axis], low_[axis], high_[axis] - low_[axis]));
        for (int axis = 0; axis < 3; ++axis)
          addWord(bytes, static_cast<std::uint16_t>(std::lround(32767.0 * share[axis])));
      }
    }
    json_["arrow"] = brief(length);
    json_["contacts"] = packed(bytes);
  }

  // The largest impacts and what else happened, as many as a line can show.
  void addEvents() {
    constexpr std::size_t kMost = 1000;
    std::vector<const Event*> events;
    for (const Event& event : recording_.report.events) events.push_back(&event);
    std::stable_sort(events.begin(), events.end(),
                     [](const Event* a, const Event* b) { return a->j > b->j; });
    if (events.size() > kMost) events.resize(kMost);
    std::sort(events.begin(), events.end(), [](const Event* a, const Event* b) {
      return std::pair(a->t, a) < std::pair(b->t, b);
    });
    Json rows = Json::array();
    for (const Event* event : events)
      rows.push_back({brief(event->t), eventName(event->kind),
                      scene_.world.bodies[static_cast<std::size_t>(event->a)].name,
                      scene_.world.bodies[static_cast<std::size_t>(event->b)].name, brief(event->j),
                      list(event->p)});
    json_["events"] = std::move(rows);
  }

  void addClaims() {
    Json rows = Json::array(), curves = Json::array();
    for (const ClaimRow& row : judge(scene_, recording_).rows)
      rows.push_back({row.label, fmt::format("{:.6g}", row.measured),
                      fmt::format("{}{:.6g}", signOf(row.relation), row.exact),
                      fmt::format("{:.2g}", row.error), fmt::format("{:.2g}", row.allowed),
                      row.holds()});
    for (const Polyline& line : presenter_.image(0).lines) {
      if (line.stroke != Stroke::Dotted) continue;
      Json curve = Json::array();
      for (const Eigen::Vector3d& point : line.points) curve.push_back(list(point));
      curves.push_back(std::move(curve));
    }
    json_["claims"] = std::move(rows);
    json_["theory"] = std::move(curves);
  }

  const Scene& scene_;
  const Recording& recording_;
  Presenter presenter_;
  std::vector<DrawnBody> drawn_;
  std::vector<bool> inSurface_;  // per body of the scene
  Vec3 low_, high_;
  Json json_;
};

// JSON inside a script: no text of a scene may end it.
std::string inScript(const Json& json) {
  std::string text = json.dump(-1, ' ', false, Json::error_handler_t::replace), safe;
  for (const char c : text) safe += c == '<' ? std::string("\\u003c") : std::string(1, c);
  return safe;
}

void fill(std::string& page, const std::string& mark, const std::string& by) {
  page.replace(page.find(mark), mark.size(), by);
}

}  // namespace

std::string pageHtml(const Scene& scene, const Recording& recording) {
  std::string page = readFile(dataFolder("page") + "/player.html");
  fill(page, "/*BENT*/null",
       scene.bent.empty() ? "null" : readFile(dataFolder("page") + "/bent.js"));
  fill(page, "/*SHADERS*/null", inScript(shaders()));
  fill(page, "/*DATA*/null", inScript(Writer(scene, recording).json()));
  return page;
}

}  // namespace tumble
