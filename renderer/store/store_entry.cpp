#include "store/store_entry.h"

#include "base/errors.h"
#include "store/meta_json.h"

#include <bit>
#include <cstring>
#include <fcntl.h>
#include <sys/stat.h>
#include <vector>

namespace voxsheet::store {

static_assert(std::endian::native == std::endian::little,
              "the store's arrays are little-endian and read as they are");

namespace {

constexpr std::uint64_t kLargestMetaBytes = 256U << 20U;

DatasetMeta readMeta(const std::string& key, const std::filesystem::path& folder) {
    const FileHandle file(folder / kMetaFile, O_RDONLY);
    if (file.bytes() > kLargestMetaBytes) throw InvalidInput(folder.string(), "meta.json is too large");
    std::string text(file.bytes(), '\0');
    file.readAll(0, std::as_writable_bytes(std::span(text)));
    const auto json = parseJson(text, kMetaFile);
    if (json.value("voxsheet_store_entry", 0) != kEntryVersion)
        throw InvalidInput(folder.string(), "it is of another version");
    auto meta = metaFromJson(json.at("dataset"));
    meta.key = key;
    return meta;
}

void checkFiles(const std::filesystem::path& folder, const DatasetMeta& meta) {
    for (int field = 0; field < static_cast<int>(meta.fields.size()); ++field) {
        if (meta.fields[static_cast<std::size_t>(field)].steps.size() != meta.times.size())
            throw InvalidInput(folder.string(), "statistics are missing");
        const auto expected = arrayLayout(meta, field).fileBytes;
        for (int step = 0; step < meta.stepCount(); ++step)
            if (FileHandle(folder / arrayFileName(field, step), O_RDONLY).bytes() != expected)
                throw InvalidInput(folder.string(), "an array is truncated");
    }
}

template <typename T>
void toValues(std::span<const std::byte> stored, const FieldMeta& field, std::span<double> out) {
    for (std::size_t i = 0; i < out.size(); ++i) {
        T sample;
        std::memcpy(&sample, stored.data() + i * sizeof(T), sizeof(T));
        out[i] = field.valueScale * static_cast<double>(sample) + field.valueOffset;
    }
}

} // namespace

StoreEntry::StoreEntry(FileHandle folder, FileHandle lock, std::shared_ptr<const DatasetMeta> meta)
    : folder_(std::move(folder)), lock_(std::move(lock)), meta_(std::move(meta)) {}

std::shared_ptr<const StoreEntry> StoreEntry::open(const std::filesystem::path& folder, bool& damaged) {
    return openAs(folder.filename().string(), folder, damaged);
}

std::shared_ptr<const StoreEntry> StoreEntry::openAs(const std::string& key,
                                                     const std::filesystem::path& folder, bool& damaged) {
    damaged = false;
    std::error_code error;
    if (!std::filesystem::exists(folder, error)) return nullptr;
    try {
        FileHandle lock(folder / kLockFile, O_RDONLY);
        // The entry may be renamed away (removed) between opening and locking.
        if (!lock.tryLock(false) || !lock.isStillAt(folder / kLockFile)) return nullptr;
        auto meta = std::make_shared<const DatasetMeta>(readMeta(key, folder));
        checkFiles(folder, *meta);
        ::futimens(lock.descriptor(),
                   nullptr); // last use; on a read-only store the order of eviction does not matter
        return std::shared_ptr<const StoreEntry>(
            new StoreEntry(FileHandle(folder, O_RDONLY | O_DIRECTORY), std::move(lock), std::move(meta)));
    } catch (const InvalidInput&) {
        damaged = true;
    } catch (const nlohmann::json::exception&) {
        damaged = true;
    } catch (const NotFound&) {
        damaged = std::filesystem::exists(folder, error);
    }
    return nullptr;
}

FileHandle StoreEntry::openArrayFile(const VolumeKey& key) const {
    try {
        return {folder_, arrayFileName(key.field, key.step), O_RDONLY};
    } catch (const NotFound& gone) {
        throw IoError(gone.subject(), "the volume store's entry is gone",
                      "import '" + meta_->sourcePath + "' again");
    }
}

std::uint64_t StoreEntry::offsetOf(const VolumeKey& key, int zBegin, int zCount,
                                   std::span<const std::byte> out) const {
    const auto range = sliceBytes(*meta_, key, zBegin, zCount);
    if (out.size() != range.count) throw InvalidInput("slices to read", "the buffer has the wrong size");
    return arrayLayout(*meta_, key.field).levels[static_cast<std::size_t>(key.level)].offset + range.offset;
}

void StoreEntry::readSlices(const VolumeKey& key, int zBegin, int zCount, std::span<std::byte> out) const {
    const auto offset = offsetOf(key, zBegin, zCount, out);
    openArrayFile(key).readAll(offset, out);
}

void StoreEntry::readSlicesPastCache(const VolumeKey& key, int zBegin, int zCount,
                                     std::span<std::byte> out) const {
    const auto offset = offsetOf(key, zBegin, zCount, out);
    openArrayFile(key).readPastCache(offset, out);
}

void StoreEntry::dropPages(const VolumeKey& key, int zBegin, int zCount) const {
    const auto range = sliceBytes(*meta_, key, zBegin, zCount);
    const auto part = arrayLayout(*meta_, key.field).levels[static_cast<std::size_t>(key.level)];
    openArrayFile(key).dropPages(part.offset + range.offset, range.count);
}

MinMaxGrid StoreEntry::readMinMax(const VolumeKey& key) const {
    validateVolumeKey(*meta_, key);
    const auto part = arrayLayout(*meta_, key.field).minMax[static_cast<std::size_t>(key.level)];
    MinMaxGrid grid;
    grid.bricks = MinMaxGrid::bricksFor(levelDims(meta_->grid.dims, key.level));
    grid.ranges.resize(part.bytes / sizeof(MinMaxGrid::Range));
    openArrayFile(key).readAll(part.offset, std::as_writable_bytes(std::span(grid.ranges)));
    return grid;
}

void StoreEntry::readBox(const VolumeKey& key, const glm::ivec3& low, const glm::ivec3& size,
                         std::span<double> out) const {
    validateVolumeKey(*meta_, key);
    const auto dims = levelDims(meta_->grid.dims, key.level);
    for (int axis = 0; axis < 3; ++axis)
        if (low[axis] < 0 || size[axis] < 1 || low[axis] >= dims[axis] || size[axis] > dims[axis] - low[axis])
            throw InvalidInput("box of samples", "it reaches beyond the volume");
    if (out.size() != static_cast<std::size_t>(sampleCount(size)))
        throw InvalidInput("box of samples", "the buffer has the wrong size");

    const auto& field = meta_->fields[static_cast<std::size_t>(key.field)];
    const auto type = levelType(field.storedType, key.level);
    const auto part = arrayLayout(*meta_, key.field).levels[static_cast<std::size_t>(key.level)];
    const auto file = openArrayFile(key);

    // Runs of samples that follow on each other in the file: rows, or whole slices where the box is as wide
    // as the level.
    const bool wholeRows = size.x == dims.x;
    const int runRows = wholeRows ? size.y : 1;
    const auto run = static_cast<std::size_t>(size.x) * static_cast<std::size_t>(runRows);
    std::vector<std::byte> stored(run * scalarBytes(type));
    std::size_t done = 0;
    for (int z = 0; z < size.z; ++z)
        for (int y = 0; y < size.y; y += runRows) {
            const auto first = (static_cast<std::uint64_t>(low.z + z) * static_cast<std::uint64_t>(dims.y) +
                                static_cast<std::uint64_t>(low.y + y)) *
                                   static_cast<std::uint64_t>(dims.x) +
                               static_cast<std::uint64_t>(low.x);
            file.readAll(part.offset + first * scalarBytes(type), stored);
            visitScalar(type, [&]<typename T>() { toValues<T>(stored, field, out.subspan(done, run)); });
            done += run;
        }
}

double StoreEntry::readValue(const VolumeKey& key, const glm::ivec3& sample) const {
    double value = 0.0;
    readBox(key, sample, glm::ivec3(1), {&value, 1});
    return value;
}

} // namespace voxsheet::store
