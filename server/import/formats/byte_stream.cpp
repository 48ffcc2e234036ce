#include "import/formats/byte_stream.h"

#include "base/errors.h"

#include <algorithm>
#include <array>
#include <limits>
#include <vector>

#include <bzlib.h>
#include <zlib.h>

namespace voxsheet::import {

namespace {

constexpr std::size_t kBlockBytes = 256 * 1024;

class PlainStream final : public ByteStream {
public:
    PlainStream(const InputFile& file, std::uint64_t offset) : file_(file), offset_(offset) {}

    std::size_t read(std::span<std::byte> out) override {
        const auto got = file_.readAt(offset_, out);
        offset_ += got;
        return got;
    }

    std::uint64_t skip(std::uint64_t count) override {
        const auto done = std::min(count, file_.bytes() - std::min(offset_, file_.bytes()));
        offset_ += done;
        return done;
    }

private:
    const InputFile& file_;
    std::uint64_t offset_;
};

/// Compressed input, block by block.
class CompressedInput {
public:
    CompressedInput(const InputFile& file, std::uint64_t offset)
        : plain_(file, offset), block_(kBlockBytes) {}

    /// The unread part of the block, the next block when it is used up; empty at the end of the file.
    std::span<std::byte> unread() {
        if (unread_.empty()) unread_ = std::span(block_).first(plain_.read(block_));
        return unread_;
    }
    void keepLast(std::size_t count) { unread_ = unread_.last(count); }

private:
    PlainStream plain_;
    std::vector<std::byte> block_;
    std::span<std::byte> unread_;
};

[[noreturn]] void throwDamaged(const InputFile& file, const char* method, const char* reason) {
    throw InvalidInput(file.name(), std::string("its ") + method + " data are " + reason,
                       "copy or write the file again");
}

unsigned chunk(std::size_t count) {
    return static_cast<unsigned>(std::min<std::size_t>(count, std::numeric_limits<int>::max()));
}

class GzipStream final : public ByteStream {
public:
    GzipStream(const InputFile& file, std::uint64_t offset) : file_(file), input_(file, offset) {
        constexpr int largestWindowAnyWrapper = 15 + 32;
        if (inflateInit2(&state_, largestWindowAnyWrapper) != Z_OK)
            throw InternalError(file.name(), "zlib could not be started");
    }
    ~GzipStream() override { inflateEnd(&state_); }
    GzipStream(const GzipStream&) = delete;
    GzipStream& operator=(const GzipStream&) = delete;

    std::size_t read(std::span<std::byte> out) override {
        std::size_t done = 0;
        while (done < out.size() && !ended_) {
            const auto in = input_.unread();
            if (in.empty()) throwDamaged(file_, "gzip", "truncated");
            state_.next_in = reinterpret_cast<Bytef*>(in.data());
            state_.avail_in = chunk(in.size());
            state_.next_out = reinterpret_cast<Bytef*>(out.data() + done);
            const auto room = chunk(out.size() - done);
            state_.avail_out = room;
            const int result = inflate(&state_, Z_NO_FLUSH);
            done += room - state_.avail_out;
            input_.keepLast(state_.avail_in);
            if (result == Z_STREAM_END)
                endMember();
            else if (result != Z_OK && result != Z_BUF_ERROR)
                throwDamaged(file_, "gzip", "damaged");
        }
        return done;
    }

private:
    /// A gzip file may be several members in a row (pigz, bgzip); what follows that is no member is ignored,
    /// as gzip does.
    void endMember() {
        const auto next = input_.unread();
        const bool another =
            !next.empty() && next[0] == std::byte{0x1f} && (next.size() < 2 || next[1] == std::byte{0x8b});
        if (!another || inflateReset(&state_) != Z_OK) ended_ = true;
    }

