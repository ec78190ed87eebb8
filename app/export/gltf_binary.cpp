#include "app/export/gltf_binary.h"

#include <algorithm>

namespace tumble {

namespace {

using Json = nlohmann::ordered_json;

constexpr int kFloat = 5126, kUnsigned = 5125;             // component types
constexpr int kArrayBuffer = 34962, kIndexBuffer = 34963;  // targets of views

void bound(const std::vector<float>& values, int width, Json& accessor) {
  std::vector<float> lo(values.begin(), values.begin() + width), hi = lo;
  for (std::size_t i = 0; i < values.size(); ++i) {
    lo[i % width] = std::min(lo[i % width], values[i]);
    hi[i % width] = std::max(hi[i % width], values[i]);
  }
  accessor["min"] = lo;
  accessor["max"] = hi;
}

}  // namespace

int GltfBinary::floats(const std::vector<float>& values, int width, bool bounded, Use use) {
  const int accessor =
      add(values.data(), values.size() * sizeof(float), values.size() / width, kFloat,
          width == 1   ? "SCALAR"
          : width == 3 ? "VEC3"
                       : "VEC4",
          use == Use::Vertices ? kArrayBuffer : 0);
  if (bounded) bound(values, width, accessors_[accessor]);
  return accessor;
}

int GltfBinary::places(const std::vector<Eigen::Vector3f>& points) {
  std::vector<float> values;
  for (const Eigen::Vector3f& p : points) values.insert(values.end(), {p.x(), p.y(), p.z()});
  return floats(values, 3, true, Use::Vertices);
}

int GltfBinary::indices(const std::vector<std::uint32_t>& values) {
  return add(values.data(), values.size() * sizeof(std::uint32_t), values.size(), kUnsigned,
             "SCALAR", kIndexBuffer);
}

void GltfBinary::tell(Json& json) const {
  json["accessors"] = accessors_;
  json["bufferViews"] = views_;
  json["buffers"] = Json::array({{{"byteLength", bytes_.size()}}});
}

int GltfBinary::add(const void* data, std::size_t size, std::size_t count, int component,
                    const char* type, int target) {
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

}  // namespace tumble
