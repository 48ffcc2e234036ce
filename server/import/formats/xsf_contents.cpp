#include "import/formats/xsf_contents.h"

#include "base/errors.h"
#include "import/formats/field_names.h"
#include "import/formats/grid_text.h"
#include "import/formats/number_text.h"
#include "import/formats/voxel_plan.h"
#include "volume/elements.h"

#include <algorithm>
#include <utility>

namespace voxsheet::import {

namespace {

constexpr std::array<std::pair<std::string_view, int>, 4> kStructures{
    {{"MOLECULE", 0}, {"POLYMER", 1}, {"SLAB", 2}, {"CRYSTAL", 3}}};

std::optional<int> periodicAxesOf(std::string_view keyword) {
    for (const auto& [word, axes] : kStructures)
        if (keyword == word) return axes;
    return std::nullopt;
}

std::string_view firstWord(std::string_view line) {
    const auto words = splitWords(line);
    return words.empty() ? std::string_view{} : words[0];
}

bool isComment(std::string_view line) {
    const auto text = trimmed(line);
    return text.empty() || text[0] == '#';
}

/// What follows DATAGRID_3D in a line that begins a grid; XCrySDen takes it with and without "BEGIN_".
std::optional<std::string> gridName(std::string_view line) {
    auto text = trimmed(line);
    if (text.starts_with("BEGIN_")) text.remove_prefix(6);
    for (const std::string_view word : {"DATAGRID_3D", "DATAGRID3D"})
        if (text.starts_with(word)) {
            text.remove_prefix(word.size());
            if (text.starts_with('_')) text.remove_prefix(1);
            return printable(text);
        }
    return std::nullopt;
}

bool beginsGridBlock(std::string_view word) {
    return word.starts_with("BEGIN_BLOCK_DATAGRID_3D") || word.starts_with("BEGIN_BLOCK_DATAGRID3D");
}

bool isKeyword(std::string_view word) {
    constexpr std::array<std::string_view, 7> words{"PRIMVEC",   "CONVVEC",   "PRIMCOORD", "CONVCOORD",
                                                    "DIM-GROUP", "ANIMSTEPS", "ATOMS"};
    return periodicAxesOf(word) || std::find(words.begin(), words.end(), word) != words.end() ||
           word.starts_with("BEGIN_BLOCK_") || word == "BEGIN_INFO";
}

class XsfParser {
public:
    XsfParser(const InputFile& file, TextScanner& text, const ImportLimits& limits)
        : file_(file), name_(file.name()), text_(text), limits_(limits) {}

    XsfContents read() {
        while (const auto line = nextLine())
            readSection(*line);
        if (contents_.grids.empty()) refuseWithoutGrid();
        contents_.periodicAxes = structure_.value_or(contents_.primitive ? 3 : 0);
        if (skippedBlocks_ > 0)
            contents_.notes.push_back("The file also holds data other than three-dimensional grids (" +
                                      lastSkipped_ + "), which were not read.");
        if (unknownElements_)
            contents_.notes.emplace_back("Some of the file's atoms are no chemical elements.");
        return std::move(contents_);
    }

private:
    [[noreturn]] void fail(const std::string& why, const std::string& toDo = {}) const {
        throw InvalidInput(name_, why, toDo);
    }

    [[noreturn]] void refuseWithoutGrid() const {
        if (skippedBlocks_ > 0)
            throw Unsupported(name_, "it holds " + lastSkipped_ + " but no three-dimensional grid",
                              "open a file with a block DATAGRID_3D");
        fail("it holds a structure but no grid", "open a file with a block DATAGRID_3D");
    }

    /// The next line that is neither blank nor a comment.
    std::optional<std::string> nextLine() {
        if (pending_) return std::exchange(pending_, std::nullopt);
        while (const auto line = text_.line())
            if (!isComment(*line)) return std::string(trimmed(*line));
        return std::nullopt;
    }

