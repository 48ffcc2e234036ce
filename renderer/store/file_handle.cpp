#include "store/file_handle.h"

#include "base/errors.h"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

namespace voxsheet::store {

namespace {

[[noreturn]] void fail(const std::filesystem::path& path, const char* action, int reason) {
    const auto why = std::string(action) + " failed: " + std::strerror(reason);
    if (reason == ENOENT || reason == ENOTDIR) throw NotFound(path.string(), why);
    if (reason == ENOSPC || reason == EDQUOT)
        throw IoError(path.string(), why, "free space on this disk, or choose another folder with --store");
    throw IoError(path.string(), why);
}

} // namespace

FileHandle::FileHandle(const std::filesystem::path& path, int flags, mode_t mode)
    : path_(path), descriptor_(::open(path.c_str(), flags | O_CLOEXEC | O_NOFOLLOW, mode)) {
    if (descriptor_ < 0) fail(path, "opening", errno);
}

FileHandle::FileHandle(const FileHandle& folder, const std::string& name, int flags)
    : path_(folder.path_ / name),
      descriptor_(::openat(folder.descriptor_, name.c_str(), flags | O_CLOEXEC | O_NOFOLLOW)) {
    if (descriptor_ < 0) fail(path_, "opening", errno);
}

FileHandle::~FileHandle() {
    if (descriptor_ >= 0) ::close(descriptor_);
}

FileHandle::FileHandle(FileHandle&& other) noexcept
    : path_(std::move(other.path_)), descriptor_(std::exchange(other.descriptor_, -1)) {}

FileHandle& FileHandle::operator=(FileHandle&& other) noexcept {
    std::swap(path_, other.path_);
    std::swap(descriptor_, other.descriptor_);
    return *this;
}

std::uint64_t FileHandle::bytes() const {
    struct stat info {};
    if (::fstat(descriptor_, &info) != 0) fail(path_, "looking at its size", errno);
    return static_cast<std::uint64_t>(info.st_size);
}

void FileHandle::readAll(std::uint64_t offset, std::span<std::byte> out) const {
    while (!out.empty()) {
        const auto got = ::pread(descriptor_, out.data(), out.size(), static_cast<off_t>(offset));
        if (got < 0 && errno == EINTR) continue;
        if (got < 0) fail(path_, "reading", errno);
        if (got == 0) throw IoError(path_.string(), "it is shorter than it was when it was written");
        offset += static_cast<std::uint64_t>(got);
        out = out.subspan(static_cast<std::size_t>(got));
    }
}

void FileHandle::readPastCache(std::uint64_t offset, std::span<std::byte> out) const {
    const bool aligned = offset % kDirectAlignment == 0 && out.size() % kDirectAlignment == 0 &&
                         reinterpret_cast<std::uintptr_t>(out.data()) % kDirectAlignment == 0;
    const int flags = ::fcntl(descriptor_, F_GETFL);
    if (!aligned || flags < 0 || ::fcntl(descriptor_, F_SETFL, flags | O_DIRECT) != 0)
        return readAll(offset, out);
    const auto got = ::pread(descriptor_, out.data(), out.size(), static_cast<off_t>(offset));
    // Some file systems take the flag and refuse to read; what is left is read as ever, and fails as ever.
    if (::fcntl(descriptor_, F_SETFL, flags) != 0) fail(path_, "reading", errno);
    const auto done = static_cast<std::size_t>(std::max(got, ssize_t{0}));
    readAll(offset + done, out.subspan(done));
}

void FileHandle::dropPages(std::uint64_t offset, std::uint64_t bytes) const {
    // The kernel leaves what is touched only in part, and it may hold what was just written in units of up to
    // 2 MiB (large folios): the beginning is rounded down to one, so that a file that is dropped piece by
    // piece from its start is dropped whole.
    constexpr std::uint64_t largest = std::uint64_t{2} << 20;
    const auto page = static_cast<std::uint64_t>(::sysconf(_SC_PAGESIZE));
    const std::uint64_t begin = offset / largest * largest;
    const std::uint64_t end = (offset + bytes + page - 1) / page * page;
    ::posix_fadvise(descriptor_, static_cast<off_t>(begin), static_cast<off_t>(end - begin),
                    POSIX_FADV_DONTNEED);
}

void FileHandle::writeAll(std::uint64_t offset, std::span<const std::byte> bytes) const {
    while (!bytes.empty()) {
        const auto put = ::pwrite(descriptor_, bytes.data(), bytes.size(), static_cast<off_t>(offset));
        if (put < 0 && errno == EINTR) continue;
        if (put < 0) fail(path_, "writing", errno);
        offset += static_cast<std::uint64_t>(put);
        bytes = bytes.subspan(static_cast<std::size_t>(put));
    }
}

void FileHandle::sync() const {
    if (::fsync(descriptor_) != 0) fail(path_, "writing to the disk", errno);
}

bool FileHandle::tryLock(bool exclusive) const {
    while (::flock(descriptor_, (exclusive ? LOCK_EX : LOCK_SH) | LOCK_NB) != 0) {
        if (errno == EWOULDBLOCK) return false;
        // Some cluster file systems are mounted without locks: then the order of eviction alone protects what
        // is in use.
        if (errno == ENOSYS || errno == ENOLCK || errno == EOPNOTSUPP) return true;
        if (errno != EINTR) fail(path_, "locking", errno);
    }
    return true;
}

bool FileHandle::isStillAt(const std::filesystem::path& path) const {
    struct stat named {};
    struct stat opened {};
    return ::stat(path.c_str(), &named) == 0 && ::fstat(descriptor_, &opened) == 0 &&
           named.st_ino == opened.st_ino && named.st_dev == opened.st_dev;
}

void syncFolder(const std::filesystem::path& folder) { FileHandle(folder, O_RDONLY | O_DIRECTORY).sync(); }

} // namespace voxsheet::store
