#include "bench/time_n/host_memory.h"

#include "store/entry_layout.h"

#include <fcntl.h>

namespace voxsheet::bench {

HostMemory::HostMemory(std::shared_ptr<const store::VolumeStore> store, std::uint64_t budgetBytes)
    : provider_(std::move(store)), budgetBytes_(budgetBytes) {}

std::shared_ptr<const DatasetMeta> HostMemory::describe(const std::string& dataset) const {
    return provider_.describe(dataset);
}

namespace {

std::uint64_t levelBytes(const DatasetMeta& meta, const VolumeKey& key) {
    return store::arrayLayout(meta, key.field).levels.at(static_cast<std::size_t>(key.level)).bytes;
}

} // namespace

void HostMemory::touch(const VolumeKey& key) const {
    const std::scoped_lock lock(mutex_);
    if (const auto known = held_.find(key); known != held_.end()) {
        recent_.splice(recent_.begin(), recent_, known->second);
        return;
    }
    const auto bytes = levelBytes(*provider_.describe(key.dataset), key);
    diskBytes_ += bytes;
    while (!recent_.empty() && residentBytes_ + bytes > budgetBytes_) {
        drop(recent_.back());
        residentBytes_ -= levelBytes(*provider_.describe(recent_.back().dataset), recent_.back());
        held_.erase(recent_.back());
        recent_.pop_back();
    }
    drop(key); // what was written before the bench may still be there
    if (bytes > budgetBytes_) return;
    recent_.push_front(key);
    held_[key] = recent_.begin();
    residentBytes_ += bytes;
}

void HostMemory::drop(const VolumeKey& key) const {
    const auto entry = provider_.entry(key.dataset);
    const auto part =
        store::arrayLayout(*entry->meta(), key.field).levels.at(static_cast<std::size_t>(key.level));
    const store::FileHandle file(entry->folder() / store::arrayFileName(key.field, key.step), O_RDONLY);
    ::posix_fadvise(file.descriptor(), static_cast<off_t>(part.offset), static_cast<off_t>(part.bytes),
                    POSIX_FADV_DONTNEED);
}

void HostMemory::readSlices(const VolumeKey& key, int zBegin, int zCount, std::span<std::byte> out) const {
    touch(key);
    provider_.readSlices(key, zBegin, zCount, out);
}

MinMaxGrid HostMemory::readMinMax(const VolumeKey& key) const { return provider_.readMinMax(key); }

std::uint64_t HostMemory::residentBytes() const {
    const std::scoped_lock lock(mutex_);
    return residentBytes_;
}

std::uint64_t HostMemory::diskBytes() const {
    const std::scoped_lock lock(mutex_);
    return diskBytes_;
}

} // namespace voxsheet::bench
