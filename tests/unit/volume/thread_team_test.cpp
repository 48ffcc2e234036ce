#include "volume/thread_team.h"

#include <gtest/gtest.h>

#include <atomic>
#include <condition_variable>
#include <mutex>
#include <set>
#include <stdexcept>
#include <thread>
#include <vector>

namespace voxsheet {
namespace {

TEST(ThreadTeam, CoversEveryIndexOnceInPiecesOfTheGrain) {
    for (const long helpers : {0L, 1L, 3L}) {
        ThreadTeam team(helpers);
        for (const long count : {0L, 1L, 2L, 7L, 100L}) {
            for (const long grain : {0L, 1L, 3L, 1000L}) {
                std::vector<std::atomic<int>> taken(static_cast<std::size_t>(count));
                team.run(count, grain, [&](long begin, long end) {
                    EXPECT_LT(begin, end);
                    EXPECT_LE(end - begin, std::max(grain, 1L));
                    for (long i = begin; i < end; ++i)
                        ++taken[static_cast<std::size_t>(i)];
                });
                for (const auto& times : taken)
                    EXPECT_EQ(times, 1) << helpers << " helpers, " << count << " by " << grain;
            }
        }
    }
}

TEST(ThreadTeam, NothingOfALoopGoesOnAfterItOrIsLost) {
    ThreadTeam team(3);
    long sum = 0;
    for (int loop = 0; loop < 20000; ++loop) {
        std::atomic<long> of{0};
        team.run(8, 1, [&](long begin, long /*end*/) { of += begin; });
        sum += of;
    }
    EXPECT_EQ(sum, 20000L * 28L);
}

TEST(ThreadTeam, HelpersWorkBesideTheCaller) {
    ThreadTeam team(2);
    std::mutex mutex;
    std::condition_variable met;
    std::set<std::thread::id> threads;
    // Each piece waits until all three threads have one: a team that leaves a helper out never ends.
    team.run(3, 1, [&](long, long) {
        std::unique_lock lock(mutex);
        threads.insert(std::this_thread::get_id());
        met.notify_all();
        met.wait(lock, [&] { return threads.size() == 3; });
    });
    EXPECT_TRUE(threads.contains(std::this_thread::get_id()));
}

TEST(ThreadTeam, ThrowsWhatABodyThrewAndGoesOn) {
    for (const long helpers : {0L, 2L}) {
        ThreadTeam team(helpers);
        const auto failing = [](long begin, long /*end*/) {
            if (begin == 5) throw std::runtime_error("the fifth");
        };
        EXPECT_THROW(team.run(10, 1, failing), std::runtime_error);
        std::atomic<long> done{0};
        team.run(10, 1, [&](long begin, long end) { done += end - begin; });
        EXPECT_EQ(done, 10);
    }
}

} // namespace
} // namespace voxsheet
