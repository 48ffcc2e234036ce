// A file descriptor that closes itself, and whole reads and writes on it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <sys/types.h>
#include <utility>

namespace voxsheet::store {

class FileHandle {
public:
    FileHandle() = default;
    /// Opens with O_CLOEXEC and O_NOFOLLOW. Throws NotFound (no such file), IoError.
    FileHandle(const std::filesystem::path& path, int flags, mode_t mode = 0600);
    /// A file in an open folder, wherever that has been moved to. Throws as above.
    FileHandle(const FileHandle& folder, const std::string& name, int flags);
    ~FileHandle();
    FileHandle(FileHandle&& other) noexcept;
    FileHandle& operator=(FileHandle&& other) noexcept;

    [[nodiscard]] int descriptor() const { return descriptor_; }
    [[nodiscard]] std::uint64_t bytes() const;

    /// Fills all of `out`. Throws IoError, also when the file ends before.
    void readAll(std::uint64_t offset, std::span<std::byte> out) const;
    /// As readAll, from the disk straight into `out` where the file system can (O_DIRECT) and offset, size
    /// and address are multiples of kDirectAlignment: the operating system's cache is not filled, and the
    /// processor copies nothing. Not while another thread reads by the same handle.
    void readPastCache(std::uint64_t offset, std::span<std::byte> out) const;
    static constexpr std::size_t kDirectAlignment = 4096;
    /// The pages that hold these bytes leave the operating system's cache, if they are written and nobody has
    /// them mapped; with them up to 2 MiB before. Only advice: where it is not taken, nothing happens.
    void dropPages(std::uint64_t offset, std::uint64_t bytes) const;
    /// Throws IoError; a full disk is named as such.
    void writeAll(std::uint64_t offset, std::span<const std::byte> bytes) const;
    /// Throws IoError.
    void sync() const;

    /// Advisory lock (flock), released on close. Returns false when another open file holds it.
    /// Throws IoError.
    [[nodiscard]] bool tryLock(bool exclusive) const;
    /// False when `path` names nothing or another file by now.
    [[nodiscard]] bool isStillAt(const std::filesystem::path& path) const;

private:
    std::filesystem::path path_;
    int descriptor_ = -1;
};

/// Makes renames and new names in a folder durable. Throws IoError.
void syncFolder(const std::filesystem::path& folder);

} // namespace voxsheet::store
