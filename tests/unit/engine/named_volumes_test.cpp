#include "engine/named_volumes.h"

#include "base/errors.h"
#include "engine/colour_map.h"
#include "memory_dataset.h"

#include <gtest/gtest.h>

namespace voxsheet::engine {
namespace {

JobState ready(const std::string& key, const std::string& quantity, int steps = 1) {
    auto meta = std::make_shared<DatasetMeta>(test::metaOf(key, {8, 8, 8}));
    meta->fields[0].quantity = quantity;
    meta->times.assign(static_cast<std::size_t>(steps), 0.0);
    JobState state;
    state.state = DatasetState::Ready;
    state.progress = 1.0;
    state.meta = meta;
    return state;
}

JobState working(double progress) {
    JobState state;
    state.state = DatasetState::Importing;
    state.progress = progress;
    return state;
}

JobState failed(ErrorKind kind, const std::string& sentence) {
    JobState state;
    state.state = DatasetState::Failed;
    state.failure = Failure{kind, sentence};
    return state;
}

/// A workbook of two sheets; every dataset's file is its name.
class NamedVolumesTest : public testing::Test {
protected:
    NamedVolumesTest()
        : keys(keyTable()),
          volumes(keys,
                  {[this](const sheet::DatasetSource& source) { return imports.at(source.files.front()); },
                   [this](const std::string& asker, const ThresholdTask& task) {
                       asked.emplace_back(asker, task);
                       return thresholdState;
                   },
                   [this](const std::string& asker) { released.push_back(asker); },
                   [](const CellContent&) { return 0.25; }}) {
        workbook.sheets[0].columns = 4;
        workbook.sheets.emplace_back();
        workbook.sheets[1].name = "Other";
        workbook.sheets[1].columns = 4;
    }

    static sheet::KeyTable keyTable() {
        auto names = ColourMapTable::embedded().names();
        names.insert(names.begin(), "auto");
        return sheet::makeKeyTable(names);
    }

    void dataset(const std::string& name, JobState state) {
        workbook.datasets[name].files = {name};
        imports[name] = std::move(state);
    }

    void cell(std::size_t sheet, const std::string& address, const std::string& key) {
        CellContent content;
        content.state = CellState::Ready;
        content.meta = ready(key, "density", 3).meta;
        contents[{sheet, sheet::parseAddress(address)}] = content;
    }

    CellContent& contentOf(const std::string& address) { return contents[{0, sheet::parseAddress(address)}]; }

    NamingCell from() { return {workbook, 0, {0, 0}, view, contents, 1}; }

    auto object(const std::string& shape) { return volumes.clipObject(shape, from()); }

    std::string refusal(const std::string& shape) {
        try {
            static_cast<void>(object(shape));
        } catch (const InvalidInput& error) {
            EXPECT_EQ(error.field(), "clip.shape");
            return error.what();
        }
        ADD_FAILURE() << shape << " was accepted";
        return {};
    }

