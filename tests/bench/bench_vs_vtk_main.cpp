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
#include "bench/volume_vs_vtk.h"
#include "volume/memory_volume_provider.h"

#include <utility>

namespace voxsheet::bench {
namespace {

constexpr int kLargeSamples = 512;
constexpr int kLargePixels = 1024;

void append(std::vector<std::string>& all, std::vector<std::string> more) {
    for (auto& one : more)
        all.push_back(std::move(one));
}

RenderDevice deviceOf(const VolumeBenchOptions& options) {
    RenderOptions renderOptions;
    renderOptions.device = options.device;
    return RenderThread(std::make_shared<MemoryVolumeProvider>(), renderOptions).device();
}

std::vector<VolumeBenchOptions> sizesOf(const VolumeBenchOptions& options) {
    std::vector<VolumeBenchOptions> sizes{options};
    if (!options.large) return sizes;
    for (const auto type : {ScalarType::U8, ScalarType::U16}) {
        auto large = options;
        large.samples = kLargeSamples;
        large.pixels = kLargePixels;
        large.type = type;
        sizes.push_back(large);
    }
    return sizes;
}

std::vector<std::string> scansAgainstVtk(const VolumeBenchOptions& options) {
    const auto missing = [](const std::string& file) { tellProgress("left out, it is not there: " + file); };
    std::vector<std::string> results;
    for (const auto& scan : readScans(options.scans, missing)) {
        const auto sampled = std::make_shared<const fields::SampledField>(scan.sampled);
        std::vector<VolumeCase> cases;
        for (const auto material : {Material::Sparse, Material::Filled})
            cases.push_back({lookOf(material, scan.low, scan.high, sampled->meta.grid), Technique::Raycast});
        std::erase_if(cases,
                      [&](const auto& one) { return !isWanted(options, one.name(options, scan.name)); });
        append(results, drawnAgainstVtk(options, scan.name, sampled, cases));
    }
    return results;
}

/// With --scans only those; with --technique only what looks inside; else that with the volumes and the sheet
/// of cells.
std::string compareWithVtk(VolumeBenchOptions options) {
    const auto device = deviceOf(options);
    std::vector<std::string> cases;
    const bool everything = options.techniques.empty();
    if (everything) options.techniques = {"all"};
    if (!options.scans.empty()) {
        cases = scansAgainstVtk(options);
    } else {
        for (const auto& size : sizesOf(options)) {
            if (everything) append(cases, volumesAgainstVtk(size));
            append(cases, insideAgainstVtk(size));
        }
        if (everything) append(cases, cellsAgainstVtk(options));
    }
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
