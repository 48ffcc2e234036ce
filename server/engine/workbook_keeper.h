// The workbook of a running engine: its history, its file, its recovery file.
#pragma once

#include "engine/engine.h"

#include <condition_variable>
#include <mutex>
#include <thread>

namespace voxsheet::engine {

/// Thread-safe.
class WorkbookKeeper {
public:
    /// \param changed  called after every change, with no lock held, from the thread that changed
    WorkbookKeeper(std::shared_ptr<const sheet::KeyTable> keys, const EngineOptions& options,
                   std::function<void(std::uint64_t version)> changed);
    ~WorkbookKeeper();
    WorkbookKeeper(const WorkbookKeeper&) = delete;
    WorkbookKeeper& operator=(const WorkbookKeeper&) = delete;

    [[nodiscard]] sheet::Snapshot snapshot() const;
    EditReport apply(const sheet::Command& command, const std::string& gesture);
    /// Makes a command of the newest snapshot and applies it, with no other edit in between.
    EditReport applyWith(const std::function<sheet::Command(const sheet::Workbook&)>& make);
    /// Without an undo step; ignored if the dataset is gone.
    void amend(const sheet::UpdateDataset& command);
    bool undo();
    bool redo();
    [[nodiscard]] bool canUndo() const;
    [[nodiscard]] bool canRedo() const;

    /// Source paths relative to the workbook's folder.
    [[nodiscard]] nlohmann::json document() const;
    void replace(const nlohmann::json& document, const std::filesystem::path& folder, DocumentOrigin origin);
    void save(const std::filesystem::path& file);
    std::optional<std::filesystem::path> saveRecovery();

private:
    static constexpr double kRecoverySeconds = 5.0; ///< after the last edit

    std::uint64_t changed(std::unique_lock<std::mutex>& lock);
    void keepRecovery();

    EngineOptions options_;
    std::function<void(std::uint64_t)> changedListener_;
    mutable std::mutex mutex_;
    std::condition_variable edited_;
    sheet::History history_;
    std::filesystem::path folder_;       ///< what relative source paths start from
    sheet::Snapshot saved_;              ///< as last written to, or read from, a file
    std::uint64_t recoveredVersion_ = 0; ///< as last written to the recovery file
    bool stopping_ = false;
    std::thread recoveryThread_;
};

} // namespace voxsheet::engine
