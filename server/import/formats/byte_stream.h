// Bytes of a file in order, decompressed on the way. Callers ask for what the header promises, so that a
// small file that inflates without end costs no more than that.
#pragma once

#include "import/formats/input_file.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>

namespace voxsheet::import {

enum class Compression {
    None,
    Gzip, ///< gzip (several members follow on each other) or zlib, told apart by their first bytes
    Bzip2,
};

class ByteStream {
public:
    virtual ~ByteStream() = default;

    /// Fills `out` as far as the stream goes; returns the number of bytes, less than out.size() only at the
    /// end. Throws InvalidInput (damaged or truncated compressed data), IoError.
    [[nodiscard]] virtual std::size_t read(std::span<std::byte> out) = 0;

    /// Reads and drops; returns how many bytes there were, at most `count`.
    virtual std::uint64_t skip(std::uint64_t count);
};

/// Stream of `file` from `offset` to its end. The file must live as long as the stream.
[[nodiscard]] std::unique_ptr<ByteStream> openStream(const InputFile& file, std::uint64_t offset,
                                                     Compression);

/// By the first bytes: 1f 8b is gzip, "BZh" is bzip2.
[[nodiscard]] Compression compressionOf(std::string_view firstBytes);

/// An upper bound of the bytes that `compressedBytes` can decompress to, for refusing lying headers before
/// anything is allocated. Deflate: at most 1032:1 (zlib's technical notes); bzip2: a block of 900 kB
/// run-length codes, 255 bytes in 5, in about 40 bytes.
[[nodiscard]] std::uint64_t largestDecompressedBytes(std::uint64_t compressedBytes, Compression compression);

/// A small file promises so much that it is decompressed once for nothing before memory is taken for it. Real
/// volumes that compress that well (masks, mostly) decompress fast.
[[nodiscard]] bool promisesMuch(std::uint64_t promisedBytes, std::uint64_t compressedBytes);

} // namespace voxsheet::import
