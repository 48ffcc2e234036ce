#include "base/errors.h"
#include "engine/entry_jobs.h"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <future>
#include <stdexcept>
#include <thread>

namespace voxsheet::engine {
namespace {

using namespace std::chrono_literals;

std::shared_ptr<const DatasetMeta> metaNamed(const std::string& key) {
    auto meta = std::make_shared<DatasetMeta>();
    meta->key = key;
    return meta;
}

EntryJobs::Work quick(const std::string& key) {
    return [key](const JobControl&) { return metaNamed(key); };
}

/// Runs until cancelled.
std::shared_ptr<const DatasetMeta> endless(const JobControl& control) {
    while (!control.cancelled())
        std::this_thread::sleep_for(1ms);
    throw Cancelled("work", "stopped");
}

TEST(EntryJobs, WorkBecomesReadyAndIsDoneOnce) {
    std::atomic<int> runs{0};
    EntryJobs jobs(2, {});
    const auto work = [&](const JobControl& control) {
        ++runs;
        control.progress(0.5);
        return metaNamed("k");
    };
    const auto first = jobs.ensure("a", work);
    EXPECT_EQ(jobs.ensure("a", work), first);
    ASSERT_TRUE(jobs.waitIdle(10));
    EXPECT_EQ(jobs.ensure("a", work), first);
    ASSERT_TRUE(jobs.waitIdle(10));
    EXPECT_EQ(runs, 1);
    EXPECT_EQ(jobs.find("a")->state, DatasetState::Ready);
    EXPECT_EQ(jobs.find("a")->meta->key, "k");
    EXPECT_FALSE(jobs.find("b"));
}

TEST(EntryJobs, IsReadyBeforeWhatIsLeftToDoAndFailsWithIt) {
    std::promise<void> goOn;
    auto gate = goOn.get_future().share();
    EntryJobs jobs(2, {});
    const auto withRest = [&](bool fails) {
        return [&, fails](const JobControl&) -> JobResult {
            return {metaNamed("k"), [gate, fails] {
                        gate.wait();
                        if (fails) throw IoError("the store", "the disk is full");
                    }};
        };
    };
    jobs.ensure("good", withRest(false));
    jobs.ensure("bad", withRest(true));
    for (const char* id : {"good", "bad"})
        while (jobs.find(id)->state != DatasetState::Ready)
            std::this_thread::sleep_for(1ms);
    EXPECT_FALSE(jobs.waitIdle(0.01)) << "the rest is still to be done";
    goOn.set_value();
    ASSERT_TRUE(jobs.waitIdle(10));
    EXPECT_EQ(jobs.find("good")->state, DatasetState::Ready);
    ASSERT_EQ(jobs.find("bad")->state, DatasetState::Failed);
    EXPECT_NE(jobs.find("bad")->failure->message.find("disk is full"), std::string::npos);
}

TEST(EntryJobs, AFailureStaysWithItsJob) {
    EntryJobs jobs(1, {});
    jobs.ensure("bad", [](const JobControl&) -> std::shared_ptr<const DatasetMeta> {
        throw InvalidInput("file 'x'", "it is cut short", "copy it again");
    });
    jobs.ensure("odd", [](const JobControl&) -> std::shared_ptr<const DatasetMeta> {
        throw std::runtime_error("oops");
    });
    jobs.ensure("good", quick("g"));
    ASSERT_TRUE(jobs.waitIdle(10));
    EXPECT_EQ(jobs.find("bad")->failure->kind, ErrorKind::InvalidInput);
    EXPECT_NE(jobs.find("bad")->failure->message.find("cut short"), std::string::npos);
    EXPECT_EQ(jobs.find("odd")->failure->kind, ErrorKind::Internal);
    EXPECT_EQ(jobs.find("good")->state, DatasetState::Ready);
}

TEST(EntryJobs, NeverMoreAtATimeThanWorkers) {
    std::atomic<int> now{0};
    std::atomic<int> most{0};
    EntryJobs jobs(2, {});
    for (int i = 0; i < 12; ++i) {
        jobs.ensure(std::to_string(i), [&](const JobControl&) {
            const int running = ++now;
            int seen = most;
            while (running > seen && !most.compare_exchange_weak(seen, running)) {
            }
            std::this_thread::sleep_for(5ms);
            --now;
            return metaNamed("k");
        });
    }
    ASSERT_TRUE(jobs.waitIdle(20));
    EXPECT_LE(most, 2);
}

TEST(EntryJobs, CancelStopsRunningAndQueuedWorkAtOnce) {
    EntryJobs jobs(1, {});
    jobs.ensure("running", endless);
    jobs.ensure("queued", quick("q"));
    while (jobs.find("running")->state == DatasetState::Queued)
        std::this_thread::sleep_for(1ms);
    jobs.cancel("queued");
    EXPECT_EQ(jobs.find("queued")->failure->kind, ErrorKind::Cancelled);
    jobs.cancel("running");
    EXPECT_EQ(jobs.find("running")->state, DatasetState::Failed);
    ASSERT_TRUE(jobs.waitIdle(10));
    EXPECT_EQ(jobs.find("running")->failure->kind, ErrorKind::Cancelled);
    jobs.cancel("no such job");
}

TEST(EntryJobs, AFailedJobStartsAgainWhenAsked) {
    EntryJobs jobs(1, {});
    jobs.ensure("a",
                [](const JobControl&) -> std::shared_ptr<const DatasetMeta> { throw NotFound("f", "gone"); });
    ASSERT_TRUE(jobs.waitIdle(10));
    const auto failed = jobs.find("a")->job;
    jobs.ensure("a", quick("k"));
    ASSERT_TRUE(jobs.waitIdle(10));
    EXPECT_EQ(jobs.find("a")->state, DatasetState::Failed) << "only when asked";
    EXPECT_GT(jobs.ensureOrRetry("a", quick("k")), failed);
    ASSERT_TRUE(jobs.waitIdle(10));
    EXPECT_EQ(jobs.find("a")->state, DatasetState::Ready);
}

TEST(EntryJobs, ProgressIsToldNowAndThenAndKnownAlways) {
    std::atomic<int> told{0};
    EntryJobs jobs(1, [&](const std::string& id, bool settled) {
        if (id == "busy" && !settled) ++told;
    });
    std::atomic<int> toldTooOften{0};
    std::atomic<double> known{0.0};
    jobs.ensure("busy", [&](const JobControl& control) {
        const auto begun = std::chrono::steady_clock::now();
        for (int i = 1; i <= 300; ++i) {
            control.progress(i / 300.0);
            std::this_thread::sleep_for(1ms);
        }
        known = jobs.find("busy")->progress;
        const auto tenths = (std::chrono::steady_clock::now() - begun) / 100ms;
        toldTooOften = told > 1 + tenths ? 1 : 0; // 1: that it begins
        return metaNamed("k");
    });
    ASSERT_TRUE(jobs.waitIdle(10));
    EXPECT_EQ(toldTooOften, 0) << told;
    EXPECT_GE(told, 2) << "300 ms have passed";
    EXPECT_DOUBLE_EQ(known, 1.0);
}

TEST(EntryJobs, AResultOfACancelledRunIsNotTakenForTheNewOne) {
    EntryJobs jobs(2, {});
    std::promise<void> release;
    auto gate = release.get_future().share();
    jobs.ensure("a", [gate](const JobControl&) {
        gate.wait();
        return metaNamed("old");
    });
    while (jobs.find("a")->state == DatasetState::Queued)
        std::this_thread::sleep_for(1ms);
    jobs.cancel("a");
    jobs.ensureOrRetry("a", quick("new"));
    while (jobs.find("a")->state != DatasetState::Ready)
        std::this_thread::sleep_for(1ms);
    release.set_value();
    ASSERT_TRUE(jobs.waitIdle(10));
    EXPECT_EQ(jobs.find("a")->meta->key, "new");
}

TEST(EntryJobs, TheListenerHearsOfTheEndAndMayAskBack) {
    std::atomic<int> settled{0};
    std::atomic<bool> consistent{true};
    EntryJobs* asked = nullptr;
    EntryJobs jobs(1, [&](const std::string& id, bool isSettled) {
        if (!isSettled) return;
        ++settled;
        if (asked->find(id)->state == DatasetState::Importing) consistent = false;
    });
    asked = &jobs;
    jobs.ensure("a", quick("k"));
    ASSERT_TRUE(jobs.waitIdle(10));
    EXPECT_EQ(settled, 1);
    EXPECT_TRUE(consistent);
}

TEST(EntryJobs, StoppingDoesNotWaitForEndlessWork) {
    const auto start = std::chrono::steady_clock::now();
    {
        EntryJobs jobs(2, {});
        jobs.ensure("a", endless);
        jobs.ensure("b", endless);
        jobs.ensure("c", quick("never"));
    }
    EXPECT_LT(std::chrono::steady_clock::now() - start, 5s);
}

TEST(EntryJobs, OnlyWhatHasNotBegunIsDroppedAndCanBeAskedForAgain) {
    std::promise<void> go;
    const std::shared_future<void> released(go.get_future());
    std::atomic<bool> begun{false};
    std::atomic<int> told{0};
    EntryJobs jobs(1, [&](const std::string&, bool settled) { told += settled ? 1 : 0; });
    jobs.ensure("first", [&](const JobControl&) {
        begun = true;
        released.wait();
        return metaNamed("first");
    });
    while (!begun)
        std::this_thread::sleep_for(1ms);
    jobs.ensure("second", quick("second"));
    jobs.dropQueued("first");
    jobs.dropQueued("second");
    jobs.dropQueued("unknown");
    EXPECT_TRUE(jobs.find("first"));
    EXPECT_FALSE(jobs.find("second"));
    go.set_value();
    ASSERT_TRUE(jobs.waitIdle(10));
    EXPECT_EQ(jobs.find("first")->state, DatasetState::Ready);
    EXPECT_EQ(told, 1);
    jobs.ensure("second", quick("second"));
    ASSERT_TRUE(jobs.waitIdle(10));
    EXPECT_EQ(jobs.find("second")->state, DatasetState::Ready);
}

} // namespace
} // namespace voxsheet::engine
