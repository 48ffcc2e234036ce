#include "cli/bench/import_bench.h"

#include "base/errors.h"
#include "bench/scratch_folder.h"
#include "cli/bench/bench_volumes.h"
#include "cli/bench/format_files.h"
#include "cli/engine_arguments.h"
#include "engine/engine.h"
#include "import/import_client.h"

#include <bzlib.h>
#include <zlib.h>

#include <algorithm>
#include <chrono>
#include <fcntl.h>
#include <limits>
#include <memory>
#include <set>
#include <sys/mman.h>
#include <thread>
#include <unistd.h>

namespace voxsheet::cli {

namespace fs = std::filesystem;

namespace {

using Clock = std::chrono::steady_clock;

double secondsSince(Clock::time_point start) {
    return std::chrono::duration<double>(Clock::now() - start).count();
}

/// Pages that no one has touched, as a reader's are: the heap would give those of the last reading again.
class FreshMemory {
public:
    explicit FreshMemory(std::size_t bytes) : bytes_(bytes) {
        memory_ = ::mmap(nullptr, bytes, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
        if (memory_ == MAP_FAILED)
            throw LimitExceeded("bench import", "there is too little memory for its files");
    }
    ~FreshMemory() { ::munmap(memory_, bytes_); }
    FreshMemory(const FreshMemory&) = delete;
    FreshMemory& operator=(const FreshMemory&) = delete;

    [[nodiscard]] char* data() { return static_cast<char*>(memory_); }
    [[nodiscard]] std::size_t size() const { return bytes_; }

private:
    std::size_t bytes_;
    void* memory_;
};

/// The stored bytes of the voxels.
void readPlain(const FormatFile& file, FreshMemory& memory) {
    const auto bytes = memory.size();
    const int descriptor = ::open(file.data.c_str(), O_RDONLY | O_CLOEXEC);
    std::size_t done = 0;
    while (descriptor >= 0 && done < bytes) {
        const auto got = ::pread(descriptor, memory.data() + done, bytes - done,
                                 static_cast<off_t>(file.dataOffset + done));
        if (got <= 0) break;
        done += static_cast<std::size_t>(got);
    }
    if (descriptor >= 0) ::close(descriptor);
    if (done < bytes) throw IoError(file.data.string(), "could not be read");
}

void inflatePlain(FreshMemory& packed, FreshMemory& out) {
    z_stream stream{};
    if (inflateInit2(&stream, 15 + 32) != Z_OK)
        throw InternalError("bench import", "zlib could not be started");
    stream.next_in = reinterpret_cast<Bytef*>(packed.data());
    stream.avail_in = static_cast<uInt>(packed.size());
    stream.next_out = reinterpret_cast<Bytef*>(out.data());
    stream.avail_out = static_cast<uInt>(out.size());
    const int result = inflate(&stream, Z_NO_FLUSH);
    inflateEnd(&stream);
    if (result != Z_STREAM_END && result != Z_OK && result != Z_BUF_ERROR)
        throw InternalError("bench import", "zlib does not decompress what it compressed");
}

void bunzipPlain(FreshMemory& packed, FreshMemory& out) {
    auto size = static_cast<unsigned>(out.size());
    if (BZ2_bzBuffToBuffDecompress(out.data(), &size, packed.data(), static_cast<unsigned>(packed.size()), 0,
                                   0) != BZ_OK)
        throw InternalError("bench import", "libbz2 does not decompress what it compressed");
}

double plainSeconds(const FormatFile& file) {
    constexpr std::size_t room = 1024; // a header within the compressed bytes
    const auto start = Clock::now();
    FreshMemory bytes(static_cast<std::size_t>(fs::file_size(file.data) - file.dataOffset));
    readPlain(file, bytes);
    if (file.plain != PlainMethod::Read) {
        FreshMemory out(static_cast<std::size_t>(file.voxelBytes) + room);
        file.plain == PlainMethod::Zlib ? inflatePlain(bytes, out) : bunzipPlain(bytes, out);
    }
    return secondsSince(start);
}

nlohmann::json formatCase(const FormatFile& file, int repeats) {
    double ours = std::numeric_limits<double>::infinity();
    double plain = ours;
    for (int repeat = 0; repeat < repeats; ++repeat) {
        plain = std::min(plain, plainSeconds(file));
        const auto time = import::measureReading({}, file.file);
        if (time.voxelBytes != file.voxelBytes)
            throw InternalError("bench import", file.name + " gave another number of voxels than it holds");
        ours = std::min(ours, time.headerSeconds + time.dataSeconds);
    }
    constexpr double mega = 1e6;
    const double fileMb = static_cast<double>(fs::file_size(file.data)) / mega;
    const double voxelMb = static_cast<double>(file.voxelBytes) / mega;
    const double counted = file.text ? fileMb : voxelMb;
    return {{"format", file.name},  {"text", file.text},      {"file_mb", fileMb},
            {"voxel_mb", voxelMb},  {"mb_s", counted / ours}, {"plain_mb_s", counted / plain},
            {"ratio", plain / ours}};
}

/// Draws each cell as soon as its volume is there.
nlohmann::json openingCase(int files, const ImportBenchOptions& options) {
    constexpr double patienceSeconds = 600.0;
    constexpr auto lookEvery = std::chrono::milliseconds(2);
    const bench::ScratchFolder scratch;
    EngineArguments arguments;
    arguments.sources = writeBenchVolumes(scratch.path(), files, options.fileDim);
    engine::Engine engine(benchEngineOptions(scratch.path(), options.device));
    const auto start = Clock::now();
    openSources(engine, arguments);
    const auto workbook = engine.snapshot();
    const auto& sheet = workbook->sheets.front();
    std::set<sheet::Address> waiting;
    for (const auto& [address, cell] : sheet.cells)
        waiting.insert(address);
    double first = 0.0;
    while (!waiting.empty()) {
        for (auto cell = waiting.begin(); cell != waiting.end();) {
            const auto tile = engine.prepareTile(*workbook, sheet.name, *cell, {}, {});
            if (!tile.code.empty()) throw IoError("bench import", tile.message);
            if (!tile.spec) {
                ++cell;
                continue;
            }
            FrameSpec frame;
            frame.tiles.push_back(*tile.spec);
            const auto picture = engine.render(std::move(frame), FramePriority::Final).get();
            if (!picture.tiles.at(0).error.empty()) throw GpuError("bench import", picture.tiles[0].error);
            if (first == 0.0) first = secondsSince(start);
            cell = waiting.erase(cell);
        }
        if (secondsSince(start) > patienceSeconds)
            throw IoError("bench import", "a picture did not come in time");
        std::this_thread::sleep_for(lookEvery);
    }
    return {{"files", files},
            {"file_dim", options.fileDim},
            {"first_picture_ms", 1e3 * first},
            {"all_pictures_ms", 1e3 * secondsSince(start)}};
}

} // namespace

nlohmann::json runImportBench(const ImportBenchOptions& options,
                              const std::function<void(const std::string&)>& progress) {
    auto cases = nlohmann::json::array();
    {
        const bench::ScratchFolder scratch;
        progress("writing the files");
        for (const auto& file : writeFormatFiles(scratch.path(), options.dim, options.only)) {
            progress(file.name);
            cases.push_back(formatCase(file, options.repeats));
        }
    }
    for (const int files : options.files) {
        if (files == 0) continue;
        progress("opening " + std::to_string(files));
        cases.push_back(openingCase(files, options));
    }
    return {{"bench", "import"}, {"dim", options.dim}, {"repeats", options.repeats}, {"cases", cases}};
}

} // namespace voxsheet::cli
