#include "app/scene/piece_store.h"

#include <fmt/format.h>

#include <chrono>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <sstream>

#include "app/file/digest.h"
#include "app/file/file.h"

namespace tumble {

namespace fs = std::filesystem;

namespace {

// The first word of a file; another one for each way of finding pieces.
constexpr const char* kVersion = "tumble-pieces-18";
constexpr double kLong = 0.1;  // s
constexpr std::size_t kMostCorners = 1'000'000;

std::string keyOf(const Polyhedron& solid, PieceKind kind, double tolerance, double grain) {
  std::string text =
      fmt::format("{} {} {:a} {:a}\n", kVersion, static_cast<int>(kind), tolerance, grain);
  for (const Vec3& p : solid.points) text += fmt::format("{:a} {:a} {:a}\n", p.x(), p.y(), p.z());
  for (const std::vector<int>& face : solid.faces)
    text += fmt::format("{}\n", fmt::join(face, " "));
  const std::uint64_t first = digest(text);
  return fmt::format("{:016x}{:016x}", first, digest(text, ~first));
}

// Where pieces are kept; "" if nobody says where.
fs::path folder() {
  if (const char* cache = std::getenv("XDG_CACHE_HOME"); cache && *cache)
    return fs::path(cache) / "tumble";
  const char* home = std::getenv("HOME");
  return home && *home ? fs::path(home) / ".cache" / "tumble" : fs::path();
}

std::shared_ptr<const Pieces> fromFile(const fs::path& path) {
  try {
    std::error_code ignored;
    return fs::is_regular_file(path, ignored) ? piecesFrom(readFile(path.string())) : nullptr;
  } catch (const FileError&) {
    return nullptr;
  }
}

void toFile(const fs::path& path, const Pieces& pieces) {
  try {
    makeFolder(path.parent_path().string());
    writeFile(path.string(), textOf(pieces));
  } catch (const FileError&) {  // found again the next time
  }
}

bool readVector(std::istream& in, Vec3& v) {
  std::string word;
  for (int k = 0; k < 3; ++k) {
    if (!(in >> word)) return false;
    char* end = nullptr;
    v[k] = std::strtod(word.c_str(), &end);
    if (*end != '\0' || !std::isfinite(v[k])) return false;
  }
  return true;
}

bool readHull(std::istream& in, Pieces& pieces) {
  std::size_t points = 0, faces = 0;
  Hull hull;
  Polyhedron solid;
  if (!(in >> points >> faces) || points + faces > kMostCorners || !readVector(in, hull.origin))
    return false;
  solid.points.resize(points);
  for (Vec3& p : solid.points)
    if (!readVector(in, p)) return false;
  for (std::size_t f = 0; f < faces; ++f) {
    std::size_t corners = 0;
    if (!(in >> corners) || corners > points) return false;
    std::vector<int>& face = solid.faces.emplace_back(corners);
    for (int& p : face)
      if (!(in >> p) || p < 0 || static_cast<std::size_t>(p) >= points) return false;
  }
  findEdges(solid);
  hull.solid = std::make_shared<const Polyhedron>(std::move(solid));
  pieces.hulls.push_back(std::move(hull));
  return true;
}

}  // namespace

std::string textOf(const Pieces& pieces) {
  std::string text =
      fmt::format("{} {:a} {:a}\n", pieces.hulls.size(), pieces.excess, pieces.slack);
  const auto vector = [](const Vec3& v) {
    return fmt::format("{:a} {:a} {:a}\n", v.x(), v.y(), v.z());
  };
  for (const Hull& hull : pieces.hulls) {
    text += fmt::format("{} {}\n", hull.solid->points.size(), hull.solid->faces.size());
    text += vector(hull.origin);
    for (const Vec3& p : hull.solid->points) text += vector(p);
    for (const std::vector<int>& face : hull.solid->faces)
      text += fmt::format("{} {}\n", face.size(), fmt::join(face, " "));
  }
  return fmt::format("{} {:016x}\n{}", kVersion, digest(text), text);
}

std::shared_ptr<const Pieces> piecesFrom(const std::string& text) {
  const std::size_t line = text.find('\n');
  if (line == std::string::npos) return nullptr;
  const std::string body = text.substr(line + 1);
  if (text.substr(0, line) != fmt::format("{} {:016x}", kVersion, digest(body))) return nullptr;
  std::istringstream in(body);
  Pieces pieces;
  std::size_t count = 0;
  std::string excess, slack;
  if (!(in >> count >> excess >> slack) || count > kMostPieces) return nullptr;
  pieces.excess = std::strtod(excess.c_str(), nullptr);
  pieces.slack = std::strtod(slack.c_str(), nullptr);
  for (std::size_t k = 0; k < count; ++k)
    if (!readHull(in, pieces)) return nullptr;
  return std::make_shared<const Pieces>(std::move(pieces));
}

std::shared_ptr<const Pieces> storedPieces(const Polyhedron& solid, PieceKind kind,
                                           double tolerance, double grain,
                                           const std::string& name) {
  static std::map<std::string, std::shared_ptr<const Pieces>> known;
  const std::string key = keyOf(solid, kind, tolerance, grain);
  std::shared_ptr<const Pieces>& pieces = known[key];
  if (pieces) return pieces;
  const fs::path store = folder(), path = store / ("pieces-" + key + ".txt");
  if (!store.empty() && (pieces = fromFile(path))) return pieces;
  const auto begin = std::chrono::steady_clock::now();
  pieces = std::make_shared<const Pieces>(piecesOf(solid, kind, tolerance, grain));
  const std::chrono::duration<double> took = std::chrono::steady_clock::now() - begin;
  if (took.count() > kLong)
    fmt::print(stderr, "{}: {} convex piece{}, found in {:.2f} s\n", name, pieces->hulls.size(),
               pieces->hulls.size() == 1 ? "" : "s", took.count());
  if (!store.empty()) toFile(path, *pieces);
  return pieces;
}

}  // namespace tumble
