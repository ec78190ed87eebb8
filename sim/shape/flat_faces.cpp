#include "sim/shape/flat_faces.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <optional>
#include <utility>

namespace tumble {
namespace {

using Edge = std::pair<int, int>;

const Vec3& at(const Polyhedron& solid, int i) {
  return solid.points[static_cast<std::size_t>(i)];
}

/// Calls act(from, to) for each edge of a face.
template <class Action>
void forEachEdge(const std::vector<int>& face, Action act) {
  for (std::size_t k = 0; k < face.size(); ++k) act(face[k], face[(k + 1) % face.size()]);
}

// Of the tolerance: what a face may be off its plane at the far end of the solid. The plane of a
// narrow one turns by what its corners are off over its width.
constexpr double kTilt = 500.0;

double longestEdge(const Polyhedron& solid, const std::vector<int>& face) {
  double longest = 0.0;
  forEachEdge(face, [&](int i, int j) {
    longest = std::max(longest, (at(solid, j) - at(solid, i)).norm());
  });
  return longest;
}

/// Which triangles make one face: the number of its face for each triangle. The largest triangle
/// left is the first of a face; it takes what hangs together with it and lies in its plane.
std::vector<int> groupsOf(const Polyhedron& solid, double tolerance) {
  const std::size_t count = solid.faces.size();
  double size = 0.0;
  for (const Vec3& p : solid.points) size = std::max(size, (p - solid.points[0]).norm());
  std::vector<Vec3> area;
  std::map<Edge, int> faceOf;
  for (std::size_t f = 0; f < count; ++f) {
    area.push_back(areaVector(solid, solid.faces[f]));
    forEachEdge(solid.faces[f], [&](int i, int j) { faceOf[{i, j}] = static_cast<int>(f); });
  }
  std::vector<std::size_t> order(count);
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t f, std::size_t g) {
    return area[f].squaredNorm() > area[g].squaredNorm();
  });
  std::vector<int> group(count, -1);
  int groups = 0;
  for (const std::size_t seed : order) {
    if (group[seed] >= 0) continue;
    const Vec3 n = area[seed].normalized(), foot = at(solid, solid.faces[seed][0]);
    const double width = area[seed].norm() / longestEdge(solid, solid.faces[seed]);
    const double flatness = tolerance * std::min(1.0, kTilt * width / size);
    std::vector<std::size_t> found = {seed};
    group[seed] = groups;
    for (std::size_t next = 0; next < found.size(); ++next)
      forEachEdge(solid.faces[found[next]], [&](int i, int j) {
        const auto other = static_cast<std::size_t>(faceOf.at({j, i}));
        const std::vector<int>& corners = solid.faces[other];
        const bool flat = std::all_of(corners.begin(), corners.end(), [&](int c) {
          return std::abs(n.dot(at(solid, c) - foot)) <= flatness;
        });
        if (group[other] >= 0 || !flat) return;
        group[other] = groups;
        found.push_back(other);
      });
    ++groups;
  }
  return group;
}

/// The ring of edges around each group; an empty one where they are no single ring.
std::vector<std::vector<int>> ringsOf(const Polyhedron& solid, const std::vector<int>& group) {
  std::map<Edge, int> groupOf;
  for (std::size_t f = 0; f < group.size(); ++f)
    forEachEdge(solid.faces[f], [&](int i, int j) { groupOf[{i, j}] = group[f]; });
  const int groups = 1 + *std::max_element(group.begin(), group.end());
  std::vector<std::map<int, int>> after(static_cast<std::size_t>(groups));
  std::vector<std::size_t> edges(after.size(), 0);
  for (const auto& [edge, g] : groupOf) {
    if (groupOf.at({edge.second, edge.first}) == g) continue;
    after[static_cast<std::size_t>(g)][edge.first] = edge.second;
    ++edges[static_cast<std::size_t>(g)];
  }
  std::vector<std::vector<int>> rings;
  for (std::size_t g = 0; g < after.size(); ++g) {
    std::vector<int> ring;
    if (after[g].size() == edges[g] && !after[g].empty()) {
      const int first = after[g].begin()->first;
      int i = first;
      do {
        ring.push_back(i);
        i = after[g].at(i);
      } while (i != first && ring.size() <= edges[g]);
    }
    if (ring.size() != edges[g]) ring.clear();
    rings.push_back(std::move(ring));
  }
  return rings;
}

