// The volume store: a folder of entries, one per dataset or formula result, that several processes may share.
#pragma once

#include "store/store_entry.h"

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>

namespace voxsheet::store {

/// A cache: deleting it, or any entry of it, loses nothing. Thread-safe; safe with several processes on one
/// folder. An entry appears whole or not at all: it is written under a temporary name in the same folder,
/// synced, and renamed.
class VolumeStore {
public:
    /// Makes the folder (readable by its owner only) if needed and removes what crashed writers left behind.
    /// \param limitBytes  of all entries together, 0 = no limit; the least recently used go first, entries
    /// that any
    ///                    process has open stay
    /// Throws IoError.
    explicit VolumeStore(std::filesystem::path folder, std::uint64_t limitBytes = 0);

    [[nodiscard]] const std::filesystem::path& folder() const { return folder_; }
    [[nodiscard]] std::uint64_t limitBytes() const { return limitBytes_; }

    /// The entry, checked, marked as used now; null if it is absent. A damaged entry is removed and counts as
    /// absent. Throws InvalidInput if `key` is no store key.
    [[nodiscard]] std::shared_ptr<const StoreEntry> open(const std::string& key) const;

    /// Removes an entry that nobody has open; returns whether it is gone.
    bool remove(const std::string& key) const;

    /// Bytes of all entries.
    [[nodiscard]] std::uint64_t usedBytes() const;
    /// Removes least recently used entries until `incomingBytes` more fit into the limit, or only open ones
    /// and `keep` are left.
    void makeRoom(std::uint64_t incomingBytes, const std::string& keep = {}) const;

private:
    friend class StoreWriter;
    void removeLeftovers() const;
    [[nodiscard]] std::filesystem::path newTemporaryFolder() const;

    std::filesystem::path folder_;
    std::uint64_t limitBytes_;
};

/// $XDG_CACHE_HOME/voxsheet/store, else ~/.cache/voxsheet/store. Throws NotFound if neither is set.
[[nodiscard]] std::filesystem::path defaultStoreFolder();

} // namespace voxsheet::store
