#include "app/export/pack.h"

#include <libdeflate.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <new>

#include "app/file/html.h"

namespace tumble {

std::uint16_t sixteenBits(double value, double low, double span) {
  const double share = span > 0.0 ? (value - low) / span : 0.0;
  return static_cast<std::uint16_t>(std::lround(65535.0 * std::clamp(share, 0.0, 1.0)));
}

std::string differences(const std::vector<std::vector<std::uint16_t>>& series) {
  std::string low, high;
  for (const std::vector<std::uint16_t>& one : series) {
    std::uint16_t before = 0;
    for (const std::uint16_t value : one) {
      const auto step = static_cast<std::int16_t>(value - before);
      const auto folded = static_cast<std::uint16_t>(step < 0 ? -2 * step - 1 : 2 * step);
      low += static_cast<char>(folded & 255);
      high += static_cast<char>(folded >> 8);
      before = value;
    }
  }
  return low + high;
}

std::string packed(const std::string& bytes) {
  constexpr int kLevel = 9;
  const std::unique_ptr<libdeflate_compressor, void (*)(libdeflate_compressor*)> zlib(
      libdeflate_alloc_compressor(kLevel), libdeflate_free_compressor);
  if (!zlib) throw std::bad_alloc();
  std::vector<std::uint8_t> out(libdeflate_zlib_compress_bound(zlib.get(), bytes.size()));
  out.resize(
      libdeflate_zlib_compress(zlib.get(), bytes.data(), bytes.size(), out.data(), out.size()));
  return base64(out);
}

}  // namespace tumble
