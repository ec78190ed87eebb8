#include "app/export/gltf_bent.h"

#include <algorithm>
#include <map>
#include <set>

#include "app/present/bent.h"

namespace tumble {

namespace {

using Json = nlohmann::ordered_json;

constexpr int kLines = 1, kTriangles = 4;  // modes of primitives

// Pairs of points that strands run through; the first one of each is inside its body.
std::vector<std::uint32_t> linesOf(const BentDef& bent) {
  std::vector<std::uint32_t> ends;
  for (int p = 0; p + 1 < bent.count; ++p)
    if (p % bent.strand > 0 && (p + 1) % bent.strand > 0)
      ends.insert(ends.end(), {static_cast<std::uint32_t>(p), static_cast<std::uint32_t>(p + 1)});
  return ends;
}

std::vector<std::uint32_t> cornersOf(const BentDef& bent, bool turned) {
  std::vector<std::uint32_t> corners;
  for (const auto& [a, b, c] : bent.triangles)
    for (const int p : {a, turned ? c : b, turned ? b : c})
      corners.push_back(static_cast<std::uint32_t>(p));
  return corners;
}

}  // namespace

std::vector<std::size_t> bentKeys(const Recording& recording) {
  const std::size_t last = recording.samples.size() - 1, count = std::min(last, kMostBentKeys - 1);
  std::vector<std::size_t> keys{0};
  for (std::size_t k = 1; k <= count; ++k) keys.push_back((2 * k * last + count) / (2 * count));
  return keys;
}

std::vector<float> bentWeights(std::size_t keys) {
  std::vector<float> weights(keys * (keys - 1), 0.0f);
  for (std::size_t k = 1; k < keys; ++k) weights[k * (keys - 1) + k - 1] = 1.0f;
  return weights;
}

Json bentMesh(const BentDef& bent, const Recording& recording, const std::vector<std::size_t>& keys,
              int front, std::optional<int> back, GltfBinary& binary) {
  // Points that nothing goes through, as those inside a solid, are left out.
  const bool isFur = bent.strand > 0;
  std::vector<std::uint32_t> corners = isFur ? linesOf(bent) : cornersOf(bent, false);
  const std::set<std::uint32_t> drawn(corners.begin(), corners.end());
  std::map<std::uint32_t, std::uint32_t> number;
  for (const std::uint32_t p : drawn) number.emplace(p, static_cast<std::uint32_t>(number.size()));
  const auto numbered = [&](std::vector<std::uint32_t> list) {
    for (std::uint32_t& p : list) p = number.at(p);
    return binary.indices(list);
  };

  std::vector<Vec3> first;
  Json targets = Json::array(), places;
  for (const std::size_t key : keys) {
    const std::vector<Vec3> now = surfacePlaces(bent, recording.samples[key]);
    const bool isBase = first.empty();
    if (isBase) first = now;
    std::vector<Eigen::Vector3f> list;
    for (const std::uint32_t p : drawn)
      list.push_back((isBase ? now[p] : Vec3(now[p] - first[p])).cast<float>());
    const int accessor = binary.places(list);
    if (isBase)
      places = accessor;
    else
      targets.push_back({{"POSITION", accessor}});
  }

  Json primitives = Json::array();
  const auto add = [&](int indices, int material) {
    Json primitive = {{"attributes", {{"POSITION", places}}},
                      {"indices", indices},
                      {"mode", isFur ? kLines : kTriangles},
                      {"material", material}};
    if (!targets.empty()) primitive["targets"] = targets;
    primitives.push_back(std::move(primitive));
  };
  add(numbered(std::move(corners)), front);
  if (back) add(numbered(cornersOf(bent, true)), *back);
  return {{"name", bent.name}, {"primitives", std::move(primitives)}};
}

}  // namespace tumble