    std::string need(const std::string& what) {
        auto line = nextLine();
        if (!line) fail("it ends before " + what, "copy the file again, or let the calculation finish");
        return *line;
    }

    glm::dvec3 needVector(const std::string& what) {
        const auto line = need(what);
        const auto vector = leadingVector(line);
        if (!vector) fail(what + " should be three numbers, not '" + printable(line) + "'");
        return *vector;
    }

    AxisColumns needVectors(const std::string& what, const char* plural) {
        AxisColumns columns;
        for (auto& column : columns)
            column = needVector(what);
        checkSpanSpace(name_, plural, columns);
        return columns;
    }

    void readSection(const std::string& line) {
        const auto words = splitWords(line);
        const auto keyword = words[0];
        if (keyword == "ANIMSTEPS" || (words.size() > 1 && isKeyword(keyword) && parseInteger(words[1])))
            throw Unsupported(name_, "it is an animation (ANIMSTEPS)",
                              "write each of its steps into an XSF file of its own");
        if (const auto axes = periodicAxesOf(keyword))
            structure_ = axes;
        else if (keyword == "DIM-GROUP")
            readPeriodicity();
        else if (keyword == "PRIMVEC")
            contents_.primitive = needVectors("a lattice vector", "lattice vectors");
        else if (keyword == "CONVVEC")
            (void)needVectors("a lattice vector", "lattice vectors");
        else if (keyword == "PRIMCOORD")
            contents_.atoms = readCountedAtoms();
        else if (keyword == "CONVCOORD")
            (void)readCountedAtoms();
        else if (keyword == "ATOMS")
            readAtomsToTheEnd();
        else if (beginsGridBlock(keyword))
            readGridBlock();
        else if (keyword.starts_with("BEGIN_"))
            skipBlock(std::string(keyword.substr(6)));
        else
            fail("its line '" + printable(line) + "' is no keyword of XSF", "correct the line or remove it");
    }

    void readPeriodicity() {
        const auto line = need("the numbers of DIM-GROUP");
        const auto axes = parseInteger(firstWord(line));
        if (!axes || *axes < 0 || *axes > 3) fail("DIM-GROUP cannot be '" + printable(line) + "'");
        structure_ = static_cast<int>(*axes);
    }

    /// "Z x y z" or "symbol x y z"; forces may follow.
    std::optional<Atom> atomOf(const std::string& line) {
        constexpr std::int64_t heaviest = 118;
        const auto words = splitWords(line);
        if (words.size() < 4) return std::nullopt;
        const auto rest = line.substr(static_cast<std::size_t>(words[1].data() - line.data()));
        const auto position = leadingVector(rest);
        if (!position) return std::nullopt;
        const auto number = parseInteger(words[0]).value_or(atomicNumber(words[0]));
        const bool element = number >= 1 && number <= heaviest;
        if (!element) unknownElements_ = true;
        return Atom{element ? static_cast<int>(number) : 0, *position};
    }

    std::vector<Atom> readCountedAtoms() {
        constexpr std::int64_t mostAtoms = 10'000'000;
        const auto line = need("its number of atoms");
        const auto count = parseInteger(firstWord(line));
        if (!count || *count < 0 || *count > mostAtoms)
            fail("its number of atoms cannot be '" + printable(line) + "'");
        std::vector<Atom> atoms;
        for (std::int64_t index = 0; index < *count; ++index) {
            const auto text = need("its last atom");
            const auto atom = atomOf(text);
            if (!atom) fail("an atom should be its element and position, not '" + printable(text) + "'");
            atoms.push_back(*atom);
        }
        return atoms;
    }

    void readAtomsToTheEnd() {
        while (auto line = nextLine()) {
            const auto atom = atomOf(*line);
            if (!atom) {
                pending_ = std::move(line);
                return;
            }
            contents_.atoms.push_back(*atom);
        }
    }

