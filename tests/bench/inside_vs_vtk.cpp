#include "bench/inside_vs_vtk.h"

#include "bench/bench_options.h"
#include "bench/inside_bench.h"
#include "bench/vs_vtk_result.h"
#include "fields/inside.h"
#include "image/vtk_peer.h"
#include "image/vtk_polygons.h"
#include "volume/clip_shape_provider.h"
#include "volume/clip_shapes.h"
#include "volume/memory_volume_provider.h"

#include <algorithm>
#include <functional>
#include <optional>
#include <utility>

namespace voxsheet::bench {
namespace {

constexpr int kTruthPixels = 64;
constexpr double kConvergedVoxels = 1.0 / 16.0;

/// Draws a tile and says how long that took.
struct Peer {
    std::function<fields::Picture(const TileSpec&)> draw;
    std::function<double()> lastMs;
};

struct Comparison {
    std::string name;
    std::function<TileSpec(int frame)> tile;
    Peer gpu; ///< VTK on OpenGL
    std::optional<Peer> cpu;
};

Peer peerOf(image::VtkPeer& peer, const std::function<TileSpec(TileSpec)>& theirs = {}) {
    return {[&peer, theirs](const TileSpec& tile) { return peer.draw(theirs ? theirs(tile) : tile); },
            [&peer] { return peer.lastMs(); }};
}

std::string compare(RenderThread& thread, const VolumeProvider& provider, const Comparison& one, int frames) {
    tellProgress(one.name);
    const auto first = one.tile(0);
    const int stride = std::max(1, first.sizePixels.x / kTruthPixels);
    auto fine = first;
    fine.sampleDistanceVoxels = kConvergedVoxels;
    const auto truth = fields::insidePicture(fine, fields::sourcesOf(provider, fine), stride);
    const auto distance = [&](const fields::Picture& picture) {
        return fields::difference(fields::everyNth(picture, stride), truth);
    };
    VsVtkResult result;
    result.name = one.name;
    // The first pictures also compile and upload.
    result.voxsheet = distance(pictureOf(drawTile(thread, first).tiles[0]));
    result.vtkGpu = distance(one.gpu.draw(first));
    if (one.cpu) result.vtkCpu = distance(one.cpu->draw(first));
    for (int frame = 0; frame < frames; ++frame) {
        const auto tile = one.tile(frame + 1);
        result.voxsheetMs.push_back(drawTile(thread, tile).wallMs);
        (void)one.gpu.draw(tile);
        result.vtkGpuMs.push_back(one.gpu.lastMs());
        if (!one.cpu) continue;
        (void)one.cpu->draw(tile);
        result.vtkCpuMs.push_back(one.cpu->lastMs());
    }
    return jsonOf(result);
}

/// A table of one colour: VTK's isosurface blend mode colours by it.
std::shared_ptr<const TransferTable> plainTable(const TransferTable& like, const glm::vec4& colour) {
    auto table = std::make_shared<TransferTable>(like);
    std::fill(table->entries.begin(), table->entries.end(), glm::vec4(glm::vec3(colour), 1.0F));
    return table;
}

std::vector<unsigned char> maskOf(const TileSpec& tile, const Grid& grid) {
    const auto& object = *tile.clip.object;
    const auto shape = clipShapeFromKey(object.dataset).value();
    std::vector<unsigned char> kept;
    for (int z = 0; z < grid.dims.z; ++z)
        for (int y = 0; y < grid.dims.y; ++y)
            for (int x = 0; x < grid.dims.x; ++x) {
                const auto world = grid.worldFromIndex * glm::dvec4(x, y, z, 1.0);
                const bool inside =
                    clipShapeDistance(shape, glm::dvec3(object.objectFromWorld * world)) < 0.0;
                kept.push_back(inside == (object.mode == ClipMode::Probe) ? 255 : 0);
            }
    return kept;
}

/// All that the comparisons draw with.
class Rivals {
public:
    Rivals(const fields::SampledField& sampled, std::vector<InsideCase> cases)
        : sampled_(sampled), grid_(sampled.meta.grid), cases_(std::move(cases)) {}

