#include "volume/thread_team.h"

#include "volume/shared_loop.h"

#include <system_error>

namespace voxsheet {

ThreadTeam::ThreadTeam(long helpers) {
    try {
        for (long i = 0; i < helpers; ++i)
            threads_.emplace_back([this] { help(); });
    } catch (const std::system_error&) {
        // The process may start no more threads: those that there are do it.
    }
}

ThreadTeam::~ThreadTeam() {
    {
        const std::lock_guard lock(mutex_);
        ending_ = true;
    }
    opened_.notify_all();
}

void ThreadTeam::run(long count, long grain, const std::function<void(long, long)>& body) {
    if (count <= 0) return;
    grain = std::max(grain, 1L);
    SharedLoop loop(count, grain, body);
    const bool shared = count > grain && !threads_.empty();
    if (shared) {
        {
            const std::lock_guard lock(mutex_);
            loop_ = &loop;
            ++loops_;
        }
        opened_.notify_all();
    }
    loop.work();
    if (shared) {
        std::unique_lock lock(mutex_);
        loop_ = nullptr;
        left_.wait(lock, [this] { return inside_ == 0; });
    }
    loop.rethrow();
}

void ThreadTeam::help() {
    std::uint64_t joined = 0;
    std::unique_lock lock(mutex_);
    for (;;) {
        opened_.wait(lock, [&] { return ending_ || (loop_ != nullptr && loops_ != joined); });
        if (ending_) return;
        joined = loops_;
        SharedLoop& loop = *loop_;
        ++inside_;
        lock.unlock();
        loop.work();
        lock.lock();
        if (--inside_ == 0) left_.notify_one();
    }
}

} // namespace voxsheet
