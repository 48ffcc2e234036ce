#include "http/net/worker_pool.h"

#include <condition_variable>
#include <deque>
#include <mutex>
#include <system_error>
#include <thread>

namespace voxsheet::http {

using namespace std::chrono_literals;

struct WorkerPool::State {
    std::mutex mutex;
    std::condition_variable work;
    std::condition_variable ended;
    std::deque<std::function<void()>> queue;
    int maxThreads = 1;
    std::size_t queueLength = 0;
    int threads = 0;
    std::size_t busy = 0;
    bool stopping = false;

    void run() {
        std::unique_lock lock(mutex);
        for (;;) {
            work.wait_for(lock, 10s, [this] { return stopping || !queue.empty(); });
            if (queue.empty()) break;
            auto task = std::move(queue.front());
            queue.pop_front();
            ++busy;
            lock.unlock();
            task();
            task = nullptr; // what it holds must not outlive it by the length of a wait
            lock.lock();
            --busy;
        }
        --threads;
        ended.notify_all();
    }
};

WorkerPool::WorkerPool(int maxThreads, std::size_t queueLength) : state_(std::make_shared<State>()) {
    state_->maxThreads = maxThreads;
    state_->queueLength = queueLength;
}

WorkerPool::~WorkerPool() { stop(std::chrono::steady_clock::now()); }

bool WorkerPool::trySubmit(std::function<void()> task) {
    const std::lock_guard lock(state_->mutex);
    if (state_->stopping) return false;
    const auto pending = state_->queue.size() + state_->busy;
    const auto threads = static_cast<std::size_t>(state_->threads);
    if (pending >= threads && state_->threads < state_->maxThreads) {
        try {
            // Detached: a handler that hangs must not keep the program from ending (see stop()).
            std::thread([state = state_] { state->run(); }).detach();
            ++state_->threads;
        } catch (const std::system_error&) {
            if (state_->threads == 0) return false;
        }
    } else if (pending >= threads + state_->queueLength) {
        return false;
    }
    state_->queue.push_back(std::move(task));
    state_->work.notify_one();
    return true;
}

bool WorkerPool::stop(std::chrono::steady_clock::time_point deadline) {
    std::deque<std::function<void()>> dropped;
    std::unique_lock lock(state_->mutex);
    state_->stopping = true;
    dropped.swap(state_->queue);
    state_->work.notify_all();
    return state_->ended.wait_until(lock, deadline, [this] { return state_->threads == 0; });
}

} // namespace voxsheet::http
