#include "sheet/formula/dependency_graph.h"
#include "sheet/formula/values.h"

#include "sheet_fixture.h"

namespace voxsheet::sheet {
namespace {

class Values : public testing::Test {
protected:
    void set(const char* address, const std::string& source) {
        book.sheets[0].cells[parseAddress(address)].source = source;
    }
    [[nodiscard]] CellValue value(const char* address, std::size_t sheet = 0) const {
        return valueAt(evaluateWorkbook(testKeys(), book, lookup), {sheet, parseAddress(address)});
    }
    [[nodiscard]] CellError error(const char* address) const {
        const CellValue found = value(address);
        if (const auto* e = std::get_if<CellError>(&found)) return *e;
        ADD_FAILURE() << address << " is no error";
        return {};
    }
    [[nodiscard]] FormulaValue formula(const char* address, std::size_t sheet = 0) const {
        const CellValue found = value(address, sheet);
        if (const auto* f = std::get_if<FormulaValue>(&found)) return *f;
        const auto* e = std::get_if<CellError>(&found);
        ADD_FAILURE() << address << ": " << (e ? e->sentence : "no formula");
        return {};
    }
    void expectError(const char* address, CellErrorCode code, const std::string& part) const {
        const CellError found = error(address);
        EXPECT_STREQ(cellErrorCodeName(found.code), cellErrorCodeName(code)) << found.sentence;
        EXPECT_NE(found.sentence.find(part), std::string::npos) << found.sentence;
    }

