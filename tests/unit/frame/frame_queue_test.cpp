#include "frame/frame_queue.h"

#include "base/errors.h"

#include <gtest/gtest.h>

namespace voxsheet {
namespace {

std::shared_ptr<FrameJob> job(FramePriority priority, std::size_t tiles = 1) {
    auto made = std::make_shared<FrameJob>();
    made->priority = priority;
    made->frame.tiles.resize(tiles);
    made->result.tiles.resize(tiles);
    made->issued.resize(tiles);
    return made;
}

TEST(FrameQueue, HandsOutByPriorityThenSubmission) {
    FrameQueue queue;
    const auto exported = job(FramePriority::Export);
    const auto final1 = job(FramePriority::Final);
    const auto final2 = job(FramePriority::Final);
    const auto interactive = job(FramePriority::Interactive);
    for (const auto& each : {exported, final1, final2, interactive})
        queue.push(each);
    for (const auto& expected : {interactive, final1, final2, exported}) {
        EXPECT_EQ(queue.next(true).job, expected);
        EXPECT_EQ(queue.next(false).job, expected) << "a frame stays until it is removed";
        queue.remove(expected);
    }
    EXPECT_EQ(queue.next(false).job, nullptr);
}

TEST(FrameQueue, HandsOutCommandsOnce) {
    FrameQueue queue;
    int runs = 0;
    queue.pushCommand([&] { ++runs; });
    for (const auto& command : queue.next(true).commands)
        command();
    EXPECT_TRUE(queue.next(false).commands.empty());
    EXPECT_EQ(runs, 1);
}

TEST(FrameQueue, StopsTakingWork) {
    FrameQueue queue;
    const auto waiting = job(FramePriority::Final);
    queue.push(waiting);
    queue.stop();
    const auto work = queue.next(true);
    EXPECT_TRUE(work.stopping);
    EXPECT_EQ(work.job, nullptr);
    ASSERT_EQ(queue.takeRemaining().size(), 1U);

    const auto late = job(FramePriority::Final);
    auto future = late->promise.get_future();
    queue.push(late);
    EXPECT_THROW(future.get(), Cancelled);
}

TEST(FrameJob, SettlesOnce) {
    const auto done = job(FramePriority::Final, 2);
    auto future = done->promise.get_future();
    done->finishedCount = 1;
    done->succeedIfFinished();
    EXPECT_FALSE(done->settled);
    done->finishedCount = 2;
    done->succeedIfFinished();
    done->fail(std::make_exception_ptr(Cancelled("the frame", "too late")));
    EXPECT_EQ(future.get().tiles.size(), 2U);
}

} // namespace
} // namespace voxsheet
