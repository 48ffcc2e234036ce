#include "store/store_writer.h"

#include "base/errors.h"
#include "store/meta_json.h"
#include "store/store_key.h"
#include "volume/pyramid.h"
#include "volume/statistics.h"

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstdio>
#include <cstring>
#include <fcntl.h>
#include <future>
#include <span>
#include <thread>
#include <utility>

namespace voxsheet::store {

namespace {

/// How long an entry in the way may take to go: whoever removes it may be waiting for a processor.
constexpr std::chrono::seconds kPatience{5};
constexpr std::chrono::milliseconds kLongestPause{50};

void validateMeta(const DatasetMeta& meta) {
    if (!isStoreKey(meta.key))
        throw InvalidInput("store key '" + meta.key.substr(0, 80) + "'", "it is no key");
    validateGrid(meta.grid);
    if (meta.fields.empty() || meta.times.empty())
        throw InvalidInput("dataset '" + meta.sourcePath + "'", "it has no field or no time step");
    (void)metaToJson(meta); // throws for numbers that JSON cannot hold, before any work is done
}

} // namespace

/// Removed by the last who uses it, unless it became an entry.
struct StoreWriter::Folder {
    std::filesystem::path path;
    bool published = false;

    explicit Folder(std::filesystem::path folder) : path(std::move(folder)) {}
    ~Folder() {
        std::error_code ignored;
        if (!published) std::filesystem::remove_all(path, ignored);
    }
    Folder(const Folder&) = delete;
    Folder& operator=(const Folder&) = delete;
};

StoreWriter::StoreWriter(const VolumeStore& store, DatasetMeta meta) : store_(store), meta_(std::move(meta)) {
    for (auto& field : meta_.fields)
        field.steps.clear();
    validateMeta(meta_);
    for (auto& field : meta_.fields)
        field.steps.resize(meta_.times.size());
    written_.resize(meta_.fields.size() * meta_.times.size());
    store_.makeRoom(entryBytes(meta_));
    while (!claimNewFolder()) {
    }
}

bool StoreWriter::claimNewFolder() {
    temporary_ = std::make_shared<Folder>(store_.newTemporaryFolder());
    const auto lockFile = temporary_->path / kLockFile;
    try {
        lock_ = FileHandle(lockFile, O_RDWR | O_CREAT | O_EXCL);
        // Between the making of the file and the locking of it a process that tidies the store may have taken
        // the folder for a leftover: it holds the lock, or has removed the folder by now.
        // Shared: readers that find the entry right after the rename must not be turned away.
        return lock_.tryLock(false) && lock_.isStillAt(lockFile);
    } catch (const NotFound&) {
        return false; // removed even before the file was made
    }
}

void StoreWriter::addArray(int field, int step, std::span<const std::byte> samples) {
    validateVolumeKey(meta_, {meta_.key, field, step, 0});
    const auto index = static_cast<std::size_t>(field) * static_cast<std::size_t>(meta_.stepCount()) +
                       static_cast<std::size_t>(step);
    if (written_[index]) throw InvalidInput("dataset '" + meta_.sourcePath + "'", "an array was given twice");

    auto& description = meta_.fields[static_cast<std::size_t>(field)];
    StoredArray array{description.storedType, meta_.grid.dims, samples, description.valueScale,
                      description.valueOffset};
    validateStoredArray(array);
    const auto layout = arrayLayout(meta_, field);
    const FileHandle file(temporary_->path / arrayFileName(field, step), O_RDWR | O_CREAT | O_EXCL);
    // The system copies the finest level, most of the bytes, on one processor: meanwhile the others work.
    auto finestWritten =
        std::async(std::launch::async, [&] { file.writeAll(layout.levels[0].offset, samples); });
    auto statistics = computeStatistics(array);
    std::vector<std::byte> current;
    for (int level = 0; level < meta_.levels(); ++level) {
        const auto l = static_cast<std::size_t>(level);
        if (level > 0) file.writeAll(layout.levels[l].offset, current);
        const auto grid = buildMinMaxGrid(array, meta_.grid.periodic);
        file.writeAll(layout.minMax[l].offset, std::as_bytes(std::span(grid.ranges)));
        if (level + 1 == meta_.levels()) break;
        current = coarserLevel(array);
        array.samples = current;
        array.type = pyramidType(array.type);
        array.dims = coarserDims(array.dims);
    }
    finestWritten.get();
    if (::ftruncate(file.descriptor(), static_cast<off_t>(layout.fileBytes)) != 0)
        throw IoError(temporary_->path.string(), std::strerror(errno));
    description.steps[static_cast<std::size_t>(step)] = std::move(statistics);
    written_[index] = true;
}

void StoreWriter::writeMeta() const {
    const nlohmann::json json{{"voxsheet_store_entry", kEntryVersion}, {"dataset", metaToJson(meta_)}};
    const auto text = json.dump(1, ' ', false, nlohmann::json::error_handler_t::replace);
    const FileHandle file(temporary_->path / kMetaFile, O_WRONLY | O_CREAT | O_EXCL);
    file.writeAll(0, std::as_bytes(std::span(text)));
}

void StoreWriter::sync() const {
    for (int field = 0; field < static_cast<int>(meta_.fields.size()); ++field)
        for (int step = 0; step < meta_.stepCount(); ++step)
            FileHandle(temporary_->path / arrayFileName(field, step), O_RDONLY).sync();
    FileHandle(temporary_->path / kMetaFile, O_RDONLY).sync();
    syncFolder(temporary_->path);
}

void StoreWriter::publish() {
    const auto target = store_.folder() / meta_.key;
    std::chrono::milliseconds pause{1};
    for (const auto end = std::chrono::steady_clock::now() + kPatience;;) {
        if (std::rename(temporary_->path.c_str(), target.c_str()) == 0) {
            temporary_->published = true;
            return;
        }
        if (errno != EEXIST && errno != ENOTEMPTY)
            throw IoError(target.string(), std::string("renaming failed: ") + std::strerror(errno));
        // Another process was first (then its entry is as good), or a damaged one is in the way (then open
        // removes it), or somebody is about to remove it (then it is gone after a while).
        if (store_.open(meta_.key)) return;
        if (std::chrono::steady_clock::now() > end) break;
        std::this_thread::sleep_for(pause);
        pause = std::min(2 * pause, kLongestPause);
    }
    throw IoError(target.string(), "an entry that cannot be read is in the way", "remove that folder");
}

void StoreWriter::addNotes(const std::vector<std::string>& notes) {
    meta_.notes.insert(meta_.notes.end(), notes.begin(), notes.end());
}

void StoreWriter::finish() {
    if (finished_) return;
    if (!std::all_of(written_.begin(), written_.end(), [](bool done) { return done; }))
        throw InvalidInput("dataset '" + meta_.sourcePath + "'", "not every field and time step was read");
    writeMeta();
    finished_ = true;
}

std::shared_ptr<const StoreEntry> StoreWriter::entry() {
    finish();
    bool damaged = false;
    const auto opened = StoreEntry::openAs(meta_.key, temporary_->path, damaged);
    if (!opened) throw IoError(temporary_->path.string(), "what was just written cannot be read");
    // Keeps the folder, too.
    return {opened.get(), [opened, folder = temporary_](const StoreEntry*) {}};
}

bool StoreWriter::commit() {
    finish();
    sync();
    publish();
    syncFolder(store_.folder());
    store_.makeRoom(0, meta_.key);
    return temporary_->published;
}

} // namespace voxsheet::store
