// Volumes that a style names besides the cell's own: what cuts it, and what colours its surfaces.
#pragma once

#include "engine/cell_contents.h"
#include "engine/cell_resolver.h"
#include "engine/clip_resolver.h"
#include "engine/engine.h"
#include "engine/threshold_job.h"
#include "sheet/clip_shape.h"

#include <functional>
#include <memory>
#include <optional>
#include <string>

namespace voxsheet::engine {

/// Where such volumes come from; thread-safe.
struct NamedVolumeSources {
    /// Starts the import unless it is known.
    std::function<JobState(const sheet::DatasetSource&)> import;
    /// Starts the computation unless it is known. `asker` wants no other any more.
    std::function<JobState(const std::string& asker, const ThresholdTask&)> threshold;
    /// `asker` wants none any more.
    std::function<void(const std::string& asker)> release;
    /// [0, 1) of what a pending cell waits for.
    std::function<double(const CellContent&)> progress;
};

/// Why a named volume is not there.
struct MissingVolume {
    std::string code;      ///< "#REF!", "#IMPORT!", …; empty: it is on its way
    std::string message;   ///< what is wrong, or what is being done
    double progress = 0.0; ///< [0, 1), when on its way
};

/// The cell that names, and what it is looked at with.
struct NamingCell {
    const sheet::Workbook& workbook;
    std::size_t sheetIndex = 0;
    sheet::Address cell;
    const View& view;
    const CellContents& contents;
    int timeStep = 0; ///< at which a dataset is taken that is named itself
};

/// Thread-safe.
class NamedVolumes {
public:
    NamedVolumes(const sheet::KeyTable& keys, NamedVolumeSources sources)
        : keys_(keys), sources_(std::move(sources)) {}

    template <typename T>
    struct Found {
        std::optional<T> volume;              ///< absent: `missing` says why
        std::optional<MissingVolume> missing; ///< absent: `volume` is there
    };

    /// What a cell shows, by that cell's own field and time; of a dataset field 0 at the naming cell's time.
    /// A formula's result is as good as a file.
    /// Throws InvalidInput (field `key`) if there is no such cell or dataset, or the cell is empty.
    [[nodiscard]] Found<FormulaInput> find(const sheet::VolumeName& name, const NamingCell& from,
                                           const std::string& key) const;

    /// Of clip.shape, which must not be empty. A dataset need not stand in a cell: it is imported when it is
    /// named. Throws InvalidInput (field clip.shape) as find() and parseClipShape(), and if a dataset does
    /// not hold signed distances.
    [[nodiscard]] Found<ClipObjectVolume> clipObject(const std::string& shape, const NamingCell& from) const;
    /// The cell needs no clip object any more: what was computed for it alone can stop.
    void releaseClipObject(const NamingCell& from) const;

private:
    [[nodiscard]] Found<FormulaInput> ofCell(const sheet::SheetAddress& name, const NamingCell& from,
                                             const std::string& key) const;
    [[nodiscard]] Found<FormulaInput> ofDataset(const std::string& name, const NamingCell& from,
                                                const std::string& key) const;
    [[nodiscard]] Found<ClipObjectVolume> mesh(const sheet::DatasetShape& shape,
                                               const NamingCell& from) const;
    [[nodiscard]] Found<ClipObjectVolume> threshold(const sheet::ComparisonShape& shape,
                                                    const std::string& text, const NamingCell& from) const;

    const sheet::KeyTable& keys_;
    NamedVolumeSources sources_;
};

} // namespace voxsheet::engine
