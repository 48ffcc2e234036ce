// bench_vs_vtk: the same scenes by Voxsheet and by VTK's two volume mappers in turn, as one JSON object.
//
// Fair to both: VTK's automatic sample distances off, image sample distance 1, the same table, unit length,
// sample distance and view, no shading, 8-bit pictures on the host; frames alternate, so that what else the
// machine does hits all alike.
#include "bench/bench_options.h"
#include "bench/cells_vs_vtk.h"
#include "bench/inside_vs_vtk.h"
#include "bench/json_text.h"
#include "image/vtk_peer.h"
#include "volume/memory_volume_provider.h"

#include <utility>

namespace voxsheet::bench {
namespace {

struct PeerTimes {
    std::vector<double> voxsheet;
    std::vector<double> vtkGpu;
    std::vector<double> vtkCpu;
};

PeerTimes drawInTurn(RenderThread& thread, VolumeScene& scene, Technique technique, image::VtkPeer& gpu,
                     image::VtkPeer& cpu, int frames) {
    PeerTimes times;
    for (int frame = 0; frame < frames; ++frame) {
        const auto tile = scene.tile(technique, frame);
        times.voxsheet.push_back(drawTile(thread, tile).wallMs);
        (void)gpu.draw(tile);
        times.vtkGpu.push_back(gpu.lastMs());
        (void)cpu.draw(tile);
        times.vtkCpu.push_back(cpu.lastMs());
    }
    return times;
}

std::string runCase(RenderThread& thread, VolumeScene& scene, Technique technique, image::VtkPeer& gpu,
                    image::VtkPeer& cpu, int frames) {
    const auto name = scene.name() + " " + fields::nameOf(technique);
    tellProgress(name);
    const auto first = scene.tile(technique, 0);
    const auto ours =
        scene.distance(technique, pictureOf(drawTile(thread, first).tiles[0])); // compiles, uploads
    const auto theirs = scene.distance(technique, gpu.draw(first));
    const auto cpus = scene.distance(technique, cpu.draw(first));
    const auto times = drawInTurn(thread, scene, technique, gpu, cpu, frames);
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

std::vector<std::string> volumesAgainstVtk(const VolumeBenchOptions& options) {
    std::vector<std::string> cases;
    for (const bool filled : {false, true}) {
        VolumeScene scene(options, filled);
        auto provider = std::make_shared<MemoryVolumeProvider>();
        provider->add(scene.sampled().meta, scene.sampled().arrays);
        RenderOptions renderOptions;
        renderOptions.device = options.device;
        RenderThread thread(provider, renderOptions);
        image::VtkPeer gpu(scene.sampled(), image::VtkMapper::Gpu);
        image::VtkPeer cpu(scene.sampled(), image::VtkMapper::Cpu);
        for (const auto technique : {Technique::Raycast, Technique::Slices})
            cases.push_back(runCase(thread, scene, technique, gpu, cpu, options.frames));
    }
    return cases;
}

RenderDevice deviceOf(const VolumeBenchOptions& options) {
    RenderOptions renderOptions;
    renderOptions.device = options.device;
    return RenderThread(std::make_shared<MemoryVolumeProvider>(), renderOptions).device();
}

/// With --technique only what looks inside; else that after the volumes and the sheet of cells.
std::string compareWithVtk(VolumeBenchOptions options) {
    const auto device = deviceOf(options);
    std::vector<std::string> cases;
    if (options.techniques.empty()) {
        cases = volumesAgainstVtk(options);
        cases.push_back(cellsAgainstVtk(options));
        options.techniques = {"all"};
    }
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
