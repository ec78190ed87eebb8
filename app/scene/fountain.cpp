// Bodies thrown one after another from one place: a fountain that flows already.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "app/scene/generator.h"
#include "app/scene/random.h"
#include "sim/math/rotation.h"

namespace tumble {

namespace {

struct Fountain {
  Vec3 base = Vec3::Zero(), gravity = Vec3::Zero();
  double speed = 5.0, cosine = 1.0;  // of the largest angle from the vertical
  double ages[2] = {0.0, 0.0};
  Random random;

  // Uniform over the cap of the unit sphere about the vertical: the height uniform, the direction
  // round it from a point of the unit disc.
  Vec3 direction() {
    const double height = random.between(cosine, 1.0);
    for (;;) {
      const double x = random.between(-1.0, 1.0);
      const double z = random.between(-1.0, 1.0);
      const double square = x * x + z * z;
      if (square > 1.0 || square < 1e-6) continue;
      const double scale = std::sqrt(std::max(0.0, 1.0 - height * height) / square);
      return {scale * x, height, scale * z};
    }
  }

  // Where the parabola is at the copy's age; a negative age has yet to come through the base.
  std::string place(BodyDef& copy) {
    if (std::get_if<HalfSpace>(&copy.shape)) return "a fountain is made of bodies, not of planes";
    const double age = random.between(ages[0], ages[1]);
    const Vec3 v0 = speed * direction();
    copy.position = base + age * (v0 + 0.5 * age * gravity);
    copy.velocity = v0 + age * gravity;
    return "";
  }
};

}  // namespace

Generator makeFountain(Section& array, Weather& weather) {
  const int count = readCount(array);
  std::string name;
  array.read("name", name);
  double spread = 10.0;  // [deg]
  Fountain fountain{.gravity = weather.gravity, .random = Random(weather.seed, name)};
  array.read("base", fountain.base, any("m"));
  array.read("speed", fountain.speed, positive("m/s"));
  array.read("spread", spread, {0.0, 180.0, false, "deg"});
  array.read("ages", fountain.ages, 2, any("s"));
  if (fountain.ages[0] > fountain.ages[1])
    array.complain("ages", "expected [youngest, oldest] in order");
  double sine = 0.0;
  sinCos(spread * (std::numbers::pi / 180.0), sine, fountain.cosine);
  const auto place = [fountain](int, BodyDef& copy) mutable { return fountain.place(copy); };
  return {count, place, {"position", "origin", "velocity"}};
}

}  // namespace tumble
