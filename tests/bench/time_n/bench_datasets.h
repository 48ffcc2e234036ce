// N datasets that differ, on disk: entries of a volume store of the bench's own.
#pragma once

#include "bench/scratch_folder.h"
#include "store/volume_store.h"
#include "volume/dataset.h"

#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace voxsheet::bench {

/// Writes them when it is made and removes them at its end. Each is the same periodic 8-bit field (a simple
/// cubic lattice of blobs, two cells along each axis, values 0 to 1) at phases of its own, so that no two
/// have the same bytes and all cost about the same to draw. Deterministic.
class BenchDatasets {
public:
    /// `wrote(n)` after each. Throws IoError (also when the disk has too little room, before anything is
    /// written); what `wrote` throws.
    BenchDatasets(int count, int dim, const std::function<void(int)>& wrote);

    [[nodiscard]] const std::shared_ptr<const store::VolumeStore>& store() const { return store_; }
    [[nodiscard]] const std::string& key(int index) const {
        return keys_.at(static_cast<std::size_t>(index));
    }
    [[nodiscard]] const Grid& grid() const { return grid_; }
    /// Whether dropping pages from the page cache makes the next read go to a disk: not so in a file system
    /// in memory.
    [[nodiscard]] bool onDisk() const;

private:
    ScratchFolder folder_;
    Grid grid_;
    std::shared_ptr<const store::VolumeStore> store_;
    std::vector<std::string> keys_;
};

} // namespace voxsheet::bench
