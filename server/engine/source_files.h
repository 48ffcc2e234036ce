// Which files may be opened as sources, and how workbooks name them.
#pragma once

#include "sheet/workbook.h"

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace voxsheet::engine {

/// Folders below which sources may lie. Immutable.
class SourceRoots {
public:
    /// Folders that do not exist are left out.
    explicit SourceRoots(const std::vector<std::filesystem::path>& folders);

    /// The canonical path, links followed. Throws NotFound if there is no such file, InvalidInput if it
    /// lies below none of the folders or is no regular file.
    [[nodiscard]] std::filesystem::path resolve(const std::filesystem::path& file) const;
    [[nodiscard]] const std::vector<std::filesystem::path>& folders() const { return folders_; }

private:
    std::vector<std::filesystem::path> folders_; ///< canonical
};

/// True if `path` is `folder` or lies below it, by whole components; both absolute and normal.
[[nodiscard]] bool isBelow(const std::filesystem::path& path, const std::filesystem::path& folder);

/// The workbook with its sources' paths made absolute, starting from `folder`; absolute ones stay.
[[nodiscard]] sheet::Workbook withAbsoluteSources(sheet::Workbook workbook,
                                                  const std::filesystem::path& folder);
/// The inverse: relative to `folder` (also upwards, "../data/a.nrrd"), so that folder and data can move
/// together.
[[nodiscard]] sheet::Workbook withRelativeSources(sheet::Workbook workbook,
                                                  const std::filesystem::path& folder);

/// Writes under a temporary name in the same folder, syncs, renames and syncs the folder: after a crash the
/// file is either the old or the new one, whole. Throws IoError naming the file.
void writeFileAtomically(const std::filesystem::path& file, std::string_view text);

/// The last component of a name that came over the network, with everything but letters, digits, space and
/// `._-+@()` replaced by '_', not beginning with '.', at most 120 bytes; "upload" if nothing is left.
[[nodiscard]] std::string safeFileName(const std::string& name);

/// "xxh3:" and 16 hex digits over the files' bytes in order. Throws IoError.
[[nodiscard]] std::string checksumOf(const std::vector<std::string>& files);

} // namespace voxsheet::engine
