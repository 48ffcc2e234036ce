#include "sheet/formula/functions.h"
#include "sheet/formula/parser.h"
#include "sheet/formula/plan.h"
#include "sheet/formula/references.h"
#include "sheet/formula/token.h"

#include "sheet_fixture.h"

#include <cmath>
#include <limits>
#include <random>

namespace voxsheet::sheet {
namespace {

CellError parseError(std::string_view text) {
    const auto parsed = parseFormula(text);
    if (const auto* error = std::get_if<CellError>(&parsed)) return *error;
    ADD_FAILURE() << text << " parses";
    return {};
}

/// Computes a formula whose cells A1, B1, C1 hold single samples.
double computed(const std::string& formula, double a = 2.0, double b = 3.0, double c = 5.0) {
    Workbook workbook = filledWorkbook(4, 1);
    workbook.sheets[0].cells[{3, 0}].source = formula;
    const WorkbookValues values = evaluateWorkbook(testKeys(), workbook, allReady(1));
    const CellValue& value = valueAt(values, {0, {3, 0}});
    const auto* result = std::get_if<FormulaValue>(&value);
    if (!result) {
        ADD_FAILURE() << formula << ": "
                      << (std::holds_alternative<CellError>(value) ? std::get<CellError>(value).sentence
                                                                   : "no formula");
        return NAN;
    }
    const std::map<std::string, double> samples{{"d1", a}, {"d2", b}, {"d3", c}};
    std::vector<PlanArray> arrays;
    for (const PlanInput& input : result->plan.inputs)
        arrays.emplace_back(std::span(&samples.at(input.dataset), 1));
    float out = 0.0F;
    evaluatePlan(result->plan, arrays, std::span(&out, 1));
    return static_cast<double>(out);
}

TEST(Formula, PrecedenceAndAssociativity) {
    EXPECT_EQ(computed("=A1+B1*C1"), 17.0);
    EXPECT_EQ(computed("=(A1+B1)*C1"), 25.0);
    EXPECT_EQ(computed("=A1-B1-C1"), -6.0);
    EXPECT_EQ(computed("=A1/B1/C1", 30.0), 2.0);
    EXPECT_EQ(computed("=A1-(B1-C1)"), 4.0);
    EXPECT_EQ(computed("=-A1*B1"), -6.0);
    EXPECT_EQ(computed("=-A1-B1"), -5.0);
    EXPECT_EQ(computed("=A1--B1"), 5.0);
    EXPECT_EQ(computed("=A1*-B1"), -6.0);
    EXPECT_EQ(computed("=+A1"), 2.0);
    EXPECT_EQ(computed("=---A1"), -2.0);
    EXPECT_EQ(computed("=abs(A1-C1)*B1"), 9.0);
    EXPECT_EQ(computed("=ABS(a1-c1)"), 3.0) << "whatever the case";
    EXPECT_EQ(computed("= A1 +\t1.5e1 "), 17.0);
    EXPECT_EQ(computed("=.5*A1"), 1.0);
    EXPECT_EQ(computed("=A1/2"), 1.0);
    EXPECT_EQ(computed("=1/A1"), 0.5);
}

TEST(Formula, WhatATextIsNotIsSaid) {
    for (const auto& [text, part] :
         std::vector<std::pair<std::string, std::string>>{{"=", "ends"},
                                                          {"=A1+", "ends"},
                                                          {"=A1**2", "\"*\" at character 5"},
                                                          {"=(A1", "closing parenthesis"},
                                                          {"=A1)", "\")\""},
                                                          {"=A1 B1", "\"B1\""},
                                                          {"=hello", "\"hello\""},
                                                          {"=abs(A1", "parenthesis"},
                                                          {"=abs(A1,", "ends"},
                                                          {"=A1^2", "\"^\""},
                                                          {"=A1+π", "\"π\" at character 5"},
                                                          {"=1e999", "1e999"},
                                                          {"='x'", "!"},
                                                          {"='x", "\"'\""},
                                                          {"=Sheet2!", "cell such as A1"},
                                                          {"=A1:", "cell such as A1"},
                                                          {"=,", "\",\""},
                                                          {"=\"text\"", "at character 2"}}) {
        const CellError error = parseError(text);
        EXPECT_EQ(error.code, CellErrorCode::Name) << text;
        EXPECT_NE(error.sentence.find(part), std::string::npos) << text << ": " << error.sentence;
    }
    EXPECT_EQ(parseError("=A9999").code, CellErrorCode::Ref);
    EXPECT_EQ(parseError("=ZZZZ1").code, CellErrorCode::Ref);
}

TEST(Formula, DepthAndLengthAreBounded) {
    const auto nested = [](std::size_t n, const char* open, const char* close) {
        std::string text = "=";
        for (std::size_t i = 0; i < n; ++i)
            text += open;
        text += "A1";
        for (std::size_t i = 0; i < n; ++i)
            text += close;
        return text;
    };
    EXPECT_TRUE(std::holds_alternative<FormulaAst>(parseFormula(nested(20, "(", ")"))));
    for (const char* open : {"(", "-", "abs(", "+", "-("})
        EXPECT_EQ(parseError(nested(2000, open, "")).code, CellErrorCode::Name) << open;
    EXPECT_EQ(parseError("=" + std::string(100000, '(')).code, CellErrorCode::Name);
    std::string wide = "=A1";
    while (wide.size() < 8000)
        wide += "+A1";
    EXPECT_TRUE(std::holds_alternative<FormulaAst>(parseFormula(wide))) << "long but flat";
}

TEST(Formula, AnyTextIsAFormulaOrAnError) {
    std::mt19937 random(3);
    const std::vector<std::string> parts{
        "A1",    "B2", "+",   "-",       "*",       "/", "(", ")",    "abs(", ",",        ":", "!", "'",
        "#REF!", "1e", "2.5", "Sheet1!", "'My s'!", " ", "é", "\xff", "%",    "ZZZ99999", ".", "_x"};
    int formulas = 0;
    for (int i = 0; i < 6000; ++i) {
        std::string text = "=";
        for (auto n = random() % 12; n > 0; --n)
            text += parts[random() % parts.size()];
        const auto parsed = parseFormula(text);
        if (const auto* ast = std::get_if<FormulaAst>(&parsed)) {
            ++formulas;
            for (std::size_t k = 0; k < ast->nodes.size(); ++k)
                for (const int child : ast->nodes[k].children)
                    EXPECT_LT(child, static_cast<int>(k)) << text;
            EXPECT_EQ(rewriteReferences(text, [](const std::string&, const AddressRange& r) { return r; }),
                      text);
        } else {
            EXPECT_FALSE(std::get<CellError>(parsed).sentence.empty());
        }
    }
    EXPECT_GT(formulas, 60) << "the generator makes both";
}

TEST(Formula, ReferencesAreRewrittenInPlace) {
    const auto down = [](const std::string& sheet, const AddressRange& r) -> std::optional<AddressRange> {
        if (!sheet.empty()) return r;
        return AddressRange{{r.first.column, r.first.row + 1}, {r.last.column, r.last.row + 1}};
    };
    EXPECT_EQ(rewriteReferences("= a1 + Sheet2!A1*abs( B9 )", down), "= A2 + Sheet2!A1*abs( B10 )");
    EXPECT_EQ(rewriteReferences("=A1:B2", down), "=A2:B3");
    const auto gone = [](const std::string&, const AddressRange&) { return std::optional<AddressRange>(); };
    EXPECT_EQ(rewriteReferences("='My s'!A1-1", gone), "=#REF!-1");
    EXPECT_EQ(rewriteReferences("=A1+*", down), "=A1+*") << "what does not parse stays";
    EXPECT_EQ(rewriteSheet("=old!A1+Other!A1+A1", "OLD", "new name"), "='new name'!A1+Other!A1+A1");
}

TEST(Evaluate, DivisionByZeroAndOverflowAreAbsent) {
    EXPECT_TRUE(std::isnan(computed("=A1/B1", 1.0, 0.0)));
    EXPECT_TRUE(std::isnan(computed("=A1/B1", 0.0, 0.0)));
    EXPECT_TRUE(std::isnan(computed("=1/(A1/B1)", 1.0, 0.0))) << "not 0: what is absent stays absent";
    EXPECT_TRUE(std::isnan(computed("=A1*B1", 1e30, 1e30)));
    EXPECT_FLOAT_EQ(static_cast<float>(computed("=A1*B1/C1", 1e30, 1e30, 1e59)), 10.0F)
        << "only the result must be a float";
    EXPECT_TRUE(std::isnan(computed("=A1-A1+B1", std::numeric_limits<double>::quiet_NaN())));
    EXPECT_TRUE(std::isnan(computed("=A1*0", std::numeric_limits<double>::infinity())));
}

TEST(Evaluate, WholeArraysInAnyRunsOfSamples) {
    FormulaPlan plan;
    plan.inputs = {{"a", std::int64_t{0}, 0}, {"b", std::int64_t{0}, 0}};
    plan.steps = {{FormulaOp::Input, 0, -1, 0},
                  {FormulaOp::Input, 1, -1, 0},
                  {FormulaOp::Subtract, 0, 1, 0},
                  {FormulaOp::Abs, 2, -1, 0}};
    std::vector<float> a(5000);
    std::vector<double> b(5000);
    for (std::size_t i = 0; i < a.size(); ++i) {
        a[i] = static_cast<float>(i);
        b[i] = 2500.0;
    }
    std::vector<float> whole(a.size());
    evaluatePlan(plan, std::vector<PlanArray>{std::span<const float>(a), std::span<const double>(b)}, whole);
    for (std::size_t i = 0; i < a.size(); ++i)
        ASSERT_EQ(whole[i], std::abs(static_cast<float>(i) - 2500.0F)) << i;
    std::vector<float> pieces(a.size());
    for (std::size_t at = 0, length = 1; at < a.size(); at += length, length = (length * 7) % 900 + 1) {
        length = std::min(length, a.size() - at);
        evaluatePlan(plan,
                     std::vector<PlanArray>{std::span<const float>(a).subspan(at, length),
                                            std::span<const double>(b).subspan(at, length)},
                     std::span(pieces).subspan(at, length));
    }
    EXPECT_EQ(pieces, whole);
}

TEST(Evaluate, ArraysMustFit) {
    FormulaPlan plan;
    plan.inputs = {{"a", std::int64_t{0}, 0}};
    plan.steps = {{FormulaOp::Input, 0, -1, 0}};
    const std::vector<float> a(3);
    std::vector<float> out(4);
    EXPECT_THROW(evaluatePlan(plan, {}, out), InvalidInput);
    EXPECT_THROW(evaluatePlan(plan, std::vector<PlanArray>{std::span<const float>(a)}, out), InvalidInput);
    EXPECT_THROW(evaluatePlan(FormulaPlan{}, {}, out), InvalidInput);
    EXPECT_THROW((void)planCacheKey(plan, {}), InvalidInput);
}

} // namespace
} // namespace voxsheet::sheet
