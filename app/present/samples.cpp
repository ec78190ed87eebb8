#include "app/present/samples.h"

#include <algorithm>

#include "app/present/palette.h"
#include "app/record/bodies.h"
#include "sim/math/frames.h"

namespace tumble {

namespace {

constexpr int kMostPoints = 3000;  // of one body
constexpr double kDot = 0.011;     // radius of a dot, in bounding radii of the body

}  // namespace

void addSamplePoints(const Scene& scene, const Sample& sample, Picture& picture) {
  for (std::size_t i = 0; i < sample.bodies.size(); ++i) {
    const BodyDef& body = scene.world.bodies[i];
    const InertiaMethod* method = findInertiaMethod(body.inertiaBy);
    if (!moves(body) || !method->spread) continue;
    Instance dot;
    dot.form = Form::Sphere;
    dot.scale.setConstant(kDot * boundingRadius(body.shape));
    dot.colour = colour::kForce;
    const int count = std::min(body.samples, kMostPoints);
    for (const Vec3& p_B : pointsInside(body.shape, *method->spread, count)) {
      dot.position = toWorld({sample.bodies[i].x, sample.bodies[i].q}, p_B);
      picture.instances.push_back(dot);
    }
  }
}

}  // namespace tumble
