#include "residency/residency_manager.h"

#include "base/byte_size.h"
#include "base/errors.h"
#include "base/log.h"
#include "gpu/context.h"
#include "residency/pending_texture.h"
#include "residency/slice_reader.h"
#include "residency/texture_table.h"

#include <algorithm>
#include <cstdlib>
#include <set>
#include <utility>

namespace voxsheet {

VolumeLease::VolumeLease(std::shared_ptr<TextureEntry> entry)
    : uploadMs(std::exchange(entry->uploadMs, 0.0)), readMs(std::exchange(entry->readMs, 0.0)),
      entry_(std::move(entry)) {
    ++entry_->leases;
}

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
    : context_(context), provider_(std::move(provider)), budgetBytes_(budgetBytes),
      reader_(std::make_unique<SliceReader>(provider_)), table_(std::make_unique<TextureTable>()) {}

ResidencyManager::~ResidencyManager() = default;

// --- at any price ---

VolumeLease ResidencyManager::acquire(const VolumeKey& key, TexelForm form, SamplesUse use) {
    return *acquireBy(Deadline::max(), key, form, use);
}

VolumeLease ResidencyManager::acquireGradients(const VolumeKey& key, TexelForm form,
                                               const DerivedTextureBuilder& build) {
    return *acquireGradientsBy(Deadline::max(), key, form, build);
}

std::optional<VolumeLease> ResidencyManager::acquireBy(Deadline deadline, const VolumeKey& key,
                                                       TexelForm form, SamplesUse use) {
    const TextureKey textureKey{key, kindOf(form)};
    if (auto resident = leaseResident(textureKey, use)) return resident;
    table_->throwIfFailed(textureKey);
    auto& pending = enqueueSamples(textureKey, form, use, WantedPriority::Visible);
    if (!advanceToLease(pending, deadline, nullptr)) return std::nullopt;
    return leaseResident(textureKey, use);
}

std::optional<VolumeLease> ResidencyManager::acquireGradientsBy(Deadline deadline, const VolumeKey& key,
                                                                TexelForm form,
                                                                const DerivedTextureBuilder& build) {
    const TextureKey textureKey{key, gradientsKind(form.floats)};
    if (auto resident = leaseResident(textureKey, SamplesUse::Drawing)) return resident;
    const auto source = acquireBy(deadline, key, form);
    if (!source) return std::nullopt;
    table_->throwIfFailed(textureKey);
    auto* pending = findPending(textureKey);
    if (pending == nullptr) {
        pending = &enqueue(std::make_unique<PendingTexture>(textureKey, source->volume().meta, build),
                           WantedPriority::Visible);
    }
    if (!advanceToLease(*pending, deadline, &source->volume())) return std::nullopt;
    auto lease = leaseResident(textureKey, SamplesUse::Drawing);
    lease->uploadMs += source->uploadMs;
    lease->readMs += source->readMs;
    return lease;
}

bool ResidencyManager::advanceToLease(PendingTexture& pending, Deadline deadline,
                                      const ResidentVolume* source) {
    try {
        if (!pending.begun()) beginAtAnyPrice(pending);
        if (!pending.advance(deadline, *reader_, source)) return false;
    } catch (...) {
        dequeue(pending);
        throw;
    }
    complete(pending);
    return true;
}

void ResidencyManager::complete(PendingTexture& pending) {
    const TextureKey key = pending.key();
    const bool wasKept = pending.isKept();
    auto entry = pending.finish();
    dequeue(pending);
    totals_.uploadMs += entry->uploadMs;
    totals_.readMs += entry->readMs;
    if (!isGradients(key.kind) && !wasKept) {
        ++totals_.uploads;
        totals_.uploadedBytes += entry->bytes;
    }
    table_->add(key, std::move(entry));
}

// --- only if it is there ---

std::optional<VolumeLease> ResidencyManager::leaseResident(const TextureKey& key, SamplesUse use) {
    auto entry = table_->use(key);
    if (!entry) return std::nullopt;
    if (use == SamplesUse::Drawing) entry->clipObject = false;
    return VolumeLease(std::move(entry));
}

std::optional<VolumeLease> ResidencyManager::acquireResident(const VolumeKey& key, TexelForm form,
                                                             SamplesUse use) {
    return leaseResident({key, kindOf(form)}, use);
}

std::optional<VolumeLease> ResidencyManager::acquireResidentGradients(const VolumeKey& key, TexelForm form) {
    return leaseResident({key, gradientsKind(form.floats)}, SamplesUse::Drawing);
}

bool ResidencyManager::isResident(const VolumeKey& key, TexelForm form) const {
    return table_->contains({key, kindOf(form)});
}

bool ResidencyManager::areGradientsResident(const VolumeKey& key, TexelForm form) const {
    return table_->contains({key, gradientsKind(form.floats)});
}

std::optional<int> ResidencyManager::nearestResidentLevel(const VolumeKey& key, TexelForm form) const {
    const int levels = provider_->describe(key.dataset)->levels();
    std::optional<int> nearest;
    VolumeKey at = key;
    for (at.level = 0; at.level < levels; ++at.level) {
        if (!isResident(at, form)) continue;
        if (!nearest || std::abs(at.level - key.level) < std::abs(*nearest - key.level)) nearest = at.level;
    }
    return nearest;
}

// --- in the background ---

void ResidencyManager::setWanted(const std::vector<WantedVolume>& wanted) {
    table_->setWanted(wanted);
    std::set<VolumeKey> keys;
    for (const auto& volume : wanted)
        keys.insert(volume.key);
    std::erase_if(queue_, [&](const auto& pending) {
        return std::exchange(pending->asked, 0) == 0 && keys.count(pending->key().volume) == 0;
    });
    for (const auto& pending : queue_)
        pending->priority = std::max(WantedPriority::Soon, table_->priority(pending->key().volume));
    for (const WantedPriority priority : {WantedPriority::Visible, WantedPriority::Soon}) {
        for (const auto& volume : wanted) {
            if (volume.priority != priority || isResident(volume.key, volume.form)) continue;
            try {
                keepIfRoom(enqueueSamples({volume.key, kindOf(volume.form)}, volume.form, SamplesUse::Drawing,
                                          priority));
            } catch (const NotFound&) {
                continue; // It was removed since: whoever draws it says so.
            }
        }
    }
}

bool ResidencyManager::request(const VolumeKey& key, TexelForm form, SamplesUse use) {
    if (isResident(key, form)) return true;
    const TextureKey textureKey{key, kindOf(form)};
    if (table_->hasFailed(textureKey)) return false;
    auto& pending = enqueueSamples(textureKey, form, use, WantedPriority::Visible);
    ++pending.asked;
    return keepIfRoom(pending);
}

bool ResidencyManager::requestGradients(const VolumeKey& key, TexelForm form,
                                        const DerivedTextureBuilder& build) {
    const TextureKey textureKey{key, gradientsKind(form.floats)};
    if (table_->contains(textureKey)) return true;
    if (table_->hasFailed(textureKey) || !request(key, form)) return false;
    auto* pending = findPending(textureKey);
    if (pending == nullptr) {
        pending =
            &enqueue(std::make_unique<PendingTexture>(textureKey, provider_->describe(key.dataset), build),
                     WantedPriority::Visible);
    }
    ++pending->asked;
    return keepIfRoom(*pending);
}

bool ResidencyManager::keepIfRoom(PendingTexture& pending) {
    if (pending.begun() || couldMakeRoom(pending)) return true;
    dequeue(pending);
    return false;
}

bool ResidencyManager::advance(Deadline deadline) {
    do {
        auto* pending = mostWanted();
        if (pending == nullptr) break;
        advanceInBackground(*pending, deadline);
    } while (std::chrono::steady_clock::now() < deadline);
    return !queue_.empty();
}

void ResidencyManager::advanceInBackground(PendingTexture& pending, Deadline deadline) {
    try {
        std::optional<VolumeLease> source;
        if (isGradients(pending.key().kind)) {
            const bool half = pending.key().kind == TextureKind::HalfGradients;
            source = acquireResident(pending.key().volume, half ? FloatTexels::Half : FloatTexels::Full);
            if (!source) return dequeue(pending); // evicted since: whoever still wants it asks again
        }
        if (!pending.begun() && !beginInBackground(pending)) return dequeue(pending);
        if (pending.advance(deadline, *reader_, source ? &source->volume() : nullptr)) complete(pending);
    } catch (const std::exception& error) {
        // The tile that needs it shows the error.
        table_->keepFailure(pending.key(), std::current_exception());
        logWarning("'" + pending.key().volume.dataset +
                   "' was not brought in ahead of time: " + error.what());
        dequeue(pending);
    }
}

PendingTexture* ResidencyManager::findPending(const TextureKey& key) const {
    const auto found =
        std::find_if(queue_.begin(), queue_.end(), [&](const auto& each) { return each->key() == key; });
    return found == queue_.end() ? nullptr : found->get();
}

PendingTexture& ResidencyManager::enqueue(std::unique_ptr<PendingTexture> pending, WantedPriority priority) {
    pending->priority = priority;
    pending->sequence = ++lastSequence_;
    return *queue_.emplace_back(std::move(pending));
}

PendingTexture& ResidencyManager::enqueueSamples(const TextureKey& key, TexelForm form, SamplesUse use,
                                                 WantedPriority priority) {
    if (auto* known = findPending(key)) {
        known->priority = std::max(known->priority, priority);
        return *known;
    }
    return enqueue(std::make_unique<PendingTexture>(*provider_, key, !workarounds().r8AsR16, form.floats,
                                                    use == SamplesUse::Clipping),
                   priority);
}

void ResidencyManager::dequeue(const PendingTexture& pending) {
    std::erase_if(queue_, [&](const auto& each) { return each.get() == &pending; });
}

PendingTexture* ResidencyManager::mostWanted() const {
    const auto best = std::min_element(queue_.begin(), queue_.end(), [](const auto& a, const auto& b) {
        return a->priority != b->priority ? a->priority > b->priority : a->sequence < b->sequence;
    });
    return best == queue_.end() ? nullptr : best->get();
}

// --- room ---

std::uint64_t ResidencyManager::occupiedBytes() const {
    std::uint64_t bytes = table_->bytes();
    for (const auto& pending : queue_)
        if (pending->begun()) bytes += pending->bytes();
    return bytes;
}

bool ResidencyManager::couldMakeRoom(const PendingTexture& pending) const {
    std::uint64_t kept = table_->bytes() - table_->evictableBytes(pending.priority);
    for (const auto& other : queue_)
        if (other.get() != &pending && other->begun() && other->priority >= pending.priority)
            kept += other->bytes();
    return kept + pending.bytes() <= budgetBytes_;
}

void ResidencyManager::beginAtAnyPrice(PendingTexture& pending) {
    const std::uint64_t leasedBytes = table_->leasedBytes();
    if (leasedBytes + pending.bytes() > budgetBytes_) {
        throw LimitExceeded(
            "a volume of " + byteText(pending.bytes()),
            "the texture budget is " + byteText(budgetBytes_) +
                (leasedBytes > 0 ? ", of which the same tile holds " + byteText(leasedBytes) : ""),
            "draw a coarser level, or raise --texture-budget")
            .withField("texture-budget");
    }
    createTexture(pending, std::nullopt);
}

bool ResidencyManager::beginInBackground(PendingTexture& pending) {
    if (!couldMakeRoom(pending)) return false;
    createTexture(pending, pending.priority);
    return true;
}

void ResidencyManager::createTexture(PendingTexture& pending, std::optional<WantedPriority> below) {
    if (!isGradients(pending.key().kind)) reader_->stopAhead(pending.key().volume);
    // What host memory keeps is taken first: what is evicted takes its place there.
    pending.takeKept();
    provider_->endAwaited(pending.key().volume);
    // Evict first and allocate then, so that the peak stays within the budget too.
    while (occupiedBytes() + pending.bytes() > budgetBytes_ && evictOne(below, pending)) {
    }
    while (true) {
        try {
            pending.begin(context_);
            return;
        } catch (const LimitExceeded&) {
            // The device has less memory than the budget hopes for: give back what we can before giving up.
            if (pending.exceedsDevice(context_) || !evictOne(below, pending)) throw;
        }
    }
}

bool ResidencyManager::evictOne(std::optional<WantedPriority> below, const PendingTexture& inFavourOf) {
    PendingTexture* unfinished = nullptr;
    for (const auto& other : queue_) {
        if (other.get() == &inFavourOf || !other->begun() || (below && other->priority >= *below)) continue;
        if (unfinished == nullptr || other->priority <= unfinished->priority) unfinished = other.get();
    }
    const auto whole = table_->evictable(below);
    if (!whole && unfinished == nullptr) return false;
    // Work under way is given up only for want of anything less wanted.
    if (whole && (unfinished == nullptr || table_->priority(whole->volume) <= unfinished->priority)) {
        const auto entry = table_->remove(*whole);
        if (isOnHost(whole->kind))
            provider_->keepLevel(whole->volume,
                                 {entry->volume.host, entry->volume.minMax, entry->volume.rangesHash});
    } else {
        dequeue(*unfinished);
    }
    ++totals_.evictions;
    return true;
}

// --- before it is asked for ---

bool ResidencyManager::isAtHand(const VolumeKey& key) const { return provider_->isAtHand(key); }

void ResidencyManager::readAhead(const std::vector<WantedVolume>& volumes) {
    std::vector<AheadRequest> levels;
    for (const WantedVolume& volume : volumes)
        levels.push_back({volume.key, volume.form.onHost ? std::optional(volume.form.floats) : std::nullopt});
    reader_->readAhead(std::move(levels));
}

void ResidencyManager::setAwaited(const std::vector<WantedVolume>& volumes) {
    std::vector<VolumeKey> levels;
    for (const WantedVolume& volume : volumes)
        levels.push_back(volume.key);
    provider_->setAwaited(levels);
}

// --- what it would take ---

std::uint64_t ResidencyManager::bytesOf(const VolumeKey& key, TexelForm form) const {
    return VolumeUpload(*provider_, key, !workarounds().r8AsR16, form.floats, isOnHost(kindOf(form))).bytes();
}

std::uint64_t ResidencyManager::gradientBytesOf(const VolumeKey& key) const {
    const auto meta = provider_->describe(key.dataset);
    validateVolumeKey(*meta, key);
    return static_cast<std::uint64_t>(sampleCount(levelDims(meta->grid.dims, key.level))) *
           gpu::texelBytes(GL_RGBA16F);
}

std::shared_ptr<const DatasetMeta> ResidencyManager::describe(const std::string& dataset) const {
    return provider_->describe(dataset);
}

void ResidencyManager::forget(const std::string& dataset) {
    table_->removeDataset(dataset);
    std::erase_if(queue_, [&](const auto& pending) { return pending->key().volume.dataset == dataset; });
}

TextureKind ResidencyManager::kindOf(TexelForm form) const { return samplesKind(form.floats, form.onHost); }

const gpu::Workarounds& ResidencyManager::workarounds() const { return context_.workarounds(); }

ResidencyState ResidencyManager::state() const {
    ResidencyState state = totals_;
    state.budgetBytes = budgetBytes_;
    table_->describe(state);
    for (const auto& pending : queue_) {
        ++state.queuedUploads;
        state.queuedBytes += pending->remainingBytes();
        if (pending->begun()) countBytes(state, pending->key().kind, pending->clipObject(), pending->bytes());
    }
    return state;
}

} // namespace voxsheet
