#include "engine/computed_entry.h"

#include "base/errors.h"
#include "store/store_writer.h"

#include <utility>

namespace voxsheet::engine {

namespace {

std::string megabytes(std::uint64_t bytes) {
    return std::to_string((bytes + (1U << 20U) - 1) >> 20U) + " MB";
}

} // namespace

void requireMemory(const std::string& what, std::uint64_t neededBytes, std::uint64_t budgetBytes) {
    if (budgetBytes == 0 || neededBytes <= budgetBytes) return;
    throw LimitExceeded(
        what, "it needs " + megabytes(neededBytes) + " of memory, the budget is " + megabytes(budgetBytes),
        "start the server with a larger --memory-budget");
}

std::shared_ptr<const DatasetMeta> storeResult(const std::string& what, const store::VolumeStore& store,
                                               DatasetMeta meta, std::vector<std::byte>&& samples) {
    const std::string key = meta.key;
    store::StoreWriter writer(store, std::move(meta));
    writer.addArray(0, 0, std::move(samples));
    writer.commit();
    const auto entry = store.open(key);
    if (!entry) throw IoError(what, "its result vanished from the volume store", "make --store-limit larger");
    return entry->meta();
}

} // namespace voxsheet::engine
