#include "cli/commands.h"
#include "cli/engine_arguments.h"
#include "cli/exit_codes.h"
#include "cli/look_arguments.h"
#include "engine/image_file.h"
#include "sheet/commands.h"

#include <CLI/CLI.hpp>

#include <charconv>
#include <cstdio>
#include <memory>
#include <string>
#include <unistd.h>
#include <vector>

namespace voxsheet::cli {

namespace {

struct RenderArguments {
    EngineArguments engine;
    std::string output;
    std::string size;
    std::string cell;
    std::string title;
    std::vector<std::string> labels;
    LookArguments look;
};

/// "1280x800".
glm::ivec2 parseSize(const std::string& text) {
    glm::ivec2 size{0};
    const char* end = text.data() + text.size();
    const auto first = std::from_chars(text.data(), end, size.x);
    const bool separated = first.ec == std::errc{} && first.ptr != end && *first.ptr == 'x';
    const auto second = separated ? std::from_chars(first.ptr + 1, end, size.y) : first;
    if (!separated || second.ec != std::errc{} || second.ptr != end || size.x < 16 || size.y < 16 ||
        size.x > 16384 || size.y > 16384)
        throw InvalidInput("--size", "`" + text + "` is no size between 16x16 and 16384x16384",
                           "write for example 1600x1000")
            .withField("--size");
    return size;
}

/// Labels go to the cells that hold something, in reading order.
void applyLabels(engine::Engine& engine, const std::string& sheetName,
                 const std::vector<std::string>& labels) {
    const auto workbook = engine.snapshot();
    auto label = labels.begin();
    std::vector<sheet::Address> cells;
    const auto& page = sheet::sheetNamed(*workbook, sheetName);
    for (int row = 0; row < page.rows; ++row)
        for (int column = 0; column < page.columns; ++column)
            if (const auto* cell = page.find({column, row}); cell != nullptr && !cell->source.empty())
                cells.push_back({column, row});
    if (labels.size() > cells.size())
        throw InvalidInput("--label", "there are " + std::to_string(labels.size()) + " labels for " +
                                          std::to_string(cells.size()) + " cells");
    for (const auto& cell : cells) {
        if (label == labels.end()) break;
        engine.apply(sheet::SetTitle{sheetName, sheet::Layer::ofCell(cell), *label++});
    }
}

/// A line that rewrites itself on a terminal; nothing in a pipe.
void waitWithProgress(const engine::Engine& engine) {
    const bool terminal = isatty(STDERR_FILENO) != 0;
    while (!engine.waitIdle(terminal ? 0.2 : 24 * 3600.0)) {
        if (!terminal) continue;
        std::size_t ready = 0;
        const auto datasets = engine.datasets();
        for (const auto& dataset : datasets)
            if (dataset.state == engine::DatasetState::Ready || dataset.state == engine::DatasetState::Failed)
                ++ready;
        std::fprintf(stderr, "\rimporting: %zu of %zu ", ready, datasets.size());
    }
    if (terminal) std::fprintf(stderr, "\r%40s\r", "");
}

/// Drawing asks for clip objects, which are computed then: again until nothing is on its way.
engine::SheetImage finalImage(const engine::Engine& engine, const engine::SheetImageRequest& request) {
    while (true) {
        waitWithProgress(engine);
        auto image = engine.renderSheet(request);
        if (image.final) return image;
    }
}

int runRender(const RenderArguments& arguments) {
    engine::SheetImageRequest request;
    request.format = engine::pixelFormatFor(arguments.output);
    if (!arguments.size.empty()) request.sizePixels = parseSize(arguments.size);
    if (!arguments.cell.empty()) {
        const auto address = sheet::parseAddress(arguments.cell);
        request.range = sheet::AddressRange{address, address};
    }
    request.title = arguments.title;
    engine::Engine engine(engineOptions(arguments.engine));
    openSources(engine, arguments.engine);
    request.sheet = engine.snapshot()->sheets.front().name;
    applyLook(engine, request.sheet, arguments.look);
    applyLabels(engine, request.sheet, arguments.labels);
    const auto image = finalImage(engine, request);
    for (const std::string& failure : image.failures)
        reportFailure(failure);
    for (const std::string& note : image.notes)
        reportWarning(note);
    engine::writeImageFile(image.pixels, arguments.output);
    return image.failedCells > 0 ? kExitFailed : kExitDone;
}

} // namespace

Action addRender(CLI::App& app) {
    auto arguments = std::make_shared<RenderArguments>();
    addEngineArguments(app, arguments->engine);
    app.get_option("SOURCES")->required();
    app.add_option("-o,--output", arguments->output, "Image to write: .png .jpg .webp .exr .tif")->required();
    app.add_option("--size", arguments->size,
                   "Size of the whole image, e.g. 1600x1000 (default: 320x240 per cell)");
    app.add_option("--cell", arguments->cell, "Only this cell, e.g. B2");
    app.add_option("--title", arguments->title, "Text above the sheet");
    app.add_option("--label", arguments->labels, "Name of a cell, in reading order; repeatable")
        ->take_all()
        ->allow_extra_args(false);
    addLookArguments(app, arguments->look);
    app.footer(
        "Example: voxsheet render a.nrrd b.nrrd =B1-A1 -o sheet.png --columns 3 --set camera.azimuth=40 "
        "--set B1:transfer.map=plasma");
    return [arguments] { return runRender(*arguments); };
}

} // namespace voxsheet::cli
