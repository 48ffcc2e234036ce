#include "volume/parallel_for.h"

#include "base/thread_count.h"

#include <algorithm>
#include <atomic>
#include <exception>
#include <mutex>
#include <system_error>
#include <thread>
#include <vector>

namespace voxsheet {

namespace {

class SharedLoop {
public:
    SharedLoop(long count, long grain, const std::function<void(long, long)>& body)
        : count_(count), grain_(grain), body_(body) {}

    void work() noexcept {
        for (;;) {
            const long begin = next_.fetch_add(grain_);
            if (begin >= count_) return;
            try {
                body_(begin, std::min(begin + grain_, count_));
            } catch (...) {
                const std::lock_guard lock(mutex_);
                if (!failure_) failure_ = std::current_exception();
                next_.store(count_);
                return;
            }
        }
    }

    void rethrow() {
        if (failure_) std::rethrow_exception(failure_);
    }

private:
    const long count_;
    const long grain_;
    const std::function<void(long, long)>& body_;
    std::atomic<long> next_{0};
    std::mutex mutex_;
    std::exception_ptr failure_;
};

} // namespace

void parallelFor(long count, long grain, const std::function<void(long, long)>& body) {
    if (count <= 0) return;
    grain = std::max(grain, 1L);
    const long chunks = (count + grain - 1) / grain;
    const long threads = threadCount().threads;
    SharedLoop loop(count, grain, body);
    std::vector<std::jthread> helpers;
    try {
        for (long i = 1; i < std::min(threads, chunks); ++i)
            helpers.emplace_back([&loop] { loop.work(); });
    } catch (const std::system_error&) {
        // The process may start no more threads: this one does the rest alone.
    }
    loop.work();
    helpers.clear();
    loop.rethrow();
}

} // namespace voxsheet
