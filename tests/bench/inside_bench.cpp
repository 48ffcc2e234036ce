#include "bench/inside_bench.h"

#include "base/errors.h"
#include "bench/json_text.h"
#include "fields/inside.h"
#include "volume/clip_shape_provider.h"
#include "volume/clip_shapes.h"
#include "volume/memory_volume_provider.h"

#include <algorithm>
#include <optional>

namespace voxsheet::bench {
namespace {

constexpr int kTruthPixels = 64; ///< per axis
constexpr double kDegreesPerFrame = 7.0;
const char* const kDataset = "bench";

fields::AnalyticField insideField() { return fields::gaussianSum(); }

/// A plane through the middle of the box that keeps what lies along the normal.
ClipPlane throughCentre(const Grid& grid, const glm::dvec3& normal) {
    return {normal, glm::dot(normal, centreWorld(grid))};
}

/// The unit shape, `halfEdges` of half the box's edge long on each side, about a point at `fractions` of the
/// box.
ClipObject shapeAt(const char* shape, const Grid& grid, double halfEdges, const glm::dvec3& fractions,
                   ClipMode mode) {
    const double scale = 1.0 / (halfEdges * 0.5 * (grid.dims.x - 1));
    const auto box = boxIndex(grid);
    const auto middle =
        glm::dvec3(grid.worldFromIndex * glm::dvec4(box.low + fractions * (box.high - box.low), 1.0));
    ClipObject object;
    object.dataset = clipShapeKey(shape);
    object.mode = mode;
    object.objectFromWorld = glm::dmat4(scale);
    object.objectFromWorld[3] = glm::dvec4(-scale * middle, 1.0);
    return object;
}

TileSpec volumeTile(const Grid& grid, int samples, int pixels) {
    const auto field = insideField();
    auto tile = fields::tileOf(kDataset, grid, Technique::Raycast, pixels);
    tile.transfer = fields::filledTable(field.low, field.high);
    // The material keeps its looks at every size of the volume: opacities hold over 1/256 of its edge.
    tile.unitLengthWorld = samples / 256.0;
    return tile;
}

TileSpec techniqueTile(const std::string& technique, const Grid& grid, int samples, int pixels) {
    auto tile = volumeTile(grid, samples, pixels);
    if (technique == "vr") return tile;
    if (technique == "sr") {
        tile.technique = Technique::Surface;
        tile.clip.planes = {throughCentre(grid, glm::normalize(glm::dvec3(-0.6, -0.3, -1.0)))};
        return tile;
    }
    if (technique == "vc") {
        tile.clip.object = shapeAt("sphere", grid, 0.8, glm::dvec3(0.5), ClipMode::Probe);
        return tile;
    }
    if (technique == "ie") {
        tile.technique = Technique::Isosurface;
        tile.isosurface.surfaces = {{0.35, glm::vec4(0.9F, 0.7F, 0.4F, 1.0F)}};
        return tile;
    }
    throw InvalidInput("--technique", "\"" + technique + "\" is not vr, sr, vc, ie or all")
        .withField("technique");
}

std::vector<std::string> chosen(const VolumeBenchOptions& options) {
    const bool all =
        std::find(options.techniques.begin(), options.techniques.end(), "all") != options.techniques.end();
    return all ? std::vector<std::string>{"vr", "sr", "vc", "ie"} : options.techniques;
}

/// Where samples would be taken were none skipped: one per pixel on a face, else along the kept part of each
/// ray.
double sampleCountOf(const TileSpec& tile, const fields::Sources& sources) {
    if (tile.technique != Technique::Surface)
        return fields::keptVoxels(tile, sources) / tile.sampleDistanceVoxels;
    return static_cast<double>(fields::facePixels(tile, sources));
}

std::string runCase(RenderThread& thread, const VolumeProvider& provider, const InsideCase& one,
                    const Grid& grid, int frames) {
    const auto first = turned(one, grid, 0);
    const auto sources = fields::sourcesOf(provider, first);
    const int stride = std::max(1, first.sizePixels.x / kTruthPixels);
    const auto picture = pictureOf(drawTile(thread, first).tiles[0]); // also compiles and uploads
    const auto distance =
        fields::difference(fields::everyNth(picture, stride), fields::insidePicture(first, sources, stride));
    std::vector<double> times;
    const double cpuBefore = processorMs();
    for (int frame = 0; frame < frames; ++frame)
        times.push_back(drawTile(thread, turned(one, grid, frame)).wallMs);
    const double cpuMs = (processorMs() - cpuBefore) / frames;
    return jsonObject({{"name", jsonString(one.name)},
                       {"ms", jsonNumber(median(std::move(times)))},
                       {"cpu_ms", jsonNumber(cpuMs)},
                       {"samples", jsonNumber(sampleCountOf(first, sources))},
                       {"psnr", jsonNumber(distance.psnr)},
                       {"p999", jsonNumber(distance.p999)}});
}

} // namespace

Grid insideGrid(int samples) { return fields::gridOf(fields::Geometry::Isotropic, samples); }

std::vector<InsideCase> insideCases(const VolumeBenchOptions& options, const Grid& grid) {
    const int samples = grid.dims.x;
    const auto size = sceneName(options, benchVolumeName(options, samples), "");
    std::vector<InsideCase> cases;
    const auto techniques = chosen(options);
    for (const auto& technique : techniques)
        for (const bool lit : {false, true}) {
            auto tile = techniqueTile(technique, grid, samples, options.pixels);
            tile.shading.enabled = lit;
            tile.adaptiveSampling = options.adaptive;
            // As the style's `auto`: a texture for volumes, six taps for isosurfaces.
            tile.shading.gradient =
                tile.technique == Technique::Raycast ? GradientSource::Texture : GradientSource::OnTheFly;
            cases.push_back({size + technique + (lit ? " lit" : ""), tile});
            if (!lit || technique == "sr") continue;
            const bool texture = tile.shading.gradient == GradientSource::Texture;
            tile.shading.gradient = texture ? GradientSource::OnTheFly : GradientSource::Texture;
            cases.push_back(
                {size + technique + (texture ? " lit by six taps" : " lit by gradient texture"), tile});
        }
    if (std::find(techniques.begin(), techniques.end(), "vr") != techniques.end()) {
        auto planes = volumeTile(grid, samples, options.pixels);
        planes.adaptiveSampling = options.adaptive;
        planes.clip.planes = {throughCentre(grid, {1, 0, 0}), throughCentre(grid, {0, 1, 0}),
                              throughCentre(grid, {0, 0, 1})};
        cases.push_back({size + "vr clip 1/8 by planes", planes});
    }
    if (std::find(techniques.begin(), techniques.end(), "vc") != techniques.end()) {
        auto object = volumeTile(grid, samples, options.pixels);
        object.adaptiveSampling = options.adaptive;
        object.clip.object = shapeAt("box", grid, 0.5, glm::dvec3(0.75), ClipMode::Probe);
        cases.push_back({size + "vc clip 1/8 by object", object});
    }
    return cases;
}

TileSpec turned(const InsideCase& one, const Grid& grid, int frame) {
    auto tile = one.tile;
    tile.camera = fields::cameraOf(grid, Projection::Perspective, 30.0 + kDegreesPerFrame * frame, 25.0);
    return tile;
}

std::string insideBench(const VolumeBenchOptions& options,
                        const std::function<void(const std::string&)>& progress) {
    const std::vector<int> sizes =
        options.samplesGiven ? std::vector{options.samples} : std::vector{128, 256};
    std::vector<std::string> cases;
    std::optional<RenderDevice> device;
    for (const int samples : sizes) {
        const auto sampled = benchVolume(options, samples);
        const auto grid = sampled->meta.grid;
        const auto list = insideCases(options, grid);
        auto memory = std::make_shared<MemoryVolumeProvider>();
        memory->add(sampled->meta, sampled->arrays);
        const ClipShapeProvider provider(memory);
        RenderOptions renderOptions;
        renderOptions.device = options.device;
        RenderThread thread(memory, renderOptions);
        device = thread.device();
        for (const auto& one : list) {
            if (one.name.find(options.only) == std::string::npos) continue;
            progress(one.name);
            cases.push_back(runCase(thread, provider, one, grid, options.frames));
        }
    }
    return jsonObject({{"device", jsonString(device->eglPlatform)},
                       {"renderer", jsonString(device->renderer)},
                       {"cases", jsonArray(cases)}});
}

} // namespace voxsheet::bench
