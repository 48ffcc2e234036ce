#include "import/formats/chgcar_header.h"

#include "base/errors.h"
#include "import/formats/grid_text.h"
#include "import/formats/number_text.h"
#include "volume/elements.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace voxsheet::import {

namespace {

constexpr std::int64_t kMostAtoms = 10'000'000;

std::optional<std::vector<std::int64_t>> atomCounts(std::string_view line) {
    const auto words = splitWords(line);
    auto counts = parseIntegers(line, words.size());
    if (words.empty() || !counts) return std::nullopt;
    for (const auto count : *counts)
        if (count < 0 || count > kMostAtoms) return std::nullopt;
    return counts;
}

/// "Na_pv" and "Na/5f0a" are sodium: the potential's name follows the symbol.
int speciesNumber(std::string_view word) { return atomicNumber(word.substr(0, word.find_first_of("_/"))); }

bool startsWithAny(std::string_view line, std::string_view letters) {
    const auto text = trimmed(line);
    return !text.empty() && letters.find(text[0]) != std::string_view::npos;
}

class StructureReader {
public:
    StructureReader(const std::string& name, TextScanner& text) : name_(name), text_(text) {}

    ChgcarStructure read() {
        structure_.firstLine = std::string(trimmed(need("the comment")));
        structure_.crystal.comment = printable(structure_.firstLine);
        readLattice();
        readSpecies();
        readAtoms();
        return structure_;
    }

private:
    [[noreturn]] void fail(const std::string& why) const { throw InvalidInput(name_, why); }

    std::string need(const char* what) {
        const auto line = text_.line();
        if (!line) fail(std::string("it ends before ") + what);
        return std::string(*line);
    }

    void readLattice() {
        const auto scaleLine = need("the scale");
        const auto words = splitWords(scaleLine);
        glm::dvec3 scale(0.0);
        if (const auto three = leadingVector(scaleLine); three && words.size() == 3)
            scale = *three;
        else if (const auto one = words.size() == 1 ? parseFortranNumber(words[0]) : std::nullopt)
            scale = glm::dvec3(*one);
        else
            fail("its second line is no scale: '" + printable(scaleLine) + "'");
        auto& lattice = structure_.crystal.lattice;
        for (glm::length_t axis = 0; axis < 3; ++axis) {
            const auto line = need("the lattice vectors");
            const auto vector = leadingVector(line);
            if (!vector) fail("a lattice vector is no three numbers: '" + printable(line) + "'");
            lattice[axis] = *vector;
        }
        const double volume = std::abs(glm::determinant(lattice));
        if (scale.x < 0.0 && scale.x == scale.y)
            scale = glm::dvec3(std::cbrt(-scale.x / volume)); // the cell's volume
        for (glm::length_t axis = 0; axis < 3; ++axis) {
            if (!std::isfinite(scale[axis]) || scale[axis] <= 0.0)
                fail("its scale is not possible: '" + printable(scaleLine) + "'");
        }
        for (glm::length_t axis = 0; axis < 3; ++axis)
            lattice[axis] *= scale;
        scale_ = scale;
        const double scaled = std::abs(glm::determinant(lattice));
        if (!std::isfinite(scaled) || scaled == 0.0) fail("its lattice vectors do not span a cell");
    }

    void readSpecies() {
        auto line = need("the numbers of atoms");
        std::vector<std::string> symbols;
        counts_ = atomCounts(line).value_or(std::vector<std::int64_t>{});
        if (counts_.empty()) {
            for (const auto word : splitWords(line))
                symbols.emplace_back(word);
            line = need("the numbers of atoms");
            counts_ = atomCounts(line).value_or(std::vector<std::int64_t>{});
        } else {
            symbols = symbolsFromComment();
        }
        if (counts_.empty() || (!symbols.empty() && symbols.size() != counts_.size()))
            fail("its numbers of atoms cannot be '" + printable(line) + "'");
        numbers_.assign(counts_.size(), 0);
        for (std::size_t species = 0; species < symbols.size(); ++species) {
            numbers_[species] = speciesNumber(symbols[species]);
            if (numbers_[species] == 0)
                structure_.notes.push_back("'" + printable(symbols[species]) + "' is no chemical element.");
        }
        if (symbols.empty()) structure_.notes.emplace_back("The file does not name its elements (VASP 4).");
    }

    /// VASP 4 files have no line of symbols; people write them into the comment.
    std::vector<std::string> symbolsFromComment() const {
        std::vector<std::string> symbols;
        for (const auto word : splitWords(structure_.firstLine)) {
            if (speciesNumber(word) == 0) return {};
            symbols.emplace_back(word);
        }
        if (symbols.size() != counts_.size()) symbols.clear();
        return symbols;
    }

