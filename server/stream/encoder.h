// Pictures to bytes: JPEG (libjpeg-turbo), PNG (libpng) and WebP (libwebp).
#pragma once

#include "frame/frame_spec.h"

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace voxsheet::stream {

enum class ImageFormat { Jpeg, Png, Webp };

struct EncodeSettings {
    ImageFormat format = ImageFormat::Png;
    int quality = 90;             ///< [1, 100]; JPEG and lossy WebP
    bool lossless = true;         ///< WebP only; PNG always is, JPEG never
    bool subsampleChroma = false; ///< JPEG: 4:2:0 instead of 4:4:4
    bool fast = false;            ///< PNG, WebP: speed before size
};

/// Encodes rgba8 (size.x * size.y * 4 bytes, top row first, premultiplied alpha). PNG is tagged sRGB and
/// written with straight alpha; a picture whose alpha is 255 everywhere is written as RGB. JPEG drops alpha
/// (over black). Thread-safe. Throws InvalidInput if the buffer does not fit its size, InternalError if the
/// library fails.
[[nodiscard]] std::string encodeImage(const TilePixels& pixels, const EncodeSettings& settings);

/// "image/png", …
[[nodiscard]] const char* mediaType(ImageFormat format) noexcept;
/// "png", "jpeg", "webp" as in the stream's tile header.
[[nodiscard]] const char* formatName(ImageFormat format) noexcept;
/// From a file extension without dot: png, jpg, jpeg, webp.
[[nodiscard]] std::optional<ImageFormat> formatFromExtension(std::string_view extension) noexcept;

} // namespace voxsheet::stream
