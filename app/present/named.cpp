#include "app/present/named.h"

namespace tumble {

void addNamedArrow(const Vec3& from, const Vec3& vector, const Colour& colour,
                   const std::string& name, Picture& picture, bool left) {
  if (vector.norm() < 1e-9) return;
  picture.arrows.push_back({from, from + vector, colour, 1.9f});
  Label label;
  label.anchor = from + vector;
  const Vec3 right = (picture.camera.target - picture.camera.eye).cross(Vec3::UnitY());
  const bool turned = right.dot(vector) < 0.0;
  if (left)
    label.offset = {-8.0, 0.0};
  else
    label.offset = turned ? Eigen::Vector2d(0.0, -9.0) : Eigen::Vector2d(8.0, 0.0);
  label.align = left ? Align::Right : Align::Left;
  label.text = name;
  label.size = 16.0f;
  label.italic = true;
  label.clear = true;
  label.colour = colour;
  picture.labels.push_back(label);
}

}  // namespace tumble
