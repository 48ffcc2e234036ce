#include "sheet/history.h"

#include "base/errors.h"

#include <utility>

namespace voxsheet::sheet {

History::History(std::shared_ptr<const KeyTable> keys, Workbook initial, std::size_t limit)
    : keys_(std::move(keys)), limit_(limit) {
    validateWorkbook(initial);
    become(std::move(initial));
}

void History::become(Workbook workbook) {
    workbook.version = version_++;
    current_ = std::make_shared<const Workbook>(std::move(workbook));
}

EditReport History::apply(const Command& command, const std::string& gesture) {
    Workbook next = sheet::apply(*current_, command, *keys_);
    EditReport report;
    report.changed = !(next == *current_);
    if (report.changed) {
        const bool continues = !gesture.empty() && gesture == openGesture_ && !past_.empty();
        if (!continues) past_.push_back({current_, commandLabel(command)});
        if (past_.size() > limit_) past_.pop_front();
        future_.clear();
        openGesture_ = gesture;
        become(std::move(next));
    }
    report.snapshot = current_;
    if (const auto* style = std::get_if<SetStyle>(&command)) {
        std::vector<std::string> names;
        for (const auto& [key, value] : style->patch)
            names.push_back(key);
        report.hidden = hiddenBy(sheetNamed(*current_, style->sheet), style->layer, names);
    }
    return report;
}

const Snapshot& History::amend(const UpdateDataset& command) {
    Workbook next = sheet::apply(*current_, command, *keys_);
    for (std::deque<Step>* steps : {&past_, &future_})
        for (Step& step : *steps)
            if (step.other->datasets.contains(command.name))
                step.other = std::make_shared<const Workbook>(sheet::apply(*step.other, command, *keys_));
    if (!(next == *current_)) become(std::move(next));
    return current_;
}

const Snapshot& History::undo() {
    if (past_.empty()) throw Conflict("undo", "there is nothing to undo");
    future_.push_back({current_, past_.back().label});
    become(*past_.back().other);
    past_.pop_back();
    openGesture_.clear();
    return current_;
}

const Snapshot& History::redo() {
    if (future_.empty()) throw Conflict("redo", "there is nothing to redo");
    past_.push_back({current_, future_.back().label});
    become(*future_.back().other);
    future_.pop_back();
    openGesture_.clear();
    return current_;
}

} // namespace voxsheet::sheet
