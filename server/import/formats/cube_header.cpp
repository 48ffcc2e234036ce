#include "import/formats/cube_header.h"

#include "base/errors.h"
#include "import/formats/field_names.h"
#include "import/formats/grid_text.h"
#include "import/formats/number_text.h"

#include <cmath>
#include <optional>

namespace voxsheet::import {

namespace {

constexpr double kAngstromFromBohr = 0.529177210903; // CODATA 2018
constexpr std::int64_t kMostAtoms = 10'000'000;
constexpr std::int64_t kMostSamples = 1 << 30; // along an axis

/// "N x y z", and for the atoms' line "N x y z NVAL".
struct CountLine {
    std::int64_t count = 0;
    glm::dvec3 vector{0.0};
    std::optional<std::int64_t> values;
};

std::optional<CountLine> countLine(std::string_view line, bool mayHaveValues) {
    const auto words = splitWords(line);
    if (words.size() != 4 && !(mayHaveValues && words.size() == 5)) return std::nullopt;
    const auto count = parseInteger(words[0]);
    const auto vector = leadingVector(line.substr(static_cast<std::size_t>(words[1].data() - line.data())));
    if (!count || !vector) return std::nullopt;
    CountLine result{*count, *vector, std::nullopt};
    if (words.size() == 5) {
        result.values = parseInteger(words[4]);
        if (!result.values) return std::nullopt;
    }
    return result;
}

/// "Z charge x y z"; the charge may differ from Z (pseudopotentials) and is not kept.
std::optional<Atom> atomLine(std::string_view line) {
    constexpr std::int64_t heaviest = 118;
    const auto words = splitWords(line);
    if (words.size() != 5) return std::nullopt;
    const auto number = parseInteger(words[0]);
    const auto charge = parseFortranNumber(words[1]);
    const auto at = leadingVector(line.substr(static_cast<std::size_t>(words[2].data() - line.data())));
    if (!number || !charge || !at) return std::nullopt;
    const bool element = *number >= 1 && *number <= heaviest; // 0: a ghost atom
    return Atom{element ? static_cast<int>(*number) : 0, *at};
}

class CubeHeaderReader {
public:
    CubeHeaderReader(const std::string& name, TextScanner& text) : name_(name), text_(text) {}

    CubeHeader read() {
        const auto title = printable(trimmed(need("its comments")));
        const auto subtitle = printable(trimmed(need("its comments")));
        header_.crystal.comment = title + (title.empty() || subtitle.empty() ? "" : "; ") + subtitle;
        const auto atoms = readAtomCount();
        readAxes();
        readAtoms(std::abs(atoms.count));
        nameFields(atoms);
        return header_;
    }

private:
    [[noreturn]] void fail(const std::string& why, const std::string& toDo = {}) const {
        throw InvalidInput(name_, why, toDo);
    }

    std::string need(const char* what) {
        const auto line = text_.line();
        if (!line)
            fail(std::string("it ends before ") + what, "copy the file again, or let the calculation finish");
        return std::string(*line);
    }

    CountLine readAtomCount() {
        const auto text = need("its number of atoms");
        const auto line = countLine(text, true);
        if (!line)
            fail("its third line is no number of atoms and origin: '" + printable(trimmed(text)) + "'",
                 "check that it is a Gaussian cube file");
        if (line->count < -kMostAtoms || line->count > kMostAtoms)
            fail("it cannot have " + std::to_string(line->count) + " atoms");
        if (line->values && *line->values < 1)
            fail("it says " + std::to_string(*line->values) + " values at a voxel", "correct its third line");
        header_.origin = line->vector;
        return *line;
    }

    void readAxes() {
        int inAngstrom = 0;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const auto text = need("its voxel vectors");
            const auto line = countLine(text, false);
            if (!line)
                fail("line " + std::to_string(axis + 4) + " is no number of voxels and vector: '" +
                     printable(trimmed(text)) + "'");
            if (line->count == 0 || line->count < -kMostSamples || line->count > kMostSamples)
                fail("it cannot have " + std::to_string(line->count) + " voxels along an axis");
            const bool angstrom = line->count < 0;
            header_.samples[axis] = std::abs(line->count);
            header_.voxelVectors[axis] = line->vector * (angstrom ? 1.0 : kAngstromFromBohr);
            if (angstrom) ++inAngstrom;
        }
        checkSpanSpace(name_, "voxel vectors", header_.voxelVectors);
        positionScale_ = inAngstrom == 3 ? 1.0 : kAngstromFromBohr;
        if (inAngstrom == 1 || inAngstrom == 2)
            header_.notes.emplace_back("The signs of the voxel numbers mix Å and Bohr: each voxel vector is "
                                       "taken in its own unit, origin and atoms in Bohr.");
        header_.origin *= positionScale_;
        for (std::size_t axis = 0; axis < 3; ++axis)
            header_.crystal.lattice[static_cast<glm::length_t>(axis)] =
                header_.voxelVectors[axis] * static_cast<double>(header_.samples[axis]);
    }

    void readAtoms(std::int64_t count) {
        for (std::int64_t atom = 0; atom < count; ++atom) {
            const auto text = need("its last atom");
            auto line = atomLine(text);
            if (!line)
                fail("atom " + std::to_string(atom + 1) + " is no atomic number, charge and position: '" +
                     printable(trimmed(text)) + "'");
            line->positionWorld *= positionScale_;
            header_.crystal.atoms.push_back(*line);
        }
    }

    /// A negative number of atoms announces a list of orbitals: their number, then their ids, on as many
    /// lines as it takes.
    void nameFields(const CountLine& atoms) {
        const auto values = atoms.values.value_or(1);
        checkFieldsAndSteps(name_, values, 1);
        if (atoms.count >= 0) {
            for (std::int64_t value = 1; value <= values; ++value)
                header_.fields.push_back(values == 1 ? "value" : "value " + std::to_string(value));
            return;
        }
        const auto count = needInteger("its number of data sets");
        if (count < 1)
            fail("it says " + std::to_string(count) + " data sets", "correct the line after the atoms");
        checkFieldsAndSteps(name_, count, 1);
        if (values > 1)
            throw Unsupported(name_,
                              "it has " + std::to_string(count) + " orbitals of " + std::to_string(values) +
                                  " values each",
                              "write each orbital into its own cube file");
        for (std::int64_t orbital = 0; orbital < count; ++orbital)
            header_.fields.push_back("orbital " + std::to_string(needInteger("the ids of its data sets")));
        header_.fields = uniqueNames(std::move(header_.fields));
    }

    std::int64_t needInteger(const char* what) {
        const auto word = text_.word();
        if (word.empty()) fail(std::string("it ends before ") + what, "copy the file again");
        const auto number = parseInteger(word);
        if (!number) fail("it holds '" + printable(word) + "' in place of " + what);
        return *number;
    }

    const std::string& name_;
    TextScanner& text_;
    CubeHeader header_;
    double positionScale_ = 1.0;
};

} // namespace

bool looksLikeCube(std::string_view head) {
    if (head.find('\0') != std::string_view::npos) return false;
    (void)takeLine(head);
    (void)takeLine(head);
    const auto atoms = countLine(takeLine(head).value_or(""), true);
    if (!atoms) return false;
    for (int axis = 0; axis < 3; ++axis)
        if (!countLine(takeLine(head).value_or(""), false)) return false;
    return atoms->count == 0 || atomLine(takeLine(head).value_or(""));
}

CubeHeader readCubeHeader(const std::string& name, TextScanner& text) {
    return CubeHeaderReader(name, text).read();
}

} // namespace voxsheet::import
