// bench_vs_vtk: the same scenes by Voxsheet and by VTK's two volume mappers in turn, as one JSON object.
//
// Fair to both: VTK's automatic sample distances off, image sample distance 1, the same table, unit length,
// sample distance and view, no shading, 8-bit pictures on the host; frames alternate, so that what else the
// machine does hits all alike.
#include "bench/bench_options.h"
#include "bench/cells_vs_vtk.h"
#include "bench/inside_vs_vtk.h"
#include "bench/json_text.h"
#include "bench/scan_fields.h"
#include "image/vtk_peer.h"
#include "volume/memory_volume_provider.h"

#include <algorithm>
#include <functional>
#include <utility>

namespace voxsheet::bench {
namespace {

/// What our tile has other than VTK's.
struct OurWay {
    std::string name;
    std::function<TileSpec(TileSpec)> tile;
};

/// Our maximum projection is opaque where the table is most so; VTK's shows the table's opacity itself.
TileSpec theirTile(TileSpec tile) {
    if (tile.technique != Technique::Mip) return tile;
    auto table = std::make_shared<TransferTable>(*tile.transfer);
    for (auto& entry : table->entries)
        entry.w /= largestOpacity(*tile.transfer);
    tile.transfer = table;
    return tile;
}

struct PeerTimes {
    std::vector<double> voxsheet;
    std::vector<double> vtkGpu;
    std::vector<double> vtkCpu;
};

PeerTimes drawInTurn(RenderThread& thread, VolumeScene& scene, Technique technique, image::VtkPeer& gpu,
                     image::VtkPeer& cpu, int frames, const std::function<TileSpec(TileSpec)>& ours) {
    PeerTimes times;
    const auto theirs = theirTile(scene.tile(technique, 0)).transfer; // one table: they compile a new one
    for (int frame = 0; frame < frames; ++frame) {
        auto tile = scene.tile(technique, frame);
        times.voxsheet.push_back(drawTile(thread, ours(tile)).wallMs);
        tile.transfer = theirs;
        (void)gpu.draw(tile);
        times.vtkGpu.push_back(gpu.lastMs());
        (void)cpu.draw(tile);
        times.vtkCpu.push_back(cpu.lastMs());
    }
    return times;
}

std::string runCase(RenderThread& thread, VolumeScene& scene, Technique technique, image::VtkPeer& gpu,
                    image::VtkPeer& cpu, int frames, const OurWay& way = {}) {
    const auto name = scene.name() + " " + fields::nameOf(technique) + way.name;
    tellProgress(name);
    const auto first = scene.tile(technique, 0);
    const auto our = [&](const TileSpec& tile) { return way.tile ? way.tile(tile) : tile; };
    const auto ours =
        scene.distance(technique, pictureOf(drawTile(thread, our(first)).tiles[0])); // compiles, uploads
    const auto theirs = scene.distance(technique, gpu.draw(theirTile(first)));
    const auto cpus = scene.distance(technique, cpu.draw(theirTile(first)));
    const auto times = drawInTurn(thread, scene, technique, gpu, cpu, frames, our);
    const double voxsheetMs = median(times.voxsheet);
    const double gpuMs = median(times.vtkGpu);
    const double cpuMs = median(times.vtkCpu);
    return jsonObject({{"name", jsonString(name)},
                       {"voxsheet_ms", jsonNumber(voxsheetMs)},
                       {"vtk_gpu_ms", jsonNumber(gpuMs)},
                       {"vtk_cpu_ms", jsonNumber(cpuMs)},
                       {"ratio_vtk_gpu", jsonNumber(gpuMs / voxsheetMs)},
                       {"ratio_vtk_cpu", jsonNumber(cpuMs / voxsheetMs)},
                       {"voxsheet_psnr", jsonNumber(ours.psnr)},
                       {"vtk_gpu_psnr", jsonNumber(theirs.psnr)},
                       {"vtk_cpu_psnr", jsonNumber(cpus.psnr)},
                       {"voxsheet_p999", jsonNumber(ours.p999)},
                       {"vtk_gpu_p999", jsonNumber(theirs.p999)}});
}

constexpr double kGoodDecibels = 40.0;

/// The longest distance of samples at which pre-integrated pictures are good, and at least as close to the
/// integral as both of VTK's.
double equalDistance(RenderThread& thread, VolumeScene& scene, image::VtkPeer& gpu, image::VtkPeer& cpu) {
    const auto first = scene.tile(Technique::Raycast, 0);
    const double least = std::max({kGoodDecibels, scene.distance(Technique::Raycast, gpu.draw(first)).psnr,
                                   scene.distance(Technique::Raycast, cpu.draw(first)).psnr});
    for (const double distance : {4.0, 2.8, 2.0, 1.4, 1.0, 0.7}) {
        const auto tile = sampledBy(first, Classification::PreIntegrated, distance);
        const auto picture = pictureOf(drawTile(thread, tile).tiles[0]);
        if (scene.distance(Technique::Raycast, picture).psnr >= least) return distance;
    }
    return first.sampleDistanceVoxels;
}

const char* const kSheetName = "25 cells";

bool isWanted(const VolumeBenchOptions& options, const std::string& name) {
    return name.find(options.only) != std::string::npos;
}

/// All that draws one volume.
struct Drawers {
    explicit Drawers(const VolumeScene& scene, int device)
        : thread(providerOf(scene), optionsOf(device)), gpu(scene.sampled(), image::VtkMapper::Gpu),
          cpu(scene.sampled(), image::VtkMapper::Cpu) {}

