// A place for the files of a bench.
#pragma once

#include <filesystem>

namespace voxsheet::bench {

/// A folder of its own below the system's temporary folder, removed with everything in it at the end.
class ScratchFolder {
public:
    /// Throws IoError.
    ScratchFolder();
    ~ScratchFolder();
    ScratchFolder(const ScratchFolder&) = delete;
    ScratchFolder& operator=(const ScratchFolder&) = delete;
    [[nodiscard]] const std::filesystem::path& path() const { return path_; }

private:
    std::filesystem::path path_;
};

} // namespace voxsheet::bench