    sheet::KeyTable keys;
    sheet::Workbook workbook;
    View view;
    CellContents contents;
    std::map<std::string, JobState> imports;
    JobState thresholdState = ready("distances", "signed distance");
    std::vector<std::pair<std::string, ThresholdTask>> asked;
    std::vector<std::string> released;
    NamedVolumes volumes;
};

TEST_F(NamedVolumesTest, AShapeNeedsNoDataset) {
    const auto torus = object("Torus");
    ASSERT_TRUE(torus.volume);
    EXPECT_EQ(torus.volume->dataset, "clip-shape:torus");
    EXPECT_FALSE(torus.volume->extent);
    EXPECT_EQ(released, std::vector<std::string>{"0!A1"}) << "a threshold of before is not wanted any more";
}

TEST_F(NamedVolumesTest, AMeshIsImportedWhenItIsNamedAndFitsByItsOwnGrid) {
    dataset("bunny", ready("mesh key", "signed distance"));
    const auto mesh = object("bunny");
    ASSERT_TRUE(mesh.volume);
    EXPECT_EQ(mesh.volume->dataset, "mesh key");
    EXPECT_EQ(mesh.volume->extent, imports["bunny"].meta->grid);
    imports["bunny"] = working(0.5);
    const auto coming = object("'bunny'");
    ASSERT_TRUE(coming.missing);
    EXPECT_EQ(coming.missing->code, "");
    EXPECT_EQ(coming.missing->progress, 0.5);
    EXPECT_NE(coming.missing->message.find("bunny"), std::string::npos);
    imports["bunny"] = failed(ErrorKind::InvalidInput, "mesh 'bunny': it is not closed");
    const auto bad = object("bunny");
    ASSERT_TRUE(bad.missing);
    EXPECT_EQ(bad.missing->code, "#IMPORT!");
    EXPECT_EQ(bad.missing->message, "mesh 'bunny': it is not closed");
}

TEST_F(NamedVolumesTest, ADatasetThatIsNoMeshIsRefusedWithWhatToWriteInstead) {
    dataset("scan 2", ready("k", "density"));
    const std::string why = refusal("scan 2");
    EXPECT_NE(why.find("density"), std::string::npos) << why;
    EXPECT_NE(why.find("'scan 2' > 0.4"), std::string::npos) << why;
    EXPECT_NE(refusal("no such thing").find("sphere"), std::string::npos);
}

TEST_F(NamedVolumesTest, AComparisonReadsWhatTheCellShows) {
    cell(0, "B1", "formula result");
    workbook.sheets[0].cells[{1, 0}].style["time"] = std::int64_t{2};
    const auto solid = object("B1 >= 0.4");
    ASSERT_TRUE(solid.volume);
    EXPECT_EQ(solid.volume->dataset, "distances");
    EXPECT_EQ(solid.volume->extent, contentOf("B1").meta->grid) << "of what was compared";
    ASSERT_EQ(asked.size(), 1U);
    EXPECT_EQ(asked[0].first, "0!A1");
    EXPECT_EQ(asked[0].second.input.meta->key, "formula result");
    EXPECT_EQ(asked[0].second.input.step, 2);
    EXPECT_EQ(asked[0].second.threshold.comparison, Comparison::GreaterOrEqual);
    EXPECT_EQ(asked[0].second.threshold.value, 0.4);
    cell(1, "C1", "elsewhere");
    ASSERT_TRUE(object("Other!C1 < -2").volume);
    EXPECT_EQ(asked[1].second.input.meta->key, "elsewhere");
    EXPECT_EQ(asked[1].second.threshold.comparison, Comparison::Less);
}

TEST_F(NamedVolumesTest, AComparedDatasetNeedNoCellAndPlaysAlong) {
    dataset("run 2", ready("k", "density", 5));
    ASSERT_TRUE(object("'run 2' <= -1").volume);
    EXPECT_EQ(asked.at(0).second.input.step, 1) << "the naming cell's time";
    EXPECT_EQ(asked.at(0).second.threshold.comparison, Comparison::LessOrEqual);
}

TEST_F(NamedVolumesTest, WhatIsBeingComputedIsWaitedForAndAFailureHasItsCode) {
    cell(0, "B1", "k");
    thresholdState = working(0.4);
    const auto coming = object("B1 > 1");
    ASSERT_TRUE(coming.missing);
    EXPECT_EQ(coming.missing->code, "");
    EXPECT_EQ(coming.missing->progress, 0.4);
    EXPECT_NE(coming.missing->message.find("B1 > 1"), std::string::npos);
    thresholdState = failed(ErrorKind::LimitExceeded, "too large");
    EXPECT_EQ(object("B1 > 1").missing->code, "#MEM!");
    EXPECT_EQ(object("B1 > 1").missing->message, "too large");
    thresholdState = failed(ErrorKind::IoError, "gone");
    EXPECT_EQ(object("B1 > 1").missing->code, "#TYPE!");
}

TEST_F(NamedVolumesTest, ACellInErrorOrOnItsWayIsNamed) {
    contentOf("B1").state = CellState::Error;
    contentOf("B1").code = "#GRID!";
    contentOf("B1").message = "The sizes differ.";
    const auto broken = object("B1 > 1");
    ASSERT_TRUE(broken.missing);
    EXPECT_EQ(broken.missing->code, "#GRID!");
    EXPECT_NE(broken.missing->message.find("B1"), std::string::npos);
    EXPECT_NE(broken.missing->message.find("The sizes differ."), std::string::npos);
    contentOf("B1").state = CellState::Pending;
    contentOf("B1").message = "Computing";
    const auto coming = object("B1 > 1");
    ASSERT_TRUE(coming.missing);
    EXPECT_EQ(coming.missing->code, "");
    EXPECT_EQ(coming.missing->progress, 0.25);
    EXPECT_TRUE(asked.empty());
}

TEST_F(NamedVolumesTest, BrokenReferencesAreRefused) {
    EXPECT_NE(refusal("D1 > 1").find("holds no volume"), std::string::npos);
    EXPECT_NE(refusal("ZZ99 > 1").find("holds no volume"), std::string::npos);
    EXPECT_NE(refusal("Nowhere!B1 > 1").find("Nowhere"), std::string::npos);
    EXPECT_NE(refusal("'nothing' > 1").find("nothing"), std::string::npos);
    refusal("#REF! > 1");
}

TEST_F(NamedVolumesTest, ColoursComeFromAnyCellOrDataset) {
    cell(0, "B1", "k");
    dataset("scan", ready("s", "density"));
    const std::string key = "isosurface.colorBy";
    EXPECT_EQ(volumes.find(sheet::parseVolumeName("b1", key), from(), key).volume->meta->key, "k");
    EXPECT_EQ(volumes.find(sheet::parseVolumeName("scan", key), from(), key).volume->meta->key, "s");
    try {
        static_cast<void>(volumes.find(sheet::parseVolumeName("C3", key), from(), key));
        FAIL();
    } catch (const InvalidInput& error) {
        EXPECT_EQ(error.field(), key);
    }
}

} // namespace
} // namespace voxsheet::engine
