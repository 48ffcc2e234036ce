#include "bench/calibrate_bench.h"

#include "volume/memory_volume_provider.h"

#include <algorithm>
#include <memory>

namespace voxsheet::bench {
namespace {

constexpr double kStep8Bit = 1.0 / 255.0;
/// Two 8-bit pictures that round to neighbouring steps are one step apart.
constexpr double kRoundingSlack = 1e-9;

/// A context of its own, in which one path draws every technique.
struct PathThread {
    RenderPath path;
    std::unique_ptr<RenderThread> thread;
};

PathThread startPath(RenderPath path, const std::shared_ptr<MemoryVolumeProvider>& volumes, int device) {
    RenderOptions options;
    options.device = device;
    options.choosePaths = [path](const RenderDevice&) {
        ForcedPaths forced;
        for (const Technique technique : kTechniques)
            for (const RenderPath candidate : candidatePaths(technique))
                if (candidate == path) forced[technique] = path;
        return choosePaths({}, {}, forced);
    };
    return {path, std::make_unique<RenderThread>(volumes, options)};
}

TileSpec tileOf(const VolumeScene& scene, Technique technique, int frame) {
    auto tile = scene.tile(technique, frame);
    tile.shading.enabled = technique != Technique::Mip;
    if (technique == Technique::Isosurface) {
        const auto& table = *tile.transfer;
        tile.isosurface.surfaces = {{0.5 * (table.low + table.high), glm::vec4(0.8F, 0.7F, 0.5F, 1.0F)}};
    }
    return tile;
}

PictureDistance distanceOf(const fields::Picture& picture, const fields::Picture& reference) {
    PictureDistance distance{0, picture.pixels.size()};
    for (std::size_t i = 0; i < picture.pixels.size(); ++i) {
        const auto apart = glm::abs(picture.pixels[i] - reference.pixels[i]);
        if (std::max({apart.x, apart.y, apart.z, apart.w}) > kStep8Bit + kRoundingSlack)
            ++distance.pixelsApart;
    }
    return distance;
}

CalibratedTechnique calibrateTechnique(const std::vector<PathThread>& threads, const VolumeScene& scene,
                                       Technique technique, RenderPath rule, int frames) {
    CalibratedTechnique result;
    result.rule = rule;
    std::vector<const PathThread*> taken;
    for (const RenderPath path : candidatePaths(technique))
        for (const PathThread& each : threads)
            if (each.path == path) taken.push_back(&each);
    fields::Picture reference; // of the shaders, which come first
    for (const PathThread* each : taken) {
        // Also compiles and uploads.
        const auto picture = pictureOf(drawTile(*each->thread, tileOf(scene, technique, 0)).tiles[0]);
        if (reference.pixels.empty()) reference = picture;
        result.measured.push_back({each->path, {}, distanceOf(picture, reference)});
    }
    std::vector<std::vector<double>> times(taken.size());
    for (int frame = 0; frame < frames; ++frame)
        for (std::size_t i = 0; i < taken.size(); ++i)
            times[i].push_back(drawTile(*taken[i]->thread, tileOf(scene, technique, frame)).wallMs);
    for (std::size_t i = 0; i < taken.size(); ++i)
        result.measured[i].ms = measuredMedian(times[i]);
    result.chosen = fastestPath(technique, rule, result.measured);
    return result;
}

} // namespace

Calibration calibrate(const CalibrateOptions& options,
                      const std::function<void(const std::string&)>& progress) {
    VolumeBenchOptions sceneOptions;
    sceneOptions.samples = options.samples;
    sceneOptions.pixels = options.pixels;
    const VolumeScene scene(sceneOptions, benchVolumeName(sceneOptions, options.samples),
                            benchVolume(sceneOptions, options.samples),
                            benchLook(Material::Filled, options.samples));
    auto volumes = std::make_shared<MemoryVolumeProvider>();
    volumes->add(scene.sampled().meta, scene.sampled().arrays);
    std::vector<PathThread> threads;
    for (const RenderPath path : {RenderPath::Shader, RenderPath::Simd})
        threads.push_back(startPath(path, volumes, options.device));
    Calibration calibration{threads.front().thread->device(), {}};
    const auto rule = pathsByRule(gpu::workaroundsNamed(calibration.device.workarounds));
    for (const Technique technique : kTechniques) {
        if (candidatePaths(technique).size() < 2) continue;
        progress(techniqueName(technique));
        calibration.techniques.push_back(
            calibrateTechnique(threads, scene, technique, rule.of(technique), options.frames));
    }
    return calibration;
}

} // namespace voxsheet::bench
