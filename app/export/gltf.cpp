#include "app/export/gltf.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <map>
#include <nlohmann/json.hpp>
#include <tuple>

#include "app/export/drawn.h"
#include "app/export/gltf_physics.h"

namespace tumble {

namespace {

using Json = nlohmann::ordered_json;

constexpr int kFloat = 5126, kUnsigned = 5125;             // component types
constexpr int kArrayBuffer = 34962, kIndexBuffer = 34963;  // targets of views

/// The binary half of the file, and what tells of it in the other.
class Binary {
 public:
  /// Values of `width` components each; the number of the accessor.
  int floats(const std::vector<float>& values, int width, bool bounded, int target = 0) {
    const int accessor =
        add(values.data(), values.size() * sizeof(float), values.size() / width, kFloat,
            width == 1   ? "SCALAR"
            : width == 3 ? "VEC3"
                         : "VEC4",
            target);
    if (bounded) bound(values, width, accessors_[accessor]);
    return accessor;
  }
  int indices(const std::vector<std::uint32_t>& values) {
    return add(values.data(), values.size() * sizeof(std::uint32_t), values.size(), kUnsigned,
               "SCALAR", kIndexBuffer);
  }
  void tell(Json& json) const {
    json["accessors"] = accessors_;
    json["bufferViews"] = views_;
    json["buffers"] = Json::array({{{"byteLength", bytes_.size()}}});
  }
  const std::string& bytes() const { return bytes_; }

 private:
  int add(const void* data, std::size_t size, std::size_t count, int component, const char* type,
          int target) {
    Json view = {{"buffer", 0}, {"byteOffset", bytes_.size()}, {"byteLength", size}};
    if (target) view["target"] = target;
    views_.push_back(std::move(view));
    bytes_.append(static_cast<const char*>(data), size);  // of four bytes each: stays aligned
    accessors_.push_back({{"bufferView", views_.size() - 1},
                          {"componentType", component},
                          {"count", count},
                          {"type", type}});
    return static_cast<int>(accessors_.size()) - 1;
  }

  static void bound(const std::vector<float>& values, int width, Json& accessor) {
    std::vector<float> lo(values.begin(), values.begin() + width), hi = lo;
    for (std::size_t i = 0; i < values.size(); ++i) {
      lo[i % width] = std::min(lo[i % width], values[i]);
      hi[i % width] = std::max(hi[i % width], values[i]);
    }
    accessor["min"] = lo;
    accessor["max"] = hi;
  }

  Json accessors_ = Json::array(), views_ = Json::array();
  std::string bytes_;
};

// sRGB to linear light, IEC 61966-2-1.
double linear(float channel) {
  return channel <= 0.04045f ? channel / 12.92 : std::pow((channel + 0.055) / 1.055, 2.4);
}

std::vector<float> flat(const std::vector<Eigen::Vector3f>& points) {
  std::vector<float> values;
  for (const Eigen::Vector3f& p : points) values.insert(values.end(), {p.x(), p.y(), p.z()});
  return values;
}

/// Numbers, as float has them: what the file says and what the animation's first key says agree.
Json vector(const Vec3& v) {
  return {static_cast<float>(v.x()), static_cast<float>(v.y()), static_cast<float>(v.z())};
}

Json quaternion(const Quat& q) {
  const Quat unit = q.normalized();
  return {static_cast<float>(unit.x()), static_cast<float>(unit.y()), static_cast<float>(unit.z()),
          static_cast<float>(unit.w())};
}

/// Builds the file body by body.
class Writer {
 public:
  Writer(const Scene& scene, const Recording& recording)
      : scene_(scene), recording_(recording), physics_(scene) {
    json_["asset"] = {{"version", "2.0"}, {"generator", "tumble " TUMBLE_VERSION}};
    json_["scene"] = 0;
    std::vector<float> times;
    for (const Sample& sample : recording.samples) times.push_back(static_cast<float>(sample.t));
    times_ = binary_.floats(times, 1, true);
    for (const DrawnBody& drawn : drawnBodies(scene, recording)) add(drawn);
  }

  std::string file() {
    Json roots = Json::array();
    for (const int root : roots_) roots.push_back(root);
    json_["scenes"] = Json::array({{{"name", scene_.title}, {"nodes", roots}}});
    json_["nodes"] = nodes_;
    json_["meshes"] = meshes_;
    json_["materials"] = materials_;
    binary_.tell(json_);
    if (!channels_.empty())
      json_["animations"] =
          Json::array({{{"name", "run"}, {"samplers", samplers_}, {"channels", channels_}}});
    physics_.tell(json_);
    return packed();
  }

