// What stands in every cell of a workbook right now: a dataset, a formula's result, something on its way,
// or an error.
#pragma once

#include "engine/cell_state.h"
#include "engine/entry_jobs.h"
#include "engine/formula_job.h"
#include "sheet/formula/values.h"

#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace voxsheet::engine {

struct CellContent {
    CellState state = CellState::Empty;
    std::string code;                        ///< Error: "#IMPORT!", "#GRID!", …
    std::string message;                     ///< Error: the sentence; Pending: what is being done
    std::shared_ptr<const DatasetMeta> meta; ///< Ready
    std::string job;                         ///< Pending: id of the job that is waited for
    bool computing = false;                  ///< Pending: `job` is a formula's, not an import's
    std::vector<std::string> notes;          ///< what a user should know, one sentence each
};

using CellContents = std::map<sheet::CellPosition, CellContent>;

/// Where contents come from.
struct ContentSources {
    /// State of a dataset of the workbook, and the id of its job.
    std::function<std::pair<std::string, JobState>(const std::string& dataset)> import;
    /// Starts the computation unless it is known, and tells its state.
    std::function<std::pair<std::string, JobState>(const FormulaTask& task)> formula;
};

/// Of every cell with a source.
[[nodiscard]] CellContents evaluateContents(const sheet::KeyTable& keys, const sheet::Workbook& workbook,
                                            const ContentSources& sources);

/// EmptyValue's content if the cell has no source.
[[nodiscard]] const CellContent& contentAt(const CellContents& contents, const sheet::CellPosition& position);

} // namespace voxsheet::engine
