#include "import/formats/xsf_reader.h"

#include "base/errors.h"
#include "import/formats/field_names.h"
#include "import/formats/grid_text.h"
#include "import/formats/number_text.h"
#include "import/formats/xsf_contents.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <sstream>

namespace voxsheet::import {

namespace {

struct XsfPlan {
    std::filesystem::path file;
    std::vector<XsfGrid> grids;
};

constexpr std::array<const char*, 3> kAxisNames{"first", "second", "third"};

glm::dmat3 matrixOf(const AxisColumns& columns) { return {columns[0], columns[1], columns[2]}; }

bool namedLikeXsf(const std::filesystem::path& path) {
    auto name = path.filename();
    if (const auto ending = lowerCase(name.extension().string()); ending == ".gz" || ending == ".bz2")
        name = name.stem();
    const auto ending = lowerCase(name.extension().string());
    return ending == ".xsf" || ending == ".axsf";
}

/// The spanning vector is a translation that the structure repeats under.
bool isTranslation(const XsfContents& contents, int axis, const glm::dvec3& spanning) {
    constexpr double textTolerance = 1e-3; // of a lattice vector: files round to few digits
    if (!contents.primitive) return axis < contents.periodicAxes;
    const auto steps = glm::inverse(matrixOf(*contents.primitive)) * spanning;
    double longest = 0.0;
    for (int vector = 0; vector < 3; ++vector) {
        if (std::abs(steps[vector] - std::round(steps[vector])) > textTolerance) return false;
        if (vector >= contents.periodicAxes && std::round(steps[vector]) != 0.0) return false;
        longest = std::max(longest, std::abs(std::round(steps[vector])));
    }
    return longest > 0.0;
}

Grid gridOf(const XsfContents& contents, const XsfGrid& source, std::vector<std::string>& notes) {
    Grid grid;
    AxisColumns steps;
    for (int axis = 0; axis < 3; ++axis) {
        const auto at = static_cast<std::size_t>(axis);
        const auto samples = static_cast<int>(source.samples[at]);
        grid.periodic[axis] = isTranslation(contents, axis, source.spanning[at]);
        grid.dims[axis] = grid.periodic[axis] ? std::max(samples - 1, 1) : samples;
        steps[at] = source.spanning[at] / static_cast<double>(std::max(samples - 1, 1));
        if (!grid.periodic[axis] && contents.periodicAxes == 3)
            notes.push_back(std::string("The grid does not span whole cells along its ") + kAxisNames[at] +
                            " axis: it is not periodic there.");
    }
    grid.worldFromIndex = affine(steps, source.origin);
    validateGrid(grid);
    return grid;
}

std::string gridText(const XsfGrid& grid) {
    return "'" + grid.name + "' (" + std::to_string(grid.samples[0]) + " x " +
           std::to_string(grid.samples[1]) + " x " + std::to_string(grid.samples[2]) + ")";
}

/// Throws Unsupported unless all grids have the samples and the place of the first.
void checkSameGrids(const std::string& name, const std::vector<XsfGrid>& grids) {
    constexpr double textTolerance = 1e-6;
    const auto& first = grids[0];
    const double size = glm::length(first.spanning[0]) + glm::length(first.spanning[1]) +
                        glm::length(first.spanning[2]) + glm::length(first.origin);
    const auto near = [&](const glm::dvec3& one, const glm::dvec3& other) {
        return glm::distance(one, other) <= textTolerance * size;
    };
    for (const auto& grid : grids) {
        const bool same = grid.samples == first.samples;
        if (same && near(grid.origin, first.origin) &&
            std::equal(grid.spanning.begin(), grid.spanning.end(), first.spanning.begin(), near))
            continue;
        throw Unsupported(name,
                          "its grids " + gridText(first) + " and " + gridText(grid) + " differ in " +
                              (same ? "origin or spanning vectors" : "their numbers of samples"),
                          "write each grid into an XSF file of its own");
    }
}

/// How well the samples that are dropped repeat the first ones, over all grids.
struct Repetition {
    double low = std::numeric_limits<double>::infinity();
    double high = -std::numeric_limits<double>::infinity();
    double largestDifference = 0.0;

