// What bends, in a glTF file: a surface, or the lines of strands, that goes from key to key.
#pragma once

#include <optional>

#include "app/export/gltf_binary.h"
#include "app/record/recording.h"

namespace tumble {

/// The samples at which a glTF file has what bends as it is: all, or so many of them, the first
/// and the last among them, about evenly apart. Between two of them each point goes straight on.
inline constexpr std::size_t kMostBentKeys = 60;
std::vector<std::size_t> bentKeys(const Recording& recording);

/// The mesh of one: places at the first key, and for each other key a morph target (§3.7.2.2), how
/// far all points have come from there. Of a cloth its triangles between its points, seen from both
/// sides, of a solid its skin, of fur each strand as a line. Without normals, which viewers find
/// for the triangles as they stand.
/// @param front, back  numbers of materials; without one for the back it is seen from the front
/// alone
nlohmann::ordered_json bentMesh(const BentDef& bent, const Recording& recording,
                                const std::vector<std::size_t>& keys, int front,
                                std::optional<int> back, GltfBinary& binary);

/// The weights of the targets at each key, its own being 1.
std::vector<float> bentWeights(std::size_t keys);

}  // namespace tumble
