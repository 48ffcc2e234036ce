#include "base/errors.h"
#include "engine/formula_job.h"
#include "engine/sample_reader.h"
#include "memory_dataset.h"
#include "store/store_volume_provider.h"
#include "temporary_folder.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace voxsheet::engine {
namespace {

using sheet::FormulaOp;

/// B - A
sheet::FormulaPlan difference() {
    sheet::FormulaPlan plan;
    plan.inputs = {{"b", std::int64_t{0}, 0}, {"a", std::int64_t{0}, 0}};
    plan.steps = {{FormulaOp::Input, 0}, {FormulaOp::Input, 1}, {FormulaOp::Subtract, 0, 1}};
    return plan;
}

class FormulaJob : public testing::Test {
protected:
    FormulaJob()
        : store(std::make_shared<const store::VolumeStore>(folder.path() / "store")), results(store) {
        test::addDataset(inputs, test::metaOf("a", {17, 9, 13}),
                         [](int i, int j, int k) { return static_cast<float>(i + j + k); });
        test::addDataset(inputs, test::metaOf("b", {17, 9, 13}), [](int i, int j, int k) {
            return i == 0 && j == 0 && k == 0 ? std::nanf("") : static_cast<float>(3 * i + j + k);
        });
    }
    FormulaTask task() {
        return {difference(), {{inputs.describe("b"), 0, 0}, {inputs.describe("a"), 0, 0}}, "=B1-A1"};
    }

