#include "base/errors.h"
#include "http/resource/api_context.h"
#include "http/resource/edit_answer.h"
#include "http/resource/style_text.h"
#include "http/resource/workbook_state.h"
#include "http/route/json_answer.h"
#include "sheet/commands.h"
#include "sheet/plane_views.h"

#include <algorithm>
#include <set>

namespace voxsheet::http {

namespace {

constexpr std::uint64_t kBodyBytes = std::uint64_t{1} << 20U;

Response getSheet(const ApiContext& context, const Request& request) {
    const auto workbook = context.engine.snapshot();
    const auto& sheet = sheet::sheetNamed(*workbook, request.param("sheet"));
    return jsonAnswer(sheetState(context.engine, *workbook, sheet));
}

/// Rows are added or taken away at the end; only blank ones are taken away.
void addRowCommand(const sheet::Sheet& sheet, int rows, std::vector<sheet::Command>& commands) {
    if (rows > sheet.rows)
        commands.emplace_back(
            sheet::InsertLines{sheet.name, sheet::Axis::Rows, sheet.rows, rows - sheet.rows});
    if (rows >= sheet.rows) return;
    for (const auto& [address, cell] : sheet.cells)
        if (address.row >= rows)
            throw Conflict("rows", "cell " + sheet::addressName(address) + " would be lost",
                           "empty or move it first")
                .withField("rows");
    commands.emplace_back(sheet::DeleteLines{sheet.name, sheet::Axis::Rows, rows, sheet.rows - rows});
}

Response patchSheet(const ApiContext& context, const Request& request) {
    const auto body = jsonBody(request);
    allowMembers(body, {"columns", "rows", "name", "title"});
    auto workbook = *context.engine.snapshot();
    auto name = sheet::sheetNamed(workbook, request.param("sheet")).name;
    std::vector<sheet::Command> commands;
    const auto add = [&](sheet::Command command) {
        workbook = sheet::apply(workbook, command, context.engine.keys());
        commands.push_back(std::move(command));
    };
    if (body.contains("columns"))
        add(sheet::SetLayout{name, static_cast<int>(integerIn(body, "columns", 1, sheet::kMaxColumns))});
    if (body.contains("rows")) {
        std::vector<sheet::Command> rows;
        addRowCommand(sheet::sheetNamed(workbook, name),
                      static_cast<int>(integerIn(body, "rows", 1, sheet::kMaxRows)), rows);
        for (auto& command : rows)
            add(std::move(command));
    }
    if (body.contains("title"))
        add(sheet::SetTitle{name, sheet::Layer::sheet(), stringOr(body, "title", "")});
    if (body.contains("name")) add(sheet::RenameSheet{name, requireString(body, "name")});
    return editAnswer(applyTogether(context.engine, commands, request.query.text("gesture").value_or("")));
}

std::vector<std::string> textList(const nlohmann::json& body, const char* name) {
    std::vector<std::string> list;
    const auto found = body.find(name);
    if (found == body.end() || found->is_null()) return list;
    if (!found->is_array())
        throw InvalidInput("member '" + std::string(name) + "'", "it must be a list").withField(name);
    for (const auto& item : *found) {
        if (!item.is_string())
            throw InvalidInput("member '" + std::string(name) + "'", "it must hold texts").withField(name);
        list.push_back(item.get<std::string>());
    }
    return list;
}

bool reaches(const sheet::Layer& layer, const std::set<sheet::Address>& cells) {
    if (cells.empty()) return true;
    return std::any_of(cells.begin(), cells.end(), [&](const sheet::Address& cell) {
        switch (layer.kind) {
        case sheet::LayerKind::Column:
            return layer.column == cell.column;
        case sheet::LayerKind::Row:
            return layer.row == cell.row;
        default:
            return layer.column == cell.column && layer.row == cell.row;
        }
    });
}

/// Resets the keys in every column, row and cell that overrides them for the given cells (none given: for
/// all).
Response clearOverrides(const ApiContext& context, const Request& request) {
    const auto body = jsonBody(request);
    allowMembers(body, {"keys", "cells"});
    const auto workbook = context.engine.snapshot();
    const auto& sheet = sheet::sheetNamed(*workbook, request.param("sheet"));
    std::set<std::string> keys;
    for (const auto& key : textList(body, "keys"))
        keys.insert(context.engine.keys().at(key).name);
    if (keys.empty()) throw InvalidInput("member 'keys'", "it names no key").withField("keys");
    std::set<sheet::Address> cells;
    for (const auto& cell : textList(body, "cells"))
        cells.insert(sheet::parseAddress(cell));
    std::vector<sheet::Command> commands;
    for (const auto& entry : sheet::listOverrides(sheet))
        if (keys.contains(entry.key) && reaches(entry.layer, cells))
            commands.emplace_back(sheet::SetStyle{sheet.name, entry.layer, {{entry.key, std::nullopt}}});
    return editAnswer(applyTogether(context.engine, commands));
}

Response makePlanes(const ApiContext& context, const Request& request) {
    const auto body = jsonBody(request);
    allowMembers(body, {"cells"});
    const auto workbook = context.engine.snapshot();
    std::vector<sheet::Address> cells;
    for (const auto& cell : textList(body, "cells"))
        cells.push_back(sheet::parseAddress(cell));
    return editAnswer(applyTogether(context.engine, sheet::planesBeside(*workbook, context.engine.keys(),
                                                                        request.param("sheet"), cells)));
}

sheet::StylePatch asPatch(const sheet::StyleMap& style) {
    sheet::StylePatch patch;
    for (const auto& [key, value] : style)
        patch[key] = value;
    return patch;
}

Response saveView(const ApiContext& context, const Request& request) {
    const auto body = jsonBody(request);
    allowMembers(body, {"style", "cells"});
    const auto workbook = context.engine.snapshot();
    const auto& sheet = sheet::sheetNamed(*workbook, request.param("sheet"));
    const auto view = viewFromJson(body, context.engine.keys());
    std::vector<sheet::Command> commands;
    if (!view.all.empty())
        commands.emplace_back(sheet::SetStyle{sheet.name, sheet::Layer::sheet(), asPatch(view.all)});
    for (const auto& [cell, style] : view.cells)
        if (!style.empty())
            commands.emplace_back(sheet::SetStyle{sheet.name, sheet::Layer::ofCell(cell), asPatch(style)});
    return editAnswer(applyTogether(context.engine, commands));
}

} // namespace

void addSheetRoutes(Router& router, const ApiContext& context) {
    router.add({.method = "GET",
                .pattern = "/api/v1/sheets/{sheet}",
                .handler = [&context](Request& request) { return getSheet(context, request); },
                .summary = "One sheet: its size and its cells with states and resolved styles"});
    router.add({.method = "PATCH",
                .pattern = "/api/v1/sheets/{sheet}",
                .handler = [&context](Request& request) { return patchSheet(context, request); },
                .summary = "Lays the cells out in so many columns or rows, renames the sheet",
                .query = {{"gesture", "string", "edits in a row with the same id are one undo step"}},
                .bodyType = "application/json",
                .bodyDoc = "{columns?, rows?, name?, title?}",
                .bodyBudgetBytes = kBodyBytes,
                .answerDoc = "{version, hidden}"});
    router.add({.method = "POST",
                .pattern = "/api/v1/sheets/{sheet}/clear-overrides",
                .handler = [&context](Request& request) { return clearOverrides(context, request); },
                .summary = "Resets keys wherever a column, row or cell overrides them for the given cells",
                .bodyType = "application/json",
                .bodyDoc = "{keys: [KEY], cells?: [\"A1\"]}",
                .bodyBudgetBytes = kBodyBytes,
                .answerDoc = "{version, hidden}"});
    router.add({.method = "POST",
                .pattern = "/api/v1/sheets/{sheet}/planes",
                .handler = [&context](Request& request) { return makePlanes(context, request); },
                .summary = "Shows each of the cells as axial, coronal and sagittal planes, too, in the three "
                           "cells to the right or below, linked by a crosshair (one undo step)",
                .bodyType = "application/json",
                .bodyDoc = "{cells: [\"A1\"]}",
                .bodyBudgetBytes = kBodyBytes,
                .answerDoc = "{version, hidden}"});
    router.add({.method = "POST",
                .pattern = "/api/v1/sheets/{sheet}/view",
                .handler = [&context](Request& request) { return saveView(context, request); },
                .summary = "Writes a page's view into the workbook (one undo step)",
                .bodyType = "application/json",
                .bodyDoc = "{style?: {KEY: VALUE}, cells?: {\"A1\": {KEY: VALUE}}}",
                .bodyBudgetBytes = kBodyBytes,
                .answerDoc = "{version, hidden}"});
}

} // namespace voxsheet::http
