#include "engine/cell_contents.h"

#include "engine/cell_resolver.h"

#include <utility>

namespace voxsheet::engine {

namespace {

CellContent errorContent(const std::string& code, std::string message) {
    CellContent content;
    content.state = CellState::Error;
    content.code = code;
    content.message = std::move(message);
    return content;
}

CellContent pendingContent(const std::string& job, bool computing, const JobState& state) {
    CellContent content;
    content.state = CellState::Pending;
    content.job = job;
    content.computing = computing;
    content.message = state.state == DatasetState::Queued ? "Waiting" : computing ? "Computing" : "Importing";
    return content;
}

CellContent readyContent(std::shared_ptr<const DatasetMeta> meta) {
    CellContent content;
    content.state = CellState::Ready;
    content.notes = meta->notes;
    content.meta = std::move(meta);
    return content;
}

/// Turns the sheet's values into contents; a struct because std::visit needs one overload per kind.
class Evaluation {
public:
    explicit Evaluation(const ContentSources& sources) : sources_(sources) {}

    CellContent operator()(const sheet::EmptyValue&) const { return {}; }
    CellContent operator()(const sheet::CellError& error) const {
        return errorContent(sheet::cellErrorCodeName(error.code), error.sentence);
    }
    CellContent operator()(const sheet::PendingValue& value) const {
        const auto [job, state] = sources_.import(value.dataset);
        return pendingContent(job, false, state);
    }
    CellContent operator()(const sheet::DatasetValue& value) const {
        const auto [job, state] = sources_.import(value.dataset);
        return state.meta ? readyContent(state.meta) : pendingContent(job, false, state);
    }
    CellContent operator()(const sheet::FormulaValue& value) const {
        FormulaTask task{value.plan, {}, formula};
        for (const sheet::PlanInput& input : value.plan.inputs) {
            const auto [job, state] = sources_.import(input.dataset);
            if (!state.meta) return pendingContent(job, false, state);
            try {
                const FieldAndStep shown = chooseField(input.field, input.timeStep, *state.meta);
                task.inputs.push_back({state.meta, shown.field, shown.step});
            } catch (const InvalidInput& error) {
                return errorContent("#REF!", "In '" + input.dataset + "': " + error.what() + ".");
            }
        }
        const auto [job, state] = sources_.formula(task);
        if (state.state == DatasetState::Failed) {
            const bool memory = state.failure && state.failure->kind == ErrorKind::LimitExceeded;
            return errorContent(memory ? "#MEM!" : "#TYPE!",
                                state.failure ? state.failure->message : "it failed");
        }
        if (!state.meta) return pendingContent(job, true, state);
        CellContent content = readyContent(state.meta);
        content.notes.insert(content.notes.end(), value.notes.begin(), value.notes.end());
        return content;
    }

    std::string formula; ///< of the cell at hand

private:
    const ContentSources& sources_;
};

} // namespace

CellContents evaluateContents(const sheet::KeyTable& keys, const sheet::Workbook& workbook,
                              const ContentSources& sources) {
    const sheet::DatasetLookup lookup = [&](const std::string& name) -> sheet::DatasetState {
        const JobState state = sources.import(name).second;
        if (state.meta) return sheet::DatasetReady{state.meta->grid};
        if (state.failure) return sheet::DatasetFailed{state.failure->message};
        return sheet::DatasetPending{};
    };
    const sheet::WorkbookValues values = sheet::evaluateWorkbook(keys, workbook, lookup);
    CellContents contents;
    Evaluation evaluation(sources);
    for (const auto& [position, value] : values.cells) {
        const sheet::Cell* cell = workbook.sheets.at(position.sheet).find(position.cell);
        evaluation.formula = cell != nullptr ? cell->source : std::string{};
        contents[position] = std::visit(evaluation, value);
    }
    return contents;
}

const CellContent& contentAt(const CellContents& contents, const sheet::CellPosition& position) {
    static const CellContent empty;
    const auto found = contents.find(position);
    return found == contents.end() ? empty : found->second;
}

} // namespace voxsheet::engine