/// How many faces meet at each point.
std::vector<int> facesAt(const Polyhedron& solid, const std::vector<std::vector<int>>& faces) {
  std::vector<int> meeting(solid.points.size(), 0);
  for (const std::vector<int>& face : faces)
    for (const int i : face) ++meeting[static_cast<std::size_t>(i)];
  return meeting;
}

/// Without the points at which fewer than three faces meet.
std::vector<std::vector<int>> withoutOthers(const Polyhedron& solid,
                                            std::vector<std::vector<int>> faces) {
  const std::vector<int> meeting = facesAt(solid, faces);
  for (std::vector<int>& face : faces)
    std::erase_if(face, [&](int i) { return meeting[static_cast<std::size_t>(i)] < 3; });
  return faces;
}

/// V − E + F of faces with three corners or more; nothing if one has fewer.
std::optional<std::ptrdiff_t> eulerOf(const Polyhedron& solid,
                                      const std::vector<std::vector<int>>& faces) {
  std::size_t corners = 0;
  for (const std::vector<int>& face : faces) {
    if (face.size() < 3) return {};
    corners += face.size();
  }
  const std::vector<int> meeting = facesAt(solid, faces);
  const auto points =
      std::count_if(meeting.begin(), meeting.end(), [](int count) { return count > 0; });
  return points - static_cast<std::ptrdiff_t>(corners / 2) +
         static_cast<std::ptrdiff_t>(faces.size());
}

}  // namespace

FlatFaces allFacesOf(const Polyhedron& solid) {
  FlatFaces all{solid.faces, std::vector<int>(solid.faces.size())};
  std::iota(all.first.begin(), all.first.end(), 0);
  return all;
}

FlatFaces flatFacesOf(const Polyhedron& solid, double tolerance) {
  const std::vector<int> group = groupsOf(solid, tolerance);
  const std::vector<std::vector<int>> rings = ringsOf(solid, group);
  FlatFaces flat;
  std::vector<char> taken(rings.size(), 0);
  for (std::size_t f = 0; f < group.size(); ++f) {
    const auto g = static_cast<std::size_t>(group[f]);
    if (taken[g] != 0) continue;
    taken[g] = rings[g].empty() ? 0 : 1;
    flat.faces.push_back(rings[g].empty() ? solid.faces[f] : rings[g]);
    flat.first.push_back(static_cast<int>(f));
  }
  flat.faces = withoutOthers(solid, std::move(flat.faces));
  return eulerOf(solid, flat.faces) == eulerOf(solid, solid.faces) ? flat : allFacesOf(solid);
}

Polyhedron withFlatFaces(const Polyhedron& triangles, double tolerance) {
  const std::vector<std::vector<int>> faces =
      withoutOthers(triangles, ringsOf(triangles, groupsOf(triangles, tolerance)));
  if (eulerOf(triangles, faces) != 2) return triangles;
  Polyhedron flat;
  const std::vector<int> meeting = facesAt(triangles, faces);
  std::vector<int> number(meeting.size(), -1);
  for (std::size_t i = 0; i < meeting.size(); ++i) {
    if (meeting[i] == 0) continue;
    number[i] = static_cast<int>(flat.points.size());
    flat.points.push_back(triangles.points[i]);
  }
  for (const std::vector<int>& face : faces) {
    flat.faces.emplace_back();
    for (const int i : face) flat.faces.back().push_back(number[static_cast<std::size_t>(i)]);
  }
  return flat;
}

}  // namespace tumble
