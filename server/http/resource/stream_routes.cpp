#include "http/resource/api_context.h"
#include "http/resource/stream_update.h"
#include "http/route/json_answer.h"

#include <memory>

namespace voxsheet::http {

namespace {

/// Closes the stream however its response ends, even if it never began.
class OpenStream {
public:
    OpenStream(stream::StreamHub& hub, const std::string& sheet, const stream::StreamOptions& options)
        : hub_(hub), id_(hub.open(sheet, options)) {}
    ~OpenStream() { hub_.close(id_); }
    OpenStream(const OpenStream&) = delete;
    OpenStream& operator=(const OpenStream&) = delete;
    [[nodiscard]] const std::string& id() const { return id_; }
    [[nodiscard]] std::optional<std::string> next() { return hub_.next(id_); }

private:
    stream::StreamHub& hub_;
    std::string id_;
};

Response openStream(const ApiContext& context, const Request& request) {
    const auto workbook = context.engine.snapshot();
    const auto& sheet = sheet::sheetNamed(*workbook, request.param("sheet"));
    const auto width = request.query.number("width", 1.0, 32768.0);
    const auto height = request.query.number("height", 1.0, 32768.0);
    const auto dpr = request.query.number("dpr", 0.1, 16.0).value_or(1.0);
    const stream::StreamOptions options{request.query.boolean("atlas").value_or(false)};
    auto open = std::make_shared<OpenStream>(context.hub, sheet.name, options);
    if (width && height)
        context.hub.update(open->id(),
                           {std::nullopt, wholeSheetView(sheet, glm::dvec2(*width, *height) * dpr)});
    Response response{200, "application/vnd.voxsheet.stream", {}};
    // Proxies that collect a response before they pass it on would hold frames back.
    response.headers.add("X-Accel-Buffering", "no");
    response.stream = [open](StreamWriter& writer) {
        while (writer.open()) {
            const auto message = open->next();
            if (!message || !writer.write(*message)) return;
        }
    };
    return response;
}

} // namespace

void addStreamRoutes(Router& router, const ApiContext& context) {
    router.add(
        {.method = "GET",
         .pattern = "/api/v1/sheets/{sheet}/stream",
         .handler = [&context](Request& request) { return openStream(context, request); },
         .summary =
             "One framed stream per page: only tiles that changed. A message is u32le header bytes, u32le "
             "payload bytes, header (JSON), payload (an encoded picture)",
         .query =
             {{"width", "number", "of the whole sheet, CSS pixels; with height: draw all cells at once"},
              {"height", "number", "of the whole sheet, CSS pixels"},
              {"dpr", "number", "device pixels per CSS pixel"},
              {"atlas", "boolean",
               "several tiles of a moving frame may come in one picture (messages \"tiles\": in the header "
               "the list `tiles` of cell, x, y, width, height and what else a tile says)"}},
         .pool = Pool::Stream,
         .answerType = "application/vnd.voxsheet.stream",
         .answerDoc = "messages hello, workbook, datasets, tile, tiles (atlas), cell, status, rest, ping"});
    router.add({.method = "POST",
                .pattern = "/api/v1/streams/{id}",
                .handler =
                    [&context](Request& request) {
                        context.hub.update(request.param("id"),
                                           streamUpdateFromJson(jsonBody(request), context.engine.keys()));
                        return noContent();
                    },
                .summary = "Acknowledges frames (cumulative) and carries the newest view",
                .bodyType = "application/json",
                .bodyDoc = "{ack?, view?: {id, moving, tiles: [{cell, width, height}], focus, style, cells}}",
                .bodyBudgetBytes = std::uint64_t{4} << 20U,
                .successStatus = 204});
    router.add({.method = "DELETE",
                .pattern = "/api/v1/streams/{id}",
                .handler =
                    [&context](Request& request) {
                        context.hub.close(request.param("id"));
                        return noContent();
                    },
                .summary = "Closes a stream",
                .bodyBudgetBytes = 1024,
                .successStatus = 204});
}

} // namespace voxsheet::http
