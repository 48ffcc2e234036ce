// The volume rendering bench: one analytic volume, thin material everywhere ("filled"), only the top of its
// range ("sparse"), or thin shells ("sharp peaks"), a camera that goes round it; times from state to host
// pixels, and the pictures' distance from the converged integral.
#pragma once

#include "fields/picture.h"
#include "fields/sampled_field.h"
#include "fields/scenes.h"
#include "frame/render_thread.h"

#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace voxsheet::bench {

struct VolumeBenchOptions {
    int samples = 256; ///< of the volume, per axis
    int pixels = 512;  ///< of the square picture
    int frames = 20;   ///< per case; the median is reported
    int device = -1;   ///< as RenderOptions::device
    ScalarType type = ScalarType::U8;
    /// Not empty: the bench of what looks inside (inside_bench.h) instead, of these out of vr, sr, vc, ie,
    /// all.
    std::vector<std::string> techniques;
    bool adaptive = true;      ///< sampling, as the style key sampling.adaptive
    std::string only;          ///< of those, the cases whose name has this text in it
    int cellSamples = 128;     ///< per axis of each of 25 cells, at most `samples`
    std::string scans;         ///< a folder of real scans, drawn instead of the analytic volumes; empty: none
    bool samplesGiven = false; ///< else that bench takes 128 and 256 samples
};

struct VolumeBenchCase {
    std::string name;
    double ms = 0.0;      ///< median, from state to host pixels
    double cpuMs = 0.0;   ///< mean per frame, of all threads
    double samples = 0.0; ///< in the box at this distance, for the first view: before any is skipped
    double psnr = 0.0;    ///< dB, of the 8-bit picture of the first view against the converged integral, over
                          ///< about 64 x 64 pixels
    double p999 = 0.0;    ///< 99.9th percentile of its error
};

enum class Material { Sparse, Filled, SharpPeaks };

/// A scene that is drawn by turns: the volume, its table and the view of a frame.
class VolumeScene {
public:
    VolumeScene(const VolumeBenchOptions& options, Material material);
    /// A given volume, with the material over the values from low to high.
    VolumeScene(const VolumeBenchOptions& options, Material material, std::string volume,
                fields::SampledField sampled, double low, double high);

    [[nodiscard]] const fields::SampledField& sampled() const { return sampled_; }
    [[nodiscard]] TileSpec tile(Technique technique, int frame) const;
    /// The converged picture of frame 0, of about 64 x 64 of its pixels. Maximum projection has its own.
    [[nodiscard]] const fields::Picture& truth(Technique technique);
    [[nodiscard]] fields::Difference distance(Technique technique, const fields::Picture& picture);
    [[nodiscard]] std::string name() const;

private:
    VolumeBenchOptions options_;
    Material material_;
    std::string volume_; ///< its name
    fields::SampledField sampled_;
    std::shared_ptr<const TransferTable> table_;
    fields::Picture integral_;
    fields::Picture maximum_;
};

/// The picture as the render thread gave it.
[[nodiscard]] fields::Picture pictureOf(const TilePixels& pixels);
/// Draws one tile and waits. Throws GpuError or the tile's error.
[[nodiscard]] FrameResult drawTile(RenderThread& thread, const TileSpec& tile);
[[nodiscard]] TileSpec sampledBy(TileSpec tile, Classification classification, double distanceVoxels);
/// Processor time of all threads of the process so far.
[[nodiscard]] double processorMs();
[[nodiscard]] double median(std::vector<double> values);

/// Every technique on both scenes, as the JSON object {"device": …, "renderer": …, "cases": [{"name", "ms",
/// "cpu_ms", "samples", "psnr", "p999"}]}. `progress` is told the name of each case.
[[nodiscard]] std::string volumeBench(const VolumeBenchOptions& options,
                                      const std::function<void(const std::string&)>& progress);

} // namespace voxsheet::bench
