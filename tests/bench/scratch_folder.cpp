#include "bench/scratch_folder.h"

#include "base/errors.h"

#include <cstdlib>

namespace voxsheet::bench {

namespace fs = std::filesystem;

ScratchFolder::ScratchFolder() {
    auto pattern = (fs::temp_directory_path() / "voxsheet-bench-XXXXXX").string();
    if (mkdtemp(pattern.data()) == nullptr)
        throw IoError(pattern, "no folder could be made there", "set TMPDIR to a folder with some GiB");
    path_ = pattern;
}

ScratchFolder::~ScratchFolder() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
}

} // namespace voxsheet::bench
