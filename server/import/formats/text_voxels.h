// Voxels written as text, as a stream of little-endian bytes.
#pragma once

#include "import/formats/byte_stream.h"
#include "volume/scalar_type.h"

#include <memory>
#include <string>

namespace voxsheet::import {

/// Numbers between blanks, line ends or commas. Reading throws InvalidInput (subject `name`) at a word that
/// is no number or does not fit the type.
[[nodiscard]] std::unique_ptr<ByteStream> asciiVoxels(std::unique_ptr<ByteStream> text, ScalarType type,
                                                      std::string name);

/// Hexadecimal digits, two a byte, in the order of the bytes; blanks are skipped.
[[nodiscard]] std::unique_ptr<ByteStream> hexVoxels(std::unique_ptr<ByteStream> text, std::string name);

} // namespace voxsheet::import
