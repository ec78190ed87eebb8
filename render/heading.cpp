#include "render/heading.h"

namespace tumble {
namespace {

const Drawing::TextStyle kTitle{22.0, Face::Bold, Align::Left, ink::text};
const Drawing::TextStyle kSubtitle{15.0, Face::Regular, Align::Left, ink::secondary};
constexpr double kTitleLine = 26.0, kSubtitleLine = 19.0;  // from line to line of each

}  // namespace

Heading::Heading(Drawing& drawing, const std::string& title, const std::string& subtitle,
                 double width, std::size_t most)
    : title_(drawing.fitted(title, width, most, kTitle, kLegible)),
      subtitle_(drawing.fitted(subtitle, width, most, kSubtitle, kLegible)) {}

double Heading::below() const {
  return title_.below(kTitleLine) + subtitle_.below(kSubtitleLine);
}

void Heading::draw(double left, Drawing& drawing) const {
  constexpr double kFirst = 46.0, kSecond = 70.0;  // baselines, of one line each
  drawing.text({left, kFirst}, title_, kTitleLine, kTitle);
  drawing.text({left, kSecond + title_.below(kTitleLine)}, subtitle_, kSubtitleLine, kSubtitle);
}

}  // namespace tumble
