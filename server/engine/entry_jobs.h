// Background work that makes entries of the volume store: imports and formulas.
#pragma once

#include "engine/dataset_state.h"
#include "volume/dataset.h"

#include <atomic>
#include <condition_variable>
#include <cstdint>
#include <deque>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <utility>
#include <vector>

namespace voxsheet::engine {

/// How work reports and learns that nobody wants it any more.
struct JobControl {
    std::function<void(double)> progress; ///< [0, 1]
    std::function<bool()> cancelled;
};

struct JobState {
    DatasetState state = DatasetState::Queued;
    double progress = 0.0;                   ///< [0, 1]
    std::optional<Failure> failure;          ///< when Failed
    std::shared_ptr<const DatasetMeta> meta; ///< when Ready
    std::uint64_t job = 0;                   ///< counts up over the life of the table
};

/// What a job made.
struct JobResult {
    std::shared_ptr<const DatasetMeta> meta;
    /// What is left to do once the job is ready, on the same thread; empty: nothing. If it throws, the job
    /// fails after all.
    std::function<void()> afterwards;

    JobResult(std::shared_ptr<const DatasetMeta> made, std::function<void()> rest = {})
        : meta(std::move(made)), afterwards(std::move(rest)) {}
};

/// Thread-safe. Jobs are known by an id that names their result; a few run at a time, in the order in which
/// they came.
class EntryJobs {
public:
    /// Makes the entry, or throws; Error becomes the failure's sentence, anything else an internal one.
    using Work = std::function<JobResult(const JobControl&)>;
    /// Called on the worker's thread, with no lock held: `settled` when a job became ready or failed, else
    /// when it begins and, ten times a second at most, on progress.
    using Listener = std::function<void(const std::string& id, bool settled)>;

    EntryJobs(int workers, Listener listener);
    ~EntryJobs();
    EntryJobs(const EntryJobs&) = delete;
    EntryJobs& operator=(const EntryJobs&) = delete;

    /// Cancels what is under way and waits for it; nothing runs and no listener is called afterwards.
    void stop();

    /// Queues the work unless the id is known already. Returns its job number.
    std::uint64_t ensure(const std::string& id, Work work);
    /// As ensure, but a job that failed starts again; with `anew` also one that is ready.
    std::uint64_t ensureOrRetry(const std::string& id, Work work, bool anew = false);
    [[nodiscard]] std::optional<JobState> find(const std::string& id) const;
    /// A queued or running job fails as Cancelled; others stay as they are.
    void cancel(const std::string& id);
    /// Forgets a job that waits for a worker, as if nobody had asked for it; others stay as they are. Nobody
    /// is told.
    void dropQueued(const std::string& id);
    [[nodiscard]] bool idle() const;
    /// False when the deadline passed first.
    bool waitIdle(double seconds) const;

private:
    struct Job {
        JobState state;
        Work work;
        std::shared_ptr<std::atomic<bool>> cancelled;
    };
    /// Called with the lock held.
    std::uint64_t queueUnlessKnown(const std::string& id, Work work);
    void run();
    void execute(const std::string& id, const Work& work,
                 const std::shared_ptr<std::atomic<bool>>& cancelled);
    void settle(const std::string& id, const std::shared_ptr<std::atomic<bool>>& cancelled, JobState result);

    Listener listener_;
    mutable std::mutex mutex_;
    mutable std::condition_variable changed_;
    std::map<std::string, Job> jobs_;
    std::deque<std::string> queue_;
    int running_ = 0;
    std::uint64_t lastJob_ = 0;
    bool stopping_ = false;
    std::vector<std::thread> workers_;
};

} // namespace voxsheet::engine
