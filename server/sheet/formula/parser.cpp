#include "sheet/formula/parser.h"

#include "base/errors.h"
#include "sheet/formula/token.h"
#include "sheet/utf8.h"
#include "sheet/workbook.h"

#include <algorithm>
#include <utility>

namespace voxsheet::sheet {

namespace {

/// Thrown and caught in this file only: the way out of the descent.
struct ParseFailure {
    CellError error;
};

class Parser {
public:
    explicit Parser(std::string_view text) : tokens_(tokenizeFormula(text)) { ast_.text = std::string(text); }

    FormulaAst run() {
        sum();
        if (peek().kind != TokenKind::End) unexpected("an operator");
        return std::move(ast_);
    }

private:
    /// Counts what is nested, so that hostile text cannot overflow the stack.
    class Level {
    public:
        explicit Level(Parser& parser) : parser_(parser) {
            if (++parser_.depth_ > kMaxFormulaDepth)
                parser_.fail(CellErrorCode::Name, "The formula nests deeper than " +
                                                      std::to_string(kMaxFormulaDepth) +
                                                      " levels; split it over several cells.");
        }
        ~Level() { --parser_.depth_; }
        Level(const Level&) = delete;
        Level& operator=(const Level&) = delete;

    private:
        Parser& parser_;
    };

    [[nodiscard]] const Token& peek(std::size_t ahead = 0) const {
        return tokens_[std::min(at_ + ahead, tokens_.size() - 1)];
    }
    const Token& take() {
        const Token& token = peek();
        if (at_ + 1 < tokens_.size()) ++at_;
        return token;
    }
    bool accept(TokenKind kind) {
        if (peek().kind != kind) return false;
        take();
        return true;
    }

    [[noreturn]] static void fail(CellErrorCode code, std::string sentence) {
        throw ParseFailure{{code, std::move(sentence)}};
    }
    [[noreturn]] void unexpected(const std::string& wanted) const {
        const Token& token = peek();
        if (token.kind == TokenKind::End)
            fail(CellErrorCode::Name, "The formula ends where " + wanted + " should be; complete it.");
        const std::string shown = ast_.text.substr(token.begin, token.end - token.begin);
        fail(CellErrorCode::Name, inQuotes(shown) + " at character " +
                                      std::to_string(characterOf(token.begin)) +
                                      " of the formula is not understood; " + wanted + " should be there.");
    }
    /// Counted in characters, from 1, as people do.
    [[nodiscard]] std::size_t characterOf(std::size_t byte) const {
        const auto before = ast_.text.begin() + static_cast<std::ptrdiff_t>(byte);
        return 1 + static_cast<std::size_t>(std::count_if(ast_.text.begin(), before, [](char c) {
                   return (static_cast<unsigned char>(c) & 0xC0U) != 0x80U;
               }));
    }

    int add(FormulaNode node) {
        ast_.nodes.push_back(std::move(node));
        return static_cast<int>(ast_.nodes.size()) - 1;
    }
    int addOperator(NodeKind kind, int left, int right) {
        FormulaNode node;
        node.kind = kind;
        node.children = {left, right};
        node.begin = ast_.nodes[static_cast<std::size_t>(left)].begin;
        node.end = ast_.nodes[static_cast<std::size_t>(right)].end;
        return add(std::move(node));
    }

    int sum() {
        int left = product();
        while (peek().kind == TokenKind::Plus || peek().kind == TokenKind::Minus) {
            const NodeKind kind = take().kind == TokenKind::Plus ? NodeKind::Add : NodeKind::Subtract;
            const int right = product();
            left = addOperator(kind, left, right);
        }
        return left;
    }

    int product() {
        int left = unary();
        while (peek().kind == TokenKind::Star || peek().kind == TokenKind::Slash) {
            const NodeKind kind = take().kind == TokenKind::Star ? NodeKind::Multiply : NodeKind::Divide;
            const int right = unary();
            left = addOperator(kind, left, right);
        }
        return left;
    }

