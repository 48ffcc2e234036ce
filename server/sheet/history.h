// Undo and redo over immutable snapshots.
#pragma once

#include "sheet/commands.h"

#include <cstddef>
#include <deque>
#include <memory>
#include <string>

namespace voxsheet::sheet {

using Snapshot = std::shared_ptr<const Workbook>;

/// What an edit did.
struct EditReport {
    Snapshot snapshot;            ///< after the edit
    bool changed = false;         ///< false: the workbook was like that already
    std::vector<HiddenBy> hidden; ///< SetStyle: nearer values that hide it from some cells (hiddenSentence)
};

/// Not thread-safe: its owner locks. The snapshots it hands out are immutable and may be read anywhere. Every
/// change of the current snapshot, undo and redo included, has a higher version than all before.
class History {
public:
    /// \param limit  most undo steps kept; the oldest go first
    History(std::shared_ptr<const KeyTable> keys, Workbook initial, std::size_t limit = 200);

    [[nodiscard]] const Snapshot& current() const { return current_; }
    [[nodiscard]] const KeyTable& keys() const { return *keys_; }

    /// Applies a command; throws what sheet::apply throws, and then nothing changed. Commands in a row with
    /// the same non-empty gesture are one undo step. A command that changes nothing makes no step.
    EditReport apply(const Command& command, const std::string& gesture = {});
    /// What became known of a source, e.g. its checksum: no undo step, and undo and redo keep it. Throws
    /// NotFound.
    const Snapshot& amend(const UpdateDataset& command);
    /// The next command of the same gesture starts a new step.
    void endGesture() { openGesture_.clear(); }

    /// Throws Conflict if there is nothing to undo or redo.
    const Snapshot& undo();
    const Snapshot& redo();
    [[nodiscard]] bool canUndo() const { return !past_.empty(); }
    [[nodiscard]] bool canRedo() const { return !future_.empty(); }
    /// What undo would take back, what redo would bring; empty if nothing.
    [[nodiscard]] std::string undoLabel() const { return past_.empty() ? std::string{} : past_.back().label; }
    [[nodiscard]] std::string redoLabel() const {
        return future_.empty() ? std::string{} : future_.back().label;
    }

private:
    struct Step {
        Snapshot other;
        std::string label;
    };
    void become(Workbook workbook);
    std::shared_ptr<const KeyTable> keys_;
    Snapshot current_;
    std::uint64_t version_ = 1;
    std::size_t limit_;
    std::deque<Step> past_;
    std::deque<Step> future_;
    std::string openGesture_;
};

} // namespace voxsheet::sheet
