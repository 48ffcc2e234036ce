#include "tiff_mutants.h"

#include "packed_bytes.h"
#include <glm/glm.hpp>
#include <tiffio.h>
#include <unistd.h>

#include <fstream>
#include <iterator>

namespace voxsheet::import::testing {

namespace {

constexpr std::uint32_t kEdge = 1024;
constexpr int kPages = 120;

template <typename T>
T numberAt(const std::string& bytes, std::size_t at) {
    T value{};
    std::memcpy(&value, bytes.data() + at, sizeof value);
    return value;
}

/// Where a page's directory has what.
class Directory {
public:
    Directory(const std::string& bytes, std::size_t at) : bytes_(bytes), at_(at) {}
    static Directory first(const std::string& bytes) { return {bytes, numberAt<std::uint32_t>(bytes, 4)}; }
    static Directory last(const std::string& bytes) {
        auto directory = first(bytes);
        while (const auto following = numberAt<std::uint32_t>(bytes, directory.next()))
            directory = {bytes, following};
        return directory;
    }
    Directory& operator=(const Directory& other) {
        at_ = other.at_; // of the same file
        return *this;
    }
    Directory(const Directory&) = default;

    [[nodiscard]] std::size_t position() const { return at_; }
    /// Of the offset of the next page.
    [[nodiscard]] std::size_t next() const {
        return at_ + 2 + std::size_t{12} * numberAt<std::uint16_t>(bytes_, at_);
    }
    /// Of a tag's entry. Throws if there is none: a mutation must change something.
    [[nodiscard]] std::size_t entry(std::uint16_t tag) const {
        for (std::size_t at = at_ + 2; at < next(); at += 12)
            if (numberAt<std::uint16_t>(bytes_, at) == tag) return at;
        throw std::logic_error("the sample has no tag " + std::to_string(tag));
    }
    /// The last value of a tag: its place and its bytes.
    [[nodiscard]] std::pair<std::size_t, std::size_t> lastValue(std::uint16_t tag) const {
        const auto at = entry(tag);
        const std::size_t bytes = numberAt<std::uint16_t>(bytes_, at + 2) == 3 ? 2 : 4; // SHORT, LONG
        const auto all = bytes * numberAt<std::uint32_t>(bytes_, at + 4);
        const auto begin = all <= 4 ? at + 8 : numberAt<std::uint32_t>(bytes_, at + 8);
        return {begin + all - bytes, bytes};
    }

private:
    const std::string& bytes_;
    std::size_t at_;
};

std::string contentsOf(const std::filesystem::path& path) {
    std::ifstream in(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}

class BombMaker {
public:
    explicit BombMaker(const std::filesystem::path& scratch)
        : file_(scratch / ("voxsheet_bomb_" + std::to_string(::getpid()) + ".tif")) {}
    ~BombMaker() {
        std::error_code ignored;
        std::filesystem::remove(file_, ignored);
    }

    /// Zeros, whose last strip or tile is said to have half the bytes that it has. Little memory: that of a
    /// process counts for its children, too.
    void add(const std::string& name, int compression, glm::uvec2 size, int pages, std::uint32_t tile = 0) {
        TIFF* const tiff = TIFFOpen(file_.c_str(), "w");
        if (!tiff) throw std::runtime_error("libtiff cannot create the test's file");
        for (int page = 0; page < pages; ++page)
            writePage(tiff, compression, size, tile);
        TIFFClose(tiff);
        auto bytes = contentsOf(file_);
        if (bytes.size() > (std::size_t{kPages} << 20) / 500)
            throw std::logic_error(name + " is no bomb: " + std::to_string(bytes.size()) + " bytes");
        const auto [at, length] =
            Directory::last(bytes).lastValue(tile > 0 ? TIFFTAG_TILEBYTECOUNTS : TIFFTAG_STRIPBYTECOUNTS);
        const auto half =
            (length == 2 ? numberAt<std::uint16_t>(bytes, at) : numberAt<std::uint32_t>(bytes, at)) / 2;
        bytes.replace(at, length, bytesOf(std::vector{static_cast<std::uint32_t>(half)}).substr(0, length));
        mutants_.push_back({"cut off at its end", {name, std::move(bytes), 0, {}}, false});
    }

    [[nodiscard]] std::vector<Mutant> all() && { return std::move(mutants_); }

private:
    static void writePage(TIFF* tiff, int compression, glm::uvec2 size, std::uint32_t tile) {
        TIFFSetField(tiff, TIFFTAG_IMAGEWIDTH, size.x);
        TIFFSetField(tiff, TIFFTAG_IMAGELENGTH, size.y);
        TIFFSetField(tiff, TIFFTAG_SAMPLESPERPIXEL, 1);
        TIFFSetField(tiff, TIFFTAG_BITSPERSAMPLE, 8);
        TIFFSetField(tiff, TIFFTAG_COMPRESSION, compression);
        TIFFSetField(tiff, TIFFTAG_PHOTOMETRIC, PHOTOMETRIC_MINISBLACK);
        if (tile > 0) {
            TIFFSetField(tiff, TIFFTAG_TILEWIDTH, tile);
            TIFFSetField(tiff, TIFFTAG_TILELENGTH, tile);
        } else {
            TIFFSetField(tiff, TIFFTAG_ROWSPERSTRIP, size.y);
        }
        std::vector<std::uint8_t> zeros(tile > 0 ? std::size_t{tile} * tile : size.x);
        const auto blocks = tile > 0 ? TIFFNumberOfTiles(tiff) : size.y;
        for (std::uint32_t block = 0; block < blocks; ++block)
            if ((tile > 0
                     ? TIFFWriteEncodedTile(tiff, block, zeros.data(), static_cast<tmsize_t>(zeros.size()))
                     : TIFFWriteScanline(tiff, zeros.data(), block, 0)) < 0)
                throw std::runtime_error("libtiff cannot write the test's page");
        if (!TIFFWriteDirectory(tiff)) throw std::runtime_error("libtiff cannot write the test's directory");
    }

    std::filesystem::path file_;
    std::vector<Mutant> mutants_;
};

/// 120 pages that share one strip, of 1 MiB where they are not compressed.
Mutant sharedStrip(int compression, const std::string& strip) {
    std::string bytes("II*\0", 4);
    bytes += bytesOf(std::vector<std::uint32_t>{8 + static_cast<std::uint32_t>(strip.size())}) + strip;
    const std::vector<std::pair<std::uint16_t, std::uint32_t>> tags{
        {TIFFTAG_IMAGEWIDTH, kEdge},
        {TIFFTAG_IMAGELENGTH, kEdge},
        {TIFFTAG_BITSPERSAMPLE, 8},
        {TIFFTAG_COMPRESSION, static_cast<std::uint32_t>(compression)},
        {TIFFTAG_PHOTOMETRIC, 1},
        {TIFFTAG_STRIPOFFSETS, 8},
        {TIFFTAG_SAMPLESPERPIXEL, 1},
        {TIFFTAG_ROWSPERSTRIP, kEdge},
        {TIFFTAG_STRIPBYTECOUNTS, static_cast<std::uint32_t>(strip.size())}};
    for (int page = 0; page < kPages; ++page) {
        bytes += bytesOf(std::vector{static_cast<std::uint16_t>(tags.size())});
        for (const auto& [tag, value] : tags)
            bytes +=
                bytesOf(std::vector<std::uint16_t>{tag, 4}) + bytesOf(std::vector<std::uint32_t>{1, value});
        const auto next = static_cast<std::uint32_t>(bytes.size()) + 4;
        bytes += bytesOf(std::vector{page + 1 < kPages ? next : 0U});
    }
    return {
        "pages that share a strip", {"shared" + std::to_string(compression) + ".tif", bytes, 0, {}}, false};
}

} // namespace

std::vector<Mutant> tiffLies(const SampleFile& sample) {
    std::vector<Mutant> mutants;
    const auto directory = Directory::first(sample.bytes);
    const auto number = [](std::uint32_t value) { return bytesOf(std::vector{value}); };
    const auto put = [&](std::size_t at, const std::string& what, const std::string& bytes) {
        Mutant mutant{what, sample, false};
        mutant.file.bytes.replace(at, bytes.size(), bytes);
        mutants.push_back(std::move(mutant));
    };
    const auto tag = [&](std::uint16_t which, const std::string& name,
                         const std::vector<std::uint32_t>& values) {
        for (const auto value : values) // as one LONG
            put(directory.entry(which) + 2, name + " " + std::to_string(value),
                bytesOf(std::vector<std::uint16_t>{4}) + number(1) + number(value));
    };
    constexpr std::uint32_t most = 0xFFFFFFFFU;
    tag(TIFFTAG_IMAGEWIDTH, "width", {0, 6, 65536, 2'000'000'000, most});
    tag(TIFFTAG_IMAGELENGTH, "height", {0, 60, 65536, 2'000'000'000, most});
    tag(TIFFTAG_BITSPERSAMPLE, "bits", {0, 17, 64, 65535, most});
    tag(TIFFTAG_COMPRESSION, "compression", {0, COMPRESSION_LZW, COMPRESSION_JPEG, 777, most});
    tag(TIFFTAG_PHOTOMETRIC, "colours", {PHOTOMETRIC_CIELAB, 99});
    tag(TIFFTAG_STRIPOFFSETS, "strips begin at", {1'000'000, most});
    tag(TIFFTAG_SAMPLESPERPIXEL, "samples", {0, 3, 60000, most});
    put(directory.next(), "a loop of pages", number(static_cast<std::uint32_t>(directory.position())));
    put(directory.next(), "a page beyond the file", number(1'000'000));
    put(directory.next(), "a page among the voxels", number(9));
    put(directory.position(), "no tags", std::string(2, '\0'));
    put(directory.position(), "65535 tags", std::string(2, '\xff'));
    put(4, "the first page beyond the file", number(most));
    put(2, "another version", std::string("\x2b\0", 2));
    return mutants;
}

std::vector<Mutant> tiffBombs(const std::filesystem::path& scratch) {
    BombMaker maker(scratch);
    maker.add("pages.tif", COMPRESSION_ADOBE_DEFLATE, {kEdge, kEdge}, kPages);
    maker.add("lzw.tif", COMPRESSION_LZW, {kEdge, kEdge}, kPages);
    maker.add("strip.tif", COMPRESSION_ADOBE_DEFLATE, {kEdge, kPages * kEdge}, 1);
    maker.add("tiles.tif", COMPRESSION_ADOBE_DEFLATE, {15 * kEdge, 8 * kEdge}, 1, kEdge);
    if (TIFFIsCODECConfigured(COMPRESSION_ZSTD))
        maker.add("zstd.tif", COMPRESSION_ZSTD, {kEdge, kPages * kEdge}, 1);

    auto all = std::move(maker).all();
    const std::string zeros(std::size_t{kEdge} * kEdge, '\0');
    all.push_back(sharedStrip(COMPRESSION_NONE, zeros));
    all.push_back(sharedStrip(COMPRESSION_ADOBE_DEFLATE, zlibbed(zeros)));
    return all;
}

} // namespace voxsheet::import::testing
