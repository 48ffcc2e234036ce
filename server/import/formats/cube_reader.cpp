#include "import/formats/cube_reader.h"

#include "base/errors.h"
#include "import/formats/chgcar_header.h"
#include "import/formats/cube_header.h"
#include "import/formats/field_names.h"
#include "import/formats/grid_text.h"
#include "import/formats/number_text.h"
#include "import/formats/voxel_plan.h"

#include <cstring>

namespace voxsheet::import {

namespace {

struct CubePlan {
    std::filesystem::path file;
    std::uint64_t dataPosition = 0; ///< of the first value, in the decompressed text
};

bool namedLikeCube(const std::filesystem::path& path) {
    auto name = path.filename();
    if (const auto ending = lowerCase(name.extension().string()); ending == ".gz" || ending == ".bz2")
        name = name.stem();
    const auto ending = lowerCase(name.extension().string());
    return ending == ".cube" || ending == ".cub";
}

/// Deals the values out to the fields' arrays, which must have their sizes.
void readFields(GridValues& values, const glm::ivec3& dims, std::vector<std::vector<std::byte>>& arrays,
                const ReadProgress& progress) {
    const auto columns = static_cast<std::size_t>(dims.x);
    const auto rows = static_cast<std::size_t>(dims.y);
    const auto slices = static_cast<std::size_t>(dims.z);
    for (std::size_t x = 0; x < columns; ++x) {
        for (std::size_t y = 0; y < rows; ++y) {
            for (std::size_t z = 0; z < slices; ++z) {
                const auto at = (x + columns * (y + rows * z)) * sizeof(double);
                for (auto& array : arrays) {
                    const double value = values.next();
                    std::memcpy(array.data() + at, &value, sizeof(double));
                }
            }
            if (progress) progress(values.fraction());
        }
    }
}

/// Its values lie scattered over the arrays, so that one line of text would touch all of their memory.
void provePromises(const InputFile& file, std::uint64_t position, std::uint64_t values) {
    if (!promisesMuch(values * sizeof(double), file.bytes())) return;
    auto text = openText(file);
    text.skipBytes(position);
    skipGrid(file, text, values, "its grid");
}

} // namespace

bool CubeReader::recognises(const FileHead& head, const ImportOptions&) const {
    if (looksLikeCube(head.inflated)) return true;
    const bool text = head.inflated.find('\0') == std::string::npos;
    return text && namedLikeCube(head.path) && !looksLikeChgcar(head.inflated);
}

SourceHeader CubeReader::readHeader(const std::filesystem::path& path, const ImportOptions&,
                                    const ImportLimits& limits) const {
    const InputFile file(path);
    auto text = openText(file);
    auto cube = readCubeHeader(file.name(), text);
    const auto& samples = cube.samples;
    const auto fields = static_cast<std::int64_t>(cube.fields.size());
    const auto bytes =
        checkedBytes(file.name(), {samples[0], samples[1], samples[2], fields}, sizeof(double), limits);
    checkTextHolds(file, bytes / sizeof(double));

    SourceHeader source;
    auto& meta = source.meta;
    meta.format = format();
    meta.grid.dims =
        glm::ivec3(static_cast<int>(samples[0]), static_cast<int>(samples[1]), static_cast<int>(samples[2]));
    meta.grid.worldFromIndex = affine(cube.voxelVectors, cube.origin);
    validateGrid(meta.grid);
    meta.lengthUnit = "Å";
    meta.sourceType = ScalarType::F64; // text, with exponents beyond a float's
    meta.fields = makeFields(static_cast<int>(fields), ScalarType::F64, cube.fields);
    meta.crystal = std::move(cube.crystal);
    meta.notes = std::move(cube.notes);
    meta.notes.emplace_back("Values are as in the file, which does not say their unit (Gaussian writes "
                            "densities in e/Bohr^3); positions are in Å.");
    source.files.push_back(canonicalPath(path));
    source.plan = std::make_shared<CubePlan>(CubePlan{source.files[0], text.position()});
    return source;
}

std::vector<std::string> CubeReader::readData(const SourceHeader& header, const ArraySink& sink,
                                              const ReadProgress& progress) const {
    const auto& plan = *static_cast<const CubePlan*>(header.plan.get());
    const InputFile file(plan.file);
    auto text = openText(file);
    text.skipBytes(plan.dataPosition);
    provePromises(file, plan.dataPosition, header.totalBytes() / sizeof(double));
    std::vector<std::vector<std::byte>> arrays;
    std::uint64_t bytes = 0;
    for (std::size_t field = 0; field < header.meta.fields.size(); ++field) {
        arrays.emplace_back(sizeof(double) * static_cast<std::size_t>(sampleCount(header.meta.grid.dims)));
        bytes += arrays.back().size();
    }
    GridValues values(text, file.name(), bytes / sizeof(double));
    readFields(values, header.meta.grid.dims, arrays, progress);
    std::vector<std::string> notes;
    if (const auto rest = text.word(); parseFortranNumber(rest)) // its numbers of atoms or voxels are wrong
        throw InvalidInput(file.name(), "it holds more values than its head says",
                           "correct the numbers of atoms, voxels and values in its head");
    else if (!rest.empty())
        notes.emplace_back("The file goes on after its last voxel; what follows was not read.");
    for (std::size_t field = 0; field < arrays.size(); ++field)
        sink(static_cast<int>(field), 0, std::move(arrays[field]));
    if (progress) progress(1.0);
    return notes;
}

} // namespace voxsheet::import
