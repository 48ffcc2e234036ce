#include "residency/slice_reader.h"

#include <algorithm>
#include <exception>
#include <optional>
#include <utility>

namespace voxsheet {

namespace {

/// Of a level read ahead, at one go. For rays it comes from the disk straight into a buffer: each piece waits
/// for the disk and then, behind the rays that are marched, for a processor.
constexpr std::size_t kAheadBytes = std::size_t{1} << 20;
constexpr std::size_t kAheadForRaysBytes = std::size_t{8} << 20;
/// Between two pieces of one volume its upload asks for nothing: no time to begin another one.
constexpr auto kAheadAfter = std::chrono::milliseconds(1);

} // namespace

SliceReader::SliceReader(std::shared_ptr<const VolumeProvider> provider)
    : provider_(std::move(provider)), thread_([this] { run(); }) {}

SliceReader::~SliceReader() {
    {
        const std::lock_guard lock(mutex_);
        ending_ = true;
    }
    wake_.notify_all();
    thread_.join();
}

template <typename Result, typename Work>
std::future<Result> SliceReader::enqueue(Work work) {
    std::promise<Result> promise;
    auto result = promise.get_future();
    std::packaged_task<void()> task([work = std::move(work), promise = std::move(promise)]() mutable {
        try {
            promise.set_value(work());
        } catch (...) {
            promise.set_exception(std::current_exception());
        }
    });
    {
        const std::lock_guard lock(mutex_);
        waiting_.push_back(std::move(task));
    }
    wake_.notify_all();
    return result;
}

std::future<std::vector<std::byte>> SliceReader::read(SliceRequest request) {
    return enqueue<std::vector<std::byte>>([provider = provider_, request = std::move(request)]() mutable {
        if (request.once)
            provider->readSlicesOnce(request.key, request.zBegin, request.zCount, request.buffer);
        else
            provider->readSlices(request.key, request.zBegin, request.zCount, request.buffer);
        return std::move(request.buffer);
    });
}

std::future<MinMaxGrid> SliceReader::readMinMax(VolumeKey key) {
    return enqueue<MinMaxGrid>(
        [provider = provider_, key = std::move(key)] { return provider->readMinMax(key); });
}

void SliceReader::readAhead(std::vector<AheadRequest> levels) {
    {
        const std::lock_guard lock(mutex_);
        if (levels == asked_) return;
        ahead_.assign(levels.begin(), levels.end());
        nextAhead_ = 0;
        asked_ = std::move(levels);
        aheadFrom_ = std::chrono::steady_clock::now() + kAheadAfter;
    }
    wake_.notify_all();
}

void SliceReader::stopAhead(const VolumeKey& key) {
    const std::lock_guard lock(mutex_);
    if (ahead_.empty()) return;
    if (ahead_.front().key == key) nextAhead_ = 0;
    std::erase_if(ahead_, [&](const AheadRequest& level) { return level.key == key; });
    if (ahead_.empty()) asked_.clear();
}

void SliceReader::run() {
    for (;;) {
        std::packaged_task<void()> task;
        std::optional<Ahead> ahead;
        {
            std::unique_lock lock(mutex_);
            wake_.wait(lock, [this] { return ending_ || !waiting_.empty() || !ahead_.empty(); });
            wake_.wait_until(lock, aheadFrom_, [this] { return ending_ || !waiting_.empty(); });
            if (ending_) return;
            if (waiting_.empty()) {
                if (std::chrono::steady_clock::now() < aheadFrom_ || ahead_.empty()) continue;
                ahead = Ahead{ahead_.front(), nextAhead_};
            } else {
                task = std::move(waiting_.front());
                waiting_.pop_front();
            }
        }
        if (ahead) {
            readAheadSome(*ahead);
            continue;
        }
        task();
        const std::lock_guard lock(mutex_);
        aheadFrom_ = std::chrono::steady_clock::now() + kAheadAfter;
    }
}

void SliceReader::readAheadSome(const Ahead& from) {
    std::optional<int> next; // nothing: the level is at its end, or fails
    try {
        const VolumeKey& key = from.level.key;
        const auto meta = provider_->describe(key.dataset);
        const int depth = levelDims(meta->grid.dims, key.level).z;
        const auto slice = sliceBytes(*meta, key, 0, 1).count;
        const auto bytes = from.level.forRays ? kAheadForRaysBytes : kAheadBytes;
        const auto slices = static_cast<int>(
            std::clamp(bytes / slice, std::size_t{1}, static_cast<std::size_t>(depth - from.zBegin)));
        provider_->readAhead(key, from.zBegin, slices, from.level.forRays);
        if (from.zBegin + slices < depth) next = from.zBegin + slices;
    } catch (const std::exception&) {
        next.reset();
    }
    const std::lock_guard lock(mutex_);
    if (ahead_.empty() || !(ahead_.front() == from.level) || nextAhead_ != from.zBegin)
        return; // others are asked for
    if (!next) ahead_.pop_front();
    nextAhead_ = next.value_or(0);
    if (ahead_.empty()) asked_.clear(); // to be asked for again once they have gone
}

} // namespace voxsheet
