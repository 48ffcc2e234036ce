// TIFF files, written by libtiff as the test wants them.
#pragma once

#include <tiffio.h>

#include <cstdint>
#include <filesystem>
#include <functional>
#include <stdexcept>
#include <string>
#include <vector>

namespace voxsheet::import::testing {

struct TiffPageOptions {
    std::uint32_t width = 5;
    std::uint32_t height = 4;
    int samples = 1;
    int compression = COMPRESSION_NONE;
    int photometric = PHOTOMETRIC_MINISBLACK;
    bool planar = false;
    std::uint32_t tile = 0; ///< edge of the tiles; 0: strips
    std::uint32_t rowsPerStrip = 3;
    std::string description;
    std::function<void(TIFF*)> more; ///< further tags
};

template <typename T>
constexpr int tiffSampleFormat() {
    if (std::is_floating_point_v<T>) return SAMPLEFORMAT_IEEEFP;
    return std::is_signed_v<T> ? SAMPLEFORMAT_INT : SAMPLEFORMAT_UINT;
}

/// Values in the order sample, x, y.
template <typename T>
void writeTiffPage(TIFF* tiff, const TiffPageOptions& page, const T* values) {
    TIFFSetField(tiff, TIFFTAG_IMAGEWIDTH, page.width);
    TIFFSetField(tiff, TIFFTAG_IMAGELENGTH, page.height);
    TIFFSetField(tiff, TIFFTAG_SAMPLESPERPIXEL, page.samples);
    TIFFSetField(tiff, TIFFTAG_BITSPERSAMPLE, static_cast<int>(8 * sizeof(T)));
    TIFFSetField(tiff, TIFFTAG_SAMPLEFORMAT, tiffSampleFormat<T>());
    TIFFSetField(tiff, TIFFTAG_COMPRESSION, page.compression);
    TIFFSetField(tiff, TIFFTAG_PHOTOMETRIC, page.photometric);
    TIFFSetField(tiff, TIFFTAG_PLANARCONFIG, page.planar ? PLANARCONFIG_SEPARATE : PLANARCONFIG_CONTIG);
    if (!page.description.empty()) TIFFSetField(tiff, TIFFTAG_IMAGEDESCRIPTION, page.description.c_str());
    const std::uint32_t blockWidth = page.tile ? page.tile : page.width;
    const std::uint32_t blockHeight = page.tile ? page.tile : page.rowsPerStrip;
    if (page.tile) {
        TIFFSetField(tiff, TIFFTAG_TILEWIDTH, page.tile);
        TIFFSetField(tiff, TIFFTAG_TILELENGTH, page.tile);
    } else {
        TIFFSetField(tiff, TIFFTAG_ROWSPERSTRIP, page.rowsPerStrip);
    }
    if (page.more) page.more(tiff);
    const auto samples = static_cast<std::uint32_t>(page.samples);
    const std::uint32_t perBlock = page.planar ? 1 : samples;
    for (std::uint32_t first = 0; first < samples; first += perBlock)
        for (std::uint32_t y0 = 0; y0 < page.height; y0 += blockHeight)
            for (std::uint32_t x0 = 0; x0 < page.width; x0 += blockWidth) {
                const auto rows = page.tile ? blockHeight : std::min(blockHeight, page.height - y0);
                std::vector<T> block(std::size_t{blockWidth} * rows * perBlock);
                for (std::uint32_t y = 0; y < rows && y0 + y < page.height; ++y)
                    for (std::uint32_t x = 0; x < blockWidth && x0 + x < page.width; ++x)
                        for (std::uint32_t s = 0; s < perBlock; ++s)
                            block[(y * blockWidth + x) * perBlock + s] =
                                values[((y0 + y) * page.width + x0 + x) * samples + first + s];
                const auto bytes = static_cast<tmsize_t>(block.size() * sizeof(T));
                const auto written =
                    page.tile
                        ? TIFFWriteTile(tiff, block.data(), x0, y0, 0, static_cast<std::uint16_t>(first))
                        : TIFFWriteEncodedStrip(tiff,
                                                TIFFComputeStrip(tiff, y0, static_cast<std::uint16_t>(first)),
                                                block.data(), bytes);
                if (written < 0) throw std::runtime_error("libtiff cannot write the test's page");
            }
    if (!TIFFWriteDirectory(tiff)) throw std::runtime_error("libtiff cannot write the test's directory");
}

/// `pages` pages of equal options with values after each other. \param mode "w" and letters of TIFFOpen.
template <typename T>
void writeTiff(const std::filesystem::path& file, const TiffPageOptions& page, int pages,
               const std::vector<T>& values, const char* mode = "w") {
    TIFF* const tiff = TIFFOpen(file.c_str(), mode);
    if (!tiff) throw std::runtime_error("libtiff cannot create the test's file");
    const auto perPage = std::size_t{page.width} * page.height * static_cast<std::size_t>(page.samples);
    for (int index = 0; index < pages; ++index)
        writeTiffPage(tiff, page, values.data() + static_cast<std::size_t>(index) * perPage);
    TIFFClose(tiff);
}

} // namespace voxsheet::import::testing
