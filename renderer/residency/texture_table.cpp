#include "residency/texture_table.h"

#include "base/errors.h"

#include <algorithm>
#include <tuple>
#include <utility>

namespace voxsheet {

TextureKind samplesKind(FloatTexels floatTexels, bool onHost) noexcept {
    const bool full = floatTexels == FloatTexels::Full;
    if (onHost) return full ? TextureKind::HostSamples : TextureKind::HalfHostSamples;
    return full ? TextureKind::Samples : TextureKind::HalfSamples;
}

bool isOnHost(TextureKind kind) noexcept {
    return kind == TextureKind::HostSamples || kind == TextureKind::HalfHostSamples;
}

TextureKind gradientsKind(FloatTexels floatTexels) noexcept {
    return floatTexels == FloatTexels::Full ? TextureKind::Gradients : TextureKind::HalfGradients;
}

bool isGradients(TextureKind kind) noexcept {
    return kind == TextureKind::Gradients || kind == TextureKind::HalfGradients;
}

void countBytes(ResidencyState& state, TextureKind kind, bool clipObject, std::uint64_t bytes) {
    state.residentBytes += bytes;
    (isGradients(kind) ? state.gradientBytes
     : clipObject      ? state.clipObjectBytes
                       : state.sampleBytes) += bytes;
}

std::shared_ptr<TextureEntry> TextureTable::use(const TextureKey& key) {
    const auto found = entries_.find(key);
    if (found == entries_.end()) return nullptr;
    found->second->lastUse = ++clock_;
    return found->second;
}

void TextureTable::add(const TextureKey& key, std::shared_ptr<TextureEntry> entry) {
    entry->lastUse = ++clock_;
    const std::uint64_t bytes = entry->bytes;
    if (!entries_.emplace(key, std::move(entry)).second)
        throw InternalError("texture of '" + key.volume.dataset + "'", "it is resident already");
    bytes_ += bytes;
}

std::shared_ptr<TextureEntry> TextureTable::remove(const TextureKey& key) {
    const auto found = entries_.find(key);
    if (found == entries_.end()) return nullptr;
    auto entry = std::move(found->second);
    bytes_ -= entry->bytes;
    entries_.erase(found);
    return entry;
}

void TextureTable::removeDataset(const std::string& dataset) {
    std::vector<TextureKey> gone;
    for (const auto& [key, entry] : entries_)
        if (key.volume.dataset == dataset) gone.push_back(key);
    for (const auto& key : gone)
        remove(key);
    std::erase_if(failures_, [&](const auto& failure) { return failure.first.volume.dataset == dataset; });
}

void TextureTable::keepFailure(const TextureKey& key, std::exception_ptr error) {
    failures_[key] = std::move(error);
}

void TextureTable::throwIfFailed(const TextureKey& key) {
    const auto failure = failures_.find(key);
    if (failure == failures_.end()) return;
    const auto error = failure->second;
    failures_.erase(failure);
    std::rethrow_exception(error);
}

void TextureTable::setWanted(const std::vector<WantedVolume>& wanted) {
    failures_.clear();
    wanted_.clear();
    for (const auto& volume : wanted) {
        auto& priority = wanted_.try_emplace(volume.key, volume.priority).first->second;
        priority = std::max(priority, volume.priority);
    }
}

WantedPriority TextureTable::priority(const VolumeKey& key) const {
    if (const auto exact = wanted_.find(key); exact != wanted_.end()) return exact->second;
    VolumeKey finer = key;
    while (--finer.level >= 0) {
        if (const auto found = wanted_.find(finer); found != wanted_.end())
            return std::min(found->second, WantedPriority::Soon);
    }
    return WantedPriority::Recent;
}

bool TextureTable::isEvictable(const TextureKey& key, const TextureEntry& entry,
                               std::optional<WantedPriority> below) const {
    return entry.leases == 0 && (!below || priority(key.volume) < *below);
}

std::optional<TextureKey> TextureTable::evictable(std::optional<WantedPriority> below) const {
    std::optional<TextureKey> best;
    std::tuple<WantedPriority, std::uint64_t> bestRank;
    for (const auto& [key, entry] : entries_) {
        if (!isEvictable(key, *entry, below)) continue;
        const std::tuple rank(priority(key.volume), entry->lastUse);
        if (best && bestRank <= rank) continue;
        best = key;
        bestRank = rank;
    }
    return best;
}

std::uint64_t TextureTable::evictableBytes(std::optional<WantedPriority> below) const {
    std::uint64_t bytes = 0;
    for (const auto& [key, entry] : entries_)
        if (isEvictable(key, *entry, below)) bytes += entry->bytes;
    return bytes;
}

std::uint64_t TextureTable::leasedBytes() const {
    std::uint64_t bytes = 0;
    for (const auto& [key, entry] : entries_)
        if (entry->leases > 0) bytes += entry->bytes;
    return bytes;
}

void TextureTable::describe(ResidencyState& state) const {
    for (const auto& [key, entry] : entries_) {
        countBytes(state, key.kind, entry->clipObject, entry->bytes);
        if (entry->leases > 0) state.pinnedBytes += entry->bytes;
        if (priority(key.volume) == WantedPriority::Visible) state.visibleBytes += entry->bytes;
        ++state.textures;
    }
}

} // namespace voxsheet
