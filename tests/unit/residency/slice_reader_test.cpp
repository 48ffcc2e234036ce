#include "residency/slice_reader.h"

#include "base/errors.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <string>
#include <thread>

namespace voxsheet {
namespace {

/// Gives the number of the first slice as every byte; waits while it is closed; dataset "bad" fails.
class GatedProvider : public VolumeProvider {
public:
    std::shared_ptr<const DatasetMeta> describe(const std::string& dataset) const override {
        throw NotFound(dataset, "this provider describes nothing");
    }
    void readSlices(const VolumeKey& key, int zBegin, int, std::span<std::byte> out) const override {
        ++reads;
        while (closed)
            std::this_thread::sleep_for(std::chrono::milliseconds(1));
        if (key.dataset == "bad") throw IoError("bad", "its disk is gone", "try again");
        std::fill(out.begin(), out.end(), static_cast<std::byte>(zBegin));
    }
    MinMaxGrid readMinMax(const VolumeKey&) const override {
        MinMaxGrid grid;
        grid.ranges.resize(3);
        return grid;
    }
    std::atomic<bool> closed{false};
    mutable std::atomic<int> reads{0};
};

SliceRequest request(const std::string& dataset, int zBegin) {
    return {{dataset, 0, 0, 0}, zBegin, 1, std::vector<std::byte>(4)};
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