 private:
  // A node of the body's own frame; what scales the shared mesh is a node below it.
  void add(const DrawnBody& drawn) {
    const BodyDef& body = scene_.world.bodies[drawn.body];
    const Instance& instance = drawn.instance;
    const int shown = static_cast<int>(nodes_.size());
    nodes_.push_back({{"mesh", meshIndex(instance)}, {"scale", vector(instance.scale)}});
    Json node = {{"name", body.name},
                 {"translation", vector(instance.position)},
                 {"rotation", quaternion(instance.orientation)},
                 {"children", Json::array({shown})}};
    physics_.add(drawn, shown, node);
    nodes_.push_back(std::move(node));
    roots_.push_back(shown + 1);
    if (drawn.moves) animate(drawn.body, shown + 1);
  }

  void animate(int body, int node) {
    std::vector<float> places, turns;
    for (const Sample& sample : recording_.samples) {
      const BodySample& now = sample.bodies[body];
      const Quat q = now.q.normalized();
      for (int i = 0; i < 3; ++i) places.push_back(static_cast<float>(now.x[i]));
      for (int i = 0; i < 4; ++i) turns.push_back(static_cast<float>(q.coeffs()[i]));
    }
    channel(binary_.floats(places, 3, false), node, "translation");
    channel(binary_.floats(turns, 4, false), node, "rotation");
  }

  void channel(int output, int node, const char* path) {
    channels_.push_back(
        {{"sampler", samplers_.size()}, {"target", {{"node", node}, {"path", path}}}});
    samplers_.push_back({{"input", times_}, {"output", output}, {"interpolation", "LINEAR"}});
  }

  // A mesh for each form and colour; those of one form share their numbers.
  int meshIndex(const Instance& instance) {
    const int material = materialIndex(instance.colour);
    const auto form = std::pair(instance.form, instance.facets.get());
    const auto known = meshOfForm_.find({form.first, form.second, material});
    if (known != meshOfForm_.end()) return known->second;
    if (!attributes_.contains(form)) {
      const IndexedMesh mesh = meshOf(instance);
      attributes_[form] = {
          {"attributes",
           {{"POSITION", binary_.floats(flat(mesh.positions), 3, true, kArrayBuffer)},
            {"NORMAL", binary_.floats(flat(mesh.normals), 3, false, kArrayBuffer)}}},
          {"indices", binary_.indices(mesh.indices)}};
    }
    Json primitive = attributes_[form];
    primitive["material"] = material;
    meshes_.push_back({{"primitives", Json::array({std::move(primitive)})}});
    return meshOfForm_[{form.first, form.second, material}] = static_cast<int>(meshes_.size()) - 1;
  }

  int materialIndex(const Colour& colour) {
    const auto [place, isNew] = materialOf_.emplace(colour, static_cast<int>(materials_.size()));
    if (isNew)
      materials_.push_back(
          {{"pbrMetallicRoughness",
            {{"baseColorFactor", {linear(colour[0]), linear(colour[1]), linear(colour[2]), 1.0}},
             {"metallicFactor", 0.0},
             {"roughnessFactor", 0.7}}}});
    return place->second;
  }

  // Header, JSON and binary chunk, each filled up to four bytes (§4.4).
  std::string packed() const {
    std::string text = json_.dump(-1, ' ', false, Json::error_handler_t::replace);
    text.resize((text.size() + 3) / 4 * 4, ' ');
    std::string bytes = binary_.bytes();
    bytes.resize((bytes.size() + 3) / 4 * 4, '\0');
    std::string file = "glTF";
    const auto word = [&](std::size_t value) {
      for (int shift = 0; shift < 32; shift += 8) file += static_cast<char>(value >> shift);
    };
    word(2);
    word(12 + 8 + text.size() + 8 + bytes.size());
    word(text.size());
    file += "JSON" + text;
    word(bytes.size());
    file += std::string("BIN\0", 4) + bytes;
    return file;
  }

  const Scene& scene_;
  const Recording& recording_;
  Physics physics_;
  Binary binary_;
  Json json_;
  Json nodes_ = Json::array(), meshes_ = Json::array(), materials_ = Json::array(),
       samplers_ = Json::array(), channels_ = Json::array();
  std::vector<int> roots_;
  std::map<Colour, int> materialOf_;
  std::map<std::pair<Form, const Facets*>, Json> attributes_;
  std::map<std::tuple<Form, const Facets*, int>, int> meshOfForm_;
  int times_ = 0;
};

}  // namespace

std::string gltfBinary(const Scene& scene, const Recording& recording) {
  return Writer(scene, recording).file();
}

}  // namespace tumble
