#include "fuzz_target.h"

#include "base/errors.h"
#include "http/message/chunked_decoder.h"
#include "http/message/query.h"
#include "http/message/request_head.h"
#include "import/client/import_options_json.h"
#include "import/client/import_protocol.h"
#include "sheet/clip_shape.h"
#include "sheet/formula/parser.h"
#include "sheet/formula/references.h"
#include "sheet/layout_pattern.h"
#include "sheet/style_keys.h"
#include "sheet/style_presets.h"
#include "sheet/workbook_json.h"
#include "store/meta_json.h"

#include <nlohmann/json.hpp>

#include <stdexcept>

namespace voxsheet::fuzz {

namespace {

using nlohmann::json;

const sheet::KeyTable& keys() {
    static const auto table = sheet::makeKeyTable({"auto", "viridis", "grey"});
    return table;
}

FuzzTarget workbook() {
    return {
        "workbook",
        {R"({"voxsheet": 1, "sheets": [{"name": "Sheet1", "columns": 1, "rows": 1}]})",
         R"({"voxsheet": 1, "title": "t", "datasets": {"run1": {"files": ["a/CHGCAR"], "bytes": 123, )"
         R"("checksum": "xxh3:0", "options": {}}}, "sheets": [{"name": "S", "title": "x", "columns": 3, "rows": 2, )"
         R"("style": {"camera.azimuth": 40, "clip.planes": [[0,-1,0,0.5]], "transfer.map": "viridis"}, )"
         R"("levels": {"policy": "slope"}, "columnHeaders": {"A": {"title": "a", "style": {"camera.fov": 30}}}, )"
         R"("rowHeaders": {"1": {"style": {"range.mode": "shared"}}}, )"
         R"("cells": {"A1": {"source": "run1", "title": "c"}, "B1": {"source": "=B1-A1"}}}]})"},
        [](std::string_view text) {
            const auto workbook = sheet::parseWorkbook(text, keys());
            const auto written = sheet::serialiseWorkbook(workbook);
            promise(sheet::serialiseWorkbook(sheet::parseWorkbook(written, keys())) == written,
                    "a workbook that reads back otherwise than it was written");
        }};
}

FuzzTarget storeMeta() {
    return {
        "store_meta",
        {R"({"anatomical":false,"fields":[{"name":"v","quantity":"","steps":[],"stored_type":"u8","unit":"",)"
         R"("value_offset":0.0,"value_scale":1.0}],"format":"nrrd","grid":{"centring":"point","dims":[1,1,1],)"
         R"("periodic":[false,false,false],"world_from_index_columns":[[1,0,0],[0,1,0],[0,0,1],[0,0,0]]},)"
         R"("length_unit":"","notes":[],"source_path":"x","source_type":"u8","times":[0.0]})"},
        [](std::string_view text) {
            const auto meta = store::metaFromJson(store::parseJson(text, "meta.json"));
            (void)store::metaToJson(meta).dump(-1, ' ', false, json::error_handler_t::replace);
        }};
}

FuzzTarget importerMessage() {
    auto header = storeMeta().seeds[0];
    return {"importer_message",
            {R"({"progress": 0.5})", R"({"key": "0123456789abcdef0123456789abcdef"})",
             R"({"error":{"kind":"invalid_input","what":"a","why":"b","todo":"c","field":""}})",
             R"({"header":{"dataset":)" + header + R"(,"files":["x"],"voxel_bytes":1}})"},
            [](std::string_view line) {
                const auto message = import::decodeMessage(line);
                (void)import::encodeMessage(message);
                if (const auto* error = std::get_if<import::ErrorMessage>(&message))
                    import::throwError(*error);
            }};
}

FuzzTarget importOptions() {
    return {
        "import_options",
        {R"({"dims": [5, 6, 7], "type": "i16", "endian": "big", "skip_bytes": 3, "components": 2})",
         R"({"spacing": [1, 2, 3], "origin": [0, 0, 0], "flip": [true, false, false], "periodic": true, )"
         R"("no_data": -1, "bit_mask": "0x7fff", "orientation": "LPI", "resolution": 64, "divide_by_cell_volume": false})"},
        [](std::string_view text) {
            const auto options = import::importOptionsFromJson(store::parseJson(text, "options"));
            const auto canonical = import::canonicalOptions(options);
            const auto again = import::importOptionsFromJson(store::parseJson(canonical, "options"));
            promise(import::canonicalOptions(again) == canonical, "options whose canonical text differs");
        }};
}

FuzzTarget formula() {
    return {"formula",
            {"=B1-A1", "=abs(Sheet2!B4)/2 + -3.5e-2*(A1:B2)", "='my sheet'!C12 * sum(A1:A9, 4)",
             "=((((A1))))", "=#REF!+1"},
            [](std::string_view text) {
                const bool parses = std::holds_alternative<sheet::FormulaAst>(sheet::parseFormula(text));
                const auto same =
                    sheet::rewriteReferences(text, [](const std::string&, const sheet::AddressRange& range) {
                        return std::optional(range);
                    });
                if (parses)
                    promise(std::holds_alternative<sheet::FormulaAst>(sheet::parseFormula(same)),
                            "a formula that does not parse after its references moved nowhere");
                else
                    promise(same == text, "a text that is no formula was changed");
                (void)sheet::rewriteReferences(
                    text, [](const std::string&, const sheet::AddressRange&) { return std::nullopt; });
                (void)sheet::rewriteSheet(text, "Sheet2", "other sheet");
            }};
}

FuzzTarget style() {
    return {"style",
            {"camera.azimuth=40", "clip.planes=0,-1,0,0.5; 1,0,0,0.2", "transfer.points=0:#000000,1:#ffffff",
             "transfer.opacity=0:0,0.3:0.1,1:0.8", "isovalue=0.4,1.2", "clip.shape='run 2' <= -1",
             "clip.shape=sphere", "layers=A1; Sheet2!C1; 'run; 2'", "range.mode=shared",
             "light.directions=[[0,0,1]]", "transfer.map="},
            [](std::string_view text) {
                const auto [key, value] = sheet::parseAssignment(keys(), text);
                if (!value) return;
                const auto& spec = keys().at(key);
                sheet::validateStyleValue(spec, *value);
            }};
}

FuzzTarget stylePatch() {
    return {
        "style_json",
        {R"({"camera.azimuth": 40, "clip.planes": [[0,-1,0,0.5]], "transfer.map": null, "isovalue": [0.4, 1.2]})",
         R"({"transfer.points": [[0, "#000000"], [1, "#ffffff"]], "layers": "A1; B1", "clip.shape": "B1 > 0.4"})"},
        [](std::string_view text) { (void)sheet::parseStylePatch(keys(), store::parseJson(text, "style")); }};
}

FuzzTarget names() {
    return {"names",
            {"B1 > 0.4", "'run 2' <= -1", "sphere", "A1; B1; 'x; y'",
             "sub-{row}_{col}.nii.gz\nsub-1_a.nii.gz\nsub-2_b.nii.gz"},
            [](std::string_view text) {
                const auto attempt = [](const auto& parse) {
                    try {
                        parse();
                    } catch (const Error&) { // an answer; the others are asked, too
                    }
                };
                attempt([&] { (void)sheet::parseClipShape(text); });
                attempt([&] { (void)sheet::parseLayers(text); });
                attempt([&] { (void)sheet::parseSheetAddress(text); });
                attempt([&] { (void)sheet::parseRange(text); });
                std::vector<std::string> paths;
                const auto end = text.find('\n');
                for (auto rest = end == std::string_view::npos ? "" : text.substr(end + 1); !rest.empty();) {
                    const auto line = rest.substr(0, rest.find('\n'));
                    paths.emplace_back(line);
                    rest.remove_prefix(std::min(rest.size(), line.size() + 1));
                }
                attempt([&] { (void)sheet::placeByPattern(text.substr(0, end), paths); });
            }};
}

FuzzTarget request() {
    return {
        "http_request",
        {"GET /api/v1/state?styles=own HTTP/1.1\r\nHost: localhost:8080\r\nConnection: close\r\n\r\n",
         "POST /api/v1/datasets HTTP/1.1\r\nHost: x\r\nContent-Length: 3\r\nExpect: 100-continue\r\n\r\nabc",
         "PUT /u HTTP/1.1\r\nHost: x\r\nTransfer-Encoding: chunked\r\n\r\n3\r\nabc\r\n0\r\n\r\n",
         "GET /a%20b?x=1&y=a+b%25 HTTP/1.0\r\n\r\n"},
        [](std::string_view received) {
            const http::HeadLimits limits;
            try {
                const auto bytes = http::headBytes(received, limits);
                if (!bytes) return;
                promise(*bytes <= received.size(), "a head longer than what was received");
                const auto head = http::parseHead(received.substr(0, *bytes), limits);
                promise(!head.path.empty() && head.path[0] == '/', "a path without its slash");
                const http::Query query(head.query);
                (void)http::percentDecoded(head.path, false);
                if (!head.chunked) return;
                http::ChunkedDecoder decoder;
                std::string body;
                for (auto rest = received.substr(*bytes); !rest.empty() && !decoder.done();) {
                    const auto taken = decoder.feed(rest.substr(0, 7), body);
                    promise(taken <= rest.size(), "more taken than given");
                    promise(taken > 0 || decoder.done(), "nothing taken");
                    rest.remove_prefix(taken);
                }
                promise(body.size() <= received.size(), "a body longer than what was received");
            } catch (const http::BadHead& bad) {
                promise(bad.status >= 400 && bad.status < 600 && !bad.detail.empty(),
                        "a refusal without a reason");
            }
        }};
}

} // namespace

void promise(bool kept, const char* what) {
    if (!kept) throw std::logic_error(std::string("broken promise: ") + what);
}

std::vector<FuzzTarget> textTargets() {
    return {workbook(), storeMeta(),  importerMessage(), importOptions(), formula(),
            style(),    stylePatch(), names(),           request()};
}

std::vector<FuzzTarget> allTargets() {
    auto all = formatTargets();
    for (auto&& more : {parserTargets(), textTargets()})
        all.insert(all.end(), more.begin(), more.end());
    return all;
}

} // namespace voxsheet::fuzz
