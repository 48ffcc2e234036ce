// What every computation into the volume store shares: its budget of memory, and how its result gets there.
#pragma once

#include "store/volume_store.h"
#include "volume/dataset.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace voxsheet::engine {

/// Throws LimitExceeded naming `what` if the bytes needed exceed the budget; a budget of 0 has no limit.
void requireMemory(const std::string& what, std::uint64_t neededBytes, std::uint64_t budgetBytes);

/// Stores one field at one step and opens what became of it. Throws what the store throws; IoError if the
/// entry vanished at once.
[[nodiscard]] std::shared_ptr<const DatasetMeta> storeResult(const std::string& what,
                                                             const store::VolumeStore& store,
                                                             DatasetMeta meta,
                                                             std::vector<std::byte>&& samples);

} // namespace voxsheet::engine
