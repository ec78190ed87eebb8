#include "sim/collide/parts.h"

#include <algorithm>

#include "sim/collide/pair_table.h"
#include "sim/math/frames.h"

namespace tumble {
namespace {

// Parts this near, per size of the body, touch: more than the rounding of where they stand.
constexpr double kFlush = 1e-9;

// Fills in which parts touch each other.
void findBeside(Parts& parts) {
  parts.beside.assign(parts.list.size(), {});
  const auto touches = [&](int i, int j) {
    const PosedPart &a = parts.list[static_cast<std::size_t>(i)],
                    &b = parts.list[static_cast<std::size_t>(j)];
    return pairs::separationOf(a.solid, a.pose, b.solid, b.pose) <= parts.flush;
  };
  const double reach = 0.0;
  forNear(parts.tree, parts.tree, Seat{}, reach, [&](int i, int j) {
    if (i != j && touches(i, j)) parts.beside[static_cast<std::size_t>(i)].push_back(j);
  });
  for (std::vector<int>& list : parts.beside) std::sort(list.begin(), list.end());
}

}  // namespace

Parts partsOf(const Compound& compound) {
  Parts parts;
  parts.list = convexParts(compound);
  parts.level = kFlush * boundingRadius(compound);
  parts.flush = std::max(compound.slack, parts.level);
  std::vector<Aabb> boxes;
  for (const PosedPart& part : parts.list) {
    const Aabb own = boundingBox(part.solid, Pose{});
    parts.size.push_back(0.5 * (own.hi - own.lo).maxCoeff());
    parts.radius.push_back(boundingRadius(part.solid));
    boxes.push_back(boundingBox(part.solid, part.pose, parts.flush));
  }
  parts.tree = BoxTree(boxes);
  parts.leaf.resize(parts.list.size());
  for (std::size_t k = 0; k < parts.tree.nodes().size(); ++k)
    if (const int part = parts.tree.nodes()[k].item; part >= 0)
      parts.leaf[static_cast<std::size_t>(part)] = static_cast<int>(k);
  findBeside(parts);
  return parts;
}

Shape readyShape(Shape shape) {
  if (Compound* compound = std::get_if<Compound>(&shape))
    compound->ready = std::make_shared<const Parts>(partsOf(*compound));
  return shape;
}

PartView::PartView(const Shape& shape, const Pose& pose) : shape_(shape), pose_(pose) {
  if (const Compound* compound = std::get_if<Compound>(&shape)) {
    if (!compound->ready) own_ = std::make_shared<const Parts>(partsOf(*compound));
    parts_ = compound->ready ? compound->ready.get() : own_.get();
    tree_ = &parts_->tree;
  } else {
    const Aabb box = plane() ? Aabb{} : boundingBox(shape, Pose{});
    single_ = BoxTree(std::span<const Aabb>(&box, 1));
    tree_ = &single_;
  }
}

Pose PartView::poseOf(int part) const {
  if (!parts_) return pose_;
  const Pose& own = parts_->list[static_cast<std::size_t>(part)].pose;
  return {toWorld(pose_, own.x), (pose_.q * own.q).normalized()};
}

}  // namespace tumble
