#include "base/errors.h"
#include "http/resource/api_context.h"
#include "http/resource/style_text.h"
#include "http/route/problem.h"

#include <sstream>

namespace voxsheet::http {

namespace {

constexpr long long kMaxSide = 8192;
constexpr long long kMaxPixels = 64LL << 20U; ///< of one picture: 256 MiB before encoding

stream::EncodeSettings encodingFor(const Request& request) {
    const auto& extension = request.param("format");
    const auto format = stream::formatFromExtension(extension);
    if (!format)
        throw NotFound("image format '" + extension + "'", "pictures come as png, jpg or webp")
            .withField("format");
    stream::EncodeSettings settings;
    settings.format = *format;
    settings.quality = 92;
    return settings;
}

glm::ivec2 sizeOf(const Query& query, const glm::ivec2& fallback) {
    const auto width = query.integer("width", 1, kMaxSide).value_or(fallback.x);
    const auto height = query.integer("height", 1, kMaxSide).value_or(fallback.y);
    if (width * height > kMaxPixels)
        throw LimitExceeded("picture", "it would have more than 64 million pixels", "ask for a smaller one")
            .withField("width");
    return {static_cast<int>(width), static_cast<int>(height)};
}

std::string quoted(const std::string& identity) { return '"' + identity + '"'; }

/// RFC 9110, 13.1.2; a weak tag compares as its strong twin.
bool noneMatchHolds(const Request& request, const std::string& tag) {
    const auto text = request.headers.find("If-None-Match");
    if (!text) return false;
    std::string_view rest = *text;
    while (!rest.empty()) {
        const auto comma = rest.find(',');
        auto entry = trimmed(rest.substr(0, comma));
        if (entry.starts_with("W/")) entry.remove_prefix(2);
        if (entry == "*" || entry == tag) return true;
        if (comma == std::string_view::npos) break;
        rest.remove_prefix(comma + 1);
    }
    return false;
}

Response notModified(const std::string& tag) {
    Response response{304, {}, {}};
    response.headers.add("ETag", tag);
    response.headers.add("Cache-Control", "private, no-cache");
    return response;
}

std::string milliseconds(double value) {
    std::ostringstream out;
    out.setf(std::ios::fixed);
    out.precision(2);
    out << value;
    return out.str();
}

/// Of any text: what headers cannot carry, and '%', as percent escapes of its UTF-8 bytes.
std::string headerText(const std::string& text) {
    std::string out;
    for (const char each : text) {
        const auto byte = static_cast<unsigned char>(each);
        if (byte >= 0x20 && byte < 0x7F && each != '%')
            out += each;
        else
            out += percentEncoded(std::string(1, each));
    }
    return out;
}

Response imageAnswer(const stream::EncodedImage& image) {
    Response response{200, stream::mediaType(image.format), image.bytes};
    response.headers.add("X-Voxsheet-Level", std::to_string(image.level));
    response.headers.add("X-Voxsheet-Render-Ms", milliseconds(image.renderMs));
    response.headers.add("X-Voxsheet-Final", image.final ? "true" : "false");
    if (!image.note.empty()) response.headers.add("X-Voxsheet-Note", headerText(image.note));
    if (!image.final) {
        response.headers.add("Cache-Control", "no-store");
        return response;
    }
    response.headers.add("ETag", quoted(image.identity));
    // Kept, but asked about each time: the same URL shows other pixels after an edit.
    response.headers.add("Cache-Control", "private, no-cache");
    return response;
}

/// As in a picture of the sheet: with title, colour bar, crosshair and orientation.
Response annotatedCell(const ApiContext& context, const Request& request,
                       const stream::CellImageRequest& wanted) {
    static_cast<void>(context.tiles.cellIdentity(wanted)); // A cell without a picture is an error here.
    engine::SheetImageRequest alone;
    alone.sheet = wanted.sheet;
    alone.range = sheet::AddressRange{wanted.cell, wanted.cell};
    alone.sizePixels = wanted.quality.sizePixels;
    alone.view = wanted.view;
    const auto image = context.tiles.sheetImage(alone, wanted.encoding);
    const auto tag = quoted(image->identity);
    if (image->final && noneMatchHolds(request, tag)) return notModified(tag);
    return imageAnswer(*image);
}

Response cellImage(const ApiContext& context, const Request& request) {
    stream::CellImageRequest wanted;
    const auto workbook = context.engine.snapshot();
    wanted.sheet = sheet::sheetNamed(*workbook, request.param("sheet")).name;
    wanted.cell = sheet::parseAddress(request.param("cell"));
    wanted.encoding = encodingFor(request);
    wanted.quality.sizePixels = sizeOf(request.query, {512, 512});
    wanted.view.request =
        styleFromQuery(request.query, context.engine.keys(), {"width", "height", "annotate"});
    if (request.query.boolean("annotate").value_or(false)) return annotatedCell(context, request, wanted);
    if (request.headers.find("If-None-Match")) {
        const auto tag = quoted(context.tiles.cellIdentity(wanted));
        if (noneMatchHolds(request, tag)) return notModified(tag);
    }
    return imageAnswer(*context.tiles.cellImage(wanted, [gone = request.gone] { return gone->load(); }));
}

Response sheetImage(const ApiContext& context, const Request& request) {
    engine::SheetImageRequest wanted;
    const auto workbook = context.engine.snapshot();
    wanted.sheet = sheet::sheetNamed(*workbook, request.param("sheet")).name;
    if (const auto range = request.query.text("range"); range && !range->empty())
        wanted.range = sheet::parseRange(*range);
    wanted.sizePixels = sizeOf(request.query, {0, 0});
    wanted.title = request.query.text("title").value_or("");
    wanted.annotate = request.query.boolean("annotate").value_or(true);
    wanted.view.request = styleFromQuery(request.query, context.engine.keys(),
                                         {"width", "height", "range", "title", "annotate"});
    const auto image = context.tiles.sheetImage(wanted, encodingFor(request));
    const auto tag = quoted(image->identity);
    if (image->final && noneMatchHolds(request, tag)) return notModified(tag);
    return imageAnswer(*image);
}

const std::vector<ParamDoc> kSizeDocs{{"width", "integer", "pixels, 1 to 8192"},
                                      {"height", "integer", "pixels, 1 to 8192"}};

} // namespace

void addImageRoutes(Router& router, const ApiContext& context) {
    auto cellDocs = kSizeDocs;
    cellDocs.push_back({"annotate", "boolean",
                        "with title, colour bar, crosshair and orientation, as in a picture of the sheet "
                        "(default false)"});
    router.add(
        {.method = "GET",
         .pattern = "/api/v1/sheets/{sheet}/cells/{cell}/image.{format}",
         .handler = [&context](Request& request) { return cellImage(context, request); },
         .summary =
             "One cell as png, jpg or webp; any style key may be set in the query for this picture alone",
         .query = cellDocs,
         .anyStyleKey = true,
         .pool = Pool::Render,
         .answerType = "image/png",
         .answerDoc =
             "the picture; headers ETag, X-Voxsheet-Level, X-Voxsheet-Render-Ms, X-Voxsheet-Final, "
             "X-Voxsheet-Note (percent-encoded where it is not ASCII: why the picture is coarser than "
             "asked for, or empty)"});
    auto docs = kSizeDocs;
    docs.push_back({"range", "string", "cells, e.g. A1:C3; default: all used ones"});
    docs.push_back({"title", "string", "drawn above the sheet"});
    docs.push_back({"annotate", "boolean", "names, headers and colour bars (default true)"});
    router.add({.method = "GET",
                .pattern = "/api/v1/sheets/{sheet}/image.{format}",
                .handler = [&context](Request& request) { return sheetImage(context, request); },
                .summary = "The sheet as png, jpg or webp",
                .query = docs,
                .anyStyleKey = true,
                .pool = Pool::Render,
                .answerType = "image/png",
                .answerDoc = "the picture; headers as of one cell"});
}

} // namespace voxsheet::http
