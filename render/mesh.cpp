#include "render/mesh.h"

#include <cmath>
#include <cstddef>
#include <numbers>

namespace tumble {
namespace {

using Eigen::Vector3f;

/// Place of `toEdge` in body.vert, beyond those of instances.
constexpr GLuint kToEdge = 8;

struct Triangles {
  std::vector<Vertex> vertices;
  std::vector<GLuint> indices;

  GLuint add(float x, float y, float z, const Vector3f& normal, float w = 0.0f) {
    vertices.push_back({{x, y, z, w}, normal, Vector3f::Zero()});
    return static_cast<GLuint>(vertices.size() - 1);
  }
  void triangle(GLuint a, GLuint b, GLuint c) { indices.insert(indices.end(), {a, b, c}); }
  void quad(GLuint a, GLuint b, GLuint c, GLuint d) {
    triangle(a, b, c);
    triangle(a, c, d);
  }
  MeshBuffer mesh() const { return MeshBuffer(vertices, indices); }
};

float turn(int i, int sides) {
  return 2.0f * std::numbers::pi_v<float> * static_cast<float>(i) / static_cast<float>(sides);
}

void enable(GLuint location, GLint size, int stride, std::size_t offset, GLuint divisor) {
  glEnableVertexAttribArray(location);
  glVertexAttribPointer(location, size, GL_FLOAT, GL_FALSE, stride,
                        reinterpret_cast<const void*>(offset));
  glVertexAttribDivisor(location, divisor);
}

}  // namespace

MeshBuffer::MeshBuffer(const std::vector<Vertex>& vertices, const std::vector<GLuint>& indices)
    : array_(gl::makeVertexArray()),
      vertices_(gl::makeBuffer()),
      indices_(gl::makeBuffer()),
      count_(static_cast<GLsizei>(indices.size())) {
  glBindVertexArray(array_);
  gl::upload(GL_ARRAY_BUFFER, vertices_, vertices);
  gl::upload(GL_ELEMENT_ARRAY_BUFFER, indices_, indices);
  enable(0, 4, sizeof(Vertex), offsetof(Vertex, position), 0);
  enable(1, 3, sizeof(Vertex), offsetof(Vertex, normal), 0);
  enable(kToEdge, 3, sizeof(Vertex), offsetof(Vertex, toEdge), 0);
}

void MeshBuffer::draw(GLuint buffer, int stride, const std::vector<InstanceAttribute>& attributes,
                      int first, int count) const {
  if (count == 0) return;
  glBindVertexArray(array_);
  glBindBuffer(GL_ARRAY_BUFFER, buffer);
  const int bytes = stride * static_cast<int>(sizeof(float));
  for (const InstanceAttribute& attribute : attributes)
    enable(attribute.location, attribute.size, bytes,
           static_cast<std::size_t>(first) * bytes + attribute.offset * sizeof(float), 1);
  glDrawElementsInstanced(GL_TRIANGLES, count_, GL_UNSIGNED_INT, nullptr, count);
}

MeshBuffer makeFacets(const Facets& facets) {
  Triangles surface;
  for (const Facets::Corner& corner : facets.corners) {
    const Vector3f& p = corner.position;
    surface.indices.push_back(surface.add(p.x(), p.y(), p.z(), corner.normal));
    surface.vertices.back().toEdge = corner.toEdge;
  }
  return surface.mesh();
}

MeshBuffer makeBox() {
  Triangles box;
  for (int axis = 0; axis < 3; ++axis) {
    for (const float side : {-1.0f, 1.0f}) {
      Vector3f normal = Vector3f::Zero(), u = Vector3f::Zero();
      normal[axis] = side;
      u[(axis + 1) % 3] = 1.0f;
      const Vector3f v = normal.cross(u);
      const auto corner = [&](float a, float b) {
        const Vector3f p = normal + a * u + b * v;
        return box.add(p.x(), p.y(), p.z(), normal);
      };
      const GLuint first = corner(-1, -1);
      corner(1, -1), corner(1, 1), corner(-1, 1);
      box.quad(first, first + 1, first + 2, first + 3);
    }
  }
  return box.mesh();
}

MeshBuffer makeCylinder(int sides) {
  Triangles cylinder;
  const GLuint top = cylinder.add(0, 1, 0, Vector3f::UnitY());
  const GLuint bottom = cylinder.add(0, -1, 0, -Vector3f::UnitY());
  for (int i = 0; i <= sides; ++i) {
    const float x = std::cos(turn(i, sides)), z = std::sin(turn(i, sides));
    const GLuint first = cylinder.add(x, 1, z, {x, 0, z});
    cylinder.add(x, -1, z, {x, 0, z});
    cylinder.add(x, 1, z, Vector3f::UnitY());
    cylinder.add(x, -1, z, -Vector3f::UnitY());
    if (i == sides) break;
    const GLuint next = first + 4;
    cylinder.quad(first, next, next + 1, first + 1);
    cylinder.triangle(top, next + 2, first + 2);
    cylinder.triangle(bottom, first + 3, next + 3);
  }
  return cylinder.mesh();
}

MeshBuffer makeSphere(int sides, int rings) {
  Triangles sphere;
  for (int ring = 0; ring <= rings; ++ring) {
    const float down = 0.5f * turn(ring, rings);
    for (int i = 0; i <= sides; ++i) {
      const Vector3f p(std::sin(down) * std::cos(turn(i, sides)), std::cos(down),
                       std::sin(down) * std::sin(turn(i, sides)));
      const GLuint here = sphere.add(p.x(), p.y(), p.z(), p);
      if (ring == rings || i == sides) continue;
      const GLuint below = here + static_cast<GLuint>(sides) + 1;
      sphere.quad(here, here + 1, below + 1, below);
    }
  }
  return sphere.mesh();
}

MeshBuffer makeDisc(int sides) {
  Triangles disc;
  const float radius = std::sqrt(turn(1, sides) / std::sin(turn(1, sides)));
  for (int i = 0; i < sides; ++i)
    disc.add(radius * std::cos(turn(i, sides)), radius * std::sin(turn(i, sides)), 0,
             Vector3f::UnitZ());
  for (int i = 2; i < sides; ++i)
    disc.triangle(0, static_cast<GLuint>(i - 1), static_cast<GLuint>(i));
  return disc.mesh();
}

MeshBuffer makeQuad() {
  Triangles quad;
  quad.add(0, -1, 0, Vector3f::UnitZ());
  quad.add(1, -1, 0, Vector3f::UnitZ());
  quad.add(1, 1, 0, Vector3f::UnitZ());
  quad.add(0, 1, 0, Vector3f::UnitZ());
  quad.quad(0, 1, 2, 3);
  return quad.mesh();
}

MeshBuffer makeArrow(int sides) {
  // Half section from base to tip: radius 0 none, 1 shaft, 2 head; at 0 base, 1 back of the head, 2
  // tip; the normal of the piece, outward and along.
  struct Piece {
    float radiusFrom, atFrom, radiusTo, atTo;
    Vector3f normal;
  };
  const Piece pieces[] = {{0, 0, 1, 0, {0, -1, 0}},
                          {1, 0, 1, 1, {1, 0, 0}},
                          {1, 1, 2, 1, {0, -1, 0}},
                          {2, 1, 0, 2, {0.93f, 0.37f, 0}}};
  Triangles arrow;
  for (const Piece& piece : pieces) {
    for (int i = 0; i < sides; ++i) {
      const float c0 = std::cos(turn(i, sides)), s0 = std::sin(turn(i, sides));
      const float c1 = std::cos(turn(i + 1, sides)), s1 = std::sin(turn(i + 1, sides));
      const GLuint first = arrow.add(c0, s0, piece.radiusFrom, piece.normal, piece.atFrom);
      arrow.add(c1, s1, piece.radiusFrom, piece.normal, piece.atFrom);
      arrow.add(c1, s1, piece.radiusTo, piece.normal, piece.atTo);
      arrow.add(c0, s0, piece.radiusTo, piece.normal, piece.atTo);
      arrow.quad(first, first + 1, first + 2, first + 3);
    }
  }
  return arrow.mesh();
}

}  // namespace tumble
