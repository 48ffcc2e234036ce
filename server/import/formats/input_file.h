// Opening files whose contents nobody vouches for.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>

namespace voxsheet::import {

/// A regular file, open for reading. Never blocks on a FIFO and never opens a device.
class InputFile {
public:
    /// Throws NotFound, IoError (no permission, I/O), InvalidInput (a folder, FIFO, socket or device; a Git
    /// LFS pointer text in place of the data).
    explicit InputFile(std::filesystem::path path);
    ~InputFile();
    InputFile(const InputFile&) = delete;
    InputFile& operator=(const InputFile&) = delete;

    [[nodiscard]] const std::filesystem::path& path() const { return path_; }
    [[nodiscard]] std::string name() const { return path_.string(); }
    [[nodiscard]] std::uint64_t bytes() const { return bytes_; }

    /// Reads until `out` is full or the file ends; returns the number of bytes. Throws IoError.
    [[nodiscard]] std::size_t readAt(std::uint64_t offset, std::span<std::byte> out) const;
    /// At most `count` bytes from `offset`, fewer where the file ends. Throws IoError.
    [[nodiscard]] std::string textAt(std::uint64_t offset, std::size_t count) const;

private:
    void refuseGitLfsPointer() const;

    std::filesystem::path path_;
    int descriptor_ = -1;
    std::uint64_t bytes_ = 0;
};

/// The file that a header names as `name`, canonical. Headers come from anywhere, so that a name may only
/// lead to a file in the header's own folder or below. Throws InvalidInput if the name is empty, absolute, or
/// leads out of the folder (also through a symbolic link), NotFound if there is no such file.
[[nodiscard]] std::filesystem::path resolveBeside(const std::filesystem::path& header, std::string_view name);

/// Canonical form of a path that exists. Throws NotFound or IoError.
[[nodiscard]] std::filesystem::path canonicalPath(const std::filesystem::path& path);

/// The part of `text` that can be shown in a message: at most 80 bytes, control characters and bytes that are
/// not ASCII replaced by '?'.
[[nodiscard]] std::string printable(std::string_view text);

} // namespace voxsheet::import