    void readAtoms() {
        auto line = need("the coordinate system");
        if (startsWithAny(line, "sS")) line = need("the coordinate system");
        const bool cartesian = startsWithAny(line, "cCkK");
        if (!cartesian && !startsWithAny(line, "dD"))
            fail("its coordinates are neither Direct nor Cartesian: '" + printable(line) + "'");
        for (std::size_t species = 0; species < counts_.size(); ++species) {
            for (std::int64_t atom = 0; atom < counts_[species]; ++atom) {
                const auto text = need("its last atom");
                const auto position = leadingVector(text);
                if (!position) fail("the position of an atom is no three numbers: '" + printable(text) + "'");
                structure_.crystal.atoms.push_back(
                    {numbers_[species],
                     cartesian ? scale_ * *position : structure_.crystal.lattice * *position});
            }
        }
        if (static_cast<std::int64_t>(structure_.crystal.atoms.size()) > kMostAtoms)
            fail("it has too many atoms");
    }

    const std::string& name_;
    TextScanner& text_;
    ChgcarStructure structure_;
    glm::dvec3 scale_{1.0};
    std::vector<std::int64_t> counts_;
    std::vector<int> numbers_;
};

} // namespace

bool looksLikeChgcar(std::string_view head) {
    (void)takeLine(head);
    const auto scale = takeLine(head).value_or("");
    const auto scaleWords = splitWords(scale);
    if (scaleWords.size() != 1 && scaleWords.size() != 3) return false;
    for (const auto word : scaleWords)
        if (!parseFortranNumber(word)) return false;
    for (int axis = 0; axis < 3; ++axis)
        if (!leadingVector(takeLine(head).value_or(""))) return false;
    if (!atomCounts(takeLine(head).value_or("")) && !atomCounts(takeLine(head).value_or(""))) return false;
    return startsWithAny(takeLine(head).value_or(""), "sSdDcCkK");
}

ChgcarKind chgcarKind(const std::string& fileName) {
    auto name = lowerCase(fileName);
    const auto has = [&](const char* word) { return name.find(word) != std::string::npos; };
    const std::vector<std::string> density{"density"};
    const std::vector<std::string> spins{"density", "magnetization"};
    if (has("locpot"))
        return {"local potential", "eV", false, true, {"potential"}, {"potential up", "potential down"}};
    if (has("elfcar"))
        return {"electron localization function", "", false, true, {"elf"}, {"elf up", "elf down"}};
    if (has("aeccar")) return {"all-electron charge density", "e/Å^3", true, true, density, spins};
    if (has("parchg")) return {"partial charge density", "e/Å^3", true, true, density, spins};
    return {"charge density", "e/Å^3", true, has("chg"), density, spins};
}

bool namedLikeChgcar(const std::string& fileName) {
    const auto name = lowerCase(fileName);
    static constexpr std::array<const char*, 5> words{"chgcar", "locpot", "aeccar", "parchg", "elfcar"};
    return std::any_of(words.begin(), words.end(),
                       [&](const char* word) { return name.find(word) != std::string::npos; });
}

ChgcarStructure readChgcarStructure(const std::string& name, TextScanner& text) {
    return StructureReader(name, text).read();
}

std::optional<glm::ivec3> findChgcarGrid(TextScanner& text, const std::optional<glm::ivec3>& expected,
                                         const std::string& frameLine, bool& newFrame) {
    constexpr std::uint64_t mostBytes = 256ULL << 20; // augmentation data: about a kilobyte an atom
    const auto start = text.position();
    newFrame = false;
    while (const auto line = text.line()) {
        if (text.position() - start > mostBytes) return std::nullopt;
        const auto content = trimmed(*line);
        if (content.empty()) continue;
        if (expected && content == frameLine) {
            newFrame = true;
            return std::nullopt;
        }
        const auto dims = parseIntegers(content, 3);
        if (dims) {
            const auto inRange = [](std::int64_t size) { return size >= 1 && size <= 1 << 30; };
            const bool possible = std::all_of(dims->begin(), dims->end(), inRange);
            const auto found = possible
                                   ? glm::ivec3(static_cast<int>((*dims)[0]), static_cast<int>((*dims)[1]),
                                                static_cast<int>((*dims)[2]))
                                   : glm::ivec3(0);
            if (!expected || found == *expected) return found;
        } else if (!expected) {
            return std::nullopt; // right after the atoms comes the grid, or there is none
        }
    }
    return std::nullopt;
}

} // namespace voxsheet::import
