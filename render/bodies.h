// Boxes, cylinders, balls, ellipsoids and facets: sorted into batches once per picture, drawn by
// every pass that needs them.
#pragma once

#include <array>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "render/cover.h"
#include "render/gl.h"
#include "render/mesh.h"
#include "render/picture.h"
#include "render/stage.h"

namespace tumble {

class Bodies {
 public:
  /// @param shaders  folder of the GLSL files
  explicit Bodies(const std::string& shaders);

  void load(const Picture& picture, const Stage& stage);

  void drawFromLight() const;  ///< depth of what is solid, into the shadow map
  void drawFromAbove() const;  ///< contact, height and cast shadow, into the map from above
  void drawSolids() const;     ///< with what sank below the floor shown through it
  void drawGhosts() const;     ///< at each sample one: the nearest of the highest layer
  void drawGlass() const;      ///< far sides, then at each sample the nearest near side
  void drawMasks();            ///< all, each in its own colour, and how far they are

 private:
  enum Group { kSolid, kSunk, kUnseen, kGhost, kGlass, kGroups };
  enum Shape { kBox, kCylinder, kEllipsoid, kSmallBall, kBall, kLargeBall, kShapes };
  enum Use { kSolidUse, kGhostUse, kGlassUse, kDepthUse, kLightUse, kAboveUse, kCastUse, kUses };
  enum Surface {
    kBoxSurface,
    kCylinderSurface,
    kEllipsoidSurface,
    kBallSurface,
    kFacetSurface,
    kSurfaces
  };

  /// As instance.glsl reads it.
  struct Body {
    float centre[3], alpha;
    float turn[4];
    float half[3], present;
    float colour[3], thickness;
    float back[3], banded;
    float hidden;
  };
  /// Instances of one group, layer and shape, which stand together.
  struct Batch {
    int layer, shape, first, count;
  };

  static Group groupOf(const Instance& instance, const Stage& stage, bool hasFloor);
  static Shape shapeOf(const Instance& instance, const Stage& stage);
  static Surface surfaceOf(int shape);
  static std::vector<Cover::Faces> hiddenFaces(const Picture& picture, const Stage& stage);
  void keepSurfaces(const Picture& picture);
  void draw(Use use, Group group, float opacity = 1.0f, float keepAbove = 0.0f) const;
  void draw(Use use, const Batch& batch, float opacity = 1.0f, float keepAbove = 0.0f) const;
  void drawAndClaim(Group group, float opacity = 1.0f, float keepAbove = 0.0f) const;

  std::string shaders_;
  std::vector<gl::Program> programs_;                             // [use][surface]
  std::vector<gl::Program> masks_;                                // [surface], made when asked for
  std::vector<MeshBuffer> meshes_;                                // [shape]
  std::map<std::shared_ptr<const Facets>, MeshBuffer> surfaces_;  // of the latest picture
  std::vector<const MeshBuffer*> drawn_;  // [shape], facets behind the others
  gl::Object buffer_;
  std::vector<Body> instances_;
  std::array<std::vector<Batch>, kGroups> batches_;  // [group], higher layers first
};

}  // namespace tumble
