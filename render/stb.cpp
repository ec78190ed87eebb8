// The single-header libraries for PNG and fonts, compiled once.
#include <libdeflate.h>

#include <cstdlib>

namespace {

/// zlib stream for stb_image_write: libdeflate is several times faster than stb's own and packs
/// closer.
unsigned char* deflateForStb(unsigned char* data, int size, int* packedSize, int level) {
  libdeflate_compressor* compressor = libdeflate_alloc_compressor(level);
  const std::size_t bound =
      libdeflate_zlib_compress_bound(compressor, static_cast<std::size_t>(size));
  auto* packed = static_cast<unsigned char*>(std::malloc(bound));
  *packedSize = static_cast<int>(
      libdeflate_zlib_compress(compressor, data, static_cast<std::size_t>(size), packed, bound));
  libdeflate_free_compressor(compressor);
  return packed;
}

}  // namespace

#define STBIW_ZLIB_COMPRESS deflateForStb
#define STBI_WRITE_NO_STDIO
#define STB_IMAGE_WRITE_IMPLEMENTATION
#include <stb_image_write.h>

#define STBI_ONLY_PNG
#define STBI_NO_STDIO
#define STB_IMAGE_IMPLEMENTATION
#include <stb_image.h>

// Dear ImGui packs its glyphs with whatever stb the program holds: both halves have to be of one
// make.
#define STB_RECT_PACK_IMPLEMENTATION
#include <stb_rect_pack.h>

#define STB_TRUETYPE_IMPLEMENTATION
#include <stb_truetype.h>
