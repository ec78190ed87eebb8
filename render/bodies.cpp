#include "render/bodies.h"

#include <algorithm>
#include <span>
#include <tuple>

namespace tumble {
namespace {

/// Places of the attributes in instance.glsl.
const std::vector<InstanceAttribute> kAttributes = {{2, 4, 0},  {3, 4, 4},  {4, 4, 8},
                                                    {5, 4, 12}, {6, 4, 16}, {7, 1, 20}};
constexpr int kStride = 21;

/// Balls of at most this radius [px] are discs of 16 and 32 corners, larger ones of 64:
/// the corners stand out by at most 0.13, 0.15 and, at 200 px, 0.12 px.
constexpr double kSmallBallRadius = 10.0, kBallRadius = 45.0;

/// What shines through the floor of a body that sank below it.
constexpr float kSunkOpacity = 0.35f;
constexpr float kFarSideOpacity = 0.35f;

/// What shaders call the surfaces.
constexpr const char* kSurfaceWords[] = {"BOX", "CYLINDER", "ELLIPSOID", "BALL", "FACETS"};

/// Bodies that differ by less than this look the same [px].
constexpr double kSamePlace = 0.2;

/// Whether two bodies of one form stand in one place, but for `slack` [m] at their surfaces.
bool coincide(const Instance& a, const Instance& b, double slack) {
  if (a.form != b.form || a.facets != b.facets ||
      (a.position - b.position).squaredNorm() > slack * slack || a.scale != b.scale)
    return false;
  const double angle = a.orientation.angularDistance(b.orientation);
  return angle * reachOf(a) <= slack;
}

/// Whether a ghost or a glass body is hidden by a later one in its place, as of something that
/// rests: drawn all the same, they would add up.
bool superseded(const std::vector<Instance>& bodies, std::size_t index, const Stage& stage) {
  const Instance& body = bodies[index];
  if (body.finish == Finish::Solid) return false;
  const double depth = (body.position - stage.projection.eye()).norm();
  const double slack = kSamePlace * stage.projection.pixelAtUnitDepth() * depth;
  return std::any_of(bodies.begin() + static_cast<std::ptrdiff_t>(index) + 1, bodies.end(),
                     [&](const Instance& later) { return coincide(body, later, slack); });
}

}  // namespace

Bodies::Bodies(const std::string& shaders) : shaders_(shaders), buffer_(gl::makeBuffer()) {
  struct Row {
    const char* fragment;
    const char* use;
  };
  const Row rows[kUses] = {{"body.frag", "SOLID"},       {"body.frag", "GHOST"},
                           {"body.frag", "GLASS"},       {"depth.frag", "DEPTH_ONLY"},
                           {"depth.frag", "FROM_LIGHT"}, {"above.frag", "FROM_ABOVE"},
                           {"above.frag", "CAST"}};
  for (const Row& row : rows) {
    for (const char* surface : kSurfaceWords) {
      programs_.emplace_back(shaders, "body.vert", row.fragment,
                             std::vector<std::string>{row.use, surface});
      programs_.back().use();
      programs_.back().set("shadowMap", 0);
      programs_.back().set("aboveMap", 1);
    }
  }
  meshes_.push_back(makeBox());
  meshes_.push_back(makeCylinder(48));
  meshes_.push_back(makeSphere(64, 32));
  for (const int sides : {16, 32, 64}) meshes_.push_back(makeDisc(sides));
}

Bodies::Group Bodies::groupOf(const Instance& instance, const Stage& stage, bool hasFloor) {
  if (instance.finish == Finish::Ghost) return kGhost;
  if (instance.finish == Finish::Glass) return kGlass;
  if (!hasFloor) return kSolid;
  // What sank by less than a pixel does not show.
  const double depth = (instance.position - stage.projection.eye()).dot(stage.projection.forward());
  const double pixel = stage.projection.pixelAtUnitDepth() * std::max(depth, 0.0);
  return lowestPoint(instance) < stage.origin.y() - pixel ? kSunk : kSolid;
}

Bodies::Shape Bodies::shapeOf(const Instance& instance, const Stage& stage) {
  if (instance.form == Form::Box) return kBox;
  if (instance.form == Form::Cylinder) return kCylinder;
  if (instance.form == Form::Ellipsoid) return kEllipsoid;
  const auto place = stage.projection.project(instance.position);
  if (!place) return kLargeBall;
  const double radius = instance.scale.x() / (place->z() * stage.projection.pixelAtUnitDepth());
  return radius <= kSmallBallRadius ? kSmallBall : radius <= kBallRadius ? kBall : kLargeBall;
}

Bodies::Surface Bodies::surfaceOf(int shape) {
  if (shape >= kShapes) return kFacetSurface;
  if (shape == kEllipsoid) return kEllipsoidSurface;
  return shape == kBox ? kBoxSurface : shape == kCylinder ? kCylinderSurface : kBallSurface;
}

// Surfaces stay in OpenGL's memory while pictures show them.
void Bodies::keepSurfaces(const Picture& picture) {
  std::map<std::shared_ptr<const Facets>, MeshBuffer> kept;
  for (const Instance& body : picture.instances) {
    if (body.form != Form::Facets || kept.count(body.facets) > 0) continue;
    auto known = surfaces_.extract(body.facets);
    if (known.empty())
      kept.emplace(body.facets, makeFacets(*body.facets));
    else
      kept.insert(std::move(known));
  }
  surfaces_ = std::move(kept);
}

// Only solids hide, and only they are asked for: ghosts and glass add to each other. With one
// sample a pixel the rasteriser itself leaves out what stands behind.
std::vector<Cover::Faces> Bodies::hiddenFaces(const Picture& picture, const Stage& stage) {
  std::vector<Cover::Faces> hidden(picture.instances.size(), 0);
  if (stage.samples == 1) return hidden;
  Cover cover(stage);
  for (const Instance& body : picture.instances)
    if (body.form == Form::Box && groupOf(body, stage, picture.floor.visible) == kSolid)
      cover.add(body);
  for (std::size_t i = 0; i < hidden.size(); ++i) {
    const Instance& body = picture.instances[i];
    if (body.finish == Finish::Solid && body.form != Form::Facets)
      hidden[i] = cover.hiddenFaces(body);
  }
  return hidden;
}

void Bodies::load(const Picture& picture, const Stage& stage) {
  // Each facetted surface is a shape of its own, numbered in the order of the picture.
  keepSurfaces(picture);
  drawn_.clear();
  for (const MeshBuffer& mesh : meshes_) drawn_.push_back(&mesh);
  std::map<const Facets*, int> numbers;
  for (const Instance& body : picture.instances) {
    if (body.form != Form::Facets) continue;
    const int next = static_cast<int>(drawn_.size());
    if (numbers.emplace(body.facets.get(), next).second)
      drawn_.push_back(&surfaces_.at(body.facets));
  }

  // Groups, layers and shapes stand together; within them glass goes from far to near, solids go
  // from near to far, so that what is hidden is seldom shaded, and ghosts keep their order.
  const std::vector<Cover::Faces> hidden = hiddenFaces(picture, stage);
  struct Key {
    int group, layer, shape;
    double nearness;
    std::size_t index;
  };
  std::vector<Key> order;
  for (std::size_t i = 0; i < picture.instances.size(); ++i) {
    const Instance& instance = picture.instances[i];
    if (superseded(picture.instances, i, stage)) continue;
    const Group group =
        hidden[i] == Cover::kAll ? kUnseen : groupOf(instance, stage, picture.floor.visible);
    const double distance = (instance.position - stage.projection.eye()).norm();
    const int shape = instance.form == Form::Facets ? numbers.at(instance.facets.get())
                                                    : shapeOf(instance, stage);
    order.push_back({group, instance.layer, shape,
                     group == kGlass   ? -distance
                     : group == kSolid ? distance
                                       : 0.0,
                     i});
  }
  std::stable_sort(order.begin(), order.end(), [](const Key& a, const Key& b) {
    return std::tie(a.group, b.layer, a.shape, a.nearness) <
           std::tie(b.group, a.layer, b.shape, b.nearness);
  });

  instances_.clear();
  for (std::vector<Batch>& batches : batches_) batches.clear();
  for (const Key& key : order) {
    const Instance& from = picture.instances[key.index];
    const Eigen::Vector3f centre = stage.toStage(from.position), half = from.scale.cast<float>();
    const Eigen::Vector4f turn = from.orientation.normalized().coeffs().cast<float>();
    const bool ghost = from.finish == Finish::Ghost;
    const float alpha = ghost ? from.alpha : from.finish == Finish::Glass ? 0.35f : 1.0f;
    const Colour& back = from.back ? *from.back : from.colour;
    std::vector<Batch>& batches = batches_[key.group];
    if (batches.empty() || batches.back().layer != key.layer || batches.back().shape != key.shape)
      batches.push_back({key.layer, key.shape, static_cast<int>(instances_.size()), 0});
    ++batches.back().count;
    instances_.push_back({{centre.x(), centre.y(), centre.z()},
                          alpha,
                          {turn.x(), turn.y(), turn.z(), turn.w()},
                          {half.x(), half.y(), half.z()},
                          ghost ? 0.0f : 1.0f,
                          {from.colour[0], from.colour[1], from.colour[2]},
                          static_cast<float>(thicknessOf(from)),
                          {back[0], back[1], back[2]},
                          from.banded ? 1.0f : 0.0f,
                          static_cast<float>(hidden[key.index])});
  }
  gl::upload(GL_ARRAY_BUFFER, buffer_, instances_);
}

void Bodies::draw(Use use, Group group, float opacity, float keepAbove) const {
  for (const Batch& batch : batches_[group]) draw(use, batch, opacity, keepAbove);
}

void Bodies::draw(Use use, const Batch& batch, float opacity, float keepAbove) const {
  const Surface surface = surfaceOf(batch.shape);
  const gl::Program& program = programs_[static_cast<std::size_t>(use) * kSurfaces + surface];
  program.use();
  program.set("opacity", opacity);
  program.set("keepAbove", keepAbove);
  drawn_[batch.shape]->draw(buffer_, kStride, kAttributes, batch.first, batch.count);
}

void Bodies::drawMasks() {
  if (masks_.empty())
    for (const char* surface : kSurfaceWords)
      masks_.emplace_back(shaders_, "body.vert", "mask.frag", std::vector<std::string>{surface});
  for (const std::vector<Batch>& batches : batches_) {
    for (const Batch& batch : batches) {
      const gl::Program& program = masks_[surfaceOf(batch.shape)];
      program.use();
      program.set("keepAbove", 0.0f);
      drawn_[batch.shape]->draw(buffer_, kStride, kAttributes, batch.first, batch.count);
    }
  }
}

// Of closed surfaces what faces the light shades all that is behind it. The map is a mirror image.
void Bodies::drawFromLight() const {
  glEnable(GL_CULL_FACE);
  glCullFace(GL_FRONT);
  for (const Group group : {kSolid, kSunk, kUnseen}) draw(kLightUse, group);
  glCullFace(GL_BACK);
  glDisable(GL_CULL_FACE);
}

void Bodies::drawFromAbove() const {
  for (int group = 0; group < kGroups; ++group) draw(kAboveUse, static_cast<Group>(group));
  glEnable(GL_CULL_FACE);
  for (int group = 0; group < kGroups; ++group) draw(kCastUse, static_cast<Group>(group));
  glDisable(GL_CULL_FACE);
}

// Solids of a layer claim the samples where they are seen: no ghost of a lower one comes there.
void Bodies::drawAndClaim(Group group, float opacity, float keepAbove) const {
  for (const Batch& batch : batches_[group]) {
    glStencilFunc(GL_ALWAYS, batch.layer > 0 ? 1 : 0, ~0u);
    draw(kSolidUse, batch, opacity, keepAbove);
  }
}

void Bodies::drawSolids() const {
  glEnable(GL_CULL_FACE);
  glEnable(GL_STENCIL_TEST);
  glStencilOp(GL_KEEP, GL_KEEP, GL_REPLACE);
  glDisable(GL_BLEND);
  drawAndClaim(kSolid);
  glEnable(GL_BLEND);
  glEnable(GL_CLIP_DISTANCE0);
  drawAndClaim(kSunk, 1.0f, 1.0f);
  drawAndClaim(kSunk, kSunkOpacity, -1.0f);
  glDisable(GL_CLIP_DISTANCE0);
  glDisable(GL_STENCIL_TEST);
  glDisable(GL_CULL_FACE);
}

// From the highest layer down; each claims the samples where it is seen.
void Bodies::drawGhosts() const {
  const std::vector<Batch>& ghosts = batches_[kGhost];
  glEnable(GL_CULL_FACE);
  glEnable(GL_STENCIL_TEST);
  for (auto first = ghosts.begin(), last = first; first != ghosts.end(); first = last) {
    last =
        std::find_if(first, ghosts.end(), [&](const Batch& b) { return b.layer != first->layer; });
    glStencilFunc(GL_EQUAL, 0, ~0u);
    glStencilOp(GL_KEEP, GL_KEEP, GL_KEEP);
    glColorMask(GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);
    for (const Batch& batch : std::span(first, last)) draw(kDepthUse, batch);
    glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    glStencilOp(GL_KEEP, GL_KEEP, GL_INCR);
    glDepthMask(GL_FALSE);
    glDepthFunc(GL_EQUAL);
    for (const Batch& batch : std::span(first, last)) draw(kGhostUse, batch);
    glDepthFunc(GL_LESS);
    glDepthMask(GL_TRUE);
  }
  glDisable(GL_STENCIL_TEST);
  glDisable(GL_CULL_FACE);
}

void Bodies::drawGlass() const {
  glEnable(GL_CULL_FACE);
  glDepthMask(GL_FALSE);
  glCullFace(GL_FRONT);
  draw(kGlassUse, kGlass, kFarSideOpacity);
  glCullFace(GL_BACK);
  glDepthMask(GL_TRUE);
  glColorMask(GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);
  draw(kDepthUse, kGlass);
  glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
  glDepthMask(GL_FALSE);
  glDepthFunc(GL_EQUAL);
  draw(kGlassUse, kGlass);
  glDepthFunc(GL_LESS);
  glDepthMask(GL_TRUE);
  glDisable(GL_CULL_FACE);
}

}  // namespace tumble
