#include "residency/slice_reader.h"

#include <utility>

namespace voxsheet {

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
        provider->readSlices(request.key, request.zBegin, request.zCount, request.buffer);
        return std::move(request.buffer);
    });
}

std::future<MinMaxGrid> SliceReader::readMinMax(VolumeKey key) {
    return enqueue<MinMaxGrid>(
        [provider = provider_, key = std::move(key)] { return provider->readMinMax(key); });
}

void SliceReader::run() {
    for (;;) {
        std::packaged_task<void()> task;
        {
            std::unique_lock lock(mutex_);
            wake_.wait(lock, [this] { return ending_ || !waiting_.empty(); });
            if (ending_) return;
            task = std::move(waiting_.front());
            waiting_.pop_front();
        }
        task();
    }
}

} // namespace voxsheet
