// Names of store entries: a hash of everything that decides the entry's bytes.
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>

namespace voxsheet::store {

/// What tells one state of a file from another without reading it.
struct FileStamp {
    std::string path; ///< canonical
    std::uint64_t bytes = 0;
    std::int64_t modifiedNs = 0; ///< since the epoch

    bool operator==(const FileStamp&) const = default;
};

/// Throws NotFound if there is no such file, IoError if it cannot be looked at.
[[nodiscard]] FileStamp stampOf(const std::filesystem::path& path);

/// 32 hexadecimal digits: XXH3 (128 bit) of the parts, each preceded by its length, so that ("ab", "c") and
/// ("a", "bc") differ.
[[nodiscard]] std::string storeKey(std::span<const std::string> parts);

/// Key of an import. `files` in the order in which the reader uses them; `options` is canonical text of all
/// options.
[[nodiscard]] std::string importKey(std::span<const FileStamp> files, std::string_view importerVersion,
                                    std::string_view options);

/// Key of a formula result: its canonical text and the keys of its inputs, in the order of the text.
[[nodiscard]] std::string formulaKey(std::string_view canonicalText, std::span<const std::string> inputKeys);

/// A key is 1 to 64 characters of [0-9a-z_]: it is a folder's name and comes in over HTTP.
[[nodiscard]] bool isStoreKey(std::string_view text) noexcept;

} // namespace voxsheet::store