    RenderThread thread;
    image::VtkPeer gpu;
    image::VtkPeer cpu;

private:
    static std::shared_ptr<MemoryVolumeProvider> providerOf(const VolumeScene& scene) {
        auto provider = std::make_shared<MemoryVolumeProvider>();
        provider->add(scene.sampled().meta, scene.sampled().arrays);
        return provider;
    }
    static RenderOptions optionsOf(int device) {
        RenderOptions options;
        options.device = device;
        return options;
    }
};

std::vector<std::string> scansAgainstVtk(const VolumeBenchOptions& options) {
    const auto missing = [](const std::string& file) { tellProgress("left out, it is not there: " + file); };
    std::vector<std::string> cases;
    for (const auto& scan : readScans(options.scans, missing))
        for (const auto material : {Material::Sparse, Material::Filled}) {
            VolumeScene scene(options, material, scan.name, scan.sampled, scan.low, scan.high);
            if (!isWanted(options, scene.name())) continue;
            Drawers drawers(scene, options.device);
            cases.push_back(
                runCase(drawers.thread, scene, Technique::Raycast, drawers.gpu, drawers.cpu, options.frames));
        }
    return cases;
}

std::vector<std::string> volumesAgainstVtk(const VolumeBenchOptions& options) {
    std::vector<std::string> cases;
    for (const auto material : {Material::Sparse, Material::Filled, Material::SharpPeaks}) {
        VolumeScene scene(options, material);
        if (!isWanted(options, scene.name())) continue;
        Drawers drawers(scene, options.device);
        auto& [thread, gpu, cpu] = drawers;
        for (const auto technique : {Technique::Raycast, Technique::Slices})
            cases.push_back(runCase(thread, scene, technique, gpu, cpu, options.frames));
        if (material == Material::Filled)
            cases.push_back(runCase(thread, scene, Technique::Mip, gpu, cpu, options.frames));
        if (material != Material::SharpPeaks) continue;
        const double distance = equalDistance(thread, scene, gpu, cpu);
        cases.push_back(runCase(thread, scene, Technique::Raycast, gpu, cpu, options.frames,
                                {" pre-integrated, " + jsonNumber(distance) + " voxels", [&](TileSpec tile) {
                                     return sampledBy(tile, Classification::PreIntegrated, distance);
                                 }}));
    }
    return cases;
}

RenderDevice deviceOf(const VolumeBenchOptions& options) {
    RenderOptions renderOptions;
    renderOptions.device = options.device;
    return RenderThread(std::make_shared<MemoryVolumeProvider>(), renderOptions).device();
}

/// With --scans only those; with --technique only what looks inside; else that after the volumes and the
/// sheet of cells.
std::string compareWithVtk(VolumeBenchOptions options) {
    const auto device = deviceOf(options);
    std::vector<std::string> cases;
    if (!options.scans.empty()) {
        cases = scansAgainstVtk(options);
    } else if (options.techniques.empty()) {
        cases = volumesAgainstVtk(options);
        if (isWanted(options, kSheetName)) cases.push_back(cellsAgainstVtk(options));
        options.techniques = {"all"};
    }
    if (options.scans.empty())
        for (auto& one : insideAgainstVtk(options))
            cases.push_back(std::move(one));
    return jsonObject({{"device", jsonString(device.eglPlatform)},
                       {"renderer", jsonString(device.renderer)},
                       {"frames", jsonNumber(options.frames)},
                       {"cases", jsonArray(cases)}});
}

} // namespace
} // namespace voxsheet::bench

int main(int count, char** arguments) {
    return voxsheet::bench::runBenchProgram(count, arguments, "bench_vs_vtk [OPTIONS] --json",
                                            voxsheet::bench::compareWithVtk);
}
