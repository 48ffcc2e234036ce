#include "http/resource/edit_answer.h"

#include "http/route/json_answer.h"
#include "sheet/commands.h"

#include <atomic>

namespace voxsheet::http {

const char* layerWord(sheet::LayerKind kind) {
    switch (kind) {
    case sheet::LayerKind::Default:
        return "default";
    case sheet::LayerKind::Sheet:
        return "sheet";
    case sheet::LayerKind::Column:
        return "column";
    case sheet::LayerKind::Row:
        return "row";
    case sheet::LayerKind::Cell:
        return "cell";
    case sheet::LayerKind::PageView:
    case sheet::LayerKind::PageCell:
        return "view";
    case sheet::LayerKind::Request:
        break;
    }
    return "request";
}

engine::EditReport applyTogether(engine::Engine& engine, const std::vector<sheet::Command>& commands,
                                 const std::string& gesture) {
    static std::atomic<std::uint64_t> serial{0};
    engine::EditReport all;
    all.version = engine.version();
    if (commands.empty()) return all;
    if (commands.size() > 1) {
        // A later command may fail: try them on a copy first, so that a refused request changes nothing.
        auto trial = *engine.snapshot();
        for (const auto& command : commands)
            trial = sheet::apply(trial, command, engine.keys());
    }
    const auto step =
        gesture.empty() && commands.size() > 1 ? "request-" + std::to_string(++serial) : gesture;
    for (const auto& command : commands) {
        auto report = engine.apply(command, step);
        all.version = report.version;
        for (auto& hidden : report.hidden)
            all.hidden.push_back(std::move(hidden));
    }
    return all;
}

Response editAnswer(const engine::EditReport& report) {
    auto hidden = nlohmann::json::array();
    for (const auto& entry : report.hidden)
        for (const auto& cell : entry.cells)
            hidden.push_back({{"cell", sheet::addressName(cell)},
                              {"key", entry.key},
                              {"by", layerWord(entry.nearer.kind)}});
    nlohmann::json answer{{"version", report.version}, {"hidden", std::move(hidden)}};
    if (!report.hidden.empty()) answer["message"] = sheet::hiddenSentence(report.hidden);
    return jsonAnswer(answer);
}

} // namespace voxsheet::http
