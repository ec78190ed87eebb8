// The few solids that everything is drawn with, to be drawn many at a time.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <vector>

#include "render/gl.h"
#include "render/picture.h"

namespace tumble {

struct Vertex {
  Eigen::Vector4f position;  ///< w is free
  Eigen::Vector3f normal;
  Eigen::Vector3f toEdge = Eigen::Vector3f::Zero();  ///< of facets
};

/// An attribute that differs from instance to instance: its place in the shader, size and offset in
/// floats.
struct InstanceAttribute {
  GLuint location;
  GLint size;
  int offset;
};

/// Triangles in OpenGL's memory; counter-clockwise from outside.
class MeshBuffer {
 public:
  MeshBuffer(const std::vector<Vertex>& vertices, const std::vector<GLuint>& indices);
  /// Draws `count` copies with attributes from a buffer of `stride` floats per instance.
  void draw(GLuint buffer, int stride, const std::vector<InstanceAttribute>& attributes, int first,
            int count) const;

 private:
  gl::Object array_, vertices_, indices_;
  GLsizei count_ = 0;
};

MeshBuffer makeFacets(const Facets& facets);
MeshBuffer makeBox();                         ///< corners at ±1
MeshBuffer makeCylinder(int sides);           ///< radius 1 about Y, from −1 to 1
MeshBuffer makeSphere(int sides, int rings);  ///< radius 1, poles on Y
MeshBuffer makeDisc(int sides);   ///< in x and y, as large as the unit circle, facing +z
MeshBuffer makeQuad();            ///< x from 0 to 1, y from −1 to 1
MeshBuffer makeArrow(int sides);  ///< for arrow.vert

}  // namespace tumble
