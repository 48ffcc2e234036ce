#include "image/png_writer.h"

#include "base/errors.h"

#include <png.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace voxsheet::image {

void writePng(const std::string& path, const fields::Picture& picture) {
    std::vector<unsigned char> bytes;
    bytes.reserve(picture.pixels.size() * 3);
    for (int y = picture.size.y - 1; y >= 0; --y)
        for (int x = 0; x < picture.size.x; ++x)
            for (int channel = 0; channel < 3; ++channel)
                bytes.push_back(static_cast<unsigned char>(
                    std::lround(255.0 * std::clamp(picture.at(x, y)[channel], 0.0, 1.0))));
    png_image image{};
    image.version = PNG_IMAGE_VERSION;
    image.width = static_cast<png_uint_32>(picture.size.x);
    image.height = static_cast<png_uint_32>(picture.size.y);
    image.format = PNG_FORMAT_RGB;
    if (png_image_write_to_file(&image, path.c_str(), 0, bytes.data(), 0, nullptr) == 0)
        throw IoError(path, image.message);
}

} // namespace voxsheet::image
