#include "render/gl.h"

#include <cerrno>
#include <cstring>
#include <fstream>
#include <sstream>
#include <stdexcept>

#include "render/context/context.h"

namespace tumble::gl {
namespace {

std::string readShader(const std::string& folder, const std::string& name) {
  std::ifstream file(folder + "/" + name);
  if (!file)
    throw NoContext("shader " + folder + "/" + name + " cannot be read: " + std::strerror(errno));
  const std::string include = "#include \"";
  std::ostringstream text;
  for (std::string line; std::getline(file, line);) {
    if (line.starts_with(include))
      text << readShader(folder, line.substr(include.size(), line.rfind('"') - include.size()));
    else
      text << line << '\n';
  }
  return text.str();
}

std::string sourceOf(const std::string& folder, const std::string& name,
                     const std::vector<std::string>& defines) {
  std::string source = "#version 330 core\n";
  for (const std::string& word : defines) source += "#define " + word + "\n";
  return source + readShader(folder, name);
}

Object compile(GLenum stage, const std::string& name, const std::string& source) {
  Object shader(glCreateShader(stage), [](GLuint id) { glDeleteShader(id); });
  const char* text = source.c_str();
  glShaderSource(shader, 1, &text, nullptr);
  glCompileShader(shader);
  GLint good = 0;
  glGetShaderiv(shader, GL_COMPILE_STATUS, &good);
  if (!good) {
    char words[2048] = "";
    glGetShaderInfoLog(shader, sizeof words, nullptr, words);
    const char* kind = stage == GL_VERTEX_SHADER ? "vertex" : "fragment";
    throw NoContext(std::string("the ") + kind + " shader of " + name +
                    " does not compile: " + words);
  }
  return shader;
}

}  // namespace

Object makeBuffer() {
  GLuint id = 0;
  glGenBuffers(1, &id);
  return {id, [](GLuint name) { glDeleteBuffers(1, &name); }};
}

Object makeVertexArray() {
  GLuint id = 0;
  glGenVertexArrays(1, &id);
  return {id, [](GLuint name) { glDeleteVertexArrays(1, &name); }};
}

Object makeTexture() {
  GLuint id = 0;
  glGenTextures(1, &id);
  return {id, [](GLuint name) { glDeleteTextures(1, &name); }};
}

Object makeRenderbuffer() {
  GLuint id = 0;
  glGenRenderbuffers(1, &id);
  return {id, [](GLuint name) { glDeleteRenderbuffers(1, &name); }};
}

Object makeFramebuffer() {
  GLuint id = 0;
  glGenFramebuffers(1, &id);
  return {id, [](GLuint name) { glDeleteFramebuffers(1, &name); }};
}

Object linkProgram(const std::string& name, const std::string& vertex,
                   const std::string& fragment) {
  const Object vertexShader = compile(GL_VERTEX_SHADER, name, vertex);
  const Object fragmentShader = compile(GL_FRAGMENT_SHADER, name, fragment);
  Object program(glCreateProgram(), [](GLuint id) { glDeleteProgram(id); });
  glAttachShader(program, vertexShader);
  glAttachShader(program, fragmentShader);
  glLinkProgram(program);
  GLint good = 0;
  glGetProgramiv(program, GL_LINK_STATUS, &good);
  if (!good) {
    char words[2048] = "";
    glGetProgramInfoLog(program, sizeof words, nullptr, words);
    throw NoContext("the shaders of " + name + " do not link: " + words);
  }
  return program;
}

Program::Program(const std::string& folder, const std::string& vertex, const std::string& fragment,
                 const std::vector<std::string>& defines) {
  const std::string vertexSource = sourceOf(folder, vertex, defines);
  program_ =
      linkProgram(vertex + " and " + fragment, vertexSource, sourceOf(folder, fragment, defines));
  const GLuint stage = glGetUniformBlockIndex(program_, "Stage");
  if (stage != GL_INVALID_INDEX) glUniformBlockBinding(program_, stage, 0);
}

GLint Program::find(const char* name) const {
  return glGetUniformLocation(program_, name);
}
void Program::set(const char* name, int value) const {
  glUniform1i(find(name), value);
}
void Program::set(const char* name, float value) const {
  glUniform1f(find(name), value);
}
void Program::set(const char* name, const Eigen::Vector2f& v) const {
  glUniform2f(find(name), v.x(), v.y());
}
void Program::set(const char* name, const Eigen::Vector3f& v) const {
  glUniform3f(find(name), v.x(), v.y(), v.z());
}

void checkFramebuffer(const std::string& what) {
  const GLenum status = glCheckFramebufferStatus(GL_FRAMEBUFFER);
  if (status == GL_FRAMEBUFFER_COMPLETE) return;
  std::ostringstream text;
  text << "the driver refuses the framebuffer for " << what << " (status 0x" << std::hex << status
       << ")";
  throw NoContext(text.str());
}

void checkErrors(const std::string& where) {
  const GLenum error = glGetError();
  if (error == GL_NO_ERROR) return;
  std::ostringstream text;
  text << "OpenGL error 0x" << std::hex << error << " while drawing " << where;
  throw std::logic_error(text.str());
}

}  // namespace tumble::gl
