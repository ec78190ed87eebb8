// OpenGL objects with owners. Every function needs the context to be current.
#pragma once

#include <glad/gl.h>

#include <Eigen/Core>
#include <string>
#include <utility>
#include <vector>

namespace tumble::gl {

/// Name of an OpenGL object that is deleted with its owner.
class Object {
 public:
  using Delete = void (*)(GLuint);
  Object() = default;
  Object(GLuint id, Delete free) : id_(id), free_(free) {}
  Object(Object&& other) noexcept : id_(std::exchange(other.id_, 0)), free_(other.free_) {}
  Object& operator=(Object&& other) noexcept {
    std::swap(id_, other.id_);
    std::swap(free_, other.free_);
    return *this;
  }
  ~Object() {
    if (id_ != 0) free_(id_);
  }
  operator GLuint() const { return id_; }

 private:
  GLuint id_ = 0;
  Delete free_ = nullptr;
};

Object makeBuffer();
Object makeVertexArray();
Object makeTexture();
Object makeRenderbuffer();
Object makeFramebuffer();

/// A program of vertex and fragment shader; `name` says in errors whose they are.
/// @throws NoContext with the name and the driver's words.
Object linkProgram(const std::string& name, const std::string& vertex, const std::string& fragment);

/// Vertex and fragment shader from files of one folder. A line `#include "file"` is replaced by
/// that file; every word of `defines` is defined in both.
/// @throws NoContext with file names and the driver's words.
class Program {
 public:
  Program() = default;
  Program(const std::string& folder, const std::string& vertex, const std::string& fragment,
          const std::vector<std::string>& defines = {});
  void use() const { glUseProgram(program_); }
  void set(const char* name, int value) const;
  void set(const char* name, float value) const;
  void set(const char* name, const Eigen::Vector2f& value) const;
  void set(const char* name, const Eigen::Vector3f& value) const;

 private:
  GLint find(const char* name) const;
  Object program_;
};

/// A pixel rectangle, y upwards from the lowest row as OpenGL counts.
struct Rectangle {
  int x = 0, y = 0, width = 0, height = 0;
  bool empty() const { return width <= 0 || height <= 0; }
};

/// Fills a buffer with values that are used for this picture only.
template <class T>
void upload(GLenum target, GLuint buffer, const std::vector<T>& values) {
  glBindBuffer(target, buffer);
  glBufferData(target, static_cast<GLsizeiptr>(values.size() * sizeof(T)), values.data(),
               GL_STREAM_DRAW);
}

/// @throws NoContext if the framebuffer that is bound cannot be drawn into.
void checkFramebuffer(const std::string& what);

/// @throws std::logic_error if OpenGL has noted an error since the last call.
void checkErrors(const std::string& where);

}  // namespace tumble::gl
