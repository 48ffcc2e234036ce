#include "base/errors.h"
#include "http/resource/api_context.h"
#include "http/resource/edit_answer.h"
#include "http/resource/workbook_state.h"
#include "http/route/json_answer.h"
#include "sheet/commands.h"

#include <algorithm>

namespace voxsheet::http {

namespace {

constexpr std::uint64_t kPatchBytes = std::uint64_t{1} << 20U;

Response getCell(const ApiContext& context, const Request& request) {
    const auto workbook = context.engine.snapshot();
    const auto& sheet = sheet::sheetNamed(*workbook, request.param("sheet"));
    const auto address = sheet::parseAddress(request.param("cell"));
    const auto resolved =
        sheet::resolveStyle(context.engine.keys(), sheet, address); // throws if it is outside
    const auto statuses = context.engine.cellStatuses(*workbook, sheet.name);
    const auto status = std::find_if(statuses.begin(), statuses.end(),
                                     [&](const engine::CellStatus& entry) { return entry.cell == address; });
    const auto* found = sheet.find(address);
    const auto cell = found != nullptr ? *found : sheet::Cell{};
    auto answer = cellState(address, cell, status != statuses.end() ? &*status : nullptr, resolved.style);
    const auto own = sheet::styleMapToJson(cell.style);
    // Flat, as PATCH takes them, and together for those who want them apart from the rest.
    answer.update(own);
    answer["style"] = own;
    answer["resolved"] = valuesJson(resolved.values);
    return jsonAnswer(answer);
}

/// null or absent: empty.
std::string textOrNull(const nlohmann::json& body, const char* name) {
    const auto& value = body.at(name);
    if (value.is_null()) return {};
    return requireString(body, name);
}

Response patchCell(const ApiContext& context, const Request& request) {
    const auto workbook = context.engine.snapshot();
    const auto& sheet = sheet::sheetNamed(*workbook, request.param("sheet"));
    const auto address = sheet::parseAddress(request.param("cell"));
    const auto layer = sheet::Layer::ofCell(address);
    auto body = jsonBody(request);
    std::vector<sheet::Command> commands;
    if (body.contains("source")) {
        commands.emplace_back(sheet::SetSource{sheet.name, address, textOrNull(body, "source")});
        body.erase("source");
    }
    if (body.contains("title")) {
        commands.emplace_back(sheet::SetTitle{sheet.name, layer, textOrNull(body, "title")});
        body.erase("title");
    }
    if (!body.empty())
        commands.emplace_back(
            sheet::SetStyle{sheet.name, layer, sheet::parseStylePatch(context.engine.keys(), body)});
    return editAnswer(applyTogether(context.engine, commands, request.query.text("gesture").value_or("")));
}

} // namespace

void addCellRoutes(Router& router, const ApiContext& context) {
    router.add({.method = "GET",
                .pattern = "/api/v1/sheets/{sheet}/cells/{cell}",
                .handler = [&context](Request& request) { return getCell(context, request); },
                .summary = "One cell: title, source, state, its own style values and all resolved ones",
                .answerDoc = "{cell, title, source, state, code, message, box: {origin, edges, voxels, "
                             "firstSample, lattice}, "
                             "style, resolved}"});
    router.add(
        {.method = "PATCH",
         .pattern = "/api/v1/sheets/{sheet}/cells/{cell}",
         .handler = [&context](Request& request) { return patchCell(context, request); },
         .summary = "Sets source, title and style values of one cell as one undo step",
         .query = {{"gesture", "string", "edits in a row with the same id are one undo step"}},
         .bodyType = "application/json",
         .bodyDoc =
             "a flat object of dotted keys; \"source\": a dataset's name, a formula \"=B1-A1\" or null; "
             "\"title\": text or null",
         .bodyBudgetBytes = kPatchBytes,
         .answerDoc = "{version, hidden}"});
}

} // namespace voxsheet::http