    Workbook book = filledWorkbook(4, 3); // d1 … d12
    DatasetLookup lookup = allReady(8);
};

TEST_F(Values, EveryKindOfCell) {
    set("D3", "");
    set("D2", "=B1-A1");
    EXPECT_TRUE(std::holds_alternative<EmptyValue>(value("D3")));
    EXPECT_EQ(std::get<DatasetValue>(value("A1")).dataset, "d1");
    const FormulaValue difference = formula("D2");
    ASSERT_EQ(difference.plan.inputs.size(), 2U);
    EXPECT_EQ(difference.plan.inputs[0].dataset, "d2");
    EXPECT_EQ(difference.grid.dims, glm::ivec3(8));
    EXPECT_TRUE(difference.notes.empty());
}

TEST_F(Values, InputsAreWhatTheReferencedCellShows) {
    book.sheets[0].cells[{0, 0}].style["field"] = std::string("spin");
    book.sheets[0].rowHeaders[0].style["time"] = std::int64_t{4};
    set("D2", "=A1+A2");
    const auto inputs = formula("D2").plan.inputs;
    EXPECT_EQ(inputs[0], (PlanInput{"d1", std::string("spin"), 4}));
    EXPECT_EQ(inputs[1], (PlanInput{"d5", std::int64_t{0}, 0}));
}

TEST_F(Values, FormulasOverFormulasComeToOnePlan) {
    set("D1", "=A1-B1");
    set("D2", "=abs(D1)*2+D1");
    const FormulaPlan plan = formula("D2").plan;
    EXPECT_EQ(plan.inputs.size(), 2U);
    EXPECT_EQ(plan.steps.size(), 7U) << "A1, B1, -, abs, 2, *, +: the difference is computed once";
}

TEST_F(Values, DoublingFormulasStayLinear) {
    book.sheets[0].rows = 60;
    set("A1", "d1");
    for (int row = 2; row <= 60; ++row) {
        const std::string above = "A" + std::to_string(row - 1);
        set(("A" + std::to_string(row)).c_str(), "=" + above + "+" + above);
    }
    EXPECT_EQ(formula("A60").plan.steps.size(), 60U) << "not 2^59";
}

TEST_F(Values, LongChainsNeitherOverflowNorLoseTheOrder) {
    book = filledWorkbook(1, 1);
    book.sheets[0].rows = 1000;
    for (int row = 1; row < 1000; ++row)
        book.sheets[0].cells[{0, row - 1}].source = "=A" + std::to_string(row + 1) + "+1"; // refers downwards
    book.sheets[0].cells[{0, 999}].source = "d1";
    const WorkbookValues values = evaluateWorkbook(testKeys(), book, lookup);
    EXPECT_EQ(std::get<FormulaValue>(valueAt(values, {0, {0, 0}})).plan.inputs.size(), 1U);
    ASSERT_EQ(values.order.size(), 999U);
    for (std::size_t i = 1; i < values.order.size(); ++i)
        EXPECT_LT(values.order[i].cell.row, values.order[i - 1].cell.row);
}

TEST_F(Values, ReferenceErrors) {
    set("D1", "=A9");
    expectError("D1", CellErrorCode::Ref, "A9 is outside the sheet, which has 4 columns and 3 rows");
    set("D1", "=Nope!A1");
    expectError("D1", CellErrorCode::Ref, "no sheet \"Nope\"");
    set("B3", "");
    set("D1", "=B3+A1");
    expectError("D1", CellErrorCode::Ref, "B3 is empty");
    set("D1", "=#REF!+A1");
    expectError("D1", CellErrorCode::Ref, "deleted");
    book.datasets.erase("d1");
    expectError("A1", CellErrorCode::Ref, "\"d1\" is not in the workbook");
}

TEST_F(Values, NameAndTypeErrors) {
    set("D1", "=abz(A1)");
    expectError("D1", CellErrorCode::Name, "did you mean \"abs\"");
    set("D1", "=median(A1)");
    expectError("D1", CellErrorCode::Name, "the functions are: abs");
    set("D1", "=A1+*");
    expectError("D1", CellErrorCode::Name, "character");
    set("D1", "=abs()");
    expectError("D1", CellErrorCode::Type, "takes 1 argument, not 0");
    set("D1", "=abs(A1,B1)");
    expectError("D1", CellErrorCode::Type, "not 2");
    set("D1", "=1+2");
    expectError("D1", CellErrorCode::Type, "number, not a volume");
    set("D1", "=A1:B2");
    expectError("D1", CellErrorCode::Type, "several cells");
}

TEST_F(Values, ShapesMustBeEqual) {
    lookup = [](const std::string& name) -> DatasetState {
        Grid grid = testGrid(8);
        if (name == "d2") grid.dims = {8, 9, 10};
        return DatasetReady{grid};
    };
    set("D1", "=A1-B1");
    expectError("D1", CellErrorCode::Grid, "A1 has 8 x 8 x 8 samples and B1 has 8 x 9 x 10");
    set("D1", "=B1*2");
    EXPECT_EQ(formula("D1").grid.dims, glm::ivec3(8, 9, 10)) << "numbers go with every shape";
    set("D2", "=D1+B1");
    EXPECT_EQ(formula("D2").plan.inputs.size(), 1U);
}

TEST_F(Values, OtherPositionsAreNoted) {
    lookup = [](const std::string& name) -> DatasetState {
        Grid grid = testGrid(8);
        if (name == "d2") grid.worldFromIndex[3].x = 0.5;
        if (name == "d3") grid.worldFromIndex[3].x = 1e-6;
        return DatasetReady{grid};
    };
    set("D1", "=A1-B1");
    const FormulaValue difference = formula("D1");
    ASSERT_EQ(difference.notes.size(), 1U);
    EXPECT_NE(difference.notes[0].find("B1 has the same number of samples as A1 at other positions"),
              std::string::npos);
    EXPECT_EQ(difference.grid.worldFromIndex[3].x, 0.0) << "the first input's geometry";
    set("D1", "=A1-C1");
    EXPECT_TRUE(formula("D1").notes.empty()) << "rounding in a header is no other position";
}

TEST_F(Values, CirclesAreNamedAndWhatUsesThemSharesTheCode) {
    set("A1", "=B1");
    set("B1", "=C1+D3");
    set("C1", "=A1");
    set("D1", "=C1*2");
    set("A2", "=A2");
    expectError("A1", CellErrorCode::Cycle, "A1 → B1 → C1 → A1");
    expectError("C1", CellErrorCode::Cycle, "A1 → B1 → C1 → A1");
    expectError("D1", CellErrorCode::Cycle, "It uses C1, which is #CYCLE!");
    expectError("A2", CellErrorCode::Cycle, "A2 → A2");
    EXPECT_TRUE(std::holds_alternative<DatasetValue>(value("D3"))) << "the others go on";
}

TEST_F(Values, LongCirclesAreShortenedInTheSentence) {
    book.sheets[0].columns = 50;
    for (int column = 0; column < 50; ++column)
        book.sheets[0].cells[{column, 0}].source = "=" + columnName((column + 1) % 50) + "1";
    const CellError found = error("A1");
    EXPECT_LT(found.sentence.size(), 120U);
    EXPECT_NE(found.sentence.find("… → A1"), std::string::npos) << found.sentence;
}

TEST_F(Values, ErrorsComeWithTheCellWhereTheyBegan) {
    set("D1", "=A9");
    set("D2", "=D1+1");
    set("D3", "=D2+1");
    expectError("D3", CellErrorCode::Ref, "It uses D1, which is #REF! A9 is outside");
}

TEST_F(Values, FailedImportsAndPendingOnes) {
    lookup = [](const std::string& name) -> DatasetState {
        if (name == "d1") return DatasetFailed{"a.nrrd: is cut short."};
        if (name == "d2") return DatasetPending{};
        return DatasetReady{testGrid(8)};
    };
    set("D1", "=B1+C1");
    set("D2", "=D1*2");
    set("D3", "=B1+A1");
    expectError("A1", CellErrorCode::Import, "a.nrrd: is cut short.");
    EXPECT_EQ(std::get<PendingValue>(value("D1")).dataset, "d2");
    EXPECT_EQ(std::get<PendingValue>(value("D2")).dataset, "d2");
    expectError("D3", CellErrorCode::Import, "It uses A1");
}

TEST_F(Values, AcrossSheets) {
    Sheet other;
    other.name = "Other one";
    other.columns = 2;
    other.cells[{0, 0}].source = "=Sheet1!A1 - SHEET1!B1";
    other.cells[{1, 0}].source = "='other one'!A1*2";
    book.sheets.push_back(other);
    set("D1", "='Other one'!B1");
    EXPECT_EQ(formula("D1").plan.inputs.size(), 2U);
    EXPECT_EQ(formula("B1", 1).plan.inputs[0].dataset, "d1");
    set("A1", "='Other one'!A1");
    expectError("A1", CellErrorCode::Cycle, "Sheet1!A1 → 'Other one'!A1 → Sheet1!A1");
}

TEST_F(Values, EachDatasetIsAskedForOnce) {
    int asked = 0;
    lookup = [&](const std::string&) -> DatasetState {
        ++asked;
        return DatasetReady{testGrid(4)};
    };
    set("B1", "d1");
    set("D1", "=A1+B1");
    (void)evaluateWorkbook(testKeys(), book, lookup);
    EXPECT_EQ(asked, 10);
}

TEST_F(Values, CacheKeysTellPlansAndInputsApart) {
    set("D1", "=A1-B1");
    set("D2", "=B1-A1");
    set("D3", "=A1 - ( B1 )");
    const auto key = [&](const char* cell, std::vector<std::string> names) {
        return planCacheKey(formula(cell).plan, names);
    };
    EXPECT_EQ(key("D1", {"x", "y"}), key("D3", {"x", "y"})) << "spelling does not matter";
    EXPECT_NE(key("D1", {"x", "y"}), key("D1", {"x", "z"}));
    EXPECT_NE(key("D1", {"x", "y"}), key("D2", {"y", "x"}));
    set("D3", "=A1-1");
    const std::string one = key("D3", {"x"});
    set("D3", "=A1-1.0000000000000002");
    EXPECT_NE(key("D3", {"x"}), one);
}

TEST_F(Values, TooLargePlansAreRefused) {
    book = filledWorkbook(300, 2);
    for (int column = 0; column < 300; ++column)
        set((columnName(column) + "2").c_str(), "");
    std::string all = "=A1";
    for (int column = 1; column < 300; ++column)
        all += "+" + columnName(column) + "1";
    set("A2", all);
    expectError("A2", CellErrorCode::Mem, "too many");
}

TEST_F(Values, ManyLongFormulasEndInAnErrorNotInAllMemory) {
    book = filledWorkbook(1, 1);
    book.sheets[0].columns = 4;
    book.sheets[0].rows = 1000;
    for (int cell = 1; cell < 4000; ++cell) { // one chain through every column
        const auto at = [](int i) { return Address{i / 1000, i % 1000}; };
        book.sheets[0].cells[at(cell)].source = "=" + addressName(at(cell - 1)) + "+1";
    }
    std::size_t steps = 0;
    const WorkbookValues all = evaluateWorkbook(testKeys(), book, lookup);
    for (const auto& [position, computed] : all.cells)
        if (const auto* f = std::get_if<FormulaValue>(&computed)) steps += f->plan.steps.size();
    EXPECT_LT(steps, 2 * kMaxCopiedSteps);
    EXPECT_EQ(std::get<FormulaValue>(valueAt(all, {0, {0, 999}})).plan.steps.size(), 1001U);
    EXPECT_EQ(std::get<CellError>(valueAt(all, {0, {3, 999}})).code, CellErrorCode::Mem);
}

TEST(DependencyGraph, ComponentsComeAfterWhatTheyNeed) {
    const DependencyGraph graph{{1, 2}, {3}, {3, 4}, {}, {2}};
    const auto components = componentsInOrder(graph);
    ASSERT_EQ(components.size(), 4U);
    EXPECT_EQ(components[0], std::vector<int>({3}));
    EXPECT_EQ(components.back(), std::vector<int>({0}));
    EXPECT_EQ(shortestCycle(graph, 2), std::vector<int>({2, 4, 2}));
    EXPECT_TRUE(shortestCycle(graph, 0).empty());
}

} // namespace
} // namespace voxsheet::sheet
