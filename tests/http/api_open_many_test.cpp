// Several files as one dataset, over the API.
#include "shared_program.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

using namespace voxsheet::http_test;
using nlohmann::json;

namespace {

struct ApiOpenMany : SharedProgram<ApiOpenMany> {
    static constexpr int datasets = 3; // 12 x 10 x 8 each
    static std::vector<std::string> arguments() { return {}; }
    static Answer open(const json& series,
                       const std::vector<std::string>& files = {"a.nrrd", "b.nrrd", "c.nrrd"}) {
        json body{{"files", files}, {"place", false}};
        if (!series.is_null()) body["series"] = series;
        return program_->ask("POST", "/api/v1/datasets", body.dump(), "Content-Type: application/json\r\n");
    }
    static json opened(const json& series) {
        const auto answer = open(series);
        EXPECT_EQ(answer.status, 202) << answer.body;
        EXPECT_TRUE(program_->waitForImports());
        const auto names = answer.json().at("datasets");
        EXPECT_EQ(names.size(), 1U);
        // By the list: a name such as "a.nrrd (2)" does not fit into a URL as it is.
        const auto all = program_->get("/api/v1/datasets").json();
        for (const auto& dataset : all.at("datasets"))
            if (dataset.at("name") == names.at(0)) return dataset;
        return {};
    }
};

TEST_F(ApiOpenMany, AStackIsOneVolume) {
    const auto dataset = opened("stack");
    EXPECT_EQ(dataset.at("state"), "ready");
    EXPECT_EQ(dataset.at("dims"), (json{12, 10, 24}));
    EXPECT_EQ(dataset.at("files").size(), 3U);
}

TEST_F(ApiOpenMany, StepsFollowEachOtherInTime) {
    for (const json& series : {json("steps"), json(true)}) {
        const auto dataset = opened(series);
        EXPECT_EQ(dataset.at("dims"), (json{12, 10, 8}));
        EXPECT_EQ(dataset.at("steps"), 3);
    }
}

TEST_F(ApiOpenMany, WithoutASeriesEachFileIsADataset) {
    EXPECT_EQ(open(false).json().at("datasets").size(), 3U);
    EXPECT_EQ(open(nullptr).json().at("datasets").size(), 3U);
}

TEST_F(ApiOpenMany, AnythingElseIsRefused) {
    for (const json& series : {json("pile"), json(3), json::array()}) {
        const auto answer = open(series);
        EXPECT_EQ(answer.status, 400);
        EXPECT_EQ(answer.json().at("field"), "series");
    }
}

} // namespace
