#include "sheet/formula/references.h"

#include "sheet/formula/parser.h"
#include "sheet/utf8.h"

#include <algorithm>

namespace voxsheet::sheet {

namespace {

std::string withSheet(const std::string& sheet, const AddressRange& range) {
    std::string text = addressName(SheetAddress{sheet, range.first});
    if (range.first != range.last) text += ":" + addressName(range.last);
    return text;
}

/// Replaces the text of each reference by what `replacement` gives; an empty string leaves it.
template <typename Replacement>
std::string rewrite(std::string_view formula, Replacement replacement) {
    const auto parsed = parseFormula(formula);
    const auto* ast = std::get_if<FormulaAst>(&parsed);
    if (!ast) return std::string(formula);
    std::vector<const FormulaNode*> references;
    for (const FormulaNode& node : ast->nodes)
        if (node.kind == NodeKind::Reference || node.kind == NodeKind::RangeReference)
            references.push_back(&node);
    std::sort(references.begin(), references.end(),
              [](const FormulaNode* a, const FormulaNode* b) { return a->begin > b->begin; });
    std::string text(formula);
    for (const FormulaNode* node : references) {
        const std::string with = replacement(*node);
        if (!with.empty()) text.replace(node->begin, node->end - node->begin, with);
    }
    return text;
}

} // namespace

std::string rewriteReferences(std::string_view formula, const ReferenceMove& move) {
    return rewrite(formula, [&](const FormulaNode& node) -> std::string {
        const std::optional<AddressRange> moved = move(node.name, node.range);
        if (!moved) return "#REF!";
        return *moved == node.range ? std::string{} : withSheet(node.name, *moved);
    });
}

std::string rewriteSheet(std::string_view formula, std::string_view from, std::string_view to) {
    return rewrite(formula, [&](const FormulaNode& node) -> std::string {
        if (node.name.empty() || lowerAscii(node.name) != lowerAscii(from)) return {};
        return to.empty() ? std::string("#REF!") : withSheet(std::string(to), node.range);
    });
}

} // namespace voxsheet::sheet
