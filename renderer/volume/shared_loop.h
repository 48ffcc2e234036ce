// A loop that several threads take pieces of.
#pragma once

#include <algorithm>
#include <atomic>
#include <exception>
#include <functional>
#include <mutex>

namespace voxsheet {

class SharedLoop {
public:
    /// \param grain  >= 1
    SharedLoop(long count, long grain, const std::function<void(long begin, long end)>& body)
        : count_(count), grain_(grain), body_(body) {}

    /// Takes pieces until none is left, or a body has thrown.
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

    /// Once all threads have left.
    void rethrow() const {
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

} // namespace voxsheet
