#include "http/resource/api_context.h"
#include "http/resource/edit_answer.h"
#include "http/resource/workbook_state.h"
#include "http/route/json_answer.h"
#include "sheet/commands.h"

namespace voxsheet::http {

namespace {

constexpr std::uint64_t kPatchBytes = std::uint64_t{1} << 20U;

using LayerOf = sheet::Layer (*)(const Request&);

/// The sheet as it is called, so that edits and messages use one spelling.
const sheet::Sheet& sheetOf(const sheet::Workbook& workbook, const Request& request) {
    return sheet::sheetNamed(workbook, request.param("sheet"));
}

Response getStyle(const ApiContext& context, const Request& request, LayerOf layerOf) {
    const auto workbook = context.engine.snapshot();
    const auto& sheet = sheetOf(*workbook, request);
    const auto layer = layerOf(request);
    const auto& own = sheet::ownStyle(sheet, layer);
    if (!request.query.boolean("resolved").value_or(false)) return jsonAnswer(sheet::styleMapToJson(own));
    return jsonAnswer(valuesJson(sheet::resolveLayer(context.engine.keys(), sheet, layer)));
}

Response patchStyle(const ApiContext& context, const Request& request, LayerOf layerOf) {
    const auto workbook = context.engine.snapshot();
    sheet::SetStyle edit;
    edit.sheet = sheetOf(*workbook, request).name;
    edit.layer = layerOf(request);
    edit.patch = sheet::parseStylePatch(context.engine.keys(), jsonBody(request));
    edit.clearNearer = request.query.boolean("clear").value_or(false);
    return editAnswer(context.engine.apply(edit, request.query.text("gesture").value_or("")));
}

void addLayer(Router& router, const ApiContext& context, const std::string& pattern, const std::string& what,
              LayerOf layerOf) {
    router.add(
        {.method = "GET",
         .pattern = pattern,
         .handler = [&context, layerOf](Request& request) { return getStyle(context, request, layerOf); },
         .summary = "The style values that the " + what + " sets itself",
         .query = {{"resolved", "boolean", "every key with its value and where it comes from"}},
         .answerDoc = "a flat object of dotted keys; resolved: {KEY: {value, origin}}"});
    router.add(
        {.method = "PATCH",
         .pattern = pattern,
         .handler = [&context, layerOf](Request& request) { return patchStyle(context, request, layerOf); },
         .summary = "Sets style values of the " + what + "; null resets a key to its inherited value",
         .query = {{"gesture", "string", "edits in a row with the same id are one undo step"},
                   {"clear", "boolean", "also removes these keys where a nearer layer would hide the edit"}},
         .bodyType = "application/json",
         .bodyDoc = "a flat object of dotted keys",
         .bodyBudgetBytes = kPatchBytes,
         .answerDoc = "{version, hidden: [{cell, key, by}]}"});
}

} // namespace

void addStyleRoutes(Router& router, const ApiContext& context) {
    addLayer(router, context, "/api/v1/sheets/{sheet}/style", "sheet",
             [](const Request&) { return sheet::Layer::sheet(); });
    addLayer(router, context, "/api/v1/sheets/{sheet}/columns/{column}/style", "column",
             [](const Request& request) {
                 return sheet::Layer::ofColumn(sheet::parseColumn(request.param("column")));
             });
    addLayer(router, context, "/api/v1/sheets/{sheet}/rows/{row}/style", "row", [](const Request& request) {
        return sheet::Layer::ofRow(sheet::parseRow(request.param("row")));
    });
}

} // namespace voxsheet::http