    void addDropped(double dropped, double kept) {
        if (std::isfinite(dropped) && std::isfinite(kept))
            largestDifference = std::max(largestDifference, std::abs(dropped - kept));
    }
    [[nodiscard]] bool fails() const {
        constexpr double textTolerance = 1e-3; // of the range: rounding, and interpolation by the writer
        return largestDifference > textTolerance * (high - low);
    }
};

/// Reads one grid of the file into `array`, which has the samples of `grid`.
void readGrid(GridValues& values, const XsfGrid& source, const Grid& grid, std::span<std::byte> array,
              Repetition& repetition, const std::function<void(double)>& progress) {
    const glm::i64vec3 dims(grid.dims);
    const auto place = [&](const glm::i64vec3& at) {
        const auto wrapped = at % dims; // beyond the kept samples only where they are dropped
        return array.data() +
               static_cast<std::size_t>(wrapped.x + dims.x * (wrapped.y + dims.y * wrapped.z)) *
                   sizeof(double);
    };
    for (std::int64_t z = 0; z < source.samples[2]; ++z) {
        for (std::int64_t y = 0; y < source.samples[1]; ++y)
            for (std::int64_t x = 0; x < source.samples[0]; ++x) {
                const double value = values.next();
                const glm::i64vec3 at(x, y, z);
                auto* const to = place(at);
                if (x < dims.x && y < dims.y && z < dims.z) {
                    std::memcpy(to, &value, sizeof(double));
                    repetition.low = std::min(repetition.low, value);
                    repetition.high = std::max(repetition.high, value);
                } else {
                    double kept = 0.0;
                    std::memcpy(&kept, to, sizeof(double)); // came before, as its place is a lower one
                    repetition.addDropped(value, kept);
                }
            }
        if (progress) progress(values.fraction());
    }
}

} // namespace

bool XsfReader::recognises(const FileHead& head, const ImportOptions&) const {
    if (looksLikeXsf(head.inflated)) return true;
    const bool text = head.inflated.find('\0') == std::string::npos;
    return text && namedLikeXsf(head.path);
}

SourceHeader XsfReader::readHeader(const std::filesystem::path& path, const ImportOptions&,
                                   const ImportLimits& limits) const {
    const InputFile file(path);
    auto text = openText(file);
    auto contents = readXsfContents(file, text, limits);
    checkSameGrids(file.name(), contents.grids);

    SourceHeader source;
    auto& meta = source.meta;
    meta.format = format();
    meta.notes = std::move(contents.notes);
    const auto& first = contents.grids[0];
    meta.grid = gridOf(contents, first, meta.notes);
    meta.lengthUnit = "Å";
    meta.sourceType = ScalarType::F64; // text, with exponents beyond a float's
    std::vector<std::string> names;
    for (const auto& grid : contents.grids)
        names.push_back(grid.name);
    names = uniqueNames(std::move(names));
    meta.fields = makeFields(static_cast<int>(names.size()), ScalarType::F64, names);
    Crystal crystal;
    crystal.lattice = matrixOf(contents.primitive.value_or(first.spanning));
    crystal.atoms = std::move(contents.atoms);
    meta.crystal = std::move(crystal);
    source.files.push_back(canonicalPath(path));
    source.plan = std::make_shared<XsfPlan>(XsfPlan{source.files[0], std::move(contents.grids)});
    return source;
}

std::vector<std::string> XsfReader::readData(const SourceHeader& header, const ArraySink& sink,
                                             const ReadProgress& progress) const {
    const auto& plan = *static_cast<const XsfPlan*>(header.plan.get());
    const InputFile file(plan.file);
    auto text = openText(file);
    Repetition repetition;
    const auto grids = static_cast<int>(plan.grids.size());
    for (int field = 0; field < grids; ++field) {
        const auto& source = plan.grids[static_cast<std::size_t>(field)];
        text.skipBytes(source.dataPosition - text.position());
        GridValues values(text, file.name(), source.values());
        std::vector<std::byte> array(header.arrayBytes(field));
        readGrid(values, source, header.meta.grid, array, repetition, [&](double fraction) {
            if (progress) progress((field + fraction) / grids);
        });
        sink(field, 0, std::move(array));
    }
    if (progress) progress(1.0);
    if (!repetition.fails()) return {};
    std::ostringstream difference;
    difference << repetition.largestDifference;
    return {"The samples at the far ends of the periods do not repeat the first ones (the largest difference "
            "is " +
            difference.str() + "); they were dropped, as XSF says that they repeat."};
}

} // namespace voxsheet::import
