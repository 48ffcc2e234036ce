#include "bench/cells_vs_vtk.h"

#include "bench/bench_options.h"
#include "bench/vs_vtk_result.h"
#include "fields/inside.h"
#include "fields/scenes.h"
#include "image/vtk_sheet.h"
#include "volume/memory_volume_provider.h"

#include <algorithm>
#include <array>

namespace voxsheet::bench {
namespace {

constexpr int kColumns = 5;
constexpr int kCells = kColumns * kColumns;
constexpr double kDegreesPerFrame = 7.0;
constexpr double kConvergedVoxels = 1.0 / 16.0;

struct Sheet {
    int samples = 0;
    int pixels = 0; ///< per edge of a cell
    int stride = 1; ///< of the pixels that are compared
    std::vector<fields::SampledField> volumes;
    std::shared_ptr<const TransferTable> table;
    bool adaptive = false;
};

int cellSamples(const VolumeBenchOptions& options) { return std::min(options.cellSamples, options.samples); }

int cellPixels(const VolumeBenchOptions& options) { return options.samples < 128 ? 64 : 256; }

Sheet sheetOf(const VolumeBenchOptions& options) {
    Sheet sheet;
    sheet.samples = cellSamples(options);
    sheet.pixels = cellPixels(options);
    sheet.stride = std::max(1, sheet.pixels / 32);
    const auto field = fields::gaussianSum();
    const auto grid = fields::gridOf(fields::Geometry::Isotropic, sheet.samples);
    for (int i = 0; i < kCells; ++i)
        sheet.volumes.push_back(fields::sampleField(field, grid, options.type, "cell " + std::to_string(i)));
    sheet.adaptive = options.adaptive;
    sheet.table = fields::filledTable(field.low, field.high);
    return sheet;
}

std::vector<TileSpec> tilesOf(const Sheet& sheet, int frame) {
    std::vector<TileSpec> tiles;
    for (int i = 0; i < kCells; ++i) {
        const auto& meta = sheet.volumes[static_cast<std::size_t>(i)].meta;
        auto tile = fields::tileOf(meta.key, meta.grid, Technique::Raycast, sheet.pixels);
        tile.transfer = sheet.table;
        tile.adaptiveSampling = sheet.adaptive;
        tile.unitLengthWorld = sheet.samples / 256.0;
        tile.camera = fields::cameraOf(meta.grid, Projection::Perspective,
                                       30.0 + 11.0 * i + kDegreesPerFrame * frame, 25.0);
        tiles.push_back(tile);
    }
    return tiles;
}

/// Cells side by side, row by row from the top; pictures have row 0 at the bottom.
template <typename PictureOf>
fields::Picture sideBySide(const PictureOf& pictureOfCell) {
    fields::Picture whole;
    for (int cell = 0; cell < kCells; ++cell) {
        const fields::Picture part = pictureOfCell(cell);
        if (cell == 0) whole = fields::Picture(part.size * kColumns);
        const glm::ivec2 corner(part.size.x * (cell % kColumns),
                                part.size.y * (kColumns - 1 - cell / kColumns));
        for (int y = 0; y < part.size.y; ++y)
            for (int x = 0; x < part.size.x; ++x)
                whole.at(corner.x + x, corner.y + y) = part.at(x, y);
    }
    return whole;
}

fields::Picture convergedSheet(const Sheet& sheet, const VolumeProvider& provider) {
    const auto tiles = tilesOf(sheet, 0);
    return sideBySide([&](int cell) {
        auto tile = tiles[static_cast<std::size_t>(cell)];
        tile.sampleDistanceVoxels = kConvergedVoxels;
        return fields::insidePicture(tile, fields::sourcesOf(provider, tile), sheet.stride);
    });
}

FrameResult drawSheet(RenderThread& thread, const Sheet& sheet, int frame) {
    return thread.submit({tilesOf(sheet, frame)}, FramePriority::Final).get();
}

} // namespace

std::vector<std::string> cellsAgainstVtk(const VolumeBenchOptions& options) {
    const auto pixels = std::to_string(cellPixels(options));
    const auto name = std::to_string(kCells) + " cells of " + std::to_string(cellSamples(options)) + "^3 " +
                      scalarName(options.type) + " " + pixels + "x" + pixels + " filled raycast";
    if (!isWanted(options, name)) return {};
    tellProgress(name);
    const auto sheet = sheetOf(options);
    auto provider = std::make_shared<MemoryVolumeProvider>();
    std::vector<const fields::SampledField*> volumes;
    for (const auto& volume : sheet.volumes) {
        provider->add(volume.meta, volume.arrays);
        volumes.push_back(&volume);
    }
    RenderOptions renderOptions;
    renderOptions.device = options.device;
    RenderThread thread(provider, renderOptions);
    image::VtkSheet gpu(volumes, glm::ivec2(kColumns), image::VtkMapper::Gpu);
    image::VtkSheet cpu(volumes, glm::ivec2(kColumns), image::VtkMapper::Cpu);

    const auto truth = convergedSheet(sheet, *provider);
    const auto distance = [&](const fields::Picture& picture) {
        return fields::difference(fields::everyNth(picture, sheet.stride), truth);
    };
    const auto first = drawSheet(thread, sheet, 0);
    VsVtkResult result;
    result.name = name;
    result.voxsheet = distance(
        sideBySide([&](int cell) { return pictureOf(first.tiles[static_cast<std::size_t>(cell)]); }));
    result.vtkGpu = distance(gpu.draw(tilesOf(sheet, 0)));
    result.vtkCpu = distance(cpu.draw(tilesOf(sheet, 0)));
    for (int frame = 1; frame <= options.frames; ++frame) {
        result.voxsheetMs.push_back(drawSheet(thread, sheet, frame).wallMs);
        (void)gpu.draw(tilesOf(sheet, frame));
        result.vtkGpuMs.push_back(gpu.lastMs());
        (void)cpu.draw(tilesOf(sheet, frame));
        result.vtkCpuMs.push_back(cpu.lastMs());
    }
    return {jsonOf(result)};
}

} // namespace voxsheet::bench