    /// Each case against what VTK has for it.
    void each(const std::function<void(const Comparison&)>& visit) {
        for (const auto& one : cases_) {
            const auto is = [&](const char* ending) {
                const std::string text(ending);
                return one.name.size() >= text.size() &&
                       one.name.compare(one.name.size() - text.size(), text.size(), text) == 0;
            };
            if (is(" vr lit")) lit(one, visit);
            if (is(" by planes")) planes(one, visit);
            if (is(" vc")) mask(one, visit);
            if (is(" ie lit")) surfaces(one, visit);
        }
    }

private:
    [[nodiscard]] std::function<TileSpec(int)> turning(const InsideCase& one) const {
        return [one, grid = grid_](int frame) { return turned(one, grid, frame); };
    }

    void lit(const InsideCase& one, const std::function<void(const Comparison&)>& visit) {
        image::VtkPeer gpu(sampled_, image::VtkMapper::Gpu);
        image::VtkPeer cpu(sampled_, image::VtkMapper::Cpu);
        visit({one.name, turning(one), peerOf(gpu), peerOf(cpu)});
    }

    void planes(const InsideCase& one, const std::function<void(const Comparison&)>& visit) {
        {
            image::VtkPeer gpu(sampled_, image::VtkMapper::Gpu);
            image::VtkPeer cpu(sampled_, image::VtkMapper::Cpu);
            visit({one.name, turning(one), peerOf(gpu), peerOf(cpu)});
        }
        // The same part of the volume, by VTK's cropping.
        image::VtkPeer gpu(sampled_, image::VtkMapper::Gpu);
        image::VtkPeer cpu(sampled_, image::VtkMapper::Cpu);
        const auto high = glm::dvec3(grid_.worldFromIndex * glm::dvec4(grid_.dims - 1, 1.0));
        gpu.crop(centreWorld(grid_), high);
        cpu.crop(centreWorld(grid_), high);
        const auto unclipped = [](TileSpec tile) {
            tile.clip.planes.clear();
            return tile;
        };
        visit({one.name + " (VTK: cropping)", turning(one), peerOf(gpu, unclipped), peerOf(cpu, unclipped)});
    }

    void mask(const InsideCase& one, const std::function<void(const Comparison&)>& visit) {
        image::VtkPeer gpu(sampled_, image::VtkMapper::Gpu);
        gpu.mask(maskOf(one.tile, grid_));
        visit({one.name + " (VTK: binary mask)", turning(one), peerOf(gpu), {}});
    }

    void surfaces(const InsideCase& one, const std::function<void(const Comparison&)>& visit) {
        const auto plain = plainTable(*one.tile.transfer, one.tile.isosurface.surfaces.at(0).colour);
        {
            image::VtkPeer gpu(sampled_, image::VtkMapper::Gpu);
            const auto coloured = [plain](TileSpec tile) {
                tile.transfer = plain;
                return tile;
            };
            visit({one.name + " (VTK: isosurface blend mode)", turning(one), peerOf(gpu, coloured), {}});
        }
        image::VtkPolygons polygons(sampled_);
        const Peer peer{[&](const TileSpec& tile) { return polygons.draw(tile); },
                        [&] { return polygons.lastMs(); }};
        visit({one.name + " (VTK: polygons)", turning(one), peer, {}});
        // Each frame has another value: VTK extracts anew.
        const auto moving = [one, grid = grid_](int frame) {
            auto tile = turned(one, grid, frame);
            tile.isosurface.surfaces.at(0).value += 0.01 * (frame % 10);
            return tile;
        };
        visit({one.name + " value moves (VTK: flying edges + polygons)", moving, peer, {}});
    }

    const fields::SampledField& sampled_;
    Grid grid_;
    std::vector<InsideCase> cases_;
};

} // namespace

std::vector<std::string> insideAgainstVtk(const VolumeBenchOptions& options) {
    auto wanted = insideCases(options, insideGrid(options.samples));
    std::erase_if(wanted, [&](const InsideCase& one) { return !isWanted(options, one.name); });
    if (wanted.empty()) return {}; // before the volume is made
    const auto sampled = benchVolume(options, options.samples);
    auto memory = std::make_shared<MemoryVolumeProvider>();
    memory->add(sampled->meta, sampled->arrays);
    const ClipShapeProvider provider(memory);
    RenderOptions renderOptions;
    renderOptions.device = options.device;
    RenderThread thread(memory, renderOptions);
    std::vector<std::string> cases;
    Rivals(*sampled, std::move(wanted)).each([&](const Comparison& one) {
        cases.push_back(compare(thread, provider, one, options.frames));
    });
    return cases;
}

} // namespace voxsheet::bench
