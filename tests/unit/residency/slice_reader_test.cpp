#include "residency/slice_reader.h"

#include "base/errors.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <mutex>
#include <string>
#include <thread>

namespace voxsheet {
namespace {

/// Gives the number of the first slice as every byte; waits while it is closed; dataset "bad" fails.
class GatedProvider : public VolumeProvider {
public:
    std::shared_ptr<const DatasetMeta> describe(const std::string& dataset) const override {
        if (dataset != "large" && dataset != "next")
            throw NotFound(dataset, "this provider describes nothing else");
        auto meta = std::make_shared<DatasetMeta>();
        meta->key = dataset;
        meta->grid.dims = glm::ivec3(1024, 1024, 3); // a MiB each slice
        meta->fields.emplace_back().storedType = ScalarType::U8;
        return meta;
    }
    void readAhead(const VolumeKey& key, int zBegin, int zCount,
                   std::optional<FloatTexels> forRays) const override {
        const std::lock_guard lock(mutex);
        ahead.push_back(key.dataset + " " + std::to_string(zBegin) + "+" + std::to_string(zCount) +
                        (forRays ? " for rays" : ""));
    }
    [[nodiscard]] std::vector<std::string> waitForAhead(std::size_t count) const {
        for (;;) {
            {
                const std::lock_guard lock(mutex);
                if (ahead.size() >= count) return ahead;
            }
            std::this_thread::sleep_for(std::chrono::milliseconds(1));
        }
    }
    void readSlices(const VolumeKey& key, int zBegin, int, std::span<std::byte> out) const override {
        ++reads;
        while (closed)
            std::this_thread::sleep_for(std::chrono::milliseconds(1));
        if (key.dataset == "bad") throw IoError("bad", "its disk is gone", "try again");
        {
            const std::lock_guard lock(mutex);
            aheadAtLastRead = ahead.size();
        }
        std::fill(out.begin(), out.end(), static_cast<std::byte>(zBegin));
    }
    MinMaxGrid readMinMax(const VolumeKey&) const override {
        MinMaxGrid grid;
        grid.ranges.resize(3);
        return grid;
    }
    std::atomic<bool> closed{false};
    mutable std::atomic<int> reads{0};
    mutable std::mutex mutex;
    mutable std::vector<std::string> ahead; ///< what was read ahead
    mutable std::size_t aheadAtLastRead = 0;
};

SliceRequest request(const std::string& dataset, int zBegin) {
    return {{dataset, 0, 0, 0}, zBegin, 1, false, std::vector<std::byte>(4)};
}

TEST(SliceReader, GivesWhatWasAskedForInItsOrderAndErrorsToWhomTheyBelong) {
    const auto provider = std::make_shared<GatedProvider>();
    SliceReader reader(provider);
    auto first = reader.read(request("a", 7));
    auto bad = reader.read(request("bad", 8));
    auto last = reader.read(request("a", 9));
    EXPECT_EQ(reader.readMinMax({"a", 0, 0, 0}).get().ranges.size(), 3U);
    // Those before it are served by then.
    EXPECT_EQ(last.wait_for(std::chrono::seconds(0)), std::future_status::ready);
    EXPECT_EQ(first.get(), std::vector<std::byte>(4, std::byte{7}));
    EXPECT_EQ(last.get(), std::vector<std::byte>(4, std::byte{9}));
    EXPECT_THROW((void)bad.get(), IoError);
}

TEST(SliceReader, ReadsAheadByPiecesWhileNobodyWaits) {
    const auto provider = std::make_shared<GatedProvider>();
    SliceReader reader(provider);
    reader.readAhead({{{"gone", 0, 0, 0}, {}}, {{"large", 0, 0, 0}, {}}});
    EXPECT_EQ(provider->waitForAhead(3), (std::vector<std::string>{"large 0+1", "large 1+1", "large 2+1"}));
    reader.readAhead({{{"large", 0, 0, 0}, {}}}); // it may have gone meanwhile
    EXPECT_EQ(provider->waitForAhead(6).back(), "large 2+1");
    reader.readAhead({{{"large", 0, 0, 0}, FloatTexels::Full}});
    EXPECT_EQ(provider->waitForAhead(7).back(), "large 0+3 for rays") << "in larger pieces";
}

TEST(SliceReader, RequestsGoBeforeWhatIsReadAhead) {
    const auto provider = std::make_shared<GatedProvider>();
    provider->closed = true;
    SliceReader reader(provider);
    auto first = reader.read(request("a", 1));
    auto second = reader.read(request("a", 2));
    while (provider->reads == 0)
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
    reader.readAhead({{{"large", 0, 0, 0}, {}}});
    provider->closed = false;
    (void)second.get();
    EXPECT_EQ(provider->waitForAhead(3).size(), 3U);
    EXPECT_EQ(provider->aheadAtLastRead, 0U);
}

TEST(SliceReader, WhatIsBroughtInIsReadAheadNoLonger) {
    const auto provider = std::make_shared<GatedProvider>();
    provider->closed = true;
    SliceReader reader(provider);
    auto busy = reader.read(request("a", 1));
    while (provider->reads == 0)
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
    reader.readAhead({{{"large", 0, 0, 0}, {}}, {{"next", 0, 0, 0}, {}}});
    reader.stopAhead({"large", 0, 0, 0});
    reader.stopAhead({"other", 0, 0, 0});
    provider->closed = false;
    EXPECT_EQ(provider->waitForAhead(3)[0], "next 0+1");
}

TEST(SliceReader, NobodyWaitsForASlowDiskUnlessAsked) {
    const auto provider = std::make_shared<GatedProvider>();
    SliceReader reader(provider);
    provider->closed = true;
    auto slow = reader.read(request("a", 1));
    EXPECT_EQ(slow.wait_for(std::chrono::milliseconds(20)), std::future_status::timeout);
    provider->closed = false;
    EXPECT_EQ(slow.get().size(), 4U);
}

TEST(SliceReader, WhatWaitsAtTheEndIsDropped) {
    const auto provider = std::make_shared<GatedProvider>();
    provider->closed = true;
    std::future<std::vector<std::byte>> underWay;
    std::future<std::vector<std::byte>> waiting;
    {
        SliceReader reader(provider);
        underWay = reader.read(request("a", 1));
        waiting = reader.read(request("a", 2));
        while (provider->reads == 0)
            std::this_thread::sleep_for(std::chrono::milliseconds(1));
        std::thread([provider] {
            std::this_thread::sleep_for(std::chrono::milliseconds(20));
            provider->closed = false;
        }).detach();
    }
    EXPECT_EQ(underWay.get().size(), 4U) << "what is under way is waited for";
    EXPECT_EQ(provider->reads, 1);
    EXPECT_THROW((void)waiting.get(), std::future_error);
}

} // namespace
} // namespace voxsheet
