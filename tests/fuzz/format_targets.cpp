#include "fuzz_target.h"

#include "base/errors.h"
#include "import/child/reader_registry.h"
#include "import/formats/own_readers.h"
#include "import/mesh/mesh_reader.h"
#include "import/tiff/tiff_reader.h"
#include "import/vtk_legacy/legacy_vtk_reader.h"
#include "scratch_folder.h"
#include "unit/import/sample_files.h"

#include <filesystem>
#include <map>
#include <memory>

namespace voxsheet::fuzz {

namespace {

namespace fs = std::filesystem;
using namespace import;

const SourceReader& readerOf(const std::string& format) {
    static const auto readers = [] {
        std::map<std::string, std::unique_ptr<SourceReader>> all;
        const auto add = [&](std::unique_ptr<SourceReader> reader) {
            const std::string name = reader->format();
            all.emplace(name, std::move(reader));
        };
        for (auto& reader : makeOwnReaders())
            add(std::move(reader));
        for (auto& reader : makeMeshReaders())
            add(std::move(reader));
        add(makeLegacyVtkReader());
        add(makeTiffReader());
        return all;
    }();
    return *readers.at(format);
}

/// As the importer does: recognise, header, voxels.
void readFile(const SourceReader& reader, const fs::path& path) {
    ImportOptions options;
    options.resolution = 8; // a surface's volume costs the same for every input
    ImportLimits limits;
    limits.maxBytes = 4ULL << 20;
    (void)reader.recognises(readFileHead(path), options);
    auto header = reader.readHeader(path, options, limits);
    promise(sampleCount(header.meta.grid.dims) > 0, "a header without samples");
    promise(!header.meta.fields.empty() && !header.meta.times.empty(), "a header without fields or steps");
    promise(header.totalBytes() <= limits.maxBytes, "a header beyond the limit");
    std::size_t arrays = 0;
    const auto sink = applyOptions(header, options, [&](int field, int, std::vector<std::byte>&& voxels) {
        promise(voxels.size() == header.arrayBytes(field), "an array of another size than the header's");
        ++arrays;
    });
    (void)reader.readData(header, sink, {});
    promise(arrays == header.meta.fields.size() * header.meta.times.size(), "arrays are missing");
}

/// The format that a sample is of, as the registry sees it.
std::string formatOf(const fs::path& path) {
    static const ReaderRegistry registry;
    return registry.choose(path, {}).format();
}

} // namespace

std::vector<FuzzTarget> formatTargets() {
    std::map<std::string, FuzzTarget> targets;
    for (const auto& sample : testing::allSamples(scratchFolder().path())) {
        // Data files stay beside what the fuzzer writes: a mutated header may still find them.
        for (const auto& [name, bytes] : sample.beside)
            scratchFolder().write(name, bytes);
        scratchFolder().write(sample.name, sample.bytes);
        const auto format = formatOf(scratchFolder().path() / sample.name);
        auto& target = targets[format];
        target.name = format;
        target.seeds.push_back(sample.bytes);
        const auto fileName = "input" + fs::path(sample.name).extension().string();
        target.run = [&reader = readerOf(format), fileName](std::string_view bytes) {
            scratchFolder().write(fileName, bytes);
            readFile(reader, scratchFolder().path() / fileName);
        };
    }
    std::vector<FuzzTarget> all;
    for (auto& [format, target] : targets)
        all.push_back(std::move(target));
    return all;
}

} // namespace voxsheet::fuzz
