// Numbers packed into text.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace tumble {

/// A value of [low, low + span] as one of 65536.
std::uint16_t sixteenBits(double value, double low, double span);

/// Series of equal length, each written as differences from value to value (mod 65536), 0, −1, 1,
/// −2, … as 0, 1, 2, 3, …, the low bytes of all before the high ones: what changes little packs
/// well.
std::string differences(const std::vector<std::vector<std::uint16_t>>& series);

/// zlib's format (RFC 1950), in base64. @throws std::bad_alloc
std::string packed(const std::string& bytes);

}  // namespace tumble
