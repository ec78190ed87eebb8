// Flat drawing onto an image: text, strokes, discs, with smooth edges. Works without OpenGL.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "render/font.h"
#include "render/image.h"
#include "render/picture.h"

namespace tumble {

/// The colours of the page.
namespace ink {
inline constexpr Colour text = {0.169f, 0.184f, 0.212f};
inline constexpr Colour secondary = {0.361f, 0.388f, 0.431f};
inline constexpr Colour leader = {0.725f, 0.753f, 0.788f};
inline constexpr Colour frame = {0.788f, 0.808f, 0.839f};
inline constexpr Colour paper = {0.984f, 0.980f, 0.969f};
inline constexpr Colour page = {0.973f, 0.973f, 0.965f};
inline constexpr Colour alarm = {0.835f, 0.251f, 0.102f};
}  // namespace ink

/// Something that can be drawn on, in pixels; x to the right, y down.
class Drawing {
 public:
  struct TextStyle {
    double size = 14.0;
    Face face = Face::Regular;
    Align align = Align::Left;
    Colour colour = ink::text;
  };

  virtual ~Drawing() = default;
  virtual double width() const = 0;
  virtual double height() const = 0;
  virtual void fill(const Eigen::Vector2d& topLeft, const Eigen::Vector2d& size,
                    const Colour& colour) = 0;
  virtual void disc(const Eigen::Vector2d& centre, double radius, const Colour& colour,
                    double alpha = 1.0) = 0;
  virtual void ring(const Eigen::Vector2d& centre, double radius, double stroke,
                    const Colour& colour) = 0;
  virtual void stroke(const Eigen::Vector2d& from, const Eigen::Vector2d& to, double width,
                      const Colour& colour, double alpha = 1.0) = 0;
  virtual void triangle(const Eigen::Vector2d& a, const Eigen::Vector2d& b,
                        const Eigen::Vector2d& c, const Colour& colour) = 0;
  /// @param pen  where the text starts, ends or has its middle, on the baseline
  virtual void text(const Eigen::Vector2d& pen, std::string_view utf8, const TextStyle& style) = 0;
  /// Width of the text [px].
  virtual double textWidth(std::string_view utf8, const TextStyle& style) = 0;

  /// The text in lines that are at most as wide as asked [px], if no word is wider; broken at
  /// blanks, and within a formula or between a number and its unit only where nothing else fits.
  /// @param most  lines; what is left when they are full is one more
  std::vector<std::string> lines(std::string_view utf8, double width, const TextStyle& style,
                                 std::size_t most = 1000);

  /// Lines of one size.
  struct Words {
    std::vector<std::string> lines;
    double size = 0.0;  ///< [px]
    /// How far the last line is below the first, if each is so far below the one before [px].
    double below(double step) const {
      return lines.empty() ? 0.0 : step * static_cast<double>(lines.size() - 1);
    }
  };
  /// The text as it can be read where there is room for so much: as large as its style has it, else
  /// smaller, else cut behind a letter, where it ends in "…".
  /// @param width  [px] of the room
  /// @param most   lines
  /// @param least  [px] of a size that can still be read
  Words fitted(std::string_view utf8, double width, std::size_t most, const TextStyle& style,
               double least);
  /// Lines below each other. @param step  [px] from one to the next
  void text(const Eigen::Vector2d& pen, const Words& words, double step, TextStyle style);

 private:
  std::string shortened(std::string text, double width, const TextStyle& style);
};

/// Draws in pixels of a page 720 high, scaled to the image; whole numbers at corners.
class Canvas : public Drawing {
 public:
  /// Both must outlive the canvas.
  Canvas(Image& image, Fonts& fonts) : image_(image), fonts_(fonts), scale_(image.height / 720.0) {}
  /// The same with a scale of its own [pixels of the image per pixel drawn].
  Canvas(Image& image, Fonts& fonts, double scale) : image_(image), fonts_(fonts), scale_(scale) {}

  /// The colour that text is lifted off with; without it, that of the page behind a drawing.
  void setPaper(const Colour& paper) { paper_ = paper; }

  double width() const override { return image_.width / scale_; }
  double height() const override { return image_.height / scale_; }

  void fill(const Eigen::Vector2d& topLeft, const Eigen::Vector2d& size,
            const Colour& colour) override;
  void disc(const Eigen::Vector2d& centre, double radius, const Colour& colour,
            double alpha = 1.0) override;
  void ring(const Eigen::Vector2d& centre, double radius, double stroke,
            const Colour& colour) override;
  void stroke(const Eigen::Vector2d& from, const Eigen::Vector2d& to, double width,
              const Colour& colour, double alpha = 1.0) override;
  void triangle(const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Eigen::Vector2d& c,
                const Colour& colour) override;
  void frame(const Eigen::Vector2d& topLeft, const Eigen::Vector2d& size, double stroke,
             const Colour& colour);
  using Drawing::text;
  void text(const Eigen::Vector2d& pen, std::string_view utf8, const TextStyle& style) override;
  double textWidth(std::string_view utf8, const TextStyle& style) override;

 private:
  /// Blends the colour over pixels near a shape given by its signed distance [px of the image], < 0
  /// inside.
  template <class Distance>
  void paint(const Eigen::Vector2d& low, const Eigen::Vector2d& high, const Colour& colour,
             double alpha, const Distance& distance);
  void blend(int x, int y, const Colour& colour, double alpha);

  Image& image_;
  Fonts& fonts_;
  double scale_;
  std::optional<Colour> paper_;
};

}  // namespace tumble
