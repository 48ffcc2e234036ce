// All readers of this build, and which of them a file is for.
#pragma once

#include "import/source_reader.h"

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace voxsheet::import {

class ReaderRegistry {
public:
    ReaderRegistry();

    /// By content; the name is a hint. Throws NotFound, IoError, InvalidInput (a folder, an empty file, a Git
    /// LFS pointer, no format that is known: the sentence lists those that are), Unsupported (a format that
    /// is known but not read).
    [[nodiscard]] const SourceReader& choose(const std::filesystem::path& path,
                                             const ImportOptions& options) const;

    /// "NRRD (.nrrd, .nhdr), MetaImage (.mha, .mhd), …"
    [[nodiscard]] std::string descriptions() const;

private:
    std::vector<std::unique_ptr<SourceReader>> readers_;
};

} // namespace voxsheet::import
