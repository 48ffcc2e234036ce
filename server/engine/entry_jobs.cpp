#include "engine/entry_jobs.h"

#include "base/heap.h"

#include <algorithm>
#include <chrono>
#include <exception>

namespace voxsheet::engine {

namespace {

using Clock = std::chrono::steady_clock;

/// Whoever is told looks at the whole sheet anew.
constexpr std::chrono::milliseconds kProgressEvery{100};

Failure failureOf(const std::exception& error) {
    if (const auto* known = dynamic_cast<const Error*>(&error)) return {known->kind(), known->what()};
    return {ErrorKind::Internal, std::string("an internal fault: ") + error.what()};
}

Failure cancelledFailure() {
    return {ErrorKind::Cancelled, "it was cancelled; open the file again to start over"};
}

} // namespace

EntryJobs::EntryJobs(int workers, Listener listener) : listener_(std::move(listener)) {
    for (int i = 0; i < std::max(1, workers); ++i)
        workers_.emplace_back([this] { run(); });
}

EntryJobs::~EntryJobs() { stop(); }

void EntryJobs::stop() {
    {
        const std::lock_guard lock(mutex_);
        stopping_ = true;
        for (auto& [id, job] : jobs_) {
            if (job.cancelled) job.cancelled->store(true);
        }
    }
    changed_.notify_all();
    for (std::thread& worker : workers_)
        worker.join();
    workers_.clear();
}

std::uint64_t EntryJobs::ensure(const std::string& id, Work work) {
    const std::lock_guard lock(mutex_);
    return queueUnlessKnown(id, std::move(work));
}

std::uint64_t EntryJobs::ensureOrRetry(const std::string& id, Work work, bool anew) {
    const std::lock_guard lock(mutex_);
    const auto known = jobs_.find(id);
    if (known != jobs_.end()) {
        const DatasetState state = known->second.state.state;
        if (state == DatasetState::Failed || (anew && state == DatasetState::Ready)) jobs_.erase(known);
    }
    return queueUnlessKnown(id, std::move(work));
}

std::uint64_t EntryJobs::queueUnlessKnown(const std::string& id, Work work) {
    const auto [known, isNew] = jobs_.try_emplace(id);
    Job& job = known->second;
    if (!isNew) return job.state.job;
    job.state.job = ++lastJob_;
    job.work = std::move(work);
    job.cancelled = std::make_shared<std::atomic<bool>>(false);
    queue_.push_back(id);
    changed_.notify_all();
    return job.state.job;
}

std::optional<JobState> EntryJobs::find(const std::string& id) const {
    const std::lock_guard lock(mutex_);
    const auto known = jobs_.find(id);
    return known == jobs_.end() ? std::nullopt : std::optional<JobState>(known->second.state);
}

void EntryJobs::cancel(const std::string& id) {
    {
        const std::lock_guard lock(mutex_);
        const auto known = jobs_.find(id);
        if (known == jobs_.end()) return;
        JobState& state = known->second.state;
        if (state.state != DatasetState::Queued && state.state != DatasetState::Importing) return;
        known->second.cancelled->store(true);
        std::erase(queue_, id);
        // The state changes at once; a worker that is still busy with it finds its result unwanted.
        state.state = DatasetState::Failed;
        state.failure = cancelledFailure();
        changed_.notify_all();
    }
    if (listener_) listener_(id, true);
}

void EntryJobs::dropQueued(const std::string& id) {
    const std::lock_guard lock(mutex_);
    if (std::erase(queue_, id) == 0) return;
    jobs_.erase(id);
    changed_.notify_all();
}

bool EntryJobs::idle() const {
    const std::lock_guard lock(mutex_);
    return queue_.empty() && running_ == 0;
}

bool EntryJobs::waitIdle(double seconds) const {
    std::unique_lock lock(mutex_);
    return changed_.wait_for(lock, std::chrono::duration<double>(seconds),
                             [this] { return queue_.empty() && running_ == 0; });
}

void EntryJobs::run() {
    std::unique_lock lock(mutex_);
    while (true) {
        changed_.wait(lock, [this] { return stopping_ || !queue_.empty(); });
        if (stopping_) return;
        const std::string id = queue_.front();
        queue_.pop_front();
        Job& job = jobs_.at(id);
        job.state.state = DatasetState::Importing;
        const Work work = job.work;
        const auto cancelled = job.cancelled;
        ++running_;
        lock.unlock();
        execute(id, work, cancelled);
        lock.lock();
        --running_;
        const bool allDone = queue_.empty() && running_ == 0;
        changed_.notify_all();
        if (!allDone) continue;
        lock.unlock();
        giveFreePagesBack();
        lock.lock();
    }
}

void EntryJobs::execute(const std::string& id, const Work& work,
                        const std::shared_ptr<std::atomic<bool>>& cancelled) {
    if (listener_) listener_(id, false);
    JobControl control;
    control.cancelled = [cancelled] { return cancelled->load(); };
    control.progress = [this, id, cancelled, told = Clock::now()](double progress) mutable {
        {
            const std::lock_guard lock(mutex_);
            const auto known = jobs_.find(id);
            if (known == jobs_.end() || known->second.cancelled != cancelled) return;
            known->second.state.progress = std::clamp(progress, 0.0, 1.0);
            if (Clock::now() - told < kProgressEvery) return;
            told = Clock::now();
        }
        if (listener_) listener_(id, false);
    };
    try {
        JobResult result = work(control);
        JobState ready;
        ready.meta = std::move(result.meta);
        ready.state = DatasetState::Ready;
        ready.progress = 1.0;
        settle(id, cancelled, std::move(ready));
        if (result.afterwards) result.afterwards();
    } catch (const std::exception& error) {
        JobState failed;
        failed.state = DatasetState::Failed;
        failed.failure = cancelled->load() ? cancelledFailure() : failureOf(error);
        settle(id, cancelled, std::move(failed));
    }
}

void EntryJobs::settle(const std::string& id, const std::shared_ptr<std::atomic<bool>>& cancelled,
                       JobState result) {
    {
        const std::lock_guard lock(mutex_);
        const auto known = jobs_.find(id);
        // Cancelled and perhaps started again meanwhile: that job's state stands.
        if (known == jobs_.end() || known->second.cancelled != cancelled) return;
        if (known->second.state.state == DatasetState::Failed) return;
        result.job = known->second.state.job;
        known->second.state = std::move(result);
        known->second.work = nullptr;
    }
    if (listener_) listener_(id, true);
}

} // namespace voxsheet::engine
