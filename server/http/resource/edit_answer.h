// Edits of the workbook: several commands as one undo step, and what they answer.
#pragma once

#include "engine/engine.h"
#include "http/message/response.h"

#include <string>
#include <vector>

namespace voxsheet::http {

/// Applies all or nothing, as one undo step; the same non-empty gesture merges with the step before.
/// Throws as Engine::apply.
[[nodiscard]] engine::EditReport applyTogether(engine::Engine& engine,
                                               const std::vector<sheet::Command>& commands,
                                               const std::string& gesture = {});

/// {"version", "hidden": [{"cell", "key", "by": "cell|row|column"}], "message"?}: which cells do not show the
/// edit, and why.
[[nodiscard]] Response editAnswer(const engine::EditReport& report);

/// "default", "sheet", "column", "row", "cell", "view" or "request".
[[nodiscard]] const char* layerWord(sheet::LayerKind kind);

} // namespace voxsheet::http
