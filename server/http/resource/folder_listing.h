// What a folder below the roots holds, as a user wants to see it: folders first, natural order, numbered
// series as one.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace voxsheet::http {

struct FolderEntry {
    std::string name; ///< of a series: "step_[1-10].nrrd"
    std::filesystem::path path;
    bool folder = false;
    std::uint64_t bytes = 0;                  ///< of a series: of all its files
    std::vector<std::filesystem::path> files; ///< of a series, in order
};

struct FolderListing {
    std::vector<FolderEntry> entries;
    bool truncated = false; ///< there are more
};

/// Regular files and folders; hidden ones are left out, and so is whatever a link leads to outside `roots`,
/// and anything that is neither file nor folder. \param folder  canonical, below one of `roots` \param glob
/// file names must match it (`*`, `?`, `[…]`); empty: all. Folders always stay \param group   numbered files
/// become one entry in front of their members Throws IoError if the folder cannot be read.
[[nodiscard]] FolderListing listFolder(const std::filesystem::path& folder,
                                       const std::vector<std::filesystem::path>& roots,
                                       const std::string& glob, bool group, std::size_t limit = 5000);

/// Groups of at least three files whose names differ in one number only, in order of that number. Names in
/// natural order.
struct NumberedSeries {
    std::string label;                ///< "step_[1-10].nrrd"
    std::vector<std::size_t> members; ///< indices into `names`
};
[[nodiscard]] std::vector<NumberedSeries> findSeries(const std::vector<std::string>& names);

} // namespace voxsheet::http
