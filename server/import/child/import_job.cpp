#include "import/child/import_job.h"

#include "base/errors.h"
#include "import/child/file_series.h"
#include "import/client/import_options_json.h"
#include "import/client/import_protocol.h"
#include "import/formats/label_files.h"
#include "import/formats/own_readers.h"
#include "store/store_key.h"
#include "store/store_writer.h"

#include <algorithm>
#include <chrono>

namespace voxsheet::import {

namespace {

/// 1.2 GB, 35 MB: enough digits to compare two sizes.
std::string readableBytes(std::uint64_t bytes) {
    if (bytes < 10'000) return std::to_string(bytes) + " bytes";
    const auto [unit, name] = bytes < 10'000'000       ? std::pair{1e3, " kB"}
                              : bytes < 10'000'000'000 ? std::pair{1e6, " MB"}
                                                       : std::pair{1e9, " GB"};
    const auto tenths = static_cast<std::uint64_t>(static_cast<double>(bytes) / unit * 10.0 + 0.5);
    return std::to_string(tenths / 10) + "." + std::to_string(tenths % 10) + name;
}

std::vector<store::FileStamp> stampsOf(const SourceHeader& header) {
    std::vector<store::FileStamp> stamps;
    for (const auto& file : header.files)
        stamps.push_back(store::stampOf(file));
    return stamps;
}

/// An array, its next level, and what a reader needs to decode and convert it.
void checkMemory(const std::string& file, const SourceHeader& header, const JobLimits& limits) {
    if (limits.memoryBytes == 0) return;
    std::uint64_t largest = 0;
    for (int field = 0; field < static_cast<int>(header.meta.fields.size()); ++field)
        largest = std::max(largest, header.arrayBytes(field));
    if (largest <= limits.memoryBytes / 5 * 2) return;
    throw LimitExceeded(file,
                        "reading its volumes of " + readableBytes(largest) + " each needs more than the " +
                            readableBytes(limits.memoryBytes) + " of memory that an import may use",
                        "raise --memory-budget, or make the volume smaller");
}

void checkDisk(const std::string& file, const store::VolumeStore& store, const DatasetMeta& meta) {
    std::error_code error;
    const auto space = std::filesystem::space(store.folder(), error);
    const auto needed = store::entryBytes(meta);
    if (error || needed <= space.available) return;
    throw LimitExceeded(file,
                        "the volume store needs " + readableBytes(needed) + " for it, and its disk has " +
                            readableBytes(space.available) + " free",
                        "free space, or choose another folder with --store");
}

/// What can be done about a file that only its writer knows.
const char* customaryAdvice(ErrorKind kind) {
    if (kind == ErrorKind::InvalidInput) return "correct its header, or write or copy the file again";
    if (kind == ErrorKind::Unsupported) return "convert it to another type or format";
    if (kind == ErrorKind::LimitExceeded) return "check its header, or make the volume smaller";
    return "";
}

/// Errors that do not say which file they are about get its name, and all say what can be done.
template <typename Work>
auto naming(const std::string& file, const Work& work) {
    try {
        return work();
    } catch (const Error& error) {
        auto whole = errorMessage(error);
        if (whole.toDo.empty()) whole.toDo = customaryAdvice(error.kind());
        if (error.subject().find('/') == std::string::npos && error.field().empty()) {
            whole.why = whole.what + ": " + whole.why;
            whole.what = file;
        }
        throwError(whole);
    }
}

SourceHeader readHeader(const SourceReader& reader, const std::filesystem::path& file,
                        const ImportOptions& options, const JobLimits& limits) {
    return naming(file.string(), [&] {
        ImportLimits readerLimits;
        readerLimits.maxBytes = limits.maxVoxelBytes;
        auto header = reader.readHeader(file, options, readerLimits);
        header.meta.sourcePath = file.string();
        addLabelFiles(file, header);
        return header;
    });
}

FilePreview previewOf(const SourceHeader& header) {
    FilePreview preview{header.meta, header.totalBytes(), {}};
    for (const auto& file : header.files)
        preview.files.push_back(file.string());
    return preview;
}

/// The header of one file, or of a series, and what reads it.
struct OpenedFiles {
    std::vector<SeriesPart> parts;
    std::optional<SeriesKind> kind;
    SourceHeader header;

    [[nodiscard]] std::vector<std::string> read(const ArraySink& sink, const ReadProgress& progress) const {
        return parts.size() == 1 ? parts.front().reader->readData(header, sink, progress)
                                 : readSeries(parts, header, sink, progress, kind);
    }
};

OpenedFiles openFiles(const ReaderRegistry& readers, const ImportJob& job) {
    OpenedFiles opened;
    opened.kind = job.options.series;
    for (const auto& file : job.files) {
        const auto& reader = readers.choose(file, job.options);
        opened.parts.push_back({&reader, readHeader(reader, file, job.options, job.limits)});
    }
    ImportLimits limits;
    limits.maxBytes = job.limits.maxVoxelBytes;
    opened.header = opened.parts.size() == 1 ? opened.parts.front().header
                                             : combinedHeader(opened.parts, limits, opened.kind);
    return opened;
}

} // namespace

FilePreview previewSource(const ReaderRegistry& readers, const std::filesystem::path& file,
                          const ImportOptions& options, const JobLimits& limits) {
    auto header = readHeader(readers.choose(file, options), file, options, limits);
    (void)applyOptions(header, options, {});
    return previewOf(header);
}

ReadingTime measureSource(const ReaderRegistry& readers, const std::filesystem::path& file,
                          const ImportOptions& options, const JobLimits& limits) {
    using Clock = std::chrono::steady_clock;
    const auto seconds = [](Clock::duration time) { return std::chrono::duration<double>(time).count(); };
    const auto start = Clock::now();
    const auto& reader = readers.choose(file, options);
    auto header = readHeader(reader, file, options, limits);
    const auto afterHeader = Clock::now();
    const auto sink = applyOptions(header, options, [](int, int, std::vector<std::byte>&&) {});
    naming(file.string(), [&] { (void)reader.readData(header, sink, {}); });
    return {seconds(afterHeader - start), seconds(Clock::now() - afterHeader), header.totalBytes()};
}

std::string importIntoStore(const ReaderRegistry& readers, const store::VolumeStore& store,
                            const ImportJob& job) {
    if (job.files.empty()) throw InvalidInput("import", "no file is named").withField("files");
    const auto file = job.files.front().string();
    const auto before = store::stampOf(job.files.front());
    auto opened = openFiles(readers, job);
    auto& header = opened.header;
    const auto stamps = stampsOf(header);
    if (stamps.empty() || stamps.front() != before)
        throw IoError(file, "it changed while it was being read", "import it again");

    // One file may name the same others as a series holds.
    const auto key = store::importKey(
        stamps, kImporterVersion, canonicalOptions(job.options) + (job.files.size() > 1 ? " series" : ""));
    checkMemory(file, header, job.limits);
    store::StoreWriter* writer = nullptr;
    const auto sink =
        applyOptions(header, job.options, [&writer](int field, int step, std::vector<std::byte>&& samples) {
            const auto taken = std::move(samples); // free before the next is read
            writer->addArray(field, step, taken);
        });
    header.meta.key = key;
    if (job.header) job.header(previewOf(header));
    if (store.open(key)) return key;

    store.makeRoom(store::entryBytes(header.meta), key);
    checkDisk(file, store, header.meta);
    store::StoreWriter entry(store, header.meta);
    writer = &entry;
    naming(file, [&] {
        // The last hundredth is for syncing to the disk.
        entry.addNotes(opened.read(sink, [&job](double fraction) {
            if (job.progress) job.progress(0.99 * fraction);
        }));
    });
    if (stampsOf(header) != stamps)
        throw IoError(file, "it changed while it was being read", "import it again");
    entry.commit();
    return key;
}

} // namespace voxsheet::import
