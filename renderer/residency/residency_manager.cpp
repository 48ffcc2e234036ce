#include "residency/residency_manager.h"

#include "base/errors.h"
#include "gpu/context.h"
#include "residency/volume_upload.h"

#include <algorithm>
#include <optional>
#include <utility>

namespace voxsheet {

struct VolumeLease::Entry {
    std::optional<gpu::Texture> texture;
    ResidentVolume volume;
    std::uint64_t lastUse = 0;
    int leases = 0;
};

VolumeLease::VolumeLease(std::shared_ptr<Entry> entry) : entry_(std::move(entry)) { ++entry_->leases; }

VolumeLease::VolumeLease(VolumeLease&& other) noexcept
    : uploadMs(other.uploadMs), readMs(other.readMs), entry_(std::move(other.entry_)) {}

VolumeLease& VolumeLease::operator=(VolumeLease&& other) noexcept {
    std::swap(uploadMs, other.uploadMs);
    std::swap(readMs, other.readMs);
    std::swap(entry_, other.entry_);
    return *this;
}

VolumeLease::~VolumeLease() {
    if (entry_) --entry_->leases;
}

const ResidentVolume& VolumeLease::volume() const { return entry_->volume; }

ResidencyManager::ResidencyManager(gpu::Context& context, std::shared_ptr<const VolumeProvider> provider,
                                   std::uint64_t budgetBytes)
    : context_(context), provider_(std::move(provider)) {
    state_.budgetBytes = budgetBytes;
}

ResidencyManager::~ResidencyManager() = default;

std::shared_ptr<VolumeLease::Entry> ResidencyManager::find(const EntryKey& key) {
    const auto known = entries_.find(key);
    if (known == entries_.end()) return nullptr;
    known->second->lastUse = ++clock_;
    return known->second;
}

VolumeLease ResidencyManager::acquire(const VolumeKey& key, FloatTexels floatTexels) {
    const Kind kind = floatTexels == FloatTexels::Full ? Kind::Samples : Kind::HalfSamples;
    if (auto known = find({key, kind})) return VolumeLease(std::move(known));
    return load(key, floatTexels);
}

VolumeLease ResidencyManager::load(const VolumeKey& key, FloatTexels floatTexels) {
    VolumeUpload upload(*provider_, key, !context_.workarounds().r8AsR16, floatTexels);
    makeRoom(upload.bytes());
    auto entry = std::make_shared<Entry>();
    entry->texture.emplace(
        createTexture([&] { return upload.createTexture(context_); }, !upload.exceedsDevice(context_)));
    upload.fill(*entry->texture);
    entry->volume = upload.volume();
    state_.uploadedBytes += entry->texture->bytes();
    auto lease =
        keep({key, floatTexels == FloatTexels::Full ? Kind::Samples : Kind::HalfSamples}, std::move(entry));
    lease.uploadMs = upload.uploadMs();
    lease.readMs = upload.readMs();
    return lease;
}

VolumeLease ResidencyManager::acquireGradients(const VolumeKey& key, FloatTexels floatTexels,
                                               const DerivedTextureBuilder& build) {
    const EntryKey entryKey{key, floatTexels == FloatTexels::Full ? Kind::Gradients : Kind::HalfGradients};
    if (auto known = find(entryKey)) return VolumeLease(std::move(known));
    const VolumeLease source = acquire(key, floatTexels);
    const auto& volume = source.volume();
    makeRoom(static_cast<std::uint64_t>(sampleCount(volume.dims)) * gpu::texelBytes(GL_RGBA16F));
    auto entry = std::make_shared<Entry>();
    entry->texture.emplace(
        createTexture([&] { return gpu::Texture(context_, GL_TEXTURE_3D, GL_RGBA16F, volume.dims); }, true));
    setVolumeSampling(*entry->texture, volume.meta->grid);
    build(volume, *entry->texture);
    entry->volume = volume;
    auto lease = keep(entryKey, std::move(entry));
    lease.uploadMs = source.uploadMs;
    lease.readMs = source.readMs;
    return lease;
}

VolumeLease ResidencyManager::keep(const EntryKey& key, std::shared_ptr<Entry> entry) {
    entry->volume.texture = &*entry->texture;
    entry->lastUse = ++clock_;
    entries_.emplace(key, entry);
    state_.residentBytes += entry->texture->bytes();
    ++state_.textures;
    return VolumeLease(std::move(entry));
}

void ResidencyManager::makeRoom(std::uint64_t bytes) {
    std::uint64_t leasedBytes = 0;
    for (const auto& [key, entry] : entries_) {
        if (entry->leases > 0) leasedBytes += entry->texture->bytes();
    }
    if (leasedBytes + bytes > state_.budgetBytes) {
        throw LimitExceeded(
            "a volume of " + std::to_string(bytes) + " bytes",
            "the texture budget is " + std::to_string(state_.budgetBytes) + " bytes" +
                (leasedBytes > 0 ? ", of which the same tile holds " + std::to_string(leasedBytes) : ""),
            "draw a coarser level, or raise --texture-budget")
            .withField("texture-budget");
    }
    // Evict first and allocate then, so that the peak stays within the budget too.
    while (state_.residentBytes + bytes > state_.budgetBytes && evictOne()) {
    }
}

gpu::Texture ResidencyManager::createTexture(const std::function<gpu::Texture()>& create, bool roomHelps) {
    while (true) {
        try {
            return create();
        } catch (const LimitExceeded&) {
            // The device has less memory than the budget hopes for: give back what we can before giving up.
            if (!roomHelps || !evictOne()) throw;
        }
    }
}

bool ResidencyManager::evictOne() {
    auto oldest = entries_.end();
    for (auto entry = entries_.begin(); entry != entries_.end(); ++entry) {
        if (entry->second->leases > 0) continue;
        if (oldest == entries_.end() || entry->second->lastUse < oldest->second->lastUse) oldest = entry;
    }
    if (oldest == entries_.end()) return false;
    drop(oldest);
    ++state_.evictions;
    return true;
}

ResidencyManager::Entries::iterator ResidencyManager::drop(Entries::iterator entry) {
    state_.residentBytes -= entry->second->texture->bytes();
    --state_.textures;
    return entries_.erase(entry);
}

bool ResidencyManager::isResident(const VolumeKey& key, FloatTexels floatTexels) const {
    return entries_.count({key, floatTexels == FloatTexels::Full ? Kind::Samples : Kind::HalfSamples}) != 0;
}

void ResidencyManager::forget(const std::string& dataset) {
    for (auto entry = entries_.begin(); entry != entries_.end();) {
        entry = entry->first.first.dataset == dataset ? drop(entry) : std::next(entry);
    }
}

ResidencyState ResidencyManager::state() const { return state_; }

} // namespace voxsheet
