#include "app/present/palette.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "app/claim/free_body.h"
#include "app/present/bent.h"

namespace tumble {

namespace {

// Six that stay apart for every kind of colour vision.
constexpr std::array kBodies = {hex(0x3A6FA8), hex(0xE8BE57), hex(0xB5485D),
                                hex(0xB4BBC4), hex(0x3F9C8C), hex(0x4B3F78)};
constexpr std::array kTime = {hex(0x2E6299), hex(0x6A93BF), hex(0xC2BDC6), hex(0xDDB27A),
                              hex(0xDB8A24)};
constexpr std::array kCividis = {hex(0x00224E), hex(0x123570), hex(0x3B496C),
                                 hex(0x575D6D), hex(0x707173), hex(0x8A8678),
                                 hex(0xA59C74), hex(0xC3B369), hex(0xE1CC55)};

constexpr std::array kSeries = {hex(0x3A6FA8), hex(0xD5401A), hex(0x3F9C8C), hex(0x4B3F78),
                                hex(0xBA9846), hex(0xB5485D), hex(0x8A9099), hex(0x2B2F36)};

// "ball" for "ball.3"; empty for a name without a number behind a dot.
std::string arrayOf(const std::string& name) {
  const std::size_t dot = name.rfind('.');
  if (dot == std::string::npos || dot + 1 == name.size()) return {};
  const bool number = name.find_first_not_of("0123456789", dot + 1) == std::string::npos;
  return number ? name.substr(0, dot) : std::string();
}

Colour single(const Rgb& rgb) {
  return {static_cast<float>(rgb[0]), static_cast<float>(rgb[1]), static_cast<float>(rgb[2])};
}

double restitutionOf(const WorldDef& world, int body) {
  return actingSurface(world, body).restitution;
}

double frictionOf(const WorldDef& world, int body) {
  return actingSurface(world, body).friction;
}

double massIfMoving(const WorldDef& world, int body) {
  return moves(world.bodies[body]) ? bodyMass(world.bodies[body]) : 0.0;
}

// Half bricks that end a course are bricks like the others.
bool wholesAndHalves(const std::vector<double>& masses, double low, double high) {
  const double tiny = 1e-9 * high;
  return std::abs(high - 2.0 * low) < tiny &&
         std::all_of(masses.begin(), masses.end(),
                     [&](double mass) { return mass - low < tiny || high - mass < tiny; });
}

// Where each body of an array stands in [0, 1] by the first quantity that varies within it. Points
// of a surface are copies of nothing: one at its edge weighs half.
std::map<std::string, double> placesInArrays(const Scene& scene) {
  const WorldDef& world = scene.world;
  const std::vector<bool> inSurface = partsOfSurfaces(scene);
  std::map<std::string, std::vector<int>> arrays;
  for (std::size_t i = 0; i < world.bodies.size(); ++i)
    if (const std::string array = arrayOf(world.bodies[i].name); !array.empty() && !inSurface[i])
      arrays[array].push_back(static_cast<int>(i));

  std::map<std::string, double> places;
  for (const auto& [name, copies] : arrays) {
    for (const auto quantity : {&restitutionOf, &frictionOf, &massIfMoving}) {
      std::vector<double> values;
      for (const int copy : copies) values.push_back(quantity(world, copy));
      const auto [low, high] = std::minmax_element(values.begin(), values.end());
      if (*high - *low <= 1e-9 * *high) continue;
      if (quantity == &massIfMoving && wholesAndHalves(values, *low, *high)) continue;
      for (std::size_t k = 0; k < copies.size(); ++k)
        places[world.bodies[copies[k]].name] = (values[k] - *low) / (*high - *low);
      break;
    }
  }
  return places;
}

}  // namespace

std::span<const Colour> timeStops() {
  return kTime;
}

std::span<const Colour> cividisStops() {
  return kCividis;
}

Colour ramp(std::span<const Colour> stops, double u) {
  const double place = std::clamp(u, 0.0, 1.0) * static_cast<double>(stops.size() - 1);
  const std::size_t k = std::min(static_cast<std::size_t>(place), stops.size() - 2);
  const float share = static_cast<float>(place - static_cast<double>(k));
  Colour mixed;
  for (std::size_t i = 0; i < 3; ++i)
    mixed[i] = stops[k][i] + share * (stops[k + 1][i] - stops[k][i]);
  return mixed;
}

Colour shade(const Colour& colour, float factor) {
  return {colour[0] * factor, colour[1] * factor, colour[2] * factor};
}

Colour seriesColour(std::size_t i) {
  return kSeries[i % kSeries.size()];
}

std::optional<Colour> backOf(const Scene& scene, std::size_t i) {
  if (i >= scene.backs.size() || !scene.backs[i]) return {};
  return single(*scene.backs[i]);
}

bool anyBack(const Scene& scene) {
  return std::any_of(scene.backs.begin(), scene.backs.end(),
                     [](const std::optional<Rgb>& back) { return back.has_value(); });
}

Colour backOfCloth(const Colour& front) {
  constexpr float kPaler = 0.55f, kDarker = 0.72f, kPale = 0.78f;
  const float light = 0.30f * front[0] + 0.59f * front[1] + 0.11f * front[2];
  if (light > kPale) return shade(front, kDarker);
  const Colour paper = hex(0xF8F8F6);
  Colour back;
  for (std::size_t k = 0; k < 3; ++k) back[k] = front[k] + kPaler * (paper[k] - front[k]);
  return back;
}

std::vector<Colour> bodyColours(const Scene& scene) {
  std::vector<Colour> colours;
  std::vector<std::string> kinds;
  const std::map<std::string, double> places = placesInArrays(scene);
  // A surface has one colour, whether some of its points stand or not.
  std::map<std::size_t, std::string> surfaces;
  for (const BentDef& bent : scene.bent)
    for (int p = 0; p < bent.count; ++p)
      surfaces[static_cast<std::size_t>(bent.first + p)] = bent.name;
  for (std::size_t i = 0; i < scene.world.bodies.size(); ++i) {
    const BodyDef& body = scene.world.bodies[i];
    if (i < scene.colours.size() && scene.colours[i]) {
      colours.push_back(single(*scene.colours[i]));
      continue;
    }
    const auto surface = surfaces.find(i);
    if (!moves(body) && surface == surfaces.end()) {
      colours.push_back(colour::kFixed);
      continue;
    }
    if (const auto place = places.find(body.name); place != places.end()) {
      colours.push_back(ramp(kCividis, place->second));
      continue;
    }
    // The copies of an array look the same; every other body is a kind of its own.
    const std::string array = surface == surfaces.end() ? arrayOf(body.name) : surface->second;
    const std::string kind = array.empty() ? body.name : array;
    const auto found = std::find(kinds.begin(), kinds.end(), kind);
    const std::size_t index = static_cast<std::size_t>(found - kinds.begin());
    if (found == kinds.end()) kinds.push_back(kind);
    colours.push_back(kBodies[index % kBodies.size()]);
  }
  return colours;
}

}  // namespace tumble
