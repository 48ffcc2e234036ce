// A parsed formula.
#pragma once

#include "sheet/address.h"

#include <cstddef>
#include <string>
#include <vector>

namespace voxsheet::sheet {

enum class NodeKind {
    Number,
    Reference,       ///< one cell
    RangeReference,  ///< a rectangle of cells
    BrokenReference, ///< #REF!: the cell was deleted
    Negate,
    Add,
    Subtract,
    Multiply,
    Divide,
    Call,
};

struct FormulaNode {
    NodeKind kind = NodeKind::Number;
    std::size_t begin = 0; ///< byte offsets into the text; of a reference: with its sheet
    std::size_t end = 0;
    double number = 0.0; ///< Number
    std::string name;    ///< Call: the function, lower case; Reference, RangeReference: the sheet, or empty
    AddressRange range;  ///< Reference (first == last), RangeReference
    std::vector<int> children; ///< operands and arguments, as indices of nodes
};

/// Nodes in an order in which children come before their parents; the last one is the root.
struct FormulaAst {
    std::string text;
    std::vector<FormulaNode> nodes;
    [[nodiscard]] const FormulaNode& root() const { return nodes.back(); }
};

} // namespace voxsheet::sheet
