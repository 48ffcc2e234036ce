// The lengths that stand before binary data in VTK's XML files ("VTK XML formats", Kitware wiki,
// "Compression"):
//   not compressed:  [bytes] data                                       in base64: encoded together
//   compressed:      [blocks][block bytes][last block bytes][compressed bytes of each block] blocks
//                                                                       in base64: lengths and blocks encoded
//                                                                       apart
#include "base/errors.h"
#include "import/vtk_xml/vti_header.h"

#include <algorithm>
#include <array>

namespace voxsheet::import {

namespace {

/// Base64 digits for `bytes` bytes, padding included.
std::uint64_t base64Digits(std::uint64_t bytes) { return (bytes + 2) / 3 * 4; }

int base64Value(char c) {
    if (c >= 'A' && c <= 'Z') return c - 'A';
    if (c >= 'a' && c <= 'z') return c - 'a' + 26;
    if (c >= '0' && c <= '9') return c - '0' + 52;
    if (c == '+') return 62;
    return c == '/' ? 63 : -1;
}

/// Decodes up to the first character that is no base64 digit.
std::string base64Decoded(std::string_view digits) {
    std::string bytes;
    unsigned bits = 0;
    int count = 0;
    for (const char c : digits) {
        const int value = base64Value(c);
        if (value < 0) break;
        bits = (bits << 6U) | static_cast<unsigned>(value);
        count += 6;
        if (count < 8) continue;
        count -= 8;
        bytes += static_cast<char>((bits >> static_cast<unsigned>(count)) & 255U);
    }
    return bytes;
}

class LengthCheck {
public:
    LengthCheck(const InputFile& file, const VtiHeader& header, const VtiArray& array, std::uint64_t expected)
        : file_(file), header_(header), array_(array), expected_(expected),
          base64_(array.encoding == VtiEncoding::Inline || header.appendedBase64) {}

    void run() const { header_.compressed ? checkCompressed() : checkPlain(); }

private:
    [[noreturn]] void damaged(const std::string& why) const {
        throw InvalidInput(file_.name(), "the array '" + printable(array_.name) + "' " + why,
                           "the file is damaged or incomplete: copy or write it again");
    }

    void checkPlain() const {
        const auto lengthBytes = header_.headerIntegerBytes;
        const auto length = integerAt(lengths(lengthBytes), 0);
        if (length != expected_)
            damaged("says that it has " + std::to_string(length) +
                    " bytes where its type and the image's size give " + std::to_string(expected_));
        require(encoded(lengthBytes + expected_));
    }

    void checkCompressed() const {
        const auto n = header_.headerIntegerBytes;
        if (expected_ == 0) return;
        const auto first = lengths(3 * n);
        const auto blocks = integerAt(first, 0);
        const auto blockBytes = integerAt(first, 1);
        const auto lastBytes = integerAt(first, 2);
        // Each block has at least one byte, so that more blocks than bytes are a lie. The size of a block is
        // that of a full one: larger than all data when they fit into one block.
        const bool possible = blocks >= 1 && blocks <= expected_ && lastBytes <= blockBytes;
        const auto full = lastBytes == 0 ? blocks : blocks - 1;
        const bool fits = possible && (full == 0 || blockBytes <= expected_ / full);
        const auto total = fits ? full * blockBytes + lastBytes : 0;
        if (total != expected_)
            damaged("says that its blocks have " + (fits ? std::to_string(total) : "impossible sizes, not") +
                    " bytes where its type and the image's size give " + std::to_string(expected_));
        const auto lengthBytes = (3 + blocks) * n;
        require(encoded(lengthBytes)); // before they are read
        const auto all = lengths(lengthBytes);
        std::uint64_t compressed = 0;
        for (std::uint64_t block = 0; block < blocks; ++block) {
            const auto bytes = integerAt(all, 3 + block);
            if (bytes > file_.bytes()) damaged("has a block that is larger than the file");
            compressed += bytes;
        }
        require(encoded(lengthBytes) + encoded(compressed));
    }

    [[nodiscard]] std::uint64_t encoded(std::uint64_t bytes) const {
        return base64_ ? base64Digits(bytes) : bytes;
    }

    /// Throws unless the file holds `count` bytes (base64: digits) of this array.
    void require(std::uint64_t count) const {
        const auto start = header_.appendedStart + array_.appendedOffset;
        const bool isInline = array_.encoding == VtiEncoding::Inline;
        const auto available = isInline ? array_.inlineCount : file_.bytes() - std::min(start, file_.bytes());
        if (available < count)
            damaged("is cut off: " + std::to_string(count) + (base64_ ? " base64 digits" : " bytes") +
                    " are needed and the file holds " + std::to_string(available));
        if (!isInline && base64_) requireDigits(start, count);
    }

    /// VTK's decoder stops without an error at a character that is no digit.
    void requireDigits(std::uint64_t start, std::uint64_t count) const {
        constexpr std::uint64_t chunk = 1U << 20U;
        for (std::uint64_t at = 0; at < count; at += chunk) {
            const auto text = file_.textAt(start + at, static_cast<std::size_t>(std::min(chunk, count - at)));
            if (!std::all_of(text.begin(), text.end(),
                             [](char c) { return base64Value(c) >= 0 || c == '='; }))
                damaged("has characters in its data that are not base64");
        }
    }

    /// The first `count` bytes of the array, decoded; fewer where the data end.
    [[nodiscard]] std::string lengths(std::uint64_t count) const {
        if (array_.encoding == VtiEncoding::Inline)
            return base64Decoded(std::string_view(array_.inlineHead).substr(0, base64Digits(count)));
        auto text = file_.textAt(header_.appendedStart + array_.appendedOffset, encoded(count));
        return base64_ ? base64Decoded(text) : text;
    }

    [[nodiscard]] std::uint64_t integerAt(const std::string& bytes, std::uint64_t index) const {
        const auto n = header_.headerIntegerBytes;
        if ((index + 1) * n > bytes.size()) damaged("is cut off before its data");
        std::uint64_t value = 0;
        for (std::size_t i = 0; i < n; ++i) {
            const auto at = index * n + (header_.bigEndian ? i : n - 1 - i);
            value = (value << 8U) | static_cast<unsigned char>(bytes[at]);
        }
        return value;
    }

    const InputFile& file_;
    const VtiHeader& header_;
    const VtiArray& array_;
    std::uint64_t expected_;
    bool base64_;
};

} // namespace

void checkVtiArray(const InputFile& file, const VtiHeader& header, const VtiArray& array,
                   std::uint64_t expectedBytes) {
    if (array.encoding != VtiEncoding::Ascii) return LengthCheck(file, header, array, expectedBytes).run();
    const auto expected = expectedBytes / scalarBytes(array.type);
    if (array.inlineCount != expected)
        throw InvalidInput(file.name(),
                           "the array '" + printable(array.name) + "' has " +
                               std::to_string(array.inlineCount) + " numbers where the image's size gives " +
                               std::to_string(expected),
                           "the file is damaged or incomplete: copy or write it again");
}

} // namespace voxsheet::import
