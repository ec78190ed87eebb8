// Text for pages.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

namespace tumble {

/// The text with what HTML reads as markup (< > & ") written as character references.
std::string htmlText(std::string_view text);

/// RFC 4648, with padding.
std::string base64(std::span<const std::uint8_t> bytes);

}  // namespace tumble
