// Numbers as bytes, and bytes compressed, for files that tests write.
#pragma once

#include <bzlib.h>
#include <zlib.h>

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <stdexcept>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

namespace voxsheet::import::testing {

template <typename T>
std::string bytesOf(const std::vector<T>& values, bool bigEndian = false) {
    std::string bytes(values.size() * sizeof(T), '\0');
    std::memcpy(bytes.data(), values.data(), bytes.size());
    if (bigEndian)
        for (std::size_t at = 0; at < bytes.size(); at += sizeof(T))
            std::reverse(bytes.begin() + static_cast<std::ptrdiff_t>(at),
                         bytes.begin() + static_cast<std::ptrdiff_t>(at + sizeof(T)));
    return bytes;
}

/// Values that differ in every byte, from the whole range of the type.
template <typename T>
std::vector<T> ramp(std::size_t count) {
    std::vector<T> values(count);
    for (std::size_t i = 0; i < count; ++i) {
        if constexpr (std::is_floating_point_v<T>)
            values[i] = static_cast<T>(static_cast<double>(i) * 1.25 - 7.0);
        else
            values[i] = static_cast<T>(i * 0x9E3779B97F4A7C15ULL >> (64 - 8 * sizeof(T)));
    }
    return values;
}

/// `head`, then `block` `repeats` times, compressed without holding all of it.
inline std::string deflated(std::string_view head, std::string_view block, std::size_t repeats,
                            int windowBits) {
    z_stream stream{};
    if (deflateInit2(&stream, 6, Z_DEFLATED, windowBits, 8, Z_DEFAULT_STRATEGY) != Z_OK)
        throw std::runtime_error("zlib could not be started");
    std::string out;
    std::vector<char> buffer(65536);
    const auto feed = [&](std::string_view bytes, int flush) {
        std::string in(bytes);
        stream.next_in = reinterpret_cast<Bytef*>(in.data());
        stream.avail_in = static_cast<uInt>(in.size());
        do {
            stream.next_out = reinterpret_cast<Bytef*>(buffer.data());
            stream.avail_out = static_cast<uInt>(buffer.size());
            (void)deflate(&stream, flush);
            out.append(buffer.data(), buffer.size() - stream.avail_out);
        } while (stream.avail_out == 0);
    };
    feed(head, Z_NO_FLUSH);
    for (std::size_t repeat = 0; repeat < repeats; ++repeat)
        feed(block, Z_NO_FLUSH);
    feed({}, Z_FINISH);
    deflateEnd(&stream);
    return out;
}
inline std::string gzipped(std::string_view bytes) { return deflated(bytes, {}, 0, 15 + 16); }
inline std::string zlibbed(std::string_view bytes) { return deflated(bytes, {}, 0, 15); }
inline std::string gzipBomb(std::string_view head, std::string_view block, std::size_t repeats) {
    return deflated(head, block, repeats, 15 + 16);
}

inline std::string bzipped(std::string_view bytes) {
    std::string in(bytes);
    auto size = static_cast<unsigned>(in.size() + in.size() / 50 + 1024);
    std::string out(size, '\0');
    if (BZ2_bzBuffToBuffCompress(out.data(), &size, in.data(), static_cast<unsigned>(in.size()), 9, 0, 0) !=
        BZ_OK)
        throw std::runtime_error("libbz2 does not compress");
    out.resize(size);
    return out;
}

} // namespace voxsheet::import::testing
