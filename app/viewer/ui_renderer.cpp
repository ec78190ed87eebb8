#include "app/viewer/ui_renderer.h"

#include <glad/gl.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string>

#include "render/gl.h"

namespace tumble {

namespace {

constexpr const char* kVertexShader = R"glsl(#version 330 core
layout(location = 0) in vec2 position;   // [px] x right, y down
layout(location = 1) in vec2 uv;
layout(location = 2) in vec4 colour;
uniform vec2 scale;                      // 2 / size of the page
out vec2 at;
out vec4 tint;
void main() {
  at = uv;
  tint = colour;
  gl_Position = vec4(position.x * scale.x - 1.0, 1.0 - position.y * scale.y, 0.0, 1.0);
}
)glsl";

constexpr const char* kFragmentShader = R"glsl(#version 330 core
in vec2 at;
in vec4 tint;
uniform sampler2D image;
out vec4 pixel;
void main() { pixel = tint * texture(image, at); }
)glsl";

void upload(unsigned texture, GLenum format, int width, int height, const void* pixels) {
  glBindTexture(GL_TEXTURE_2D, texture);
  glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
  glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA8, width, height, 0, format, GL_UNSIGNED_BYTE, pixels);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
}

// An own framebuffer with one colour texture, bound while it lives.
class Page {
 public:
  Page(int width, int height) : width_(width), height_(height) {
    glGenFramebuffers(1, &framebuffer_);
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_);
    glGenTextures(1, &colour_);
    upload(colour_, GL_RGBA, width, height, nullptr);
    glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, colour_, 0);
  }
  ~Page() {
    glBindFramebuffer(GL_FRAMEBUFFER, 0);
    glDeleteTextures(1, &colour_);
    glDeleteFramebuffers(1, &framebuffer_);
  }
  Page(const Page&) = delete;
  Page& operator=(const Page&) = delete;

  Image read() const {
    Image image;
    image.width = width_;
    image.height = height_;
    const std::size_t row = 3 * static_cast<std::size_t>(width_);
    image.rgb.resize(row * height_);
    glPixelStorei(GL_PACK_ALIGNMENT, 1);
    glReadPixels(0, 0, width_, height_, GL_RGB, GL_UNSIGNED_BYTE, image.rgb.data());
    // OpenGL counts rows from below.
    for (int y = 0; y < height_ / 2; ++y) {
      const auto upper = image.rgb.begin() + row * y;
      std::swap_ranges(upper, upper + row, image.rgb.begin() + row * (height_ - 1 - y));
    }
    return image;
  }

 private:
  int width_, height_;
  unsigned framebuffer_ = 0, colour_ = 0;
};

void attribute(int place, int count, GLenum type, bool normalised, std::size_t offset) {
  glEnableVertexAttribArray(place);
  glVertexAttribPointer(place, count, type, normalised, sizeof(ImDrawVert),
                        reinterpret_cast<const void*>(offset));
}

}  // namespace

UiTexture::UiTexture() {
  glGenTextures(1, &name_);
}
UiTexture::~UiTexture() {
  glDeleteTextures(1, &name_);
}

void UiTexture::load(const Image& image) {
  upload(name_, GL_RGB, image.width, image.height, image.rgb.data());
}

ImTextureID UiTexture::id() const {
  return reinterpret_cast<ImTextureID>(static_cast<std::uintptr_t>(name_));
}

UiRenderer::UiRenderer()
    : program_(gl::linkProgram("the user interface", kVertexShader, kFragmentShader)),
      scale_(glGetUniformLocation(program_, "scale")) {
  glGenVertexArrays(1, &vertexArray_);
  glGenBuffers(1, &vertices_);
  glGenBuffers(1, &indices_);
  glBindVertexArray(vertexArray_);
  glBindBuffer(GL_ARRAY_BUFFER, vertices_);
  glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, indices_);
  attribute(0, 2, GL_FLOAT, false, offsetof(ImDrawVert, pos));
  attribute(1, 2, GL_FLOAT, false, offsetof(ImDrawVert, uv));
  attribute(2, 4, GL_UNSIGNED_BYTE, true, offsetof(ImDrawVert, col));
  glBindVertexArray(0);

  unsigned char* pixels = nullptr;
  int width = 0, height = 0;
  ImGui::GetIO().Fonts->GetTexDataAsRGBA32(&pixels, &width, &height);
  upload(static_cast<unsigned>(reinterpret_cast<std::uintptr_t>(glyphs_.id())), GL_RGBA, width,
         height, pixels);
  ImGui::GetIO().Fonts->SetTexID(glyphs_.id());
}

