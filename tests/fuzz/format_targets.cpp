#include "fuzz_target.h"

#include "base/errors.h"
#include "import/child/reader_registry.h"
#include "import/formats/own_readers.h"
#include "import/mesh/mesh_reader.h"
#include "import/tiff/tiff_reader.h"
#include "import/vtk_legacy/legacy_vtk_reader.h"
#include "unit/import/sample_files.h"

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <memory>
#include <stdexcept>

namespace voxsheet::fuzz {

namespace {

namespace fs = std::filesystem;
using namespace import;

/// A folder in memory where there is one, removed at the end of the program.
class ScratchFolder {
public:
    ScratchFolder() {
        const fs::path memory = "/dev/shm";
        std::error_code error;
        const auto base = fs::is_directory(memory, error) ? memory : fs::temp_directory_path();
        auto pattern = (base / "voxsheet-fuzz-XXXXXX").string();
        if (::mkdtemp(pattern.data()) == nullptr)
            throw std::runtime_error("no folder for the fuzzer's files");
        path_ = pattern;
    }
    ~ScratchFolder() {
        std::error_code ignored;
        fs::remove_all(path_, ignored);
    }
    ScratchFolder(const ScratchFolder&) = delete;
    ScratchFolder& operator=(const ScratchFolder&) = delete;

    [[nodiscard]] const fs::path& path() const { return path_; }
    void write(const std::string& name, std::string_view bytes) const {
        std::ofstream out(path_ / name, std::ios::binary);
        out.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    }

private:
    fs::path path_;
};

const ScratchFolder& scratch() {
    static const ScratchFolder folder;
    return folder;
}

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
    for (const auto& sample : testing::allSamples(scratch().path())) {
        // Data files stay beside what the fuzzer writes: a mutated header may still find them.
        for (const auto& [name, bytes] : sample.beside)
            scratch().write(name, bytes);
        scratch().write(sample.name, sample.bytes);
        const auto format = formatOf(scratch().path() / sample.name);
        auto& target = targets[format];
        target.name = format;
        target.seeds.push_back(sample.bytes);
        const auto fileName = "input" + fs::path(sample.name).extension().string();
        target.run = [&reader = readerOf(format), fileName](std::string_view bytes) {
            scratch().write(fileName, bytes);
            readFile(reader, scratch().path() / fileName);
        };
    }
    std::vector<FuzzTarget> all;
    for (auto& [format, target] : targets)
        all.push_back(std::move(target));
    return all;
}

} // namespace voxsheet::fuzz
