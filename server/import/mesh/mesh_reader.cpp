#include "import/mesh/mesh_reader.h"

#include "base/errors.h"
#include "import/formats/voxel_plan.h"
#include "import/mesh/mesh_distance.h"
#include "import/mesh/mesh_formats.h"

#include <cstring>

namespace voxsheet::import {

namespace {

constexpr int defaultResolution = 96;

/// A distance has a meaning only on the grid that it was measured on.
void refuseOtherOptions(const ImportOptions& options) {
    const auto refuse = [](const char* option) {
        throw InvalidInput(std::string("import option '") + option + "'",
                           "it does not fit a surface, whose volume is made by the import",
                           "leave it out; 'resolution' sets the number of samples")
            .withField(std::string("options.") + option);
    };
    if (options.spacing) refuse("spacing");
    if (options.periodic) refuse("periodic");
    if (options.bitMask) refuse("bit_mask");
    if (options.noDataValue) refuse("no_data");
}

class MeshReader : public SourceReader {
public:
    MeshReader(MeshFormat meshFormat, const char* format, const char* description)
        : meshFormat_(meshFormat), format_(format), description_(description) {}

    [[nodiscard]] const char* format() const override { return format_; }
    [[nodiscard]] const char* description() const override { return description_; }

    [[nodiscard]] bool recognises(const FileHead& head, const ImportOptions&) const override {
        return meshFormatOf(head) == meshFormat_;
    }

    [[nodiscard]] SourceHeader readHeader(const std::filesystem::path& path, const ImportOptions& options,
                                          const ImportLimits& limits) const override {
        refuseOtherOptions(options);
        const InputFile file(path);
        const auto mesh = std::make_shared<const TriangleMesh>(readMesh(file, meshFormat_));
        const auto bounds = boundsOf(*mesh);
        if (bounds.low == bounds.high)
            throw InvalidInput(file.name(), "all of its triangles are at one point",
                               "save a surface that bounds a solid");
        SourceHeader source;
        source.files.push_back(canonicalPath(path));
        source.meta.format = format_;
        source.meta.grid = gridAbout(bounds, options.resolution.value_or(defaultResolution));
        source.meta.sourceType = ScalarType::F32;
        auto& field = source.meta.fields.emplace_back();
        field.name = "distance";
        field.quantity = "signed distance";
        field.storedType = ScalarType::F32;
        const auto& dims = source.meta.grid.dims;
        (void)checkedBytes(file.name(), {dims.x, dims.y, dims.z}, sizeof(float), limits);
        source.plan = mesh;
        return source;
    }

    [[nodiscard]] std::vector<std::string> readData(const SourceHeader& header, const ArraySink& sink,
                                                    const ReadProgress& progress) const override {
        constexpr double checking = 0.3; // of the time, roughly
        auto mesh = *static_cast<const TriangleMesh*>(header.plan.get());
        const auto solid = makeSolid(std::move(mesh), header.files.front().string(), [&](double fraction) {
            if (progress) progress(checking * fraction);
        });
        const auto distances = distancesOn(header.meta.grid, MeshDistance(solid), [&](double fraction) {
            if (progress) progress(checking + (1.0 - checking) * fraction);
        });
        std::vector<std::byte> bytes(distances.size() * sizeof(float));
        std::memcpy(bytes.data(), distances.data(), bytes.size());
        sink(0, 0, std::move(bytes));
        return solid.surface.notes;
    }

private:
    MeshFormat meshFormat_;
    const char* format_;
    const char* description_;
};

} // namespace

std::vector<std::unique_ptr<SourceReader>> makeMeshReaders() {
    std::vector<std::unique_ptr<SourceReader>> readers;
    readers.push_back(std::make_unique<MeshReader>(MeshFormat::Ply, "ply", "PLY surface (.ply)"));
    readers.push_back(std::make_unique<MeshReader>(MeshFormat::Stl, "stl", "STL surface (.stl)"));
    readers.push_back(std::make_unique<MeshReader>(MeshFormat::Obj, "obj", "OBJ surface (.obj)"));
    return readers;
}

} // namespace voxsheet::import
