// What is known about one dataset: geometry, fields, statistics. Mirrored by meta.json in the volume store.
#pragma once

#include "volume/grid.h"
#include "volume/scalar_type.h"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace voxsheet {

/// Counts of finite stored values in equal bins over [low, high]; high belongs to the last bin.
struct Histogram {
    double low = 0.0; ///< in values (after slope and intercept)
    double high = 0.0;
    std::vector<std::uint64_t> counts; ///< 256 bins
};

/// Over the finite values of one field and step, in values (after slope and intercept).
struct ValueStatistics {
    double min = 0.0;
    double max = 0.0;
    double mean = 0.0;
    double standardDeviation = 0.0;
    std::uint64_t finiteCount = 0;
    std::uint64_t nanCount = 0;
};

struct FieldStep {
    ValueStatistics statistics;
    Histogram histogram;
};

struct FieldMeta {
    std::string name;                        ///< unique within the dataset
    std::string quantity;                    ///< e.g. "electron density"; may be empty
    std::string unit;                        ///< of values, e.g. "eV", "e/Å^3"; may be empty
    ScalarType storedType = ScalarType::F32; ///< of the level-0 array; levels >= 1: pyramidType(storedType)
    double valueScale = 1.0;                 ///< value = valueScale * stored + valueOffset
    double valueOffset = 0.0;
    std::vector<FieldStep> steps; ///< one per time step
};

struct Atom {
    int atomicNumber = 0;
    glm::dvec3 positionWorld{0.0};
};

struct Crystal {
    glm::dmat3 lattice{1.0}; ///< columns are the lattice vectors a, b, c in world units
    std::vector<Atom> atoms;
    std::string comment;
};

/// What a file calls one value of a label map.
struct LabelMeta {
    std::int64_t value = 0;
    std::string name;              ///< may be empty
    std::optional<glm::dvec3> rgb; ///< display sRGB, [0, 1]
};

struct DatasetMeta {
    std::string key;        ///< folder in the volume store; unique
    std::string sourcePath; ///< as opened
    std::string format;     ///< "nrrd", "metaimage", "nifti", "raw", "chgcar", "vti", "vtk", "formula", …
    Grid grid;
    ScalarType sourceType = ScalarType::F32; ///< of the file
    std::string lengthUnit;                  ///< of the world: "mm", "Å", …; empty when unknown
    bool anatomical = false;                 ///< the world is RAS+: orientation letters may be shown
    std::vector<FieldMeta> fields;           ///< at least one
    std::vector<double> times{0.0};          ///< one per time step
    std::optional<Crystal> crystal;
    std::vector<LabelMeta> labels;  ///< that the file names, by value, each once; none for most
    std::vector<std::string> notes; ///< what the importer did that a user should know, one sentence each

    [[nodiscard]] int stepCount() const { return static_cast<int>(times.size()); }
    [[nodiscard]] int levels() const { return levelCount(grid.dims); }
};

/// Stored type of levels >= 1: 8- and 16-bit integers keep their type (rounded means), all others become F32.
[[nodiscard]] ScalarType pyramidType(ScalarType storedType) noexcept;
[[nodiscard]] ScalarType levelType(ScalarType storedType, int level) noexcept;

} // namespace voxsheet
