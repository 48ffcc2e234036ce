#include "engine/workbook_keeper.h"

#include "base/log.h"
#include "engine/source_files.h"
#include "sheet/workbook_json.h"

#include <chrono>

#include <unistd.h>

namespace voxsheet::engine {

namespace {

namespace fs = std::filesystem;

fs::path recoveryFile(const EngineOptions& options) {
    const fs::path folder = options.recoveryDir.empty() ? options.uploadDir : options.recoveryDir;
    const std::string stem = options.workbookFile.empty() ? "untitled" : options.workbookFile.stem().string();
    return folder / (stem + ".recovery-" + std::to_string(::getpid()) + ".json");
}

} // namespace

WorkbookKeeper::WorkbookKeeper(std::shared_ptr<const sheet::KeyTable> keys, const EngineOptions& options,
                               std::function<void(std::uint64_t)> changed)
    : options_(options), changedListener_(std::move(changed)), history_(std::move(keys), sheet::Workbook{}),
      folder_(options.workbookFile.empty() ? fs::current_path()
                                           : fs::absolute(options.workbookFile).parent_path()),
      saved_(history_.current()), recoveryThread_([this] { keepRecovery(); }) {}

WorkbookKeeper::~WorkbookKeeper() {
    {
        const std::lock_guard lock(mutex_);
        stopping_ = true;
    }
    edited_.notify_all();
    recoveryThread_.join();
}

sheet::Snapshot WorkbookKeeper::snapshot() const {
    const std::lock_guard lock(mutex_);
    return history_.current();
}

std::uint64_t WorkbookKeeper::changed(std::unique_lock<std::mutex>& lock) {
    const std::uint64_t version = history_.current()->version;
    lock.unlock();
    edited_.notify_all();
    if (changedListener_) changedListener_(version);
    return version;
}

EditReport WorkbookKeeper::apply(const sheet::Command& command, const std::string& gesture) {
    std::unique_lock lock(mutex_);
    sheet::EditReport done = history_.apply(command, gesture);
    if (done.changed) changed(lock);
    return {done.snapshot->version, std::move(done.hidden)};
}

EditReport WorkbookKeeper::applyWith(const std::function<sheet::Command(const sheet::Workbook&)>& make) {
    std::unique_lock lock(mutex_);
    history_.apply(make(*history_.current()), {});
    return {changed(lock), {}};
}

void WorkbookKeeper::amend(const sheet::UpdateDataset& command) {
    std::unique_lock lock(mutex_);
    const bool clean = *history_.current() == *saved_;
    try {
        history_.amend(command);
    } catch (const NotFound&) {
        return; // The dataset was removed or renamed meanwhile.
    }
    // What the program found out by itself is no edit that could be lost.
    if (clean) saved_ = history_.current();
    changed(lock);
}

bool WorkbookKeeper::undo() {
    std::unique_lock lock(mutex_);
    if (!history_.canUndo()) return false;
    history_.undo();
    changed(lock);
    return true;
}

bool WorkbookKeeper::redo() {
    std::unique_lock lock(mutex_);
    if (!history_.canRedo()) return false;
    history_.redo();
    changed(lock);
    return true;
}

bool WorkbookKeeper::canUndo() const {
    const std::lock_guard lock(mutex_);
    return history_.canUndo();
}

bool WorkbookKeeper::canRedo() const {
    const std::lock_guard lock(mutex_);
    return history_.canRedo();
}

nlohmann::json WorkbookKeeper::document() const {
    const std::lock_guard lock(mutex_);
    return sheet::workbookToJson(withRelativeSources(*history_.current(), folder_));
}

void WorkbookKeeper::replace(const nlohmann::json& document, const fs::path& folder, DocumentOrigin origin) {
    const sheet::Workbook parsed = sheet::workbookFromJson(document, history_.keys());
    auto workbook = std::make_shared<const sheet::Workbook>(withAbsoluteSources(parsed, folder));
    std::unique_lock lock(mutex_);
    history_.apply(sheet::ReplaceWorkbook{std::move(workbook)}, {});
    folder_ = fs::absolute(folder);
    if (origin == DocumentOrigin::File) saved_ = history_.current();
    changed(lock);
}

void WorkbookKeeper::save(const fs::path& file) {
    const fs::path target = fs::absolute(file.empty() ? options_.workbookFile : file);
    if (file.empty() && options_.workbookFile.empty()) {
        throw InvalidInput("the workbook", "it has no file yet", "name the file to save it in")
            .withField("path");
    }
    const sheet::Snapshot now = snapshot();
    const fs::path folder = target.parent_path();
    writeFileAtomically(target, sheet::serialiseWorkbook(withRelativeSources(*now, folder)));
    const std::lock_guard lock(mutex_);
    saved_ = now;
    folder_ = folder;
    std::error_code ignored;
    if (recoveredVersion_ != 0) fs::remove(recoveryFile(options_), ignored);
    recoveredVersion_ = 0;
}

std::optional<fs::path> WorkbookKeeper::saveRecovery() {
    const sheet::Snapshot now = snapshot();
    {
        const std::lock_guard lock(mutex_);
        if (*now == *saved_) return std::nullopt;
        if (recoveredVersion_ == now->version) return recoveryFile(options_);
    }
    const fs::path file = recoveryFile(options_);
    fs::create_directories(file.parent_path());
    writeFileAtomically(file, sheet::serialiseWorkbook(withRelativeSources(*now, file.parent_path())));
    const std::lock_guard lock(mutex_);
    recoveredVersion_ = now->version;
    return file;
}

void WorkbookKeeper::keepRecovery() {
    std::unique_lock lock(mutex_);
    std::uint64_t seen = history_.current()->version;
    while (!stopping_) {
        edited_.wait(lock, [&] { return stopping_ || history_.current()->version != seen; });
        // Wait for a pause in the edits, so that a drag does not write a file for every step of it.
        while (!stopping_ && history_.current()->version != seen) {
            seen = history_.current()->version;
            edited_.wait_for(lock, std::chrono::duration<double>(kRecoverySeconds),
                             [&] { return stopping_ || history_.current()->version != seen; });
        }
        if (stopping_) return;
        lock.unlock();
        try {
            saveRecovery();
        } catch (const std::exception& error) {
            logWarning(std::string("the recovery file was not written: ") + error.what());
        }
        lock.lock();
    }
}

} // namespace voxsheet::engine
