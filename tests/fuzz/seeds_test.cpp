// Every target over its seeds and over simple mutations of them, in builds without libFuzzer too.
#include "fuzz_target.h"

#include "base/errors.h"

#include <gtest/gtest.h>

#include <random>

namespace voxsheet::fuzz {
namespace {

const std::vector<FuzzTarget>& targets() {
    static const auto all = allTargets();
    return all;
}

class FuzzSeeds : public ::testing::TestWithParam<std::size_t> {
protected:
    [[nodiscard]] const FuzzTarget& target() const { return targets()[GetParam()]; }

    void run(const std::string& input) const {
        try {
            target().run(input);
        } catch (const Error& error) {
            EXPECT_FALSE(error.why().empty());
        } catch (const std::exception& error) {
            ADD_FAILURE() << target().name << ": " << error.what() << " for '" << input << "'";
        }
    }
};

TEST_P(FuzzSeeds, AreAnswered) {
    ASSERT_FALSE(target().seeds.empty());
    EXPECT_NO_THROW(target().run(target().seeds.front())) << "the first seed is a valid input";
    for (const auto& seed : target().seeds)
        run(seed);
}

TEST_P(FuzzSeeds, AreAnsweredWhenMutated) {
    constexpr int rounds = 100;
    std::mt19937 random(20261126);
    for (const auto& seed : target().seeds)
        for (int round = 0; round < rounds; ++round) {
            auto input = seed;
            for (auto changes = 1 + random() % 4; changes > 0 && !input.empty(); --changes) {
                const auto at = random() % input.size();
                const auto other = random() % input.size();
                if (random() % 3 == 0)
                    input.erase(at, 1 + random() % 9);
                else if (random() % 2 == 0)
                    input.insert(at, input.substr(other, random() % 30));
                else
                    input[at] = static_cast<char>(random());
            }
            run(input);
        }
}

INSTANTIATE_TEST_SUITE_P(Of, FuzzSeeds, ::testing::Range<std::size_t>(0, targets().size()),
                         [](const auto& seed) { return targets()[seed.param].name; });

} // namespace
} // namespace voxsheet::fuzz
