#include "engine/image_file.h"

#include "base/errors.h"
#include "base/thread_count.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <string>
#include <system_error>
#include <vector>

#include <OpenImageIO/imageio.h>
#include <unistd.h>

namespace voxsheet::engine {

namespace {

enum class FileKind { Png, Jpeg, Webp, Tiff, Exr };

FileKind kindOf(const std::filesystem::path& file) {
    std::string ending = file.extension().string();
    std::transform(ending.begin(), ending.end(), ending.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    if (ending == ".png") return FileKind::Png;
    if (ending == ".jpg" || ending == ".jpeg") return FileKind::Jpeg;
    if (ending == ".webp") return FileKind::Webp;
    if (ending == ".tif" || ending == ".tiff") return FileKind::Tiff;
    if (ending == ".exr") return FileKind::Exr;
    throw InvalidInput("output file '" + file.string() + "'",
                       ending.empty() ? "its name has no ending" : "'" + ending + "' is not a picture format",
                       "use .png, .jpg, .webp, .exr or .tif");
}

bool wantsFloats(FileKind kind) { return kind == FileKind::Tiff || kind == FileKind::Exr; }

std::vector<float> asFloats(const TilePixels& picture) {
    if (!picture.rgba32f.empty()) return picture.rgba32f;
    std::vector<float> out(picture.rgba8.size());
    std::transform(picture.rgba8.begin(), picture.rgba8.end(), out.begin(),
                   [](unsigned char v) { return static_cast<float>(v) / 255.0F; });
    return out;
}

std::vector<unsigned char> asBytes(const TilePixels& picture) {
    if (!picture.rgba8.empty()) return picture.rgba8;
    std::vector<unsigned char> out(picture.rgba32f.size());
    std::transform(picture.rgba32f.begin(), picture.rgba32f.end(), out.begin(), [](float v) {
        return static_cast<unsigned char>(
            std::lround(std::clamp(std::isnan(v) ? 0.0F : v, 0.0F, 1.0F) * 255.0F));
    });
    return out;
}

bool isOpaque(const std::vector<unsigned char>& rgba) {
    for (std::size_t i = 3; i < rgba.size(); i += 4) {
        if (rgba[i] != 255) return false;
    }
    return true;
}

/// Colour over black is the premultiplied colour itself.
std::vector<unsigned char> withoutAlpha(const std::vector<unsigned char>& rgba) {
    std::vector<unsigned char> rgb;
    rgb.reserve(rgba.size() / 4 * 3);
    for (std::size_t i = 0; i < rgba.size(); i += 4)
        rgb.insert(rgb.end(), rgba.begin() + static_cast<long>(i), rgba.begin() + static_cast<long>(i) + 3);
    return rgb;
}

/// OpenImageIO takes premultiplied pixels and divides for formats with straight alpha; its division works
/// on linear values unless told otherwise, so it is done here.
void unpremultiply(std::vector<unsigned char>& rgba) {
    for (std::size_t i = 0; i < rgba.size(); i += 4) {
        const unsigned alpha = rgba[i + 3];
        if (alpha == 0 || alpha == 255) continue;
        for (std::size_t c = 0; c < 3; ++c) {
            rgba[i + c] =
                static_cast<unsigned char>(std::min(255U, (rgba[i + c] * 255U + alpha / 2U) / alpha));
        }
    }
}

OIIO::ImageSpec specFor(const TilePixels& picture, FileKind kind, int channels) {
    OIIO::ImageSpec spec(picture.size.x, picture.size.y, channels,
                         wantsFloats(kind) ? OIIO::TypeDesc::FLOAT : OIIO::TypeDesc::UINT8);
    spec.attribute("Software", "Voxsheet");
    if (kind == FileKind::Exr) {
        spec.attribute("voxsheet:colorspace", "display sRGB, not linear; alpha premultiplied");
        spec.attribute("compression", "zip");
    } else {
        spec.attribute("oiio:ColorSpace", "sRGB");
    }
    if (kind == FileKind::Tiff) spec.attribute("compression", "zip");
    if (kind == FileKind::Jpeg) spec.attribute("Compression", "jpeg:95");
    if (kind == FileKind::Webp) spec.attribute("Compression", "webp:100");
    if (kind == FileKind::Png || kind == FileKind::Webp) spec.attribute("oiio:UnassociatedAlpha", 1);
    return spec;
}

void writeTo(const std::filesystem::path& target, const TilePixels& picture, FileKind kind) {
    const auto fail = [&](const std::string& why) {
        throw IoError("picture '" + target.string() + "'", why,
                      "check the folder and the space left on the disk");
    };
    const auto output = OIIO::ImageOutput::create(target.string());
    if (!output) fail("OpenImageIO has no writer for it: " + OIIO::geterror());
    const auto write = [&](const OIIO::ImageSpec& spec, OIIO::TypeDesc type, const void* data) {
        if (!output->open(target.string(), spec) || !output->write_image(type, data) || !output->close()) {
            fail(output->geterror());
        }
    };
    if (wantsFloats(kind)) {
        const std::vector<float> floats = asFloats(picture);
        write(specFor(picture, kind, 4), OIIO::TypeDesc::FLOAT, floats.data());
        return;
    }
    std::vector<unsigned char> bytes = asBytes(picture);
    if (kind == FileKind::Jpeg || isOpaque(bytes)) {
        bytes = withoutAlpha(bytes);
        write(specFor(picture, kind, 3), OIIO::TypeDesc::UINT8, bytes.data());
        return;
    }
    unpremultiply(bytes);
    write(specFor(picture, kind, 4), OIIO::TypeDesc::UINT8, bytes.data());
}

} // namespace

PixelFormat pixelFormatFor(const std::filesystem::path& file) {
    return wantsFloats(kindOf(file)) ? PixelFormat::Rgba32F : PixelFormat::Rgba8;
}

void writeImageFile(const TilePixels& picture, const std::filesystem::path& file) {
    const FileKind kind = kindOf(file);
    OIIO::attribute("threads", threadCount().threads);
    const auto samples = static_cast<std::size_t>(std::max(picture.size.x, 0)) *
                         static_cast<std::size_t>(std::max(picture.size.y, 0)) * 4;
    if (samples == 0 || (picture.rgba8.size() != samples && picture.rgba32f.size() != samples)) {
        throw InvalidInput("picture for '" + file.string() + "'", "its pixels do not fit its size");
    }
    // The ending stays the last part of the name: OpenImageIO chooses the format by it.
    std::filesystem::path partial = file;
    partial.replace_filename("." + file.stem().string() + "." + std::to_string(::getpid()) + ".part" +
                             file.extension().string());
    std::error_code error;
    try {
        writeTo(partial, picture, kind);
        std::filesystem::rename(partial, file);
    } catch (const std::filesystem::filesystem_error& failure) {
        std::filesystem::remove(partial, error);
        throw IoError("picture '" + file.string() + "'", failure.code().message(),
                      "check the folder's permissions");
    } catch (...) {
        std::filesystem::remove(partial, error);
        throw;
    }
}

} // namespace voxsheet::engine
