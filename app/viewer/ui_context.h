// Dear ImGui with the house's type and colours.
#pragma once

#include <string>

namespace tumble {

/// The ImGui context of the program while it lives. Keeps no settings file.
class UiContext {
 public:
  /// @param fonts folder with Lato-Regular.ttf and DejaVuSans.ttf  @throws NoContext if one is
  /// missing
  explicit UiContext(const std::string& fonts);
  ~UiContext();
  UiContext(const UiContext&) = delete;
  UiContext& operator=(const UiContext&) = delete;
};

}  // namespace tumble
