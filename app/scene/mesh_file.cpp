#include "app/scene/mesh_file.h"

#include <filesystem>

#include "app/file/data.h"
#include "app/file/file.h"
#include "app/scene/obj_lines.h"
#include "sim/shape/written.h"

namespace tumble {

namespace fs = std::filesystem;

namespace {

constexpr std::size_t kMostPoints = 1'000'000;

// What a file says, or why it is refused.
ObjFile read(const std::string& text, const std::string& file) {
  try {
    return readObj(text, file);
  } catch (const ObjError& reason) {
    throw MeshError(reason.what());
  }
}

// What stands at a path that is no regular file.
std::string kindOf(fs::file_type type) {
  if (type == fs::file_type::directory) return "a folder";
  if (type == fs::file_type::character || type == fs::file_type::block) return "a device";
  return "no regular file";
}

// The lines of a solid's faces, from those of a file's: a face with as many corners as written is
// one, another has been cut into triangles, two fewer than its corners.
std::vector<int> linesOf(const Polyhedron& solid, const std::vector<int>& written,
                         const std::vector<std::size_t>& corners) {
  std::vector<int> lines;
  for (std::size_t f = 0; f < written.size(); ++f) {
    const bool whole = solid.faces[lines.size()].size() == corners[f];
    lines.insert(lines.end(), whole ? 1 : corners[f] - 2, written[f]);
  }
  return lines;
}

}  // namespace

std::string MeshFile::lineOf(int face) const {
  return face < 0 ? "" : ":" + std::to_string(lines[static_cast<std::size_t>(face)]);
}

MeshFile parseMesh(const std::string& text, const std::string& file) {
  ObjFile obj = read(text, file);
  if (obj.points.size() > kMostPoints) throw MeshError(file + ": more than a million points");
  std::vector<std::size_t> corners;
  for (const std::vector<int>& face : obj.faces) corners.push_back(face.size());
  MeshFile mesh{nullptr, std::move(obj.lines)};
  mesh.grain = obj.grain;
  if (!obj.points.empty()) mesh.first = obj.points.front();
  try {
    mesh.solid = std::make_shared<const Polyhedron>(
        makeWritten(std::move(obj.points), std::move(obj.faces), obj.grain));
  } catch (const NotASolid& reason) {
    throw MeshError(file + mesh.lineOf(reason.face()) + ": " + reason.what());
  }
  mesh.lines = linesOf(*mesh.solid, mesh.lines, corners);
  return mesh;
}

MeshFile readMesh(const std::string& path) {
  std::string text;
  try {
    text = readFile(path);
  } catch (const FileError& reason) {
    throw MeshError(reason.what());
  }
  return parseMesh(text, fs::path(path).filename().string());
}

std::string meshPath(const std::string& mesh, const std::string& sceneFile) {
  const fs::path places[] = {fs::path(sceneFile).parent_path() / mesh,
                             fs::path(dataFolder("meshes")) / mesh};
  std::error_code ignored;
  for (const fs::path& place : places)
    if (fs::is_regular_file(place, ignored)) return place.string();
  for (const fs::path& place : places)
    if (const fs::file_status status = fs::status(place, ignored); fs::exists(status))
      throw MeshError("expected an OBJ file, found " + kindOf(status.type()) + " '" +
                      place.string() + "'");
  const std::string second = places[1] == places[0] ? "" : " or '" + places[1].string() + "'";
  throw MeshError("no file '" + places[0].string() + "'" + second);
}

}  // namespace tumble
