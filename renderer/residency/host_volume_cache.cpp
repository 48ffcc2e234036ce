#include "residency/host_volume_cache.h"

#include "base/errors.h"

#include <algorithm>
#include <chrono>
#include <cstring>
#include <iterator>
#include <limits>
#include <utility>

namespace voxsheet {

namespace {

constexpr std::size_t kBlockBytes = std::size_t{1} << 20;

using Clock = std::chrono::steady_clock;

double millisecondsSince(Clock::time_point begun) {
    return std::chrono::duration<double, std::milli>(Clock::now() - begun).count();
}

} // namespace

HostVolumeCache::HostVolumeCache(std::shared_ptr<const VolumeProvider> source,
                                 const HostCacheOptions& options)
    : source_(std::move(source)), options_(options), keep_(options.keep) {
    state_.budgetBytes = options_.budgetBytes;
}

HostVolumeCache::~HostVolumeCache() = default;

std::shared_ptr<const DatasetMeta> HostVolumeCache::describe(const std::string& dataset) const {
    return source_->describe(dataset);
}

void HostVolumeCache::readSlices(const VolumeKey& key, int zBegin, int zCount,
                                 std::span<std::byte> out) const {
    readBlocks(key, zBegin, zCount, out, keep_ && blocksOf(key).levelBytes <= options_.budgetBytes);
}

void HostVolumeCache::readSlicesOnce(const VolumeKey& key, int zBegin, int zCount,
                                     std::span<std::byte> out) const {
    readBlocks(key, zBegin, zCount, out, false);
}

void HostVolumeCache::readBlocks(const VolumeKey& key, int zBegin, int zCount, std::span<std::byte> out,
                                 bool keepThem) const {
    const auto meta = source_->describe(key.dataset);
    if (out.size() != sliceBytes(*meta, key, zBegin, zCount).count)
        throw InvalidInput("slices to read", "the buffer has the wrong size");
    const std::size_t slice = sliceBytes(*meta, key, 0, 1).count;
    const Blocks blocks = blocksOf(key);
    for (int z = zBegin; z < zBegin + zCount;) {
        const int number = z / blocks.slices;
        const int first = blocks.first(number);
        const int count = blocks.count(number);
        const int end = std::min(first + count, zBegin + zCount);
        const auto part = out.subspan(static_cast<std::size_t>(z - zBegin) * slice,
                                      static_cast<std::size_t>(end - z) * slice);
        const BlockKey blockKey{key, number};
        auto block = find(blockKey);
        if (!block && keepThem) {
            block = readBlock(key, first, count);
            keep(blockKey, block);
        }
        if (block) {
            std::memcpy(part.data(), block->samples.data() + static_cast<std::size_t>(z - first) * slice,
                        part.size());
        } else {
            const auto begun = Clock::now();
            source_->readSlices(key, z, end - z, part);
            countRead(part.size(), millisecondsSince(begun));
            if (options_.pageCache == PageCacheUse::DropAlways ||
                (options_.pageCache == PageCacheUse::DropOverBudget && keep_))
                source_->dropPages(key, z, end - z);
        }
        z = end;
    }
}

bool HostVolumeCache::isAtHand(const VolumeKey& key) const {
    const Blocks blocks = blocksOf(key);
    if (!keep_ || isKept({key, kLevelBlock})) return true;
    if (!isKept({key, kMinMaxBlock})) return false;
    for (int number = 0; blocks.first(number) < blocks.depth; ++number)
        if (!isKept({key, number})) return false;
    return true;
}

void HostVolumeCache::readAhead(const VolumeKey& key, int zBegin, int zCount,
                                std::optional<FloatTexels> forRays) const {
    (void)sliceBytes(*source_->describe(key.dataset), key, zBegin, zCount); // are there
    const Blocks blocks = blocksOf(key);
    if (!keep_ || 2 * blocks.levelBytes > options_.budgetBytes || isKept({key, kLevelBlock})) return;
    if (forRays) return readLevelAhead(key, zBegin, zCount, *forRays);
    for (int number = zBegin / blocks.slices; blocks.first(number) < zBegin + zCount; ++number) {
        const BlockKey blockKey{key, number};
        const int first = blocks.first(number);
        const int count = blocks.count(number);
        if (isKept(blockKey)) continue;
        if (!fitsBesideAwaited(sliceBytes(*source_->describe(key.dataset), key, first, count).count)) return;
        keep(blockKey, readBlock(key, first, count));
    }
    if (zBegin + zCount == blocks.depth && !isKept({key, kMinMaxBlock})) (void)readMinMax(key);
}

void HostVolumeCache::readLevelAhead(const VolumeKey& key, int zBegin, int zCount, FloatTexels floats) const {
    const std::lock_guard lock(aheadMutex_);
    const TexelPlan plan = planTexels(*source_, key, true, floats);
    if (zBegin == 0 && !beginLevel(key, plan)) return;
    const auto block = lookUp({key, kUnfinishedBlock});
    // Gone: it was taken, or had to make room.
    if (!block || block->unfinished->slices != zBegin) return;
    addSlices(key, *block->unfinished, plan, zCount);
    if (block->unfinished->slices == plan.dims.z) finishLevel(key, *block->unfinished);
}

bool HostVolumeCache::beginLevel(const VolumeKey& key, const TexelPlan& plan) const {
    takeBlock({key, kUnfinishedBlock});
    if (!fitsBesideAwaited(HostTexels::bytesFor(plan.encoding.format, plan.dims))) return false;
    auto texels = texelsFor(plan);
    auto block = std::make_shared<Block>();
    block->unfinished = std::make_shared<UnfinishedLevel>(UnfinishedLevel{std::move(texels), 0});
    block->bytes = HostTexels::bytesFor(plan.encoding.format, plan.dims);
    keep({key, kUnfinishedBlock}, block);
    return true;
}

std::shared_ptr<HostTexels> HostVolumeCache::texelsFor(const TexelPlan& plan) const {
    const std::uint64_t bytes = HostTexels::bytesFor(plan.encoding.format, plan.dims);
    Evicted evicted;
    {
        const std::lock_guard lock(mutex_);
        evicted = makeRoom(bytes);
    }
    if (options_.pageCache == PageCacheUse::DropOverBudget) dropOf(evicted);
    for (const auto& [key, block] : evicted) {
        // What goes for it is the best place for it: its pages are there already. Nobody else may hold it.
        const auto& old = block->level.texels;
        if (old && old.use_count() == 1 && old->format() == plan.encoding.format &&
            old->dims() == plan.dims && old->periodic() == plan.meta->grid.periodic)
            return std::const_pointer_cast<HostTexels>(old);
    }
    return std::make_shared<HostTexels>(plan.encoding.format, plan.dims, plan.meta->grid.periodic);
}

void HostVolumeCache::addSlices(const VolumeKey& key, UnfinishedLevel& level, const TexelPlan& plan,
                                int zCount) const {
    const auto bytes = sliceBytes(*plan.meta, key, level.slices, zCount).count;
    if (pieces_.stored.size() < bytes) pieces_.stored = HugePageBlock(bytes);
    const std::span<std::byte> stored(pieces_.stored.data(), bytes);
    const auto begun = Clock::now();
    if (isOverBudget())
        source_->readSlicesOnce(key, level.slices, zCount, stored);
    else
        source_->readSlices(key, level.slices, zCount, stored);
    countRead(bytes, millisecondsSince(begun));
    if (options_.pageCache == PageCacheUse::DropAlways) source_->dropPages(key, level.slices, zCount);
    std::span<const std::byte> texels = stored;
    if (!isVerbatim(plan.type, plan.encoding)) {
        pieces_.texels.resize(bytes / scalarBytes(plan.type) * texelFormatBytes(plan.encoding.format));
        encodeTexels(plan.type, plan.encoding, stored, pieces_.texels);
        texels = pieces_.texels;
    }
    level.texels->setSlices(level.slices, zCount, texels);
    level.slices += zCount;
}

bool HostVolumeCache::isOverBudget() const {
    if (options_.pageCache != PageCacheUse::DropOverBudget)
        return options_.pageCache == PageCacheUse::DropAlways;
    const std::lock_guard lock(mutex_);
    return state_.evictions > 0;
}

void HostVolumeCache::finishLevel(const VolumeKey& key, const UnfinishedLevel& level) const {
    level.texels->closeBorders();
    const auto begun = Clock::now();
    auto minMax = std::make_shared<const MinMaxGrid>(source_->readMinMax(key));
    countRead(minMax->ranges.size() * sizeof(MinMaxGrid::Range), millisecondsSince(begun));
    const HostLevel whole{level.texels, minMax, contentHash(*minMax)};
    if (takeBlock({key, kUnfinishedBlock})) keepLevel(key, whole);
}

std::optional<UnfinishedLevel> HostVolumeCache::takeUnfinished(const VolumeKey& key,
                                                               TexelFormat format) const {
    const std::lock_guard lock(aheadMutex_);
    const auto block = lookUp({key, kUnfinishedBlock});
    if (!block || block->unfinished->texels->format() != format) return std::nullopt;
    takeBlock({key, kUnfinishedBlock});
    return *block->unfinished;
}

std::shared_ptr<const HostVolumeCache::Block> HostVolumeCache::lookUp(const BlockKey& key) const {
    const std::lock_guard lock(mutex_);
    const auto found = blocks_.find(key);
    return found == blocks_.end() ? nullptr : found->second.block;
}

std::shared_ptr<const HostVolumeCache::Block> HostVolumeCache::takeBlock(const BlockKey& key) const {
    const std::lock_guard lock(mutex_);
    const auto found = blocks_.find(key);
    if (found == blocks_.end()) return nullptr;
    auto block = found->second.block;
    remove(found);
    return block;
}

void HostVolumeCache::keepLevel(const VolumeKey& key, const HostLevel& level) const {
    const BlockKey blockKey{key, kLevelBlock};
    auto block = std::make_shared<Block>();
    block->level = level;
    block->zCount = level.texels->dims().z;
    block->bytes = bytesOf(level);
    takeBlock(blockKey);
    if (block->bytes <= options_.budgetBytes)
        keep(blockKey, block);
    else if (options_.pageCache == PageCacheUse::DropOverBudget)
        dropOf({{blockKey, block}});
}

std::optional<HostLevel> HostVolumeCache::takeLevel(const VolumeKey& key, TexelFormat format) const {
    const std::lock_guard lock(mutex_);
    const auto found = blocks_.find({key, kLevelBlock});
    if (found == blocks_.end() || found->second.block->level.texels->format() != format) return std::nullopt;
    ++state_.hits;
    auto level = found->second.block->level;
    remove(found);
    return level;
}

HostVolumeCache::Blocks HostVolumeCache::blocksOf(const VolumeKey& key) const {
    const auto meta = source_->describe(key.dataset);
    const std::size_t slice = sliceBytes(*meta, key, 0, 1).count;
    Blocks blocks;
    blocks.depth = levelDims(meta->grid.dims, key.level).z;
    blocks.slices = static_cast<int>(
        std::clamp(kBlockBytes / slice, std::size_t{1}, static_cast<std::size_t>(blocks.depth)));
    blocks.levelBytes = std::uint64_t{slice} * static_cast<std::uint64_t>(blocks.depth);
    return blocks;
}

bool HostVolumeCache::isKept(const BlockKey& key) const { return lookUp(key) != nullptr; }

std::shared_ptr<const HostVolumeCache::Block> HostVolumeCache::readBlock(const VolumeKey& key, int zBegin,
                                                                         int zCount) const {
    auto block = std::make_shared<Block>();
    block->zBegin = zBegin;
    block->zCount = zCount;
    block->samples.resize(sliceBytes(*source_->describe(key.dataset), key, zBegin, zCount).count);
    block->bytes = block->samples.size();
    const auto begun = Clock::now();
    source_->readSlices(key, zBegin, zCount, block->samples);
    countRead(block->bytes, millisecondsSince(begun));
    if (options_.pageCache == PageCacheUse::DropAlways) source_->dropPages(key, zBegin, zCount);
    return block;
}

MinMaxGrid HostVolumeCache::readMinMax(const VolumeKey& key) const {
    const BlockKey blockKey{key, kMinMaxBlock};
    if (const auto found = find(blockKey)) return found->minMax;
    auto block = std::make_shared<Block>();
    const auto begun = Clock::now();
    block->minMax = source_->readMinMax(key);
    block->bytes = block->minMax.ranges.size() * sizeof(MinMaxGrid::Range);
    countRead(block->bytes, millisecondsSince(begun));
    // Beside samples only: who holds the level elsewhere holds its grid, too.
    if (keep_ && block->bytes <= options_.budgetBytes && isKept({key, 0})) keep(blockKey, block);
    return block->minMax;
}

void HostVolumeCache::dropPages(const VolumeKey& key, int zBegin, int zCount) const {
    source_->dropPages(key, zBegin, zCount);
}

std::shared_ptr<const HostVolumeCache::Block> HostVolumeCache::find(const BlockKey& key) const {
    const std::lock_guard lock(mutex_);
    const auto found = blocks_.find(key);
    if (found == blocks_.end()) {
        ++state_.misses;
        return nullptr;
    }
    ++state_.hits;
    auto& order = orderOf(found->second);
    order.splice(order.begin(), order, found->second.order);
    return found->second.block;
}

HostVolumeCache::Kepts::iterator HostVolumeCache::remove(Kepts::iterator kept) const {
    state_.bytes -= kept->second.block->bytes;
    if (kept->second.awaited) awaitedBytes_ -= kept->second.block->bytes;
    orderOf(kept->second).erase(kept->second.order);
    return blocks_.erase(kept);
}

// --- what is awaited ---

std::list<HostVolumeCache::BlockKey>& HostVolumeCache::orderOf(const Kept& kept) const {
    return kept.awaited ? awaitedOrder_ : order_;
}

void HostVolumeCache::markAwaited(Kept& kept, bool awaited) const {
    if (kept.awaited == awaited) return;
    auto& from = orderOf(kept);
    kept.awaited = awaited;
    auto& to = orderOf(kept);
    to.splice(to.begin(), from, kept.order);
    if (awaited)
        awaitedBytes_ += kept.block->bytes;
    else
        awaitedBytes_ -= kept.block->bytes;
}

void HostVolumeCache::setAwaited(const std::vector<VolumeKey>& levels) const {
    const std::lock_guard lock(mutex_);
    awaited_ = {levels.begin(), levels.end()};
    for (auto& [key, kept] : blocks_)
        markAwaited(kept, awaited_.count(key.volume) != 0);
}

void HostVolumeCache::endAwaited(const VolumeKey& level) const {
    const std::lock_guard lock(mutex_);
    if (awaited_.erase(level) == 0) return;
    for (auto kept = blocks_.lower_bound({level, std::numeric_limits<int>::min()});
         kept != blocks_.end() && kept->first.volume == level; ++kept)
        markAwaited(kept->second, false);
}

bool HostVolumeCache::fitsBesideAwaited(std::uint64_t bytes) const {
    const std::lock_guard lock(mutex_);
    return awaitedBytes_ + bytes <= options_.budgetBytes;
}

// --- room ---

HostVolumeCache::Evicted HostVolumeCache::makeRoom(std::uint64_t bytes) const {
    Evicted evicted;
    while (state_.bytes + bytes > options_.budgetBytes && !blocks_.empty()) {
        const auto oldest = blocks_.find(order_.empty() ? awaitedOrder_.back() : order_.back());
        ++state_.evictions;
        evicted.emplace_back(oldest->first, oldest->second.block);
        remove(oldest);
    }
    return evicted;
}

void HostVolumeCache::keep(const BlockKey& key, const std::shared_ptr<const Block>& block) const {
    Evicted evicted;
    {
        const std::lock_guard lock(mutex_);
        if (blocks_.count(key) != 0) return; // another thread was faster
        evicted = makeRoom(block->bytes);
        Kept kept{block, {}, awaited_.count(key.volume) != 0};
        auto& order = orderOf(kept);
        kept.order = order.insert(order.begin(), key);
        if (kept.awaited) awaitedBytes_ += block->bytes;
        state_.bytes += block->bytes;
        blocks_.emplace(key, std::move(kept));
    }
    if (options_.pageCache == PageCacheUse::DropOverBudget) dropOf(evicted);
}

void HostVolumeCache::dropOf(const Evicted& evicted) const {
    for (const auto& [key, block] : evicted) {
        if (key.block == kMinMaxBlock || key.block == kUnfinishedBlock) continue;
        try {
            source_->dropPages(key.volume, block->zBegin, block->zCount);
        } catch (const Error&) {
            continue; // The dataset is gone, and its pages with it.
        }
    }
}

void HostVolumeCache::countRead(std::uint64_t bytes, double ms) const {
    const std::lock_guard lock(mutex_);
    state_.diskBytes += bytes;
    state_.diskMs += ms;
}

void HostVolumeCache::forget(const std::string& dataset) {
    const std::lock_guard lock(mutex_);
    for (auto kept = blocks_.begin(); kept != blocks_.end();)
        kept = kept->first.volume.dataset == dataset ? remove(kept) : std::next(kept);
}

HostCacheState HostVolumeCache::state() const {
    const std::lock_guard lock(mutex_);
    return state_;
}

} // namespace voxsheet
