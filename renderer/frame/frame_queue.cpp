#include "frame/frame_queue.h"

#include "base/errors.h"

#include <algorithm>
#include <utility>

namespace voxsheet {

void FrameJob::fail(std::exception_ptr error) {
    if (settled) return;
    settled = true;
    promise.set_exception(std::move(error));
}

void FrameJob::succeedIfFinished() {
    if (settled || finishedCount < frame.tiles.size()) return;
    settled = true;
    if (begun) {
        result.wallMs =
            std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - *begun).count();
    }
    promise.set_value(std::move(result));
}

void FrameQueue::push(std::shared_ptr<FrameJob> job) {
    {
        const std::scoped_lock lock(mutex_);
        if (!stopping_) {
            jobs_.push_back(std::move(job));
        } else {
            job->fail(std::make_exception_ptr(Cancelled("the frame", "the renderer is shutting down")));
        }
    }
    changed_.notify_one();
}

void FrameQueue::pushCommand(std::function<void()> command) {
    {
        const std::scoped_lock lock(mutex_);
        commands_.push_back(std::move(command));
    }
    changed_.notify_one();
}

void FrameQueue::stop() {
    {
        const std::scoped_lock lock(mutex_);
        stopping_ = true;
    }
    changed_.notify_one();
}

std::shared_ptr<FrameJob> FrameQueue::best() const {
    const auto first = std::min_element(
        jobs_.begin(), jobs_.end(), [](const auto& a, const auto& b) { return a->priority < b->priority; });
    return first == jobs_.end() ? nullptr : *first;
}

FrameQueue::Work FrameQueue::next(bool wait) {
    std::unique_lock lock(mutex_);
    if (wait) changed_.wait(lock, [&] { return stopping_ || !commands_.empty() || !jobs_.empty(); });
    return {std::exchange(commands_, {}), stopping_ ? nullptr : best(), stopping_};
}

void FrameQueue::remove(const std::shared_ptr<FrameJob>& job) {
    const std::scoped_lock lock(mutex_);
    std::erase(jobs_, job);
}

std::vector<std::shared_ptr<FrameJob>> FrameQueue::takeRemaining() {
    const std::scoped_lock lock(mutex_);
    std::vector<std::shared_ptr<FrameJob>> remaining(jobs_.begin(), jobs_.end());
    jobs_.clear();
    return remaining;
}

} // namespace voxsheet
