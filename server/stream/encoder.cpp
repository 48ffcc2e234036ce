#include "stream/encoder.h"

#include "base/errors.h"

#include <array>
#include <csetjmp>
#include <cstdlib>
#include <memory>

#include <png.h>
#include <turbojpeg.h>
#include <webp/encode.h>

namespace voxsheet::stream {

namespace {

struct FormatRow {
    ImageFormat format;
    const char* name;
    const char* media;
};

constexpr std::array<FormatRow, 3> kFormats{{
    {ImageFormat::Jpeg, "jpeg", "image/jpeg"},
    {ImageFormat::Png, "png", "image/png"},
    {ImageFormat::Webp, "webp", "image/webp"},
}};

bool isOpaque(const std::vector<unsigned char>& rgba) {
    for (std::size_t i = 3; i < rgba.size(); i += 4)
        if (rgba[i] != 255) return false;
    return true;
}

/// Straight alpha, as PNG and WebP define it; rounded to nearest.
std::vector<unsigned char> unpremultiplied(const std::vector<unsigned char>& rgba) {
    auto straight = rgba;
    for (std::size_t i = 0; i < straight.size(); i += 4) {
        const unsigned alpha = straight[i + 3];
        if (alpha == 0 || alpha == 255) continue;
        for (std::size_t c = 0; c < 3; ++c) {
            const unsigned value = (straight[i + c] * 255U + alpha / 2U) / alpha;
            straight[i + c] = static_cast<unsigned char>(value > 255U ? 255U : value);
        }
    }
    return straight;
}

std::vector<unsigned char> withoutAlpha(const std::vector<unsigned char>& rgba) {
    std::vector<unsigned char> rgb(rgba.size() / 4 * 3);
    for (std::size_t i = 0, o = 0; i < rgba.size(); i += 4, o += 3) {
        rgb[o] = rgba[i];
        rgb[o + 1] = rgba[i + 1];
        rgb[o + 2] = rgba[i + 2];
    }
    return rgb;
}

std::string encodeJpeg(const TilePixels& pixels, const EncodeSettings& settings) {
    const std::unique_ptr<void, int (*)(tjhandle)> compressor(tjInitCompress(), &tjDestroy);
    if (!compressor) throw InternalError("JPEG encoder", "could not be created");
    const int subsampling = settings.subsampleChroma ? TJSAMP_420 : TJSAMP_444;
    // Room for the worst case, a tenth of which is ever written: not filled before.
    unsigned long bytes = tjBufSize(pixels.size.x, pixels.size.y, subsampling);
    const auto room = std::make_unique_for_overwrite<unsigned char[]>(bytes);
    auto* buffer = room.get();
    if (tjCompress2(compressor.get(), pixels.rgba8.data(), pixels.size.x, 0, pixels.size.y, TJPF_RGBX,
                    &buffer, &bytes, subsampling, settings.quality, TJFLAG_NOREALLOC | TJFLAG_FASTDCT) != 0)
        throw InternalError("JPEG encoder", tjGetErrorStr2(compressor.get()));
    return {reinterpret_cast<const char*>(buffer), bytes};
}

void appendPngBytes(png_structp png, png_bytep data, png_size_t count) {
    static_cast<std::string*>(png_get_io_ptr(png))->append(reinterpret_cast<const char*>(data), count);
}

[[noreturn]] void throwPngError(png_structp /*png*/, png_const_charp text) {
    throw InternalError("PNG encoder", text);
}

/// Owns the pair of libpng structures; its error handler throws, so no setjmp is needed.
class PngWriter {
public:
    PngWriter() : png_(png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, &throwPngError, nullptr)) {
        if (png_ != nullptr) info_ = png_create_info_struct(png_);
        if (info_ == nullptr) throw InternalError("PNG encoder", "could not be created");
    }
    ~PngWriter() { png_destroy_write_struct(&png_, &info_); }
    PngWriter(const PngWriter&) = delete;
    PngWriter& operator=(const PngWriter&) = delete;
    [[nodiscard]] png_structp png() const { return png_; }
    [[nodiscard]] png_infop info() const { return info_; }

private:
    png_structp png_;
    png_infop info_ = nullptr;
};

std::string encodePng(const TilePixels& pixels, const EncodeSettings& settings) {
    const bool opaque = isOpaque(pixels.rgba8);
    const auto data = opaque ? withoutAlpha(pixels.rgba8) : unpremultiplied(pixels.rgba8);
    const std::size_t stride = static_cast<std::size_t>(pixels.size.x) * (opaque ? 3 : 4);
    std::string out;
    out.reserve(data.size() / 2 + 1024);
    const PngWriter writer;
    png_set_write_fn(writer.png(), &out, &appendPngBytes, nullptr);
    png_set_IHDR(writer.png(), writer.info(), static_cast<png_uint_32>(pixels.size.x),
                 static_cast<png_uint_32>(pixels.size.y), 8,
                 opaque ? PNG_COLOR_TYPE_RGB : PNG_COLOR_TYPE_RGB_ALPHA, PNG_INTERLACE_NONE,
                 PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
    png_set_sRGB(writer.png(), writer.info(), PNG_sRGB_INTENT_PERCEPTUAL);
    // One filter and level 1: measured several times faster than libpng's adaptive default, for a quarter
    // more bytes.
    if (settings.fast) {
        png_set_compression_level(writer.png(), 1);
        png_set_filter(writer.png(), PNG_FILTER_TYPE_BASE, PNG_FILTER_SUB);
    }
    png_write_info(writer.png(), writer.info());
    for (int y = 0; y < pixels.size.y; ++y)
        png_write_row(writer.png(), data.data() + static_cast<std::size_t>(y) * stride);
    png_write_end(writer.png(), nullptr);
    return out;
}

std::string encodeWebp(const TilePixels& pixels, const EncodeSettings& settings) {
    WebPConfig config;
    WebPPicture picture;
    if (WebPConfigInit(&config) == 0 || WebPPictureInit(&picture) == 0)
        throw InternalError("WebP encoder", "version mismatch");
    config.lossless = settings.lossless ? 1 : 0;
    config.quality = settings.lossless ? 20.0F : static_cast<float>(settings.quality);
    config.method = settings.fast ? 0 : 3;
    config.exact = 1;
    picture.use_argb = 1;
    picture.width = pixels.size.x;
    picture.height = pixels.size.y;
    WebPMemoryWriter memory;
    WebPMemoryWriterInit(&memory);
    picture.writer = WebPMemoryWrite;
    picture.custom_ptr = &memory;
    const auto straight = unpremultiplied(pixels.rgba8);
    const bool done = WebPPictureImportRGBA(&picture, straight.data(), pixels.size.x * 4) != 0 &&
                      WebPEncode(&config, &picture) != 0;
    std::string out(reinterpret_cast<const char*>(memory.mem), memory.size);
    const auto code = static_cast<int>(picture.error_code);
    WebPMemoryWriterClear(&memory);
    WebPPictureFree(&picture);
    if (!done) throw InternalError("WebP encoder", "failed with code " + std::to_string(code));
    return out;
}

} // namespace

std::string encodeImage(const TilePixels& pixels, const EncodeSettings& settings) {
    const auto expected =
        static_cast<std::size_t>(pixels.size.x) * static_cast<std::size_t>(pixels.size.y) * 4;
    if (pixels.size.x < 1 || pixels.size.y < 1 || pixels.rgba8.size() != expected)
        throw InvalidInput("picture to encode", "its buffer does not fit its size");
    switch (settings.format) {
    case ImageFormat::Jpeg:
        return encodeJpeg(pixels, settings);
    case ImageFormat::Webp:
        return encodeWebp(pixels, settings);
    case ImageFormat::Png:
        break;
    }
    return encodePng(pixels, settings);
}

const char* mediaType(ImageFormat format) noexcept {
    return kFormats[static_cast<std::size_t>(format)].media;
}

const char* formatName(ImageFormat format) noexcept {
    return kFormats[static_cast<std::size_t>(format)].name;
}

std::optional<ImageFormat> formatFromExtension(std::string_view extension) noexcept {
    if (extension == "jpg") return ImageFormat::Jpeg;
    for (const auto& row : kFormats)
        if (extension == row.name) return row.format;
    return std::nullopt;
}

} // namespace voxsheet::stream
