#include "app/export/gltf.h"

#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <numeric>
#include <optional>
#include <tuple>

#include "app/export/drawn.h"
#include "app/export/gltf_bent.h"
#include "app/export/gltf_binary.h"
#include "app/export/gltf_physics.h"
#include "app/present/bent.h"
#include "app/present/palette.h"

namespace tumble {

namespace {

using Json = nlohmann::ordered_json;

// sRGB to linear light, IEC 61966-2-1.
double linear(float channel) {
  return channel <= 0.04045f ? channel / 12.92 : std::pow((channel + 0.055) / 1.055, 2.4);
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
    const std::vector<bool> inSurface = partsOfSurfaces(scene);
    for (const DrawnBody& drawn : drawnBodies(scene, recording))
      if (!inSurface[static_cast<std::size_t>(drawn.body)]) add(drawn);
    addBent();
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

  void addBent() {
    const std::vector<std::size_t> keys = bentKeys(recording_);
    const std::vector<Colour> colours = bodyColours(scene_);
    std::optional<std::pair<int, int>> times;  // and weights, which all share
    for (const BentDef& bent : scene_.bent) {
      const Colour front = colours[static_cast<std::size_t>(bent.first)];
      const int node = static_cast<int>(nodes_.size());
      nodes_.push_back({{"name", bent.name}, {"mesh", meshes_.size()}});
      std::optional<int> back;  // a solid shows none, nor do strands
      if (bent.columns > 0) back = materialIndex(backOf(bent, front));
      meshes_.push_back(bentMesh(bent, recording_, keys, materialIndex(front), back, binary_));
      roots_.push_back(node);
      if (keys.size() < 2) continue;
      if (!times) times = {timesOf(keys), binary_.floats(bentWeights(keys.size()), 1, false)};
      channel(times->first, times->second, node, "weights");
    }
  }

  int timesOf(const std::vector<std::size_t>& samples) {
    std::vector<float> times;
    for (const std::size_t k : samples)
      times.push_back(static_cast<float>(recording_.samples[k].t));
    return binary_.floats(times, 1, true);
  }

  void animate(int body, int node) {
    if (!times_) {
      std::vector<std::size_t> all(recording_.samples.size());
      std::iota(all.begin(), all.end(), std::size_t{0});
      times_ = timesOf(all);
    }
    std::vector<float> places, turns;
    for (const Sample& sample : recording_.samples) {
      const BodySample& now = sample.bodies[body];
      const Quat q = now.q.normalized();
      for (int i = 0; i < 3; ++i) places.push_back(static_cast<float>(now.x[i]));
      for (int i = 0; i < 4; ++i) turns.push_back(static_cast<float>(q.coeffs()[i]));
    }
    channel(*times_, binary_.floats(places, 3, false), node, "translation");
    channel(*times_, binary_.floats(turns, 4, false), node, "rotation");
  }

  void channel(int input, int output, int node, const char* path) {
    channels_.push_back(
        {{"sampler", samplers_.size()}, {"target", {{"node", node}, {"path", path}}}});
    samplers_.push_back({{"input", input}, {"output", output}, {"interpolation", "LINEAR"}});
  }

  // A mesh for each form and colour; those of one form share their numbers.
  int meshIndex(const Instance& instance) {
    const int material = materialIndex(instance.colour);
    const auto form = std::pair(instance.form, instance.facets.get());
    const auto known = meshOfForm_.find({form.first, form.second, material});
    if (known != meshOfForm_.end()) return known->second;
    if (!attributes_.contains(form)) {
      const IndexedMesh mesh = meshOf(instance);
      attributes_[form] = {{"attributes",
                            {{"POSITION", binary_.places(mesh.positions)},
                             {"NORMAL", binary_.places(mesh.normals)}}},
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
  GltfBinary binary_;
  Json json_;
  Json nodes_ = Json::array(), meshes_ = Json::array(), materials_ = Json::array(),
       samplers_ = Json::array(), channels_ = Json::array();
  std::vector<int> roots_;
  std::map<Colour, int> materialOf_;
  std::map<std::pair<Form, const Facets*>, Json> attributes_;
  std::map<std::tuple<Form, const Facets*, int>, int> meshOfForm_;
  std::optional<int> times_;  // of all samples
};

}  // namespace

std::string gltfBinary(const Scene& scene, const Recording& recording) {
  return Writer(scene, recording).file();
}

}  // namespace tumble
