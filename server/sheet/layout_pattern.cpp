#include "sheet/layout_pattern.h"

#include "base/errors.h"
#include "sheet/dataset_names.h"
#include "sheet/utf8.h"

#include <algorithm>
#include <map>
#include <optional>

namespace voxsheet::sheet {

namespace {

enum class PieceKind { Literal, Row, Column, Any };

struct Piece {
    PieceKind kind = PieceKind::Literal;
    std::string text; ///< Literal
};

struct Labels {
    std::string row;
    std::string column;
};

InvalidInput badPattern(std::string_view pattern, const std::string& why) {
    InvalidInput error("layout pattern " + inQuotes(pattern), why,
                       "write a file name with {row} and {col}, for example sub-{row}_{col}.nii.gz");
    error.withField("layout");
    return error;
}

std::vector<Piece> parsePattern(std::string_view pattern) {
    std::vector<Piece> pieces;
    std::string literal;
    const auto flush = [&] {
        if (!literal.empty()) pieces.push_back({PieceKind::Literal, literal});
        literal.clear();
    };
    const auto special = [&](PieceKind kind, std::size_t length) {
        flush();
        const bool again =
            kind != PieceKind::Any &&
            std::any_of(pieces.begin(), pieces.end(), [&](const Piece& p) { return p.kind == kind; });
        if (again) throw badPattern(pattern, "has a placeholder twice");
        pieces.push_back({kind, {}});
        return length;
    };
    for (std::size_t at = 0; at < pattern.size();) {
        const std::string_view rest = pattern.substr(at);
        if (rest.starts_with("{row}"))
            at += special(PieceKind::Row, 5);
        else if (rest.starts_with("{col}"))
            at += special(PieceKind::Column, 5);
        else if (rest.front() == '*')
            at += special(PieceKind::Any, 1);
        else if (rest.front() == '{' || rest.front() == '}')
            throw badPattern(pattern, "has a brace that belongs to neither {row} nor {col}");
        else
            literal += pattern[at++];
    }
    flush();
    const bool any = std::any_of(pieces.begin(), pieces.end(), [](const Piece& piece) {
        return piece.kind == PieceKind::Row || piece.kind == PieceKind::Column;
    });
    if (!any) throw badPattern(pattern, "has neither {row} nor {col}");
    return pieces;
}

/// The placeholders' texts, the earliest as short as possible. Positions that failed are remembered: the work
/// is at most pieces x length + 2 x length^2, whatever the pattern.
class Matcher {
public:
    Matcher(const std::vector<Piece>& pieces, std::string_view text)
        : pieces_(pieces), text_(text),
          failed_(pieces.size() + 1, std::vector<bool>(text.size() + 1, false)) {}

    std::optional<Labels> run() {
        constexpr std::size_t longest = 4096; // of a path; also bounds the recursion
        if (text_.size() > longest || !match(0, 0)) return std::nullopt;
        return labels_;
    }

private:
    bool match(std::size_t piece, std::size_t at) {
        if (piece == pieces_.size()) return at == text_.size();
        if (failed_[piece][at]) return false;
        const PieceKind kind = pieces_[piece].kind;
        const bool good = kind == PieceKind::Literal ? literal(piece, at)
                          : kind == PieceKind::Any   ? anything(piece, at)
                                                     : placeholder(piece, at);
        if (!good) failed_[piece][at] = true;
        return good;
    }

    bool literal(std::size_t piece, std::size_t at) {
        const std::string& wanted = pieces_[piece].text;
        return text_.substr(at, wanted.size()) == wanted && match(piece + 1, at + wanted.size());
    }

    bool anything(std::size_t piece, std::size_t at) {
        if (match(piece + 1, at)) return true;
        return at < text_.size() && text_[at] != '/' && match(piece, at + 1);
    }

    bool placeholder(std::size_t piece, std::size_t at) {
        const PieceKind kind = pieces_[piece].kind;
        for (std::size_t length = 1; at + length <= text_.size(); ++length) {
            if (text_[at + length - 1] == '/') return false;
            if (!match(piece + 1, at + length)) continue;
            if (kind == PieceKind::Row) labels_.row = text_.substr(at, length);
            if (kind == PieceKind::Column) labels_.column = text_.substr(at, length);
            return true;
        }
        return false;
    }

    const std::vector<Piece>& pieces_;
    std::string_view text_;
    std::vector<std::vector<bool>> failed_;
    Labels labels_;
};

/// As many last components of the path as the pattern has.
std::string_view lastComponents(std::string_view path, std::size_t count) {
    std::size_t at = path.size();
    for (std::size_t i = 0; i < count; ++i) {
        const std::size_t slash = at == 0 ? std::string_view::npos : path.rfind('/', at - 1);
        if (slash == std::string_view::npos) return path;
        at = slash;
    }
    return path.substr(at + 1);
}

std::vector<std::string> sortedUnique(std::vector<std::string> labels) {
    sortNaturally(labels);
    labels.erase(std::unique(labels.begin(), labels.end()), labels.end());
    return labels;
}

int indexOf(const std::vector<std::string>& labels, const std::string& label) {
    return static_cast<int>(std::find(labels.begin(), labels.end(), label) - labels.begin());
}

} // namespace

PatternPlacement placeByPattern(std::string_view pattern, const std::vector<std::string>& paths) {
    if (pattern.size() > 1000) throw badPattern(pattern, "is longer than 1000 bytes");
    const std::vector<Piece> pieces = parsePattern(pattern);
    const auto depth = static_cast<std::size_t>(std::count(pattern.begin(), pattern.end(), '/')) + 1;
    std::vector<Labels> labels;
    std::vector<std::string> rows;
    std::vector<std::string> columns;
    for (const std::string& path : paths) {
        const std::optional<Labels> found = Matcher(pieces, lastComponents(path, depth)).run();
        if (!found)
            throw InvalidInput(inQuotes(path), "does not match the layout pattern " + inQuotes(pattern),
                               "leave the file out or change the pattern")
                .withField("layout");
        labels.push_back(*found);
        rows.push_back(found->row);
        columns.push_back(found->column);
    }
    PatternPlacement placement;
    placement.rowTitles = sortedUnique(rows);
    placement.columnTitles = sortedUnique(columns);
    if (placement.rowTitles.size() > kMaxRows || placement.columnTitles.size() > kMaxColumns ||
        placement.rowTitles.size() * placement.columnTitles.size() > kMaxCells)
        throw LimitExceeded("layout by " + inQuotes(pattern),
                            "would need " + std::to_string(placement.columnTitles.size()) + " columns and " +
                                std::to_string(placement.rowTitles.size()) + " rows",
                            "use a pattern with fewer different parts");
    std::map<Address, std::size_t> taken;
    for (std::size_t i = 0; i < labels.size(); ++i) {
        const Address at{indexOf(placement.columnTitles, labels[i].column),
                         indexOf(placement.rowTitles, labels[i].row)};
        const auto [other, isNew] = taken.emplace(at, i);
        if (!isNew)
            throw InvalidInput(inQuotes(paths[i]),
                               "would share cell " + addressName(at) + " with " +
                                   inQuotes(paths[other->second]),
                               "make the pattern tell them apart")
                .withField("layout");
        placement.places.push_back(at);
    }
    placement.layout = {std::max(1, static_cast<int>(placement.columnTitles.size())),
                        std::max(1, static_cast<int>(placement.rowTitles.size()))};
    return placement;
}

} // namespace voxsheet::sheet
