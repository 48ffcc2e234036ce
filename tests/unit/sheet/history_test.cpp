#include "sheet/history.h"

#include "sheet_fixture.h"

#include <random>

namespace voxsheet::sheet {
namespace {

std::shared_ptr<const KeyTable> sharedKeys() { return std::make_shared<const KeyTable>(testKeys()); }

SetStyle turn(double azimuth) { return {"Sheet1", Layer::sheet(), {{"camera.azimuth", azimuth}}}; }

double azimuthOf(const Snapshot& snapshot) {
    return resolveStyle(testKeys(), snapshot->sheets[0], {0, 0}).style.camera.azimuthDegrees;
}

TEST(History, UndoAndRedo) {
    History history(sharedKeys(), filledWorkbook(2, 1));
    const Snapshot start = history.current();
    EXPECT_FALSE(history.canUndo());
    EXPECT_THROW((void)history.undo(), Conflict);
    EXPECT_THROW((void)history.redo(), Conflict);
    (void)history.apply(turn(1));
    (void)history.apply(turn(2));
    EXPECT_EQ(history.undoLabel(), "Set camera.azimuth of sheet");
    EXPECT_EQ(azimuthOf(history.undo()), 1.0);
    EXPECT_EQ(*history.undo(), *start);
    EXPECT_TRUE(history.canRedo());
    EXPECT_EQ(azimuthOf(history.redo()), 1.0);
    (void)history.apply(turn(5));
    EXPECT_FALSE(history.canRedo()) << "a new edit ends what could be redone";
    EXPECT_EQ(azimuthOf(start), 150.0) << "old snapshots never change";
}

TEST(History, VersionsOnlyRise) {
    History history(sharedKeys(), filledWorkbook(1, 1));
    std::uint64_t last = history.current()->version;
    EXPECT_GT(last, 0U);
    for (int i = 0; i < 6; ++i) {
        const std::uint64_t next =
            i % 2 == 0 ? history.apply(turn(i)).snapshot->version : history.undo()->version;
        EXPECT_GT(next, last);
        last = next;
    }
}

TEST(History, OneDragIsOneStep) {
    History history(sharedKeys(), filledWorkbook(1, 1));
    for (int i = 0; i < 50; ++i)
        (void)history.apply(turn(i), "drag-1");
    for (int i = 0; i < 50; ++i)
        (void)history.apply(turn(100 + i), "drag-2");
    EXPECT_EQ(azimuthOf(history.undo()), 49.0);
    EXPECT_EQ(azimuthOf(history.undo()), 150.0);
    EXPECT_FALSE(history.canUndo());
    EXPECT_EQ(azimuthOf(history.redo()), 49.0);
}

TEST(History, AGestureEndsWithUndoOrWhenTold) {
    History history(sharedKeys(), filledWorkbook(1, 1));
    (void)history.apply(turn(1), "g");
    (void)history.undo();
    (void)history.apply(turn(2), "g");
    EXPECT_EQ(azimuthOf(history.undo()), 150.0);
    (void)history.apply(turn(3), "g");
    history.endGesture();
    (void)history.apply(turn(4), "g");
    EXPECT_EQ(azimuthOf(history.undo()), 3.0);
}

TEST(History, WhatChangesNothingOrFailsMakesNoStep) {
    History history(sharedKeys(), filledWorkbook(1, 1));
    (void)history.apply(turn(1));
    const Snapshot before = history.current();
    EXPECT_FALSE(history.apply(turn(1)).changed);
    EXPECT_EQ(history.current(), before);
    EXPECT_THROW((void)history.apply(SetSource{"Sheet1", {0, 0}, "none such"}), NotFound);
    EXPECT_EQ(history.current(), before);
    EXPECT_EQ(azimuthOf(history.undo()), 150.0);
}

TEST(History, KeepsNoMoreThanItsLimit) {
    History history(sharedKeys(), filledWorkbook(1, 1), 3);
    for (int i = 0; i < 10; ++i)
        (void)history.apply(turn(i));
    int steps = 0;
    for (; history.canUndo(); ++steps)
        (void)history.undo();
    EXPECT_EQ(steps, 3);
    EXPECT_EQ(azimuthOf(history.current()), 6.0);
}

TEST(History, ReportsWhatHidesAnEdit) {
    History history(sharedKeys(), filledWorkbook(2, 1));
    (void)history.apply(SetStyle{"Sheet1", Layer::ofCell({1, 0}), {{"camera.azimuth", 9.0}}});
    const EditReport report = history.apply(turn(1));
    ASSERT_EQ(report.hidden.size(), 1U);
    EXPECT_EQ(hiddenSentence(report.hidden), "camera.azimuth is set nearer by cell B1");
}

TEST(History, WhatBecameKnownOfASourceSurvivesUndo) {
    History history(sharedKeys(), filledWorkbook(1, 1));
    (void)history.apply(turn(1));
    (void)history.undo();
    DatasetSource source = history.current()->datasets.at("d1");
    source.checksum = "xxh3:1234";
    const Snapshot amended = history.amend(UpdateDataset{"d1", source});
    EXPECT_EQ(amended->datasets.at("d1").checksum, "xxh3:1234");
    EXPECT_EQ(history.redo()->datasets.at("d1").checksum, "xxh3:1234");
    EXPECT_EQ(history.undo()->datasets.at("d1").checksum, "xxh3:1234");
    EXPECT_THROW((void)history.amend(UpdateDataset{"d9", source}), NotFound);
}

TEST(History, UndoOfEveryStepOfALongRandomSessionGivesTheStart) {
    History history(sharedKeys(), filledWorkbook(3, 3), 1000);
    const Workbook start = *history.current();
    std::mt19937 random(11);
    const auto pick = [&](int n) { return static_cast<int>(random() % static_cast<unsigned>(n)); };
    int steps = 0;
    for (int i = 0; i < 300; ++i) {
        const Sheet& sheet = history.current()->sheets[0];
        const Address a{pick(sheet.columns), pick(sheet.rows)};
        const Address b{pick(sheet.columns), pick(sheet.rows)};
        const std::vector<Command> choices{
            turn(pick(360)),
            SetStyle{"Sheet1", Layer::ofCell(a), {{"camera.fov", 20.0 + pick(50)}}},
            SetSource{"Sheet1", a, "=" + addressName(b) + "-A1"},
            SwapCells{"Sheet1", a, b},
            MoveCells{"Sheet1", {a, a}, b},
            InsertLines{"Sheet1", Axis::Rows, a.row, 1},
            DeleteLines{"Sheet1", Axis::Rows, a.row, 1},
            SetLayout{"Sheet1", 1 + pick(5)},
            SetTitle{"Sheet1", Layer::ofColumn(a.column), "t" + std::to_string(pick(9))},
        };
        try {
            steps += history.apply(choices[static_cast<std::size_t>(pick(static_cast<int>(choices.size())))])
                             .changed
                         ? 1
                         : 0;
        } catch (const Error&) {
            continue; // refused: nothing changed
        }
        EXPECT_NO_THROW(validateWorkbook(*history.current()));
    }
    EXPECT_GT(steps, 100);
    const Workbook end = *history.current();
    for (int i = 0; i < steps; ++i)
        (void)history.undo();
    EXPECT_EQ(*history.current(), start);
    for (int i = 0; i < steps; ++i)
        (void)history.redo();
    EXPECT_EQ(*history.current(), end);
}

} // namespace
} // namespace voxsheet::sheet