    const InputFile& file_;
    CompressedInput input_;
    z_stream state_{};
    bool ended_ = false;
};

class Bzip2Stream final : public ByteStream {
public:
    Bzip2Stream(const InputFile& file, std::uint64_t offset) : file_(file), input_(file, offset) { start(); }
    ~Bzip2Stream() override { BZ2_bzDecompressEnd(&state_); }
    Bzip2Stream(const Bzip2Stream&) = delete;
    Bzip2Stream& operator=(const Bzip2Stream&) = delete;

    std::size_t read(std::span<std::byte> out) override {
        std::size_t done = 0;
        while (done < out.size() && !ended_) {
            const auto in = input_.unread();
            if (in.empty()) throwDamaged(file_, "bzip2", "truncated");
            state_.next_in = reinterpret_cast<char*>(in.data());
            state_.avail_in = chunk(in.size());
            state_.next_out = reinterpret_cast<char*>(out.data() + done);
            const auto room = chunk(out.size() - done);
            state_.avail_out = room;
            const int result = BZ2_bzDecompress(&state_);
            done += room - state_.avail_out;
            input_.keepLast(state_.avail_in);
            if (result == BZ_STREAM_END)
                endStream();
            else if (result != BZ_OK)
                throwDamaged(file_, "bzip2", "damaged");
        }
        return done;
    }

private:
    void start() {
        state_ = {};
        if (BZ2_bzDecompressInit(&state_, 0, 0) != BZ_OK)
            throw InternalError(file_.name(), "libbz2 could not be started");
    }

    /// As with gzip, streams may follow on each other (pbzip2).
    void endStream() {
        const auto next = input_.unread();
        if (next.empty() || next[0] != std::byte{'B'}) {
            ended_ = true;
            return;
        }
        BZ2_bzDecompressEnd(&state_);
        start();
    }

    const InputFile& file_;
    CompressedInput input_;
    bz_stream state_{};
    bool ended_ = false;
};

} // namespace

std::uint64_t ByteStream::skip(std::uint64_t count) {
    std::vector<std::byte> dropped(static_cast<std::size_t>(std::min<std::uint64_t>(count, kBlockBytes)));
    std::uint64_t done = 0;
    while (done < count) {
        const auto want = static_cast<std::size_t>(std::min<std::uint64_t>(count - done, dropped.size()));
        const auto got = read(std::span(dropped).first(want));
        done += got;
        if (got < want) break;
    }
    return done;
}

std::unique_ptr<ByteStream> openStream(const InputFile& file, std::uint64_t offset, Compression compression) {
    switch (compression) {
    case Compression::Gzip:
        return std::make_unique<GzipStream>(file, offset);
    case Compression::Bzip2:
        return std::make_unique<Bzip2Stream>(file, offset);
    case Compression::None:
        break;
    }
    return std::make_unique<PlainStream>(file, offset);
}

Compression compressionOf(std::string_view firstBytes) {
    if (firstBytes.starts_with("\x1f\x8b")) return Compression::Gzip;
    if (firstBytes.starts_with("BZh")) return Compression::Bzip2;
    return Compression::None;
}

std::uint64_t largestDecompressedBytes(std::uint64_t compressedBytes, Compression compression) {
    constexpr std::uint64_t deflateRatio = 1032;
    constexpr std::uint64_t bzip2Ratio = 2'000'000;
    constexpr std::uint64_t cap = 1ULL
                                  << 42; // a file of 4 TiB has no say beyond this; keeps the product in range
    const auto bounded = std::min(compressedBytes, cap);
    switch (compression) {
    case Compression::Gzip:
        return bounded * deflateRatio;
    case Compression::Bzip2:
        return bounded * bzip2Ratio;
    case Compression::None:
        break;
    }
    return compressedBytes;
}

bool promisesMuch(std::uint64_t promisedBytes, std::uint64_t compressedBytes) {
    constexpr std::uint64_t ratio = 32;
    constexpr std::uint64_t harmlessBytes = 32ULL << 20;
    return promisedBytes > harmlessBytes && promisedBytes / ratio > compressedBytes;
}

} // namespace voxsheet::import