    test::TemporaryFolder folder;
    MemoryVolumeProvider inputs;
    std::shared_ptr<const store::VolumeStore> store;
    store::StoreVolumeProvider results;
};

TEST_F(FormulaJob, TheResultIsAVolumeLikeAnyOther) {
    auto made = computeFormula(task(), *store, inputs, 0, {});
    const auto meta = made.meta();
    EXPECT_TRUE(made.commit());
    EXPECT_EQ(meta->format, "formula");
    EXPECT_EQ(meta->grid.dims, glm::ivec3(17, 9, 13));
    EXPECT_EQ(meta->fields[0].unit, "e/Å^3");
    EXPECT_EQ(meta->fields[0].steps[0].statistics.max, 32.0);
    EXPECT_EQ(meta->fields[0].steps[0].statistics.nanCount, 1U);
    const auto values = readValues(results, *meta, {meta->key, 0, 0, 0}, 0, 13);
    EXPECT_TRUE(std::isnan(values[0]));
    for (int k = 0; k < 13; ++k) {
        for (int j = 0; j < 9; ++j) {
            for (int i = k + j == 0 ? 1 : 0; i < 17; ++i) {
                ASSERT_EQ(values[static_cast<std::size_t>((k * 9 + j) * 17 + i)], 2.0 * i);
            }
        }
    }
    EXPECT_NO_THROW(static_cast<void>(results.readMinMax({meta->key, 0, 0, 0})));
}

TEST_F(FormulaJob, SlabsOnAllThreadsMakeOneVolume) {
    const glm::ivec3 dims{64, 65, 50}; // slabs of 15 slices, the last one of 5
    test::addDataset(inputs, test::metaOf("x", dims), [](int i, int, int) { return static_cast<float>(i); });
    test::addDataset(inputs, test::metaOf("y", dims),
                     [](int, int j, int k) { return static_cast<float>(100 * j + 7000 * k); });
    std::vector<double> told;
    JobControl control;
    control.progress = [&](double progress) { told.push_back(progress); };
    auto made =
        computeFormula({difference(), {{inputs.describe("y"), 0, 0}, {inputs.describe("x"), 0, 0}}, "=Y1-X1"},
                       *store, inputs, 0, control);
    const auto meta = made.meta();
    EXPECT_TRUE(made.commit());
    EXPECT_EQ(told.size(), 4U);
    EXPECT_TRUE(std::is_sorted(told.begin(), told.end()));
    const auto values = readValues(results, *meta, {meta->key, 0, 0, 0}, 0, dims.z);
    std::size_t next = 0;
    for (int k = 0; k < dims.z; ++k)
        for (int j = 0; j < dims.y; ++j)
            for (int i = 0; i < dims.x; ++i)
                ASSERT_EQ(values[next++], 100.0 * j + 7000.0 * k - i) << i << " " << j << " " << k;
}

TEST_F(FormulaJob, TheSameFormulaIsComputedOnce) {
    const FormulaTask formula = task();
    auto first = computeFormula(formula, *store, inputs, 0, {});
    EXPECT_TRUE(first.commit());
    // With its inputs gone, only the store can answer.
    inputs.remove("a");
    inputs.remove("b");
    EXPECT_EQ(computeFormula(formula, *store, inputs, 0, {}).meta()->key, first.meta()->key);
}

TEST_F(FormulaJob, TheResultIsReadableBeforeItIsInTheStoreAndThenStays) {
    std::shared_ptr<const store::StoreEntry> dropped;
    {
        auto made = computeFormula(task(), *store, inputs, 0, {});
        results.adopt(made.entry());
        EXPECT_EQ(readValues(results, *made.meta(), {made.meta()->key, 0, 0, 0}, 0, 1)[3], 6.0);
        EXPECT_EQ(store->open(made.meta()->key), nullptr) << "nobody else finds what is not durable yet";
        EXPECT_TRUE(made.commit());
        EXPECT_EQ(readValues(results, *made.meta(), {made.meta()->key, 0, 0, 0}, 0, 1)[3], 6.0);
        EXPECT_NE(store->open(made.meta()->key), nullptr);
        results.forget(made.meta()->key);
    }
    store->remove(formulaEntryKey(task()));
    dropped = computeFormula(task(), *store, inputs, 0, {}).entry();
    EXPECT_EQ(store->open(formulaEntryKey(task())), nullptr) << "it was never committed";
    std::vector<double> value(1);
    EXPECT_NO_THROW(dropped->readBox({dropped->meta()->key, 0, 0, 0}, {3, 0, 0}, glm::ivec3(1), value));
    EXPECT_EQ(value[0], 6.0) << "a reader keeps what it holds";
}

TEST_F(FormulaJob, TheKeyTellsArraysAndPlansApart) {
    FormulaTask swapped = task();
    std::swap(swapped.inputs[0], swapped.inputs[1]);
    EXPECT_NE(formulaEntryKey(task()), formulaEntryKey(swapped));
    FormulaTask sum = task();
    sum.plan.steps[2].op = FormulaOp::Add;
    EXPECT_NE(formulaEntryKey(task()), formulaEntryKey(sum));
    FormulaTask renamed = task();
    renamed.formula = "= B1 - A1";
    EXPECT_EQ(formulaEntryKey(task()), formulaEntryKey(renamed)) << "spelling does not matter";
}

TEST_F(FormulaJob, ABudgetTooSmallIsSaidBeforeAnythingIsRead) {
    EXPECT_THROW(static_cast<void>(computeFormula(task(), *store, inputs, 1000, {})), LimitExceeded);
    EXPECT_EQ(store->open(formulaEntryKey(task())), nullptr);
}

TEST_F(FormulaJob, CancellingLeavesNothingInTheStore) {
    JobControl control;
    control.cancelled = [] { return true; };
    EXPECT_THROW(static_cast<void>(computeFormula(task(), *store, inputs, 0, control)), Cancelled);
    EXPECT_EQ(store->open(formulaEntryKey(task())), nullptr);
}

TEST(FormulaMeaning, SumsKeepQuantityAndUnitAndProductsLoseThem) {
    const ValueMeaning potential{"local potential", "eV"};
    const ValueMeaning energy{"energy", "eV"};
    const ValueMeaning temperature{"temperature", "K"};
    const ValueMeaning unknown{};
    sheet::FormulaPlan plan = difference();
    EXPECT_EQ(formulaMeaning(plan, {potential, potential}), potential);
    EXPECT_EQ(formulaMeaning(plan, {potential, energy}), (ValueMeaning{"", "eV"}));
    EXPECT_EQ(formulaMeaning(plan, {potential, temperature}), unknown);
    EXPECT_EQ(formulaMeaning(plan, {potential, unknown}), unknown);
    plan.steps[2].op = FormulaOp::Multiply;
    EXPECT_EQ(formulaMeaning(plan, {potential, potential}), unknown);
    plan.steps[2].op = FormulaOp::Divide;
    EXPECT_EQ(formulaMeaning(plan, {potential, potential}), unknown);
    // abs(2 * B)
    plan.steps = {{FormulaOp::Constant, -1, -1, 2.0},
                  {FormulaOp::Input, 0},
                  {FormulaOp::Multiply, 0, 1},
                  {FormulaOp::Abs, 2}};
    EXPECT_EQ(formulaMeaning(plan, {potential, temperature}), potential);
}

} // namespace
} // namespace voxsheet::engine
