// What a sample says in single numbers, by name: of a body "ball.y", of the run "energy".
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "app/record/recording.h"

namespace tumble {

/// What a quantity is read off.
struct Instant {
  const Scene& scene;
  const Sample& sample;
  int body = 0;                 ///< of quantities of a body
  Mat3 inertia = Mat3::Zero();  ///< [kg m²] of that body, about its centre of mass, body frame
};

/// A row of one of the two tables. World frame, SI.
struct Quantity {
  const char *name, *unit, *meaning;
  double (*of)(const Instant&);
};
const std::vector<Quantity>& bodyQuantities();
const std::vector<Quantity>& runQuantities();

/// A quantity of a scene that is read off many samples.
class Gauge {
 public:
  /// Nothing if the scene has none of that name.
  static std::optional<Gauge> named(const Scene& scene, const std::string& name);
  double operator()(const Sample& sample) const;

  const Quantity& quantity() const { return *quantity_; }
  std::optional<int> body() const { return body_; }

 private:
  const Scene* scene_ = nullptr;
  const Quantity* quantity_ = nullptr;
  std::optional<int> body_;
  Mat3 inertia_ = Mat3::Zero();
};

/// What to say of a name that a scene does not have: ", did you mean …" and the quantities there
/// are.
std::string hintOfQuantity(const Scene& scene, const std::string& name);

}  // namespace tumble
