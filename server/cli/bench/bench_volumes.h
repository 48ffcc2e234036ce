// Volumes that benches show: deterministic, all different.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace voxsheet::cli {

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

/// Writes `count` NRRD files of dim^3 8-bit samples (Marschner-Lobb signals, each turned to another phase).
[[nodiscard]] std::vector<std::string> writeBenchVolumes(const std::filesystem::path& folder, int count,
                                                         int dim);

} // namespace voxsheet::cli
