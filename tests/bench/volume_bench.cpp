#include "bench/volume_bench.h"

#include "base/errors.h"
#include "bench/json_text.h"
#include "fields/integrator.h"
#include "volume/memory_volume_provider.h"

#include <time.h>

#include <algorithm>
#include <utility>

namespace voxsheet::bench {
namespace {

constexpr int kTruthPixels = 64; ///< per axis: the integrator is slow
constexpr double kTruthStepVoxels = 1.0 / 16.0;
constexpr double kDegreesPerFrame = 7.0;
const char* const kDataset = "bench";

int truthStride(const VolumeBenchOptions& options) { return std::max(1, options.pixels / kTruthPixels); }

fields::AnalyticField benchField() { return fields::gaussianSum(); }

} // namespace

std::shared_ptr<const fields::SampledField> benchVolume(const VolumeBenchOptions& options, int samples) {
    return std::make_shared<const fields::SampledField>(fields::sampleField(
        benchField(), fields::gridOf(fields::Geometry::Isotropic, samples), options.type, kDataset));
}

VolumeLook lookOf(Material material, double low, double high, const Grid& grid) {
    const auto edges = glm::dvec3(grid.dims) * spacingWorld(grid);
    const double unitLength = (edges.x + edges.y + edges.z) / 3.0 / 256.0;
    switch (material) {
    case Material::Filled:
        return {"filled", fields::filledTable(low, high), unitLength};
    case Material::SharpPeaks:
        return {"sharp peaks", fields::peaksTable(low, high), unitLength};
    case Material::Sparse:
        break;
    }
    return {"sparse", fields::sparseTable(low, high), unitLength};
}

VolumeLook benchLook(Material material, int samples) {
    const auto field = benchField();
    return lookOf(material, field.low, field.high, fields::gridOf(fields::Geometry::Isotropic, samples));
}

std::string benchVolumeName(const VolumeBenchOptions& options, int samples) {
    return std::to_string(samples) + "^3 " + scalarName(options.type);
}

std::string sceneName(const VolumeBenchOptions& options, const std::string& volume, const std::string& look) {
    const auto p = std::to_string(options.pixels);
    return volume + " " + p + "x" + p + " " + look;
}

VolumeScene::VolumeScene(const VolumeBenchOptions& options, std::string volume,
                         std::shared_ptr<const fields::SampledField> sampled, VolumeLook look)
    : options_(options), volume_(std::move(volume)), sampled_(std::move(sampled)), look_(std::move(look)) {}

std::string VolumeScene::name() const { return sceneName(options_, volume_, look_.name); }

TileSpec VolumeScene::tile(Technique technique, int frame) const {
    const auto& grid = sampled_->meta.grid;
    auto tile = fields::tileOf(sampled_->meta.key, grid, technique, options_.pixels);
    tile.transfer = look_.table;
    tile.adaptiveSampling = options_.adaptive;
    tile.unitLengthWorld = look_.unitLengthWorld;
    tile.camera = fields::cameraOf(grid, Projection::Perspective, 30.0 + kDegreesPerFrame * frame, 25.0);
    return tile;
}

const fields::Picture& VolumeScene::truth(Technique technique) {
    auto& picture = technique == Technique::Mip ? maximum_ : integral_;
    if (picture.pixels.empty()) {
        MemoryVolumeProvider provider;
        provider.add(sampled_->meta, sampled_->arrays);
        const fields::Interpolant interpolant(provider, {sampled_->meta.key, 0, 0, 0});
        const auto view = tile(technique, 0);
        picture = fields::integrateConverged(
            view, sampled_->meta.grid, interpolant.dims(),
            [&](const glm::dvec3& texture) { return interpolant.at(texture); }, kTruthStepVoxels,
            truthStride(options_));
    }
    return picture;
}

fields::Difference VolumeScene::distance(Technique technique, const fields::Picture& picture) {
    return fields::difference(fields::everyNth(picture, truthStride(options_)), truth(technique));
}

fields::Picture pictureOf(const TilePixels& pixels) {
    fields::Picture picture(pixels.size);
    const auto width = static_cast<std::size_t>(pixels.size.x);
    for (int y = 0; y < pixels.size.y; ++y)
        for (std::size_t x = 0; x < width; ++x) {
            const auto row = static_cast<std::size_t>(pixels.size.y - 1 - y); // top row first there
            const auto* rgba = pixels.rgba8.data() + (row * width + x) * 4;
            picture.at(static_cast<int>(x), y) = glm::dvec4(rgba[0], rgba[1], rgba[2], rgba[3]) / 255.0;
        }
    return picture;
}

FrameResult drawTile(RenderThread& thread, const TileSpec& tile) {
    FrameSpec frame;
    frame.tiles.push_back(tile);
    auto result = thread.submit(std::move(frame), FramePriority::Export).get();
    if (!result.tiles.at(0).error.empty()) throw GpuError("bench picture", result.tiles[0].error);
    return result;
}

TileSpec sampledBy(TileSpec tile, Classification classification, double distanceVoxels) {
    tile.classification = classification;
    tile.sampleDistanceVoxels = distanceVoxels;
    return tile;
}

double processorMs() {
    timespec time{};
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
    return 1e3 * static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_nsec);
}

