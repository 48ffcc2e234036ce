// Reads samples on a thread of its own, so that the render thread never waits for a disk any longer than it
// wants to. Private to this room.
#pragma once

#include "volume/volume_provider.h"

#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <deque>
#include <future>
#include <memory>
#include <mutex>
#include <optional>
#include <thread>
#include <vector>

namespace voxsheet {

/// Slices [zBegin, zBegin + zCount) of a level.
struct SliceRequest {
    VolumeKey key;
    int zBegin = 0;
    int zCount = 0;
    bool once = false;             ///< VolumeProvider::readSlicesOnce
    std::vector<std::byte> buffer; ///< what they are read into, given back as the result; of their size
};

/// A level that will be wanted soon.
struct AheadRequest {
    VolumeKey key;
    std::optional<FloatTexels> forRays; ///< VolumeProvider::readAhead

    bool operator==(const AheadRequest&) const = default;
};

/// Requests are served one after another, in their order, and levels are read ahead while none comes. Its
/// members may be called from any thread.
class SliceReader {
public:
    explicit SliceReader(std::shared_ptr<const VolumeProvider> provider);
    /// Waits for the request that is being served; those after it are dropped.
    ~SliceReader();
    SliceReader(const SliceReader&) = delete;
    SliceReader& operator=(const SliceReader&) = delete;

    /// The futures throw what the provider throws.
    [[nodiscard]] std::future<std::vector<std::byte>> read(SliceRequest request);
    [[nodiscard]] std::future<MinMaxGrid> readMinMax(VolumeKey key);

    /// Brings levels into the provider's memory (VolumeProvider::readAhead), some MiB between two looks at
    /// the requests. Other levels than before replace what is left of those. What fails is left to who reads
    /// it.
    void readAhead(std::vector<AheadRequest> levels);
    /// The level is being brought in: it is read ahead no longer, but for a piece that may be under way.
    void stopAhead(const VolumeKey& key);

private:
    template <typename Result, typename Work>
    [[nodiscard]] std::future<Result> enqueue(Work work);
    void run();
    struct Ahead {
        AheadRequest level;
        int zBegin = 0;
    };
    void readAheadSome(const Ahead& from);

    std::shared_ptr<const VolumeProvider> provider_;
    std::mutex mutex_;
    std::condition_variable wake_;
    std::deque<std::packaged_task<void()>> waiting_;
    std::vector<AheadRequest> asked_;                 ///< readAhead()
    std::deque<AheadRequest> ahead_;                  ///< of those, what is left
    std::chrono::steady_clock::time_point aheadFrom_; ///< unless a request comes first
    int nextAhead_ = 0;                               ///< slice of the first of them
    bool ending_ = false;
    std::thread thread_;
};

} // namespace voxsheet