    int unary() {
        const Level level(*this);
        const std::size_t begin = peek().begin;
        if (accept(TokenKind::Plus)) return unary();
        if (!accept(TokenKind::Minus)) return primary();
        FormulaNode node;
        node.kind = NodeKind::Negate;
        node.children = {unary()};
        node.begin = begin;
        node.end = ast_.nodes.back().end;
        return add(std::move(node));
    }

    int primary() {
        const Token& token = peek();
        switch (token.kind) {
        case TokenKind::Number:
            return number();
        case TokenKind::Open:
            return parentheses();
        case TokenKind::BrokenReference: {
            take();
            FormulaNode node;
            node.kind = NodeKind::BrokenReference;
            node.begin = token.begin;
            node.end = token.end;
            return add(std::move(node));
        }
        case TokenKind::QuotedSheet:
            return reference();
        case TokenKind::Word:
            if (peek(1).kind == TokenKind::Open) return call();
            if (peek(1).kind == TokenKind::Bang || looksLikeAddress(token.text)) return reference();
            fail(CellErrorCode::Name,
                 inQuotes(token.text) +
                     " is no cell and no function; use addresses such as A1 or Sheet2!B4.");
        default:
            break;
        }
        unexpected("a cell, a number or a parenthesis");
    }

    int number() {
        const Token& token = take();
        FormulaNode node;
        node.number = token.number;
        node.begin = token.begin;
        node.end = token.end;
        return add(std::move(node));
    }

    int parentheses() {
        const Level level(*this);
        take();
        const int inside = sum();
        if (!accept(TokenKind::Close)) unexpected("a closing parenthesis");
        return inside;
    }

    int call() {
        const Level level(*this);
        FormulaNode node;
        node.kind = NodeKind::Call;
        node.begin = peek().begin;
        node.name = lowerAscii(take().text);
        take();
        if (peek().kind != TokenKind::Close) {
            do
                node.children.push_back(sum());
            while (accept(TokenKind::Comma));
        }
        node.end = peek().end;
        if (!accept(TokenKind::Close)) unexpected("a comma or a closing parenthesis");
        return add(std::move(node));
    }

    int reference() {
        FormulaNode node;
        node.kind = NodeKind::Reference;
        node.begin = peek().begin;
        if (peek(1).kind == TokenKind::Bang) {
            node.name = take().text;
            take();
        } else if (peek().kind == TokenKind::QuotedSheet) {
            take();
            unexpected("! and a cell");
        }
        const Address first = address(node.end);
        node.range = {first, first};
        if (accept(TokenKind::Colon)) {
            const Address last = address(node.end);
            node.kind = NodeKind::RangeReference;
            node.range = {{std::min(first.column, last.column), std::min(first.row, last.row)},
                          {std::max(first.column, last.column), std::max(first.row, last.row)}};
        }
        return add(std::move(node));
    }

    Address address(std::size_t& end) {
        if (peek().kind != TokenKind::Word || !looksLikeAddress(peek().text)) unexpected("a cell such as A1");
        const Token& token = take();
        end = token.end;
        try {
            return parseAddress(token.text);
        } catch (const InvalidInput& error) {
            fail(CellErrorCode::Ref,
                 token.text + " is no cell of any sheet: " + error.why() + "; " + error.toDo() + ".");
        }
    }

    std::vector<Token> tokens_;
    std::size_t at_ = 0;
    int depth_ = 0;
    FormulaAst ast_;
};

} // namespace

std::variant<FormulaAst, CellError> parseFormula(std::string_view text) {
    if (text.size() > kMaxFormulaBytes)
        return CellError{CellErrorCode::Name, "The formula is longer than " +
                                                  std::to_string(kMaxFormulaBytes) +
                                                  " bytes; split it over several cells."};
    try {
        return Parser(text).run();
    } catch (const ParseFailure& failure) {
        return failure.error;
    }
}

} // namespace voxsheet::sheet
