// Threads that wait for one loop after another: for those who run so many short loops that starting threads
// for each would take as long.
#pragma once

#include <condition_variable>
#include <cstdint>
#include <functional>
#include <mutex>
#include <thread>
#include <vector>

namespace voxsheet {

class SharedLoop;

class ThreadTeam {
public:
    /// \param helpers  threads beside the one that calls run(); fewer where the process may start no more
    explicit ThreadTeam(long helpers);
    ~ThreadTeam();
    ThreadTeam(const ThreadTeam&) = delete;
    ThreadTeam& operator=(const ThreadTeam&) = delete;

    /// As parallelFor(), by one thread at a time and not from a body. A helper that the system has not woken
    /// by the time the others are through is not waited for: on a busy machine that takes longer than a short
    /// loop.
    void run(long count, long grain, const std::function<void(long begin, long end)>& body);

private:
    void help();

    std::mutex mutex_;
    std::condition_variable opened_; ///< or ending_
    std::condition_variable left_;
    SharedLoop* loop_ = nullptr; ///< that helpers may join
    std::uint64_t loops_ = 0;    ///< opened so far
    int inside_ = 0;             ///< helpers at work on loop_
    bool ending_ = false;
    std::vector<std::jthread> threads_;
};

} // namespace voxsheet
