// Text for pages.
#pragma once

#include <string>
#include <string_view>

namespace tumble {

/// The text with what HTML reads as markup (< > & ") written as character references.
std::string htmlText(std::string_view text);

}  // namespace tumble