UiRenderer::~UiRenderer() {
  glDeleteBuffers(1, &indices_);
  glDeleteBuffers(1, &vertices_);
  glDeleteVertexArrays(1, &vertexArray_);
}

void UiRenderer::draw(const ImDrawData& data) {
  const ImVec2 pixels = {data.DisplaySize.x * data.FramebufferScale.x,
                         data.DisplaySize.y * data.FramebufferScale.y};
  glViewport(0, 0, static_cast<int>(pixels.x), static_cast<int>(pixels.y));
  glDisable(GL_DEPTH_TEST);
  glDisable(GL_CULL_FACE);
  glDisable(GL_SCISSOR_TEST);
  glClearColor(0.965f, 0.957f, 0.937f, 1.0f);
  glClear(GL_COLOR_BUFFER_BIT);
  glEnable(GL_BLEND);
  glBlendEquation(GL_FUNC_ADD);
  glBlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
  glEnable(GL_SCISSOR_TEST);
  glUseProgram(program_);
  glUniform2f(scale_, 2.0f / data.DisplaySize.x, 2.0f / data.DisplaySize.y);
  glActiveTexture(GL_TEXTURE0);
  glBindVertexArray(vertexArray_);
  glBindBuffer(GL_ARRAY_BUFFER, vertices_);
  for (int i = 0; i < data.CmdListsCount; ++i) drawList(*data.CmdLists[i], data);
  glBindVertexArray(0);
  glUseProgram(0);
  glDisable(GL_SCISSOR_TEST);
  glDisable(GL_BLEND);
}

void UiRenderer::drawList(const ImDrawList& list, const ImDrawData& data) {
  glBufferData(GL_ARRAY_BUFFER, list.VtxBuffer.size_in_bytes(), list.VtxBuffer.Data,
               GL_STREAM_DRAW);
  glBufferData(GL_ELEMENT_ARRAY_BUFFER, list.IdxBuffer.size_in_bytes(), list.IdxBuffer.Data,
               GL_STREAM_DRAW);
  const ImVec2 scale = data.FramebufferScale;
  const float height = data.DisplaySize.y * scale.y;
  for (const ImDrawCmd& command : list.CmdBuffer) {
    const ImVec4& clip = command.ClipRect;
    const float width = (clip.z - clip.x) * scale.x, tall = (clip.w - clip.y) * scale.y;
    if (width <= 0.0f || tall <= 0.0f) continue;
    glScissor(static_cast<int>(clip.x * scale.x), static_cast<int>(height - clip.w * scale.y),
              static_cast<int>(width), static_cast<int>(tall));
    glBindTexture(GL_TEXTURE_2D,
                  static_cast<unsigned>(reinterpret_cast<std::uintptr_t>(command.GetTexID())));
    const std::size_t first = command.IdxOffset * sizeof(ImDrawIdx);
    glDrawElements(GL_TRIANGLES, static_cast<int>(command.ElemCount),
                   sizeof(ImDrawIdx) == 2 ? GL_UNSIGNED_SHORT : GL_UNSIGNED_INT,
                   reinterpret_cast<const void*>(first));
  }
}

void UiRenderer::drawToWindow(const ImDrawData& data) {
  glBindFramebuffer(GL_FRAMEBUFFER, 0);
  draw(data);
}

Image UiRenderer::drawToImage(const ImDrawData& data) {
  const Page page(static_cast<int>(data.DisplaySize.x * data.FramebufferScale.x),
                  static_cast<int>(data.DisplaySize.y * data.FramebufferScale.y));
  draw(data);
  return page.read();
}

}  // namespace tumble
