// A suite of tests that share one run of the real program.
#pragma once

#include "served_program.h"

#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <vector>

namespace voxsheet::http_test {

/// Derive as `class Suite : public SharedProgram<Suite>`, with static `datasets` and `arguments()` as
/// ServedProgram takes them.
template <typename Suite>
class SharedProgram : public testing::Test {
protected:
    static void SetUpTestSuite() {
        program_ = std::make_unique<ServedProgram>(Suite::datasets, Suite::arguments());
        ASSERT_TRUE(program_->waitForImports());
    }
    static void TearDownTestSuite() { program_.reset(); }
    static nlohmann::json getJson(const std::string& target) {
        const auto answer = program_->get(target);
        EXPECT_EQ(answer.status, 200) << target << answer.body;
        return answer.json();
    }

    static inline std::unique_ptr<ServedProgram> program_;
};

} // namespace voxsheet::http_test
