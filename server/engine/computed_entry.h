// What every computation into the volume store shares: its budget of memory, and how its result gets there.
#pragma once

#include "store/store_writer.h"
#include "store/volume_store.h"
#include "volume/dataset.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>

namespace voxsheet::engine {

/// Throws LimitExceeded naming `what` if the bytes needed exceed the budget; a budget of 0 has no limit.
void requireMemory(const std::string& what, std::uint64_t neededBytes, std::uint64_t budgetBytes);

/// The result of a computation: readable at once, so that pictures need not wait for the disk, and in the
/// store once it is committed. Without commit() nothing is left in the store.
class ComputedEntry {
public:
    /// One that the store had.
    explicit ComputedEntry(std::shared_ptr<const store::StoreEntry> stored);
    /// Writes one field at one step. Throws what StoreWriter throws.
    ComputedEntry(const store::VolumeStore& store, DatasetMeta meta, std::span<const std::byte> samples);

    [[nodiscard]] const std::shared_ptr<const store::StoreEntry>& entry() const { return entry_; }
    [[nodiscard]] const std::shared_ptr<const DatasetMeta>& meta() const { return entry_->meta(); }

    /// Returns false if the store has another entry under the key by now, as good as this one. Throws
    /// IoError.
    bool commit();

private:
    std::unique_ptr<store::StoreWriter> writer_; ///< null: nothing to commit
    std::shared_ptr<const store::StoreEntry> entry_;
};

} // namespace voxsheet::engine
