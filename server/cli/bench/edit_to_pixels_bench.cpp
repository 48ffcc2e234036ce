#include "cli/bench/edit_to_pixels_bench.h"

#include "base/errors.h"
#include "bench/scratch_folder.h"
#include "cli/bench/percentile.h"
#include "cli/bench/served_volumes.h"
#include "cli/bench/stream_probe.h"
#include "sheet/layout.h"

#include <cstdio>
#include <functional>
#include <set>
#include <vector>

namespace voxsheet::cli {

namespace {

using nlohmann::json;

constexpr double kPatienceSeconds = 60.0;

/// Of a number from 0.1 to 0.9.
using BodyOf = std::function<json(double part)>;

struct EditKind {
    const char* name;
    BodyOf body;
};

std::vector<EditKind> styleEdits() {
    const auto ramp = [](double begin) { return json{{begin, 0.0}, {1.0, 0.05}}; };
    return {
        {"camera",
         [ramp](double part) {
             return json{
                 {"technique", "raycast"}, {"transfer.opacity", ramp(0.0)}, {"camera.azimuth", 90.0 * part}};
         }},
        {"opacity",
         [ramp](double part) {
             return json{{"transfer.opacity", ramp(part)}};
         }},
        {"range",
         [](double part) {
             return json{{"range.mode", "percentile"}, {"range.min", 40.0 * part}};
         }},
        {"light",
         [](double part) {
             return json{{"shading.model", "phong"}, {"shading.ambient", part}};
         }},
        {"planes",
         [](double part) {
             return json{{"shading.model", "none"},
                         {"clip.units", "fraction"},
                         {"clip.planes", json::array({json{1, 0, 0, part}})}};
         }},
        {"isovalue",
         [](double part) {
             return json{{"technique", "isosurface"},
                         {"clip.planes", "none"},
                         {"isovalue", json::array({255.0 * part})}};
         }},
    };
}

/// A sheet, and a page that looks at all of it.
class WatchedServer {
public:
    WatchedServer(const EditToPixelsOptions& options, const std::filesystem::path& scratch)
        : served_(options.cells, options.dim, options.device, scratch), edits_(options.edits),
          sheet_(served_.engine().snapshot()->sheets.front().name), probe_(served_.port(), sheet_) {
        const auto layout = sheet::chooseLayout(static_cast<std::size_t>(options.cells));
        json tiles = json::array();
        for (const auto& [address, cell] : served_.engine().snapshot()->sheets.front().cells) {
            names_.push_back(sheet::addressName(address));
            tiles.push_back({{"cell", names_.back()},
                             {"width", options.width / layout.columns},
                             {"height", options.height / layout.rows}});
        }
        probe_.post({{"tiles", tiles}, {"moving", false}});
        if (!probe_.waitFinal(names_.size(), 2 * kPatienceSeconds) || !probe_.waitRest(kPatienceSeconds))
            throw IoError("bench edit-to-pixels", "the first pictures did not come");
    }

    [[nodiscard]] json styleCase(const EditKind& kind) {
        return measured(kind.name, "style", kind.body, {names_.begin(), names_.end()});
    }

    [[nodiscard]] json formulaCase() {
        const auto& cell = names_.back();
        const auto body = [this](double part) {
            return json{{"source", "=" + names_[1] + "-" + names_[0] + "*" + std::to_string(part)}};
        };
        return measured("formula", "cells/" + cell, body, {cell});
    }

private:
    json measured(const char* name, const std::string& resource, const BodyOf& body,
                  const std::set<std::string>& cells) {
        std::vector<double> first;
        std::vector<double> final;
        std::vector<double> scales;
        // What is met for the first time is made ready by the first edit, which does not count.
        for (int i = 0; i <= edits_; ++i) {
            const double part = 0.1 + 0.8 * i / edits_;
            const auto seen =
                probe_.edit("/api/v1/sheets/" + sheet_ + "/" + resource, body(part), cells, kPatienceSeconds);
            if (i == 0) continue;
            first.push_back(seen.firstMs);
            final.push_back(seen.finalMs);
            scales.push_back(seen.scale);
        }
        return {{"edit", name},
                {"first_ms_p50", percentile(first, 0.5)},
                {"first_ms_p95", percentile(first, 0.95)},
                {"scale", percentile(scales, 0.5)},
                {"final_ms_p50", percentile(final, 0.5)},
                {"final_ms_p95", percentile(final, 0.95)}};
    }

    ServedVolumes served_;
    int edits_;
    std::string sheet_;
    StreamProbe probe_;
    std::vector<std::string> names_;
};

} // namespace

json runEditToPixelsBench(const EditToPixelsOptions& options) {
    const bench::ScratchFolder scratch;
    WatchedServer server(options, scratch.path());
    json cases = json::array();
    const auto add = [&](const char* name, const std::function<json()>& measure) {
        std::fprintf(stderr, "bench edit-to-pixels: %s\n", name);
        cases.push_back(measure());
    };
    for (const auto& kind : styleEdits())
        add(kind.name, [&] { return server.styleCase(kind); });
    if (options.cells >= 3) add("formula", [&] { return server.formulaCase(); });
    return {{"bench", "edit-to-pixels"}, {"dim", options.dim},     {"size", {options.width, options.height}},
            {"cells", options.cells},    {"edits", options.edits}, {"cases", cases}};
}

} // namespace voxsheet::cli
