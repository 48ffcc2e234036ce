#include "store/entry_layout.h"

#include "volume/grid.h"

namespace voxsheet::store {

namespace {

ArrayLayout::Part append(ArrayLayout& layout, std::uint64_t bytes) {
    constexpr std::uint64_t alignment = 64;
    const ArrayLayout::Part part{layout.fileBytes, bytes};
    layout.fileBytes += (bytes + alignment - 1) / alignment * alignment;
    return part;
}

} // namespace

ArrayLayout arrayLayout(const DatasetMeta& meta, int field) {
    ArrayLayout layout;
    const auto type = meta.fields.at(static_cast<std::size_t>(field)).storedType;
    for (int level = 0; level < meta.levels(); ++level) {
        const auto samples = static_cast<std::uint64_t>(sampleCount(levelDims(meta.grid.dims, level)));
        layout.levels.push_back(append(layout, samples * scalarBytes(levelType(type, level))));
    }
    for (int level = 0; level < meta.levels(); ++level) {
        const auto bricks =
            static_cast<std::uint64_t>(sampleCount(MinMaxGrid::bricksFor(levelDims(meta.grid.dims, level))));
        layout.minMax.push_back(append(layout, bricks * sizeof(MinMaxGrid::Range)));
    }
    return layout;
}

std::string arrayFileName(int field, int step) {
    return "f" + std::to_string(field) + "_s" + std::to_string(step) + ".raw";
}

std::uint64_t entryBytes(const DatasetMeta& meta) {
    std::uint64_t bytes = 0;
    for (int field = 0; field < static_cast<int>(meta.fields.size()); ++field)
        bytes += arrayLayout(meta, field).fileBytes * meta.times.size();
    return bytes;
}

} // namespace voxsheet::store
