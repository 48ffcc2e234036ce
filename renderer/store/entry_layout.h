// Where things are in a store entry: one file per field and step with all levels and their min-max grids.
#pragma once

#include "volume/dataset.h"
#include "volume/volume_provider.h"

#include <cstdint>
#include <string>
#include <vector>

namespace voxsheet::store {

/// Written into meta.json. Entries of another version are treated as absent.
inline constexpr int kEntryVersion = 3;

inline constexpr const char* kMetaFile = "meta.json";
/// Held shared by readers, exclusively by whoever writes or deletes the entry; its mtime is the entry's last
/// use.
inline constexpr const char* kLockFile = "lock";

/// Contents of "f<field>_s<step>.raw", little-endian: the samples of level 0, 1, … (x fastest), then the
/// min-max grids of level 0, 1, … as pairs of 32-bit floats (low, high), each part padded to a multiple of 64
/// bytes.
struct ArrayLayout {
    struct Part {
        std::uint64_t offset = 0;
        std::uint64_t bytes = 0; ///< without padding
    };
    std::vector<Part> levels;
    std::vector<Part> minMax;
    std::uint64_t fileBytes = 0;
};

[[nodiscard]] ArrayLayout arrayLayout(const DatasetMeta& meta, int field);
[[nodiscard]] std::string arrayFileName(int field, int step);
/// Bytes of all array files together.
[[nodiscard]] std::uint64_t entryBytes(const DatasetMeta& meta);

} // namespace voxsheet::store
