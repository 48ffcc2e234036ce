// Samples in host memory, up to a budget: what was read before need not be read from disk again.
#pragma once

#include "base/huge_page_block.h"
#include "residency/host_cache_state.h"
#include "volume/texel_plan.h"
#include "volume/volume_provider.h"

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <list>
#include <map>
#include <memory>
#include <mutex>
#include <set>
#include <vector>

namespace voxsheet {

/// When the operating system is told to give up its own copy (the page cache) of what was read.
enum class PageCacheUse {
    Keep,           ///< never
    DropOverBudget, ///< of what this cache does not keep, or not any more
    DropAlways      ///< of everything that was read, at once: then this cache is all the memory there is
};

struct HostCacheOptions {
    std::uint64_t budgetBytes = 0; ///< 0: nothing is kept
    PageCacheUse pageCache = PageCacheUse::Keep;
    bool keep = true; ///< false: nothing is kept until keepFromNowOn()
};

/// A provider in front of another one. Samples are kept in blocks of whole slices, about 1 MiB each, min-max
/// grids and levels that left the textures' budget whole; the least recently used go first, what is awaited
/// last. A level that is larger than the budget is read block by block and not kept, so that it does not push
/// out everything else. Thread-safe, if the source is; two threads that miss the same block both read it.
/// Memory beyond the budget: one block per reading thread, and two pieces of what is read ahead.
class HostVolumeCache : public VolumeProvider {
public:
    /// \param source  not null
    HostVolumeCache(std::shared_ptr<const VolumeProvider> source, const HostCacheOptions& options);
    ~HostVolumeCache() override;

    [[nodiscard]] std::shared_ptr<const DatasetMeta> describe(const std::string& dataset) const override;
    void readSlices(const VolumeKey& key, int zBegin, int zCount, std::span<std::byte> out) const override;
    [[nodiscard]] MinMaxGrid readMinMax(const VolumeKey& key) const override;
    void dropPages(const VolumeKey& key, int zBegin, int zCount) const override;
    /// All of its samples and its min-max grid are kept, or nothing is yet.
    [[nodiscard]] bool isAtHand(const VolumeKey& key) const override;
    /// Of levels that fit the budget twice, so that those before them stay, and beside what is awaited.
    void readAhead(const VolumeKey& key, int zBegin, int zCount,
                   std::optional<FloatTexels> forRays) const override;
    void setAwaited(const std::vector<VolumeKey>& levels) const override;
    void endAwaited(const VolumeKey& level) const override;
    void readSlicesOnce(const VolumeKey& key, int zBegin, int zCount,
                        std::span<std::byte> out) const override;
    void keepLevel(const VolumeKey& key, const HostLevel& level) const override;
    [[nodiscard]] std::optional<HostLevel> takeLevel(const VolumeKey& key, TexelFormat format) const override;
    [[nodiscard]] std::optional<UnfinishedLevel> takeUnfinished(const VolumeKey& key,
                                                                TexelFormat format) const override;

    /// While all that is looked at fits on the GPU, a second copy in host memory is of no use.
    void keepFromNowOn() { keep_ = true; }
    void forget(const std::string& dataset);
    [[nodiscard]] HostCacheState state() const;

private:
    struct BlockKey {
        VolumeKey volume;
        int block = 0; ///< number of the run of slices, or one of those below 0

        auto operator<=>(const BlockKey&) const = default;
    };
    struct Block {
        std::vector<std::byte> samples;
        MinMaxGrid minMax;
        HostLevel level;
        std::shared_ptr<UnfinishedLevel> unfinished; ///< under aheadMutex_
        int zBegin = 0;
        int zCount = 0;
        std::uint64_t bytes = 0;
    };
    struct Kept {
        std::shared_ptr<const Block> block;
        std::list<BlockKey>::iterator order; ///< in orderOf()
        bool awaited = false;
    };
    static constexpr int kMinMaxBlock = -1;
    static constexpr int kLevelBlock = -2;      ///< HostLevel
    static constexpr int kUnfinishedBlock = -3; ///< one that is being read ahead
    using Kepts = std::map<BlockKey, Kept>;

    /// How a level is divided.
    struct Blocks {
        int slices = 1; ///< of each, but for the last
        int depth = 1;  ///< slices of the level
        std::uint64_t levelBytes = 0;

        [[nodiscard]] int first(int block) const { return block * slices; }
        [[nodiscard]] int count(int block) const { return std::min(slices, depth - first(block)); }
    };
    [[nodiscard]] Blocks blocksOf(const VolumeKey& key) const;
    [[nodiscard]] std::shared_ptr<const Block> lookUp(const BlockKey& key) const; ///< which is no use of it
    [[nodiscard]] bool isKept(const BlockKey& key) const;                         ///< likewise
    [[nodiscard]] std::shared_ptr<const Block> find(const BlockKey& key) const;
    Kepts::iterator remove(Kepts::iterator kept) const;   ///< under the lock
    std::list<BlockKey>& orderOf(const Kept& kept) const; ///< likewise
    void markAwaited(Kept& kept, bool awaited) const;     ///< likewise
    [[nodiscard]] bool fitsBesideAwaited(std::uint64_t bytes) const;
    using Evicted = std::vector<std::pair<BlockKey, std::shared_ptr<const Block>>>;
    Evicted makeRoom(std::uint64_t bytes) const; ///< under the lock
    void keep(const BlockKey& key, const std::shared_ptr<const Block>& block) const;
    [[nodiscard]] std::shared_ptr<HostTexels> texelsFor(const TexelPlan& plan) const;
    void readBlocks(const VolumeKey& key, int zBegin, int zCount, std::span<std::byte> out,
                    bool keepThem) const;
    [[nodiscard]] std::shared_ptr<const Block> readBlock(const VolumeKey& key, int zBegin, int zCount) const;
    void countRead(std::uint64_t bytes, double ms) const;
    void readLevelAhead(const VolumeKey& key, int zBegin, int zCount, FloatTexels floats) const;
    /// False: there is no room.
    [[nodiscard]] bool beginLevel(const VolumeKey& key, const TexelPlan& plan) const;
    void addSlices(const VolumeKey& key, UnfinishedLevel& level, const TexelPlan& plan, int zCount) const;
    /// What is read now would leave the system's page cache again: it need not go there.
    [[nodiscard]] bool isOverBudget() const;
    void finishLevel(const VolumeKey& key, const UnfinishedLevel& level) const;
    std::shared_ptr<const Block> takeBlock(const BlockKey& key) const;
    void dropOf(const Evicted& evicted) const;

    std::shared_ptr<const VolumeProvider> source_;
    HostCacheOptions options_;
    std::atomic<bool> keep_;
    mutable std::mutex mutex_;
    mutable Kepts blocks_;
    mutable std::list<BlockKey> order_; ///< most recently used first
    mutable std::set<VolumeKey> awaited_;
    mutable std::list<BlockKey> awaitedOrder_; ///< of what is kept of those; it goes after all others
    mutable std::uint64_t awaitedBytes_ = 0;   ///< likewise
    mutable HostCacheState state_;

    mutable std::mutex aheadMutex_; ///< of levels that are being read ahead; locked before mutex_
    struct Pieces {
        HugePageBlock stored; ///< begins on a page, so that a disk can write into it
        std::vector<std::byte> texels;
    };
    mutable Pieces pieces_; ///< what is read ahead passes through
};

} // namespace voxsheet
