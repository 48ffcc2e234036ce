// Threads that come when there is work and go when there is none.
#pragma once

#include <chrono>
#include <functional>
#include <memory>

namespace voxsheet::http {

/// Thread-safe. A task must not throw.
class WorkerPool {
public:
    /// \param queueLength  tasks that may wait when all threads are busy
    WorkerPool(int maxThreads, std::size_t queueLength);
    ~WorkerPool();
    WorkerPool(const WorkerPool&) = delete;
    WorkerPool& operator=(const WorkerPool&) = delete;

    /// False, and the task is not run: all threads are busy and the queue is full, or the pool was stopped.
    [[nodiscard]] bool trySubmit(std::function<void()> task);
    /// Takes no more tasks, drops those that wait, and waits for those under way. False: some still run at
    /// the deadline; their threads keep what they use alive and end on their own.
    bool stop(std::chrono::steady_clock::time_point deadline);

private:
    struct State;
    std::shared_ptr<State> state_;
};

} // namespace voxsheet::http
