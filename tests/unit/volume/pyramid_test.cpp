#include "base/errors.h"
#include "volume/dataset.h"
#include "volume/grid.h"
#include "volume/pyramid.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>
#include <random>

namespace voxsheet {
namespace {

template <typename T>
std::span<const std::byte> bytesOf(const std::vector<T>& values) {
    return std::as_bytes(std::span(values));
}

template <typename T>
std::vector<T> valuesOf(const std::vector<std::byte>& bytes) {
    std::vector<T> values(bytes.size() / sizeof(T));
    std::memcpy(values.data(), bytes.data(), bytes.size());
    return values;
}

template <typename T>
std::vector<T> coarser(ScalarType type, glm::ivec3 dims, const std::vector<T>& samples) {
    return valuesOf<T>(coarserLevel({type, dims, bytesOf(samples)}));
}

/// Mean over the texture interval of a coarse sample, by the definition: overlap lengths on each axis.
double referenceMean(const std::vector<float>& finer, glm::ivec3 n, glm::ivec3 c) {
    const glm::ivec3 m = coarserDims(n);
    double sum = 0.0;
    double total = 0.0;
    for (int z = 0; z < n.z; ++z)
        for (int y = 0; y < n.y; ++y)
            for (int x = 0; x < n.x; ++x) {
                const glm::ivec3 p(x, y, z);
                double weight = 1.0;
                for (int a = 0; a < 3; ++a) {
                    const double low = double(c[a]) * n[a] / m[a];
                    const double high = double(c[a] + 1) * n[a] / m[a];
                    weight *= std::max(0.0, std::min(high, p[a] + 1.0) - std::max(low, double(p[a])));
                }
                const float v = finer[static_cast<std::size_t>((z * n.y + y) * n.x + x)];
                if (weight < 1e-12 || !std::isfinite(v)) continue;
                sum += weight * v;
                total += weight;
            }
    return total > 0.0 ? sum / total : std::numeric_limits<double>::quiet_NaN();
}

TEST(Pyramid, EvenSizesAreMeansOfEightChildren) {
    const std::vector<float> samples{1, 2, 3, 4, 5, 6, 7, 8};
    EXPECT_EQ(coarser(ScalarType::F32, {2, 2, 2}, samples), std::vector<float>{4.5F});
}

TEST(Pyramid, OddAxesAreWeightedByOverlap) {
    // 3 samples become 2, each covering 1.5 finer samples.
    const std::vector<float> samples{0, 3, 9};
    const auto result = coarser(ScalarType::F32, {3, 1, 1}, samples);
    ASSERT_EQ(result.size(), 2U);
    EXPECT_FLOAT_EQ(result[0], (0.0F + 0.5F * 3.0F) / 1.5F);
    EXPECT_FLOAT_EQ(result[1], (0.5F * 3.0F + 9.0F) / 1.5F);
}

TEST(Pyramid, AgreesWithItsDefinitionForAllParitiesAndAbsentSamples) {
    std::mt19937 random(7);
    std::uniform_real_distribution<float> value(-10.0F, 10.0F);
    for (const glm::ivec3 n :
         {glm::ivec3(4, 6, 8), glm::ivec3(5, 7, 3), glm::ivec3(1, 9, 2), glm::ivec3(11, 4, 5)}) {
        std::vector<float> samples(static_cast<std::size_t>(sampleCount(n)));
        for (auto& s : samples)
            s = random() % 5 == 0 ? std::nanf("") : value(random);
        samples[3] = std::numeric_limits<float>::infinity();
        const auto result = coarser(ScalarType::F32, n, samples);
        const auto m = coarserDims(n);
        ASSERT_EQ(result.size(), static_cast<std::size_t>(sampleCount(m)));
        for (int z = 0; z < m.z; ++z)
            for (int y = 0; y < m.y; ++y)
                for (int x = 0; x < m.x; ++x) {
                    const double expected = referenceMean(samples, n, {x, y, z});
                    const float got = result[static_cast<std::size_t>((z * m.y + y) * m.x + x)];
                    if (std::isnan(expected))
                        EXPECT_TRUE(std::isnan(got));
                    else
                        EXPECT_NEAR(got, expected, 1e-5);
                }
    }
}

TEST(Pyramid, KeepsTheMeanOfTheLevel) {
    const glm::ivec3 n(7, 10, 5);
    std::vector<double> samples(static_cast<std::size_t>(sampleCount(n)));
    std::mt19937 random(3);
    double mean = 0.0;
    for (auto& s : samples)
        mean += s = double(random() % 1000);
    mean /= double(samples.size());
    const auto level = valuesOf<float>(coarserLevel({ScalarType::F64, n, bytesOf(samples)}));
    double coarseMean = 0.0;
    for (const float v : level)
        coarseMean += v;
    // Coarse samples all cover the same volume, so the plain mean of them is the mean of the level.
    EXPECT_NEAR(coarseMean / double(level.size()), mean, 1e-4);
}

TEST(Pyramid, SmallIntegersKeepTheirTypeAndRound) {
    EXPECT_EQ(coarser<unsigned char>(ScalarType::U8, {2, 2, 2}, {255, 255, 255, 255, 255, 255, 255, 255})[0],
              255);
    EXPECT_EQ(coarser<unsigned char>(ScalarType::U8, {2, 1, 1}, {1, 2})[0], 2);
    EXPECT_EQ(coarser<signed char>(ScalarType::I8, {2, 1, 1}, {-128, -128})[0], -128);
    EXPECT_EQ(coarser<signed char>(ScalarType::I8, {2, 1, 1}, {-1, -2})[0], -2);
    EXPECT_EQ(coarser<short>(ScalarType::I16, {3, 1, 1}, {-30000, -30000, -30000})[1], -30000);
    EXPECT_EQ(coarser<unsigned short>(ScalarType::U16, {5, 1, 1}, {65535, 65535, 65535, 65535, 65535})[2],
              65535);
}

TEST(Pyramid, WideTypesBecomeFloat) {
    const std::vector<long> samples{4000000000L, 4000000002L};
    const auto level = valuesOf<float>(coarserLevel({ScalarType::I64, {2, 1, 1}, bytesOf(samples)}));
    ASSERT_EQ(level.size(), 1U);
    EXPECT_FLOAT_EQ(level[0], 4000000001.0F);
    EXPECT_EQ(pyramidType(ScalarType::I64), ScalarType::F32);
}

TEST(Pyramid, RefusesArraysOfTheWrongSize) {
    const std::vector<float> samples(7);
    EXPECT_THROW((void)coarserLevel({ScalarType::F32, {2, 2, 2}, bytesOf(samples)}), InvalidInput);
    EXPECT_THROW((void)coarserLevel({ScalarType::F32, {0, 2, 2}, {}}), InvalidInput);
}

} // namespace
} // namespace voxsheet