double median(std::vector<double> values) {
    if (values.empty()) throw InvalidInput("median", "there is no value");
    std::sort(values.begin(), values.end());
    const auto middle = values.size() / 2;
    return values.size() % 2 == 1 ? values[middle] : 0.5 * (values[middle - 1] + values[middle]);
}

namespace {

VolumeBenchCase runCase(RenderThread& thread, VolumeScene& scene, const std::string& name,
                        const std::function<TileSpec(int frame)>& tile, const VolumeBenchOptions& options) {
    VolumeBenchCase result;
    result.name = name;
    const auto first = tile(0);
    const auto picture = pictureOf(drawTile(thread, first).tiles[0]); // also compiles and uploads
    const auto distance = scene.distance(first.technique, picture);
    result.psnr = distance.psnr;
    result.p999 = distance.p999;
    const auto& grid = scene.sampled().meta.grid;
    result.samples = fields::pathVoxels(first, grid, grid.dims) / first.sampleDistanceVoxels;
    std::vector<double> times;
    const double cpuBefore = processorMs();
    for (int frame = 0; frame < options.frames; ++frame)
        times.push_back(drawTile(thread, tile(frame)).wallMs);
    result.cpuMs = (processorMs() - cpuBefore) / options.frames;
    result.ms = median(std::move(times));
    return result;
}

struct Drawn {
    double ms = 0.0;
    double cpuMs = 0.0;
};

Drawn timed(RenderThread& thread, const TileSpec& tile) {
    const double before = processorMs();
    const double ms = drawTile(thread, tile).wallMs;
    return {ms, processorMs() - before};
}

/// Adaptive against even samples, frame by frame in turn.
std::string compareSampling(RenderThread& thread, VolumeScene& scene, const std::string& name, bool lit,
                            const VolumeBenchOptions& options) {
    const auto tileOf = [&](int frame, bool adaptive) {
        auto tile = scene.tile(Technique::Raycast, frame);
        tile.shading.enabled = lit;
        tile.adaptiveSampling = adaptive;
        return tile;
    };
    const auto even = pictureOf(drawTile(thread, tileOf(0, false)).tiles[0]);
    const auto adaptive = pictureOf(drawTile(thread, tileOf(0, true)).tiles[0]);
    std::vector<double> evenMs, evenCpu, ms, cpu;
    for (int frame = 0; frame < options.frames; ++frame) {
        const auto one = timed(thread, tileOf(frame, false));
        const auto other = timed(thread, tileOf(frame, true));
        evenMs.push_back(one.ms);
        evenCpu.push_back(one.cpuMs);
        ms.push_back(other.ms);
        cpu.push_back(other.cpuMs);
    }
    std::vector<std::pair<std::string, std::string>> fields{
        {"name", jsonString(name)},
        {"ms", jsonNumber(median(ms))},
        {"even_ms", jsonNumber(median(evenMs))},
        {"cpu_ms", jsonNumber(median(cpu))},
        {"even_cpu_ms", jsonNumber(median(evenCpu))},
        {"ratio_cpu", jsonNumber(median(cpu) / median(evenCpu))},
        {"psnr_to_even", jsonNumber(fields::difference(adaptive, even).psnr)},
        {"p999_to_even", jsonNumber(fields::difference(adaptive, even).p999)}};
    if (!lit) {
        fields.emplace_back("psnr", jsonNumber(scene.distance(Technique::Raycast, adaptive).psnr));
        fields.emplace_back("even_psnr", jsonNumber(scene.distance(Technique::Raycast, even).psnr));
    }
    return jsonObject(fields);
}

std::string jsonOf(const VolumeBenchCase& one) {
    return jsonObject({{"name", jsonString(one.name)},
                       {"ms", jsonNumber(one.ms)},
                       {"cpu_ms", jsonNumber(one.cpuMs)},
                       {"samples", jsonNumber(one.samples)},
                       {"psnr", jsonNumber(one.psnr)},
                       {"p999", jsonNumber(one.p999)}});
}

} // namespace

