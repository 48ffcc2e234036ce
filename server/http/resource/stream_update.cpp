#include "http/resource/stream_update.h"

#include "base/errors.h"
#include "http/resource/style_text.h"
#include "http/route/json_answer.h"

#include <algorithm>

namespace voxsheet::http {

namespace {

constexpr int kMaxSide = 8192;
constexpr std::size_t kMaxTiles = sheet::kMaxCells;

std::vector<stream::ViewTile> tilesFromJson(const nlohmann::json& view) {
    std::vector<stream::ViewTile> tiles;
    const auto found = view.find("tiles");
    if (found == view.end()) return tiles;
    if (!found->is_array() || found->size() > kMaxTiles)
        throw InvalidInput("member 'tiles'", "it must be a list of cells").withField("tiles");
    for (const auto& item : *found) {
        if (!item.is_object())
            throw InvalidInput("member 'tiles'", "it must hold objects").withField("tiles");
        allowMembers(item, {"cell", "width", "height"});
        tiles.push_back({sheet::parseAddress(requireString(item, "cell")),
                         {static_cast<int>(integerIn(item, "width", 1, kMaxSide)),
                          static_cast<int>(integerIn(item, "height", 1, kMaxSide))}});
    }
    return tiles;
}

stream::ClientView clientView(const nlohmann::json& json, const sheet::KeyTable& keys) {
    if (!json.is_object()) throw InvalidInput("member 'view'", "it must be an object").withField("view");
    allowMembers(json, {"id", "moving", "tiles", "focus", "style", "cells"});
    stream::ClientView view;
    view.id = static_cast<std::uint64_t>(integerIn(json, "id", 0, INT64_MAX));
    view.moving = booleanOr(json, "moving", false);
    view.tiles = tilesFromJson(json);
    if (const auto focus = stringOr(json, "focus", ""); !focus.empty())
        view.focus = sheet::parseAddress(focus);
    view.overrides = viewFromJson(json, keys);
    return view;
}

} // namespace

stream::StreamUpdate streamUpdateFromJson(const nlohmann::json& body, const sheet::KeyTable& keys) {
    allowMembers(body, {"ack", "view"});
    stream::StreamUpdate update;
    if (body.contains("ack")) update.ack = static_cast<std::uint64_t>(integerIn(body, "ack", 0, INT64_MAX));
    if (const auto view = body.find("view"); view != body.end() && !view->is_null())
        update.view = clientView(*view, keys);
    return update;
}

stream::ClientView wholeSheetView(const sheet::Sheet& sheet, glm::dvec2 sizePixels) {
    stream::ClientView view;
    const glm::ivec2 tile = glm::clamp(glm::ivec2(sizePixels / glm::dvec2(sheet.columns, sheet.rows)),
                                       glm::ivec2(16), glm::ivec2(kMaxSide));
    for (const auto& [address, cell] : sheet.cells)
        if (!cell.source.empty()) view.tiles.push_back({address, tile});
    return view;
}

} // namespace voxsheet::http
