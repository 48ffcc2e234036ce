// Receives a file over the network into a folder, within a limit and the space that is left.
#pragma once

#include "http/message/request.h"

#include <cstdint>
#include <filesystem>

namespace voxsheet::http {

/// A file that is removed again unless it was moved away.
class ReceivedFile {
public:
    explicit ReceivedFile(std::filesystem::path path) : path_(std::move(path)) {}
    ~ReceivedFile();
    ReceivedFile(const ReceivedFile&) = delete;
    ReceivedFile& operator=(const ReceivedFile&) = delete;
    ReceivedFile(ReceivedFile&& other) noexcept : path_(std::move(other.path_)) { other.path_.clear(); }
    ReceivedFile& operator=(ReceivedFile&&) = delete;
    [[nodiscard]] const std::filesystem::path& path() const { return path_; }

private:
    std::filesystem::path path_;
};

/// Writes the body under an unguessable name in `folder` (made if it is not there).
/// Throws LimitExceeded when the disk would have less than 64 MiB left, IoError, and what the body's reader
/// throws.
[[nodiscard]] ReceivedFile receiveFile(BodyReader& body, const std::filesystem::path& folder);

} // namespace voxsheet::http
