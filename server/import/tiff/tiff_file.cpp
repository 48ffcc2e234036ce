#include "import/tiff/tiff_file.h"

#include "base/errors.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdarg>
#include <cstdio>
#include <cstring>

#include <tiffio.h>

namespace voxsheet::import {

namespace {

constexpr const char* kCopyAgain = "copy or write the file again";
constexpr std::uint64_t kMostBlockBytes = 1ULL << 30; // of a strip
constexpr std::uint64_t kMostTileBytes = 32ULL << 20; // 4096 x 4096 of 16 bits

template <typename T>
T tag(TIFF* handle, std::uint32_t which) {
    T value{};
    TIFFGetFieldDefaulted(handle, which, &value);
    return value;
}

std::optional<PageColours> coloursOf(TIFF* handle, int samples) {
    const auto photometric = tag<std::uint16_t>(handle, TIFFTAG_PHOTOMETRIC);
    switch (photometric) {
    case PHOTOMETRIC_MINISWHITE:
        return PageColours::Inverted;
    case PHOTOMETRIC_MINISBLACK:
        return PageColours::Grey;
    case PHOTOMETRIC_RGB:
        return samples >= 3 ? PageColours::Rgb : PageColours::Grey;
    case PHOTOMETRIC_PALETTE:
        return samples == 1 ? std::optional(PageColours::Palette) : std::nullopt;
    case PHOTOMETRIC_SEPARATED:
        return samples >= 4 ? PageColours::Cmyk : PageColours::Grey;
    case PHOTOMETRIC_YCBCR: // libtiff turns it into RGB for JPEG only
        if (tag<std::uint16_t>(handle, TIFFTAG_COMPRESSION) != COMPRESSION_JPEG || samples != 3)
            return std::nullopt;
        TIFFSetField(handle, TIFFTAG_JPEGCOLORMODE, JPEGCOLORMODE_RGB);
        return PageColours::Rgb;
    default:
        return std::nullopt;
    }
}

int alphaSampleOf(TIFF* handle, int samples) {
    std::uint16_t count = 0;
    std::uint16_t* meanings = nullptr;
    if (!TIFFGetField(handle, TIFFTAG_EXTRASAMPLES, &count, &meanings)) return -1;
    for (int extra = 0; extra < count; ++extra)
        if (meanings[extra] != EXTRASAMPLE_UNSPECIFIED) return samples - count + extra;
    return -1;
}

/// Deflate: 1032:1 (zlib's technical notes); LZW: codes of 12 bits for strings of at most 4096 bytes;
/// PackBits: 128 bytes from 2. Zstandard, LZMA, WebP and fax codes have no useful bound.
std::uint64_t mostBytesPerFileByte(int compression) {
    switch (compression) {
    case COMPRESSION_NONE:
        return 1;
    case COMPRESSION_PACKBITS:
        return 64;
    case COMPRESSION_LZW:
        return 2731;
    case COMPRESSION_ADOBE_DEFLATE:
    case COMPRESSION_DEFLATE:
        return 1032;
    default:
        return 0;
    }
}

std::optional<double> resolution(TIFF* handle, std::uint32_t which) {
    float value = 0.0F;
    if (!TIFFGetField(handle, which, &value) || !std::isfinite(value) || value <= 0.0F) return std::nullopt;
    return static_cast<double>(value);
}

} // namespace

/// What libtiff calls; nothing may be thrown through it.
struct TiffCallbacks {
    static tmsize_t read(thandle_t handle, void* out, tmsize_t bytes) {
        auto& source = *static_cast<TiffFile::Source*>(handle);
        if (bytes <= 0) return 0;
        try {
            const auto got = source.file->readAt(
                source.position, {static_cast<std::byte*>(out), static_cast<std::size_t>(bytes)});
            source.position += got;
            return static_cast<tmsize_t>(got);
        } catch (const std::exception& error) {
            if (source.firstError.empty()) source.firstError = error.what();
            return -1;
        }
    }
    static tmsize_t write(thandle_t, void*, tmsize_t) { return -1; }
    static toff_t seek(thandle_t handle, toff_t offset, int whence) {
        auto& source = *static_cast<TiffFile::Source*>(handle);
        if (whence == SEEK_CUR) offset += source.position;
        if (whence == SEEK_END) offset += source.file->bytes();
        source.position = offset;
        return offset;
    }
    static int close(thandle_t) { return 0; }
    static toff_t size(thandle_t handle) { return static_cast<TiffFile::Source*>(handle)->file->bytes(); }
    static int error(TIFF*, void* user, const char*, const char* format, va_list arguments) {
        auto& text = static_cast<TiffFile::Source*>(user)->firstError;
        if (!text.empty()) return 1;
        std::array<char, 256> buffer{};
        std::vsnprintf(buffer.data(), buffer.size(), format, arguments);
        text = buffer.data();
        return 1; // libtiff prints nothing
    }
    static int warning(TIFF*, void*, const char*, const char*, va_list) { return 1; }
};

std::string PageFormat::text() const {
    return std::to_string(width) + " x " + std::to_string(height) + " " + std::string(scalarName(type())) +
           (sample.isPacked() ? " of " + std::to_string(sample.bits) + " bits" : "") +
           (samples > 1 ? ", " + std::to_string(samples) + " samples per pixel" : "") +
           (colours == PageColours::Palette ? " with a palette" : "");
}

void TiffFile::Closer::operator()(::tiff* handle) const { TIFFClose(handle); }

TiffFile::TiffFile(const InputFile& file) : source_(std::make_unique<Source>()) {
    source_->file = &file;
    const std::unique_ptr<TIFFOpenOptions, void (*)(TIFFOpenOptions*)> options(TIFFOpenOptionsAlloc(),
                                                                               TIFFOpenOptionsFree);
    TIFFOpenOptionsSetMaxSingleMemAlloc(options.get(), static_cast<tmsize_t>(kMostBlockBytes));
    TIFFOpenOptionsSetErrorHandlerExtR(options.get(), TiffCallbacks::error, source_.get());
    TIFFOpenOptionsSetWarningHandlerExtR(options.get(), TiffCallbacks::warning, source_.get());
    // m: no memory map, which a file that shrinks would turn into SIGBUS; O: tables of strips on demand.
    handle_.reset(TIFFClientOpenExt(file.name().c_str(), "rmO", source_.get(), TiffCallbacks::read,
                                    TiffCallbacks::write, TiffCallbacks::seek, TiffCallbacks::close,
                                    TiffCallbacks::size, nullptr, nullptr, options.get()));
    if (!handle_) fail("opening its first page");
}

void TiffFile::fail(const std::string& doing) const {
    std::string_view error =
        source_->firstError; // some begin with the name of the file, which stands there anyway
    const auto name = source_->file->name() + ": ";
    if (error.starts_with(name)) error.remove_prefix(name.size());
    while (error.ends_with(' ') || error.ends_with(':'))
        error.remove_suffix(1);
    throw InvalidInput(source_->file->name(),
                       doing + " failed: " + (error.empty() ? "libtiff says no more" : printable(error)),
                       kCopyAgain);
}

bool TiffFile::nextPage() {
    if (TIFFLastDirectory(handle_.get())) return false;
    source_->firstError.clear();
    if (!TIFFReadDirectory(handle_.get())) {
        if (source_->firstError.empty()) source_->firstError = "the list of its pages is damaged or a loop";
        fail("going to its next page");
    }
    return true;
}

std::uint64_t TiffFile::pageOffset() const { return TIFFCurrentDirOffset(handle_.get()); }

void TiffFile::goToPage(std::uint64_t pageOffset) {
    source_->firstError.clear();
    if (TIFFCurrentDirOffset(handle_.get()) == pageOffset) return;
    if (!TIFFSetSubDirectory(handle_.get(), pageOffset)) fail("going to a page");
}

PageFormat TiffFile::format(int page) const {
    auto* const handle = handle_.get();
    const auto refuse = [&](const std::string& why,
                            const char* whatToDo = "convert it to 8, 16 or 32 bits, grey or RGB") {
        throw Unsupported(source_->file->name(), "page " + std::to_string(page) + " " + why, whatToDo);
    };
    PageFormat format;
    format.width = tag<std::uint32_t>(handle, TIFFTAG_IMAGEWIDTH);
    format.height = tag<std::uint32_t>(handle, TIFFTAG_IMAGELENGTH);
    format.samples = tag<std::uint16_t>(handle, TIFFTAG_SAMPLESPERPIXEL);
    const int bits = tag<std::uint16_t>(handle, TIFFTAG_BITSPERSAMPLE);
    const int sampleFormat = tag<std::uint16_t>(handle, TIFFTAG_SAMPLEFORMAT);
    const int compression = tag<std::uint16_t>(handle, TIFFTAG_COMPRESSION);
    if (format.width == 0 || format.height == 0 || format.samples == 0 ||
        std::max<std::uint32_t>(tag<std::uint32_t>(handle, TIFFTAG_IMAGEDEPTH), 1) != 1)
        refuse("has no plane of pixels");
    if (!TIFFIsCODECConfigured(static_cast<std::uint16_t>(compression)))
        refuse("is compressed in a way that cannot be read here (number " + std::to_string(compression) + ")",
               "save it without compression");
    const auto sample = sampleFormatOf(bits, sampleFormat);
    if (!sample)
        refuse("has samples of " + std::to_string(bits) + " bits" +
               (sampleFormat == SAMPLEFORMAT_IEEEFP                                     ? ", floating point"
                : sampleFormat == SAMPLEFORMAT_UINT || sampleFormat == SAMPLEFORMAT_INT ? ""
                                                                                        : ", complex"));
    format.sample = *sample;
    const auto colours = coloursOf(handle, format.samples);
    if (!colours)
        refuse("has colours of a kind that cannot be read here (photometric interpretation " +
               std::to_string(tag<std::uint16_t>(handle, TIFFTAG_PHOTOMETRIC)) + ")");
    format.colours = *colours;
    if (format.colours == PageColours::Palette && format.type() != ScalarType::U8)
        refuse("has a palette for samples of more than 8 bits");
    format.alphaSample = alphaSampleOf(handle, format.samples);
    return format;
}

PageTags TiffFile::tags() const {
    auto* const handle = handle_.get();
    PageTags tags;
    const char* description = nullptr;
    if (TIFFGetField(handle, TIFFTAG_IMAGEDESCRIPTION, &description) && description)
        tags.description = description;
    tags.xResolution = resolution(handle, TIFFTAG_XRESOLUTION);
    tags.yResolution = resolution(handle, TIFFTAG_YRESOLUTION);
    tags.resolutionUnit = tag<std::uint16_t>(handle, TIFFTAG_RESOLUTIONUNIT);
    tags.orientation = tag<std::uint16_t>(handle, TIFFTAG_ORIENTATION);
    if (tags.orientation < 1 || tags.orientation > 8) tags.orientation = 1;
    const auto kind = tag<std::uint32_t>(handle, TIFFTAG_SUBFILETYPE);
    tags.reducedOrMask = (kind & (FILETYPE_REDUCEDIMAGE | FILETYPE_MASK)) != 0;
    tags.mostBytesPerFileByte = mostBytesPerFileByte(tag<std::uint16_t>(handle, TIFFTAG_COMPRESSION));
    return tags;
}

void TiffFile::readStrips(const PageFormat& format, int page, const std::function<void(const Block&)>& use) {
    auto* const handle = handle_.get();
    const bool separate = tag<std::uint16_t>(handle, TIFFTAG_PLANARCONFIG) == PLANARCONFIG_SEPARATE;
    const auto strip = std::clamp(tag<std::uint32_t>(handle, TIFFTAG_ROWSPERSTRIP), 1U, format.height);
    const int perBlock = separate ? 1 : format.samples;
    const auto bytesPerRow =
        rowBytes(format.sample, std::size_t{format.width} * static_cast<std::size_t>(perBlock));
    for (int sample = 0; sample < format.samples; sample += perBlock)
        for (std::uint32_t row = 0; row < format.height;) {
            const auto rows = std::min(strip, format.height - row);
            block_.resize(rows * bytesPerRow);
            const auto got = TIFFReadEncodedStrip(
                handle, TIFFComputeStrip(handle, row, static_cast<std::uint16_t>(sample)), block_.data(),
                static_cast<tmsize_t>(block_.size()));
            if (got < static_cast<tmsize_t>(block_.size()) || !source_->firstError.empty())
                fail("reading page " + std::to_string(page));
            use({0, row, format.width, rows, format.width, sample, perBlock});
            row += rows;
        }
}

void TiffFile::readTiles(const PageFormat& format, int page, const std::function<void(const Block&)>& use) {
    auto* const handle = handle_.get();
    const bool separate = tag<std::uint16_t>(handle, TIFFTAG_PLANARCONFIG) == PLANARCONFIG_SEPARATE;
    const auto width = tag<std::uint32_t>(handle, TIFFTAG_TILEWIDTH);
    const auto height = tag<std::uint32_t>(handle, TIFFTAG_TILELENGTH);
    const int perBlock = separate ? 1 : format.samples;
    const auto bytesPerRow = rowBytes(format.sample, std::size_t{width} * static_cast<std::size_t>(perBlock));
    if (width == 0 || height == 0 || bytesPerRow > kMostTileBytes / height ||
        TIFFTileSize64(handle) != bytesPerRow * height)
        throw InvalidInput(source_->file->name(),
                           "page " + std::to_string(page) + " has tiles of " + std::to_string(width) + " x " +
                               std::to_string(height) + " pixels, which is not possible",
                           kCopyAgain);
    block_.resize(bytesPerRow * height);
    for (int sample = 0; sample < format.samples; sample += perBlock)
        for (std::uint64_t y = 0; y < format.height; y += height)
            for (std::uint64_t x = 0; x < format.width; x += width) {
                const auto left = static_cast<std::uint32_t>(x);
                const auto top = static_cast<std::uint32_t>(y);
                const auto got =
                    TIFFReadTile(handle, block_.data(), left, top, 0, static_cast<std::uint16_t>(sample));
                if (got < static_cast<tmsize_t>(block_.size()) || !source_->firstError.empty())
                    fail("reading page " + std::to_string(page));
                use({left, top, std::min(width, format.width - left), std::min(height, format.height - top),
                     width, sample, perBlock});
            }
}

void TiffFile::provePage(const PageFormat& expected, int page) {
    source_->firstError.clear();
    if (format(page) != expected) throw IoError(source_->file->name(), "it changed while it was read");
    auto* const handle = handle_.get();
    if (TIFFIsTiled(handle)) return readTiles(expected, page, [](const Block&) {});
    const bool separate = tag<std::uint16_t>(handle, TIFFTAG_PLANARCONFIG) == PLANARCONFIG_SEPARATE;
    const auto rowBytes = static_cast<std::uint64_t>(TIFFScanlineSize64(handle));
    if (rowBytes == 0 || rowBytes > kMostBlockBytes) fail("reading page " + std::to_string(page));
    block_.resize(rowBytes);
    for (int sample = 0; sample < (separate ? expected.samples : 1); ++sample)
        for (std::uint32_t row = 0; row < expected.height; ++row)
            if (TIFFReadScanline(handle, block_.data(), row, static_cast<std::uint16_t>(sample)) != 1 ||
                !source_->firstError.empty())
                fail("reading page " + std::to_string(page));
}

void TiffFile::readPage(const PageFormat& expected, int page, std::span<const std::span<std::byte>> planes) {
    source_->firstError.clear();
    if (format(page) != expected) throw IoError(source_->file->name(), "it changed while it was read");
    const auto use = [&](const Block& block) { splitBlock(expected, block, planes); };
    if (TIFFIsTiled(handle_.get()))
        readTiles(expected, page, use);
    else
        readStrips(expected, page, use);
    if (expected.colours == PageColours::Palette && planes.size() == 3)
        mapPalette(page, expected.sample.bits, planes);
}

void TiffFile::splitBlock(const PageFormat& format, const Block& block,
                          std::span<const std::span<std::byte>> planes) const {
    const auto valueBytes = scalarBytes(format.type());
    const auto samples = static_cast<std::size_t>(block.samples);
    const auto bytesPerRow = rowBytes(format.sample, block.rowPixels * samples);
    for (std::size_t sample = 0; sample < samples; ++sample)
        for (std::size_t row = 0; row < block.height; ++row) {
            const auto* from = block_.data() + row * bytesPerRow;
            const auto to = planes[static_cast<std::size_t>(block.firstSample) + sample].subspan(
                ((block.y + row) * format.width + block.x) * valueBytes, block.width * valueBytes);
            if (format.sample.isPacked()) {
                unpackRow(format.sample, from, sample, samples, to);
            } else if (samples == 1) {
                std::memcpy(to.data(), from, to.size());
            } else {
                for (std::size_t i = 0; i < block.width; ++i)
                    std::memcpy(to.data() + i * valueBytes, from + (i * samples + sample) * valueBytes,
                                valueBytes);
            }
        }
}

void TiffFile::mapPalette(int page, int bits, std::span<const std::span<std::byte>> planes) const {
    const auto colours = std::size_t{1} << static_cast<unsigned>(bits);
    std::array<std::uint16_t*, 3> maps{};
    if (!TIFFGetField(handle_.get(), TIFFTAG_COLORMAP, &maps[0], &maps[1], &maps[2]))
        throw InvalidInput(source_->file->name(), "page " + std::to_string(page) + " has lost its palette",
                           kCopyAgain);
    // Some old writers put 8-bit colours in where 16 bits belong.
    const bool wide = std::any_of(maps.begin(), maps.end(), [&](const std::uint16_t* map) {
        return std::any_of(map, map + colours, [](std::uint16_t value) { return value > 255; });
    });
    for (std::size_t pixel = 0; pixel < planes[0].size(); ++pixel) {
        const auto index = std::to_integer<std::size_t>(planes[0][pixel]);
        for (std::size_t channel = 0; channel < 3; ++channel) {
            const unsigned value = maps[channel][index];
            planes[channel][pixel] = static_cast<std::byte>(wide ? value >> 8U : value);
        }
    }
}

} // namespace voxsheet::import
