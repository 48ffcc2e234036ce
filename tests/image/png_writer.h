// Pictures as PNG files, for people to look at.
#pragma once

#include "fields/picture.h"

#include <string>

namespace voxsheet::image {

/// 8-bit RGB over black, top row first. Throws IoError.
void writePng(const std::string& path, const fields::Picture& picture);

} // namespace voxsheet::image
