#include "engine/computed_entry.h"

#include "base/errors.h"

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

ComputedEntry::ComputedEntry(std::shared_ptr<const store::StoreEntry> stored) : entry_(std::move(stored)) {}

ComputedEntry::ComputedEntry(const store::VolumeStore& store, DatasetMeta meta,
                             std::span<const std::byte> samples)
    : writer_(std::make_unique<store::StoreWriter>(store, std::move(meta))) {
    writer_->addArray(0, 0, samples);
    entry_ = writer_->entry();
}

bool ComputedEntry::commit() {
    const auto writer = std::move(writer_);
    return !writer || writer->commit();
}

} // namespace voxsheet::engine
