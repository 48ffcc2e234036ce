// Makes one entry of the volume store out of level-0 arrays: statistics, histogram, pyramid, min-max grids.
#pragma once

#include "store/volume_store.h"

#include <cstddef>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace voxsheet::store {

/// Use from one thread at a time; the work on an array is spread over the cores. Without commit() nothing is
/// left in the store.
class StoreWriter {
public:
    /// Makes room in the store, then a temporary folder.
    /// \param meta  with meta.key the key of the entry to be (an import's or a formula's); steps of fields
    /// are overwritten Throws InvalidInput if the key, the grid, or the numbers of fields and steps are bad,
    /// or a number is not finite; IoError.
    StoreWriter(const VolumeStore& store, DatasetMeta meta);
    StoreWriter(const StoreWriter&) = delete;
    StoreWriter& operator=(const StoreWriter&) = delete;

    /// Level 0 of one field and step, in the field's storedType, x fastest, native byte order. Each once, in
    /// any order. Throws InvalidInput if the size is wrong or the array came already; IoError.
    void addArray(int field, int step, std::span<const std::byte> samples);

    /// Adds to DatasetMeta::notes. Before entry() and commit().
    void addNotes(const std::vector<std::string>& notes);

    /// The entry that commit() makes visible, for this process to read while the disk is not done: nobody
    /// else finds it before. It stays readable whatever becomes of the writer. Throws InvalidInput if an
    /// array is missing; IoError.
    [[nodiscard]] std::shared_ptr<const StoreEntry> entry();

    /// Makes the entry visible under its key, durably. If another process made the same entry meanwhile, that
    /// one stays, and false is returned. Throws as entry().
    bool commit();

private:
    struct Folder;
    /// Returns false if another process took the new folder for a leftover of a crashed one: then there is to
    /// be another.
    bool claimNewFolder();
    void finish();
    void writeMeta() const;
    void sync() const;
    void publish();

    const VolumeStore& store_;
    DatasetMeta meta_;
    std::shared_ptr<Folder> temporary_;
    FileHandle lock_;
    std::vector<bool> written_; ///< [field * steps + step]
    bool finished_ = false;     ///< meta.json is there
};

} // namespace voxsheet::store