std::string volumeBench(const VolumeBenchOptions& options,
                        const std::function<void(const std::string&)>& progress) {
    const auto volume = benchVolume(options, options.samples);
    const auto sceneOf = [&](Material material) {
        return VolumeScene(options, benchVolumeName(options, options.samples), volume,
                           benchLook(material, options.samples));
    };
    auto sparse = sceneOf(Material::Sparse);
    auto filled = sceneOf(Material::Filled);
    auto peaks = sceneOf(Material::SharpPeaks);
    auto provider = std::make_shared<MemoryVolumeProvider>();
    provider->add(volume->meta, volume->arrays);
    RenderOptions renderOptions;
    renderOptions.device = options.device;
    RenderThread thread(provider, renderOptions);
    std::vector<std::string> cases;
    for (auto* scene : {&sparse, &filled, &peaks})
        for (const bool lit : {false, true}) {
            const auto name = scene->name() + " raycast adaptive" + (lit ? " lit" : "");
            progress(name);
            if (name.find(options.only) != std::string::npos)
                cases.push_back(compareSampling(thread, *scene, name, lit, options));
        }
    if (!options.only.empty()) return jsonObject({{"cases", jsonArray(cases)}});
    for (auto* scene : {&sparse, &filled})
        for (const auto technique : {Technique::Raycast, Technique::Slices, Technique::Mip}) {
            const auto name = scene->name() + " " + fields::nameOf(technique);
            progress(name);
            const auto tile = [&](int frame) { return scene->tile(technique, frame); };
            cases.push_back(jsonOf(runCase(thread, *scene, name, tile, options)));
        }
    for (auto* scene : {&filled, &peaks})
        for (const auto classification : {Classification::AtSamples, Classification::PreIntegrated})
            for (const double distance : {0.5, 1.0, 2.0}) {
                const auto name =
                    scene->name() + " raycast " +
                    (classification == Classification::AtSamples ? "at samples, " : "pre-integrated, ") +
                    jsonNumber(distance) + " voxels";
                progress(name);
                const auto tile = [&](int frame) {
                    return sampledBy(scene->tile(Technique::Raycast, frame), classification, distance);
                };
                cases.push_back(jsonOf(runCase(thread, *scene, name, tile, options)));
            }
    return jsonObject({{"device", jsonString(thread.device().eglPlatform)},
                       {"renderer", jsonString(thread.device().renderer)},
                       {"cases", jsonArray(cases)}});
}

} // namespace voxsheet::bench
