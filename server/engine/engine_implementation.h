// What stands behind the facade: the parts of a running engine, and how they call each other.
#pragma once

#include "engine/dataset_keeper.h"
#include "engine/engine.h"
#include "engine/probe_service.h"
#include "engine/shown_volumes.h"
#include "engine/tile_maker.h"
#include "engine/typesetter.h"
#include "engine/workbook_keeper.h"
#include "residency/host_volume_cache.h"

#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

namespace voxsheet::engine {

class Engine::Implementation {
public:
    explicit Implementation(EngineOptions given);

    /// Jobs call back into everything below them: they end first.
    ~Implementation();

    /// Starts the imports and formulas that the new snapshot needs.
    void workbookChanged(std::uint64_t version);

    /// \param importId  of an import that became ready or failed; empty for progress and formulas
    void datasetsChanged(bool settled, const std::string& importId);

    /// Size and checksum of what was imported, for the workbook's file.
    void noteSource(const sheet::Workbook& now, const std::string& importId);

    void notify(ChangeKind kind, std::uint64_t version);

    [[nodiscard]] DatasetInfo infoOf(const std::string& name, const sheet::DatasetSource& source);

    /// Throws NotFound.
    [[nodiscard]] static const sheet::DatasetSource& sourceOf(const sheet::Workbook& now,
                                                              const std::string& name);

    /// As Engine::importDatasets, in the order given.
    std::vector<std::string> import(const std::vector<ImportRequest>& requests, const ImportLayout& layout);

    /// Checks the files and starts the import.
    [[nodiscard]] sheet::NamedDataset namedDataset(const ImportRequest& request);

    [[nodiscard]] static std::vector<std::string> chooseNames(const sheet::Workbook& now,
                                                              const std::vector<sheet::NamedDataset>& added);

    [[nodiscard]] std::shared_ptr<const CellContents> contents(const sheet::Workbook& snapshot);

    /// Of the named sheet, or of the first if the name is empty. Throws NotFound.
    [[nodiscard]] static std::size_t indexOf(const sheet::Workbook& snapshot, const std::string& sheetName);

    /// For ProbeService::atWorld, whose call it must not outlive.
    [[nodiscard]] ProbeService::LayersOf layersOf(const sheet::Workbook& snapshot, std::size_t sheetIndex,
                                                  const View& view,
                                                  const std::shared_ptr<const CellContents>& contents);

    [[nodiscard]] std::future<FrameResult> render(FrameSpec frame, FramePriority priority,
                                                  std::function<bool()> cancelled) const;

    EngineOptions options;
    std::shared_ptr<const sheet::KeyTable> keys;
    std::vector<sheet::StylePreset> presets;
    std::mutex listenerMutex;
    std::map<std::uint64_t, ChangeListener> listeners;
    std::uint64_t lastListener = 0;
    DatasetKeeper datasets;
    std::shared_ptr<HostVolumeCache> hostCache;
    std::unique_ptr<RenderThread> thread;
    std::mutex shownMutex; ///< held until the render thread has been told, so that the newest wins
    ShownVolumes shown;
    TileMaker tiles;
    Typesetter typesetter;
    ProbeService probes;
    WorkbookKeeper workbook;
};

} // namespace voxsheet::engine