    void skipBlock(const std::string& block) {
        const auto end = "END_" + block.substr(0, block.find('_', block.find('_') + 1));
        while (firstWord(need("END_" + printable(block))).substr(0, end.size()) != end) {
        }
        if (block == "INFO") return;
        ++skippedBlocks_;
        lastSkipped_ = printable(block);
    }

    /// BEGIN_BLOCK_DATAGRID_3D was read: a line of comment, which may look like anything, then grids.
    void readGridBlock() {
        const auto comment = text_.line();
        if (!comment) fail("it ends within a block of grids", "copy the file again");
        if (gridName(*comment)) pending_ = std::string(*comment);
        for (;;) {
            const auto line = need("END_BLOCK_DATAGRID_3D");
            if (line.starts_with("END_BLOCK_DATAGRID")) return;
            const auto name = gridName(line);
            if (!name) fail("a grid should begin at '" + printable(line) + "'");
            readGrid(*name);
        }
    }

    void readGrid(const std::string& name) {
        constexpr std::int64_t mostSamples = 1 << 30; // along an axis
        XsfGrid grid;
        grid.name = name;
        const auto line = need("the numbers of samples of a grid");
        const auto samples = parseIntegers(line, 3);
        if (!samples || !std::all_of(samples->begin(), samples->end(),
                                     [](std::int64_t count) { return count >= 1 && count <= mostSamples; }))
            fail("its numbers of samples cannot be '" + printable(line) + "'");
        std::copy(samples->begin(), samples->end(), grid.samples.begin());
        grid.origin = needVector("the origin of a grid");
        grid.spanning = needVectors("a spanning vector of a grid", "spanning vectors");
        grid.dataPosition = text_.position();

        bytes_ += checkedBytes(name_, *samples, sizeof(double), limits_);
        if (bytes_ > limits_.maxBytes)
            throw LimitExceeded(name_,
                                "its grids need more than " + std::to_string(limits_.maxBytes) + " bytes",
                                "write fewer grids into a file");
        checkTextHolds(file_, bytes_ / sizeof(double));
        contents_.grids.push_back(grid);
        checkFieldsAndSteps(name_, static_cast<std::int64_t>(contents_.grids.size()), 1);
        skipGrid(file_, text_, grid.values(), "grid " + std::to_string(contents_.grids.size()));
        if (const auto end = need("END_DATAGRID_3D"); !end.starts_with("END_DATAGRID"))
            fail("grid " + std::to_string(contents_.grids.size()) +
                     " should end after its last value, not go on with '" + printable(end) + "'",
                 "correct its numbers of samples");
    }

    const InputFile& file_;
    std::string name_;
    TextScanner& text_;
    const ImportLimits& limits_;
    XsfContents contents_;
    std::optional<int> structure_; ///< periodic axes, where the file says so
    std::optional<std::string> pending_;
    std::uint64_t bytes_ = 0; ///< of the grids so far, stored
    int skippedBlocks_ = 0;
    std::string lastSkipped_;
    bool unknownElements_ = false;
};

} // namespace

bool looksLikeXsf(std::string_view head) {
    if (head.find('\0') != std::string_view::npos) return false;
    std::array<std::string_view, 2> lines; // that are neither blank nor comments
    for (auto& line : lines)
        do {
            const auto next = takeLine(head);
            if (!next) return false;
            line = trimmed(*next);
        } while (isComment(line));
    const auto keyword = firstWord(lines[0]);
    if (!isKeyword(keyword)) return false;
    // Other texts may have such a word as their title.
    if (keyword == "ANIMSTEPS") return splitWords(lines[0]).size() == 2;
    if (keyword != lines[0]) return false;
    if (keyword.starts_with("BEGIN_")) return true;
    if (periodicAxesOf(keyword)) return isKeyword(firstWord(lines[1]));
    return splitWords(lines[1]).size() >= 2;
}

XsfContents readXsfContents(const InputFile& file, TextScanner& text, const ImportLimits& limits) {
    return XsfParser(file, text, limits).read();
}

} // namespace voxsheet::import
