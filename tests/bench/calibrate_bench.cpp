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

/// The pictures of all scenes add up; the first to be drawn are the reference. Also compiles and uploads.
PictureDistance drawOnce(const PathThread& path, const std::vector<VolumeScene>& scenes, Technique technique,
                         std::vector<fields::Picture>& references) {
    PictureDistance sum;
    for (std::size_t i = 0; i < scenes.size(); ++i) {
        const auto picture = pictureOf(drawTile(*path.thread, tileOf(scenes[i], technique, 0)).tiles[0]);
        if (i == references.size()) references.push_back(picture);
        const auto distance = distanceOf(picture, references[i]);
        sum.pixelsApart += distance.pixelsApart;
        sum.pixels += distance.pixels;
    }
    return sum;
}

double frameMs(const PathThread& path, const std::vector<VolumeScene>& scenes, Technique technique,
               int frame) {
    double sum = 0.0;
    for (const auto& scene : scenes)
        sum += drawTile(*path.thread, tileOf(scene, technique, frame)).wallMs;
    return sum;
}

CalibratedTechnique calibrateTechnique(const std::vector<PathThread>& threads,
                                       const std::vector<VolumeScene>& scenes, Technique technique,
                                       RenderPath rule, int frames) {
    CalibratedTechnique result;
    result.rule = rule;
    std::vector<const PathThread*> taken;
    for (const RenderPath path : candidatePaths(technique))
        for (const PathThread& each : threads)
            if (each.path == path) taken.push_back(&each);
    std::vector<fields::Picture> references; // of the shaders, which come first
    for (const PathThread* each : taken)
        result.measured.push_back({each->path, {}, drawOnce(*each, scenes, technique, references)});
    std::vector<std::vector<double>> times(taken.size());
    for (int frame = 0; frame < frames; ++frame)
        for (std::size_t i = 0; i < taken.size(); ++i)
            times[i].push_back(frameMs(*taken[i], scenes, technique, frame));
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
    const auto volume = benchVolume(sceneOptions, options.samples);
    std::vector<VolumeScene> scenes;
    for (const Material material : {Material::Filled, Material::Sparse, Material::SharpPeaks})
        scenes.emplace_back(sceneOptions, benchVolumeName(sceneOptions, options.samples), volume,
                            benchLook(material, options.samples));
    auto volumes = std::make_shared<MemoryVolumeProvider>();
    volumes->add(volume->meta, volume->arrays);
    std::vector<PathThread> threads;
    for (const RenderPath path : {RenderPath::Shader, RenderPath::Simd})
        threads.push_back(startPath(path, volumes, options.device));
    Calibration calibration{threads.front().thread->device(), {}};
    const auto rule = pathsByRule(gpu::workaroundsNamed(calibration.device.workarounds));
    for (const Technique technique : kTechniques) {
        if (candidatePaths(technique).size() < 2) continue;
        progress(techniqueName(technique));
        calibration.techniques.push_back(
            calibrateTechnique(threads, scenes, technique, rule.of(technique), options.frames));
    }
    return calibration;
}

} // namespace voxsheet::bench
