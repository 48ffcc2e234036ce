// One TIFF file through libtiff, page by page. libtiff because OpenImageIO rescales odd bit depths, converts
// colours and multiplies by alpha: here the numbers of the file count. It also starts in a tenth of the time.
#pragma once

#include "import/formats/input_file.h"
#include "import/tiff/packed_samples.h"

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

struct tiff;

namespace voxsheet::import {

enum class PageColours {
    Grey,     ///< also a single sample of any meaning
    Inverted, ///< grey, 0 is shown white
    Rgb,
    Palette, ///< one index of at most 8 bits per pixel
    Cmyk,
};

/// What must be equal for the pages of a volume.
struct PageFormat {
    std::uint32_t width = 0;
    std::uint32_t height = 0;
    int samples = 1; ///< per pixel, as stored: 1 for a palette
    SampleFormat sample;
    PageColours colours = PageColours::Grey;
    int alphaSample = -1; ///< index of the first sample that is alpha, -1: none

    bool operator==(const PageFormat&) const = default;
    [[nodiscard]] ScalarType type() const { return sample.type; }
    /// "640 x 480 u8, 3 samples", "640 x 480 u16 of 12 bits".
    [[nodiscard]] std::string text() const;
};

/// What else a page says.
struct PageTags {
    std::string description;
    std::optional<double> xResolution; ///< pixels per unit, finite and > 0
    std::optional<double> yResolution;
    int resolutionUnit = 2; ///< 1 none, 2 inch, 3 cm
    int orientation = 1;    ///< 1 to 8; 1: first row at the top, first sample at the left
    bool reducedOrMask = false;
    /// More bytes than the page's voxels can come from by its compression; 0: no bound is known.
    std::uint64_t mostBytesPerFileByte = 0;
};

class TiffFile {
public:
    /// Opens the first page. `file` must outlive this. Throws InvalidInput if there is none.
    explicit TiffFile(const InputFile& file);

    /// Goes to the next page; false after the last one. Throws InvalidInput (damaged, a loop of pages).
    [[nodiscard]] bool nextPage();
    /// Where the present page begins in the file.
    [[nodiscard]] std::uint64_t pageOffset() const;
    /// Throws InvalidInput.
    void goToPage(std::uint64_t pageOffset);

    /// `page`, counted from 1, names it in errors. Throws Unsupported for what cannot become numbers here.
    [[nodiscard]] PageFormat format(int page) const;
    [[nodiscard]] PageTags tags() const;

    /// Reads the present page, of this format: one plane of width * height values for each sample, or red,
    /// green and blue (of 8 bits) for a palette when there are three planes. Throws InvalidInput.
    void readPage(const PageFormat& format, int page, std::span<const std::span<std::byte>> planes);

    /// Decompresses the present page, of this format, and keeps nothing: a row (of strips) or a tile is held
    /// at a time. Throws InvalidInput as readPage.
    void provePage(const PageFormat& format, int page);

private:
    struct Source {
        const InputFile* file = nullptr;
        std::uint64_t position = 0;
        std::string firstError;
    };
    struct Closer {
        void operator()(::tiff* handle) const;
    };
    struct Block {
        std::uint32_t x = 0, y = 0;          ///< first pixel
        std::uint32_t width = 0, height = 0; ///< of what lies within the page
        std::uint32_t rowPixels = 0;         ///< of the block itself
        int firstSample = 0;
        int samples = 1;
    };
    friend struct TiffCallbacks;

    [[noreturn]] void fail(const std::string& doing) const;
    void readStrips(const PageFormat& format, int page, const std::function<void(const Block&)>& use);
    void readTiles(const PageFormat& format, int page, const std::function<void(const Block&)>& use);
    /// Of block_.
    void splitBlock(const PageFormat& format, const Block& block,
                    std::span<const std::span<std::byte>> planes) const;
    void mapPalette(int page, int bits, std::span<const std::span<std::byte>> planes) const;

    std::unique_ptr<Source> source_; ///< libtiff keeps its address
    std::unique_ptr<::tiff, Closer> handle_;
    std::vector<std::byte> block_;
};

} // namespace voxsheet::import
