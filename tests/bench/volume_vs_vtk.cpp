#include "bench/volume_vs_vtk.h"

#include "bench/bench_options.h"
#include "bench/json_text.h"
#include "bench/vs_vtk_result.h"
#include "image/vtk_peer.h"
#include "volume/memory_volume_provider.h"

#include <algorithm>
#include <utility>

namespace voxsheet::bench {
namespace {

constexpr double kGoodDecibels = 40.0;

/// Our maximum projection is opaque where the table is most so; VTK's shows the table's opacity itself.
TileSpec theirTile(TileSpec tile) {
    if (tile.technique != Technique::Mip) return tile;
    auto table = std::make_shared<TransferTable>(*tile.transfer);
    for (auto& entry : table->entries)
        entry.w /= largestOpacity(*tile.transfer);
    tile.transfer = table;
    return tile;
}

/// The three that draw one volume.
class Contest {
public:
    Contest(const VolumeBenchOptions& options, const fields::SampledField& sampled)
        : frames_(options.frames), provider_(std::make_shared<MemoryVolumeProvider>()),
          gpu_(sampled, image::VtkMapper::Gpu), cpu_(sampled, image::VtkMapper::Cpu) {
        provider_->add(sampled.meta, sampled.arrays);
        RenderOptions renderOptions;
        renderOptions.device = options.device;
        thread_ = std::make_unique<RenderThread>(provider_, renderOptions);
    }

    /// \param ours  makes our tile from the one that VTK draws
    VsVtkResult run(VolumeScene& scene, Technique technique, const std::function<TileSpec(TileSpec)>& ours) {
        VsVtkResult result;
        const auto first = scene.tile(technique, 0); // compiles, uploads
        result.voxsheet = scene.distance(technique, pictureOf(drawTile(*thread_, ours(first)).tiles[0]));
        result.vtkGpu = scene.distance(technique, gpu_.draw(theirTile(first)));
        result.vtkCpu = scene.distance(technique, cpu_.draw(theirTile(first)));
        const auto theirs = theirTile(first).transfer; // one table: they compile a new one
        for (int frame = 0; frame < frames_; ++frame) {
            auto tile = scene.tile(technique, frame);
            result.voxsheetMs.push_back(drawTile(*thread_, ours(tile)).wallMs);
            tile.transfer = theirs;
            (void)gpu_.draw(tile);
            result.vtkGpuMs.push_back(gpu_.lastMs());
            (void)cpu_.draw(tile);
            result.vtkCpuMs.push_back(cpu_.lastMs());
        }
        return result;
    }

    /// The longest distance of samples at which pre-integrated pictures are good, and at least as close to
    /// the integral as both of VTK's.
    double equalDistance(VolumeScene& scene) {
        const auto first = scene.tile(Technique::Raycast, 0);
        const double least =
            std::max({kGoodDecibels, scene.distance(Technique::Raycast, gpu_.draw(first)).psnr,
                      scene.distance(Technique::Raycast, cpu_.draw(first)).psnr});
        for (const double distance : {4.0, 2.8, 2.0, 1.4, 1.0, 0.7}) {
            const auto tile = sampledBy(first, Classification::PreIntegrated, distance);
            const auto picture = pictureOf(drawTile(*thread_, tile).tiles[0]);
            if (scene.distance(Technique::Raycast, picture).psnr >= least) return distance;
        }
        return first.sampleDistanceVoxels;
    }

private:
    int frames_;
    std::shared_ptr<MemoryVolumeProvider> provider_;
    std::unique_ptr<RenderThread> thread_;
    image::VtkPeer gpu_;
    image::VtkPeer cpu_;
};

} // namespace

std::string VolumeCase::name(const VolumeBenchOptions& options, const std::string& volume) const {
    return sceneName(options, volume, look.name) + " " + fields::nameOf(technique) +
           (atEqualQuality ? " pre-integrated" : "");
}

std::vector<std::string> drawnAgainstVtk(const VolumeBenchOptions& options, const std::string& volume,
                                         const std::shared_ptr<const fields::SampledField>& sampled,
                                         const std::vector<VolumeCase>& cases) {
    std::vector<std::string> results;
    if (cases.empty()) return results;
    Contest contest(options, *sampled);
    std::optional<VolumeScene> scene; // of the cases in a row with one look: its integral is worth keeping
    std::string look;
    for (const auto& one : cases) {
        if (!scene || look != one.look.name) scene.emplace(options, volume, sampled, one.look);
        look = one.look.name;
        auto name = one.name(options, volume);
        tellProgress(name);
        std::function<TileSpec(TileSpec)> ours = [](const TileSpec& tile) { return tile; };
        if (one.atEqualQuality) {
            const double distance = contest.equalDistance(*scene);
            name += ", " + jsonNumber(distance) + " voxels";
            ours = [distance](TileSpec tile) {
                return sampledBy(std::move(tile), Classification::PreIntegrated, distance);
            };
        }
        auto result = contest.run(*scene, one.technique, ours);
        result.name = name;
        results.push_back(jsonOf(result));
    }
    return results;
}

std::vector<std::string> volumesAgainstVtk(const VolumeBenchOptions& options) {
    const auto volume = benchVolumeName(options, options.samples);
    std::vector<VolumeCase> cases;
    for (const auto material : {Material::Sparse, Material::Filled, Material::SharpPeaks}) {
        const auto look = benchLook(material, options.samples);
        for (const auto technique : {Technique::Raycast, Technique::Slices})
            cases.push_back({look, technique});
        if (material == Material::Filled) cases.push_back({look, Technique::Mip});
        if (material == Material::SharpPeaks) cases.push_back({look, Technique::Raycast, true});
    }
    std::erase_if(cases,
                  [&](const VolumeCase& one) { return !isWanted(options, one.name(options, volume)); });
    if (cases.empty()) return {};
    return drawnAgainstVtk(options, volume, benchVolume(options, options.samples), cases);
}

} // namespace voxsheet::bench
