#include "app/scene/mesh_file.h"

#define TINYOBJLOADER_IMPLEMENTATION
#define TINYOBJLOADER_USE_DOUBLE
#include <tiny_obj_loader.h>

#include <filesystem>
#include <sstream>

#include "app/file/data.h"
#include "app/file/file.h"
#include "app/scene/obj_lines.h"

namespace tumble {

namespace fs = std::filesystem;

namespace {

constexpr std::size_t kMostPoints = 1'000'000;

struct Raw {
  std::vector<Vec3> points;
  std::vector<std::vector<int>> faces;
};

void addPoint(void* raw, double x, double y, double z, double) {
  static_cast<Raw*>(raw)->points.emplace_back(x, y, z);
}

// A file counts points from 1.
void addFace(void* target, tinyobj::index_t* indices, int count) {
  Raw& raw = *static_cast<Raw*>(target);
  std::vector<int> face;
  for (int k = 0; k < count; ++k) face.push_back(indices[k].vertex_index - 1);
  raw.faces.push_back(std::move(face));
}

// Line, counted from 1, on which face number `face` of a cleaned text stands; 0 for none.
int lineOf(const std::string& text, int face) {
  std::istringstream lines(text);
  std::string line;
  int number = 0, seen = -1;
  while (std::getline(lines, line)) {
    ++number;
    if (line.starts_with("f ") && ++seen == face) return number;
  }
  return 0;
}

// The checked text of a file, or why it is refused.
std::string cleaned(const std::string& text, const std::string& file) {
  try {
    return cleanObj(text, file);
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

}  // namespace

std::shared_ptr<const Polyhedron> parseMesh(const std::string& given, const std::string& file) {
  const std::string text = cleaned(given, file);
  Raw raw;
  tinyobj::callback_t callbacks;
  callbacks.vertex_cb = addPoint;
  callbacks.index_cb = addFace;
  std::istringstream in(text);
  std::string warnings, errors;
  if (!tinyobj::LoadObjWithCallback(in, callbacks, &raw, nullptr, &warnings, &errors))
    throw MeshError(file + ": not an OBJ file: " + errors);
  if (raw.points.size() > kMostPoints) throw MeshError(file + ": more than a million points");
  try {
    return std::make_shared<const Polyhedron>(
        makePolyhedron(std::move(raw.points), std::move(raw.faces)));
  } catch (const NotASolid& reason) {
    const int line = reason.face() < 0 ? 0 : lineOf(text, reason.face());
    throw MeshError(file + (line > 0 ? ":" + std::to_string(line) : "") + ": " + reason.what());
  }
}

std::shared_ptr<const Polyhedron> readMesh(const std::string& path) {
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
