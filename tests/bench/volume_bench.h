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
    bool large = false;        ///< against VTK: volumes of 512^3, u8 and u16, at 1024 x 1024, too
    std::string scans;         ///< against VTK: a folder of real scans, drawn instead; empty: none
    int cellSamples = 128;     ///< per axis of each of 25 cells, at most `samples`
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

/// How a volume is shown.
struct VolumeLook {
    std::string name; ///< "filled"
    std::shared_ptr<const TransferTable> table;
    double unitLengthWorld = 1.0; ///< of the table's opacities
};

/// The analytic volume of the benches, under the key "bench".
[[nodiscard]] std::shared_ptr<const fields::SampledField> benchVolume(const VolumeBenchOptions& options,
                                                                      int samples);
/// The material over the values from low to high. It keeps its looks at every size of the volume: opacities
/// hold over 1/256 of the grid's edge.
[[nodiscard]] VolumeLook lookOf(Material material, double low, double high, const Grid& grid);
/// Of benchVolume.
[[nodiscard]] VolumeLook benchLook(Material material, int samples);
/// "256^3 u8", for benchVolume.
[[nodiscard]] std::string benchVolumeName(const VolumeBenchOptions& options, int samples);
/// "VOLUME 512x512 LOOK"
[[nodiscard]] std::string sceneName(const VolumeBenchOptions& options, const std::string& volume,
                                    const std::string& look);

/// A scene that is drawn by turns: a volume of one field, its look and the view of a frame.
class VolumeScene {
public:
    /// \param volume  its name: "256^3 u8"
    VolumeScene(const VolumeBenchOptions& options, std::string volume,
                std::shared_ptr<const fields::SampledField> sampled, VolumeLook look);

    [[nodiscard]] const fields::SampledField& sampled() const { return *sampled_; }
    [[nodiscard]] TileSpec tile(Technique technique, int frame) const;
    /// The converged picture of frame 0, of about 64 x 64 of its pixels. Maximum projection has its own.
    [[nodiscard]] const fields::Picture& truth(Technique technique);
    [[nodiscard]] fields::Difference distance(Technique technique, const fields::Picture& picture);
    [[nodiscard]] std::string name() const;

private:
    VolumeBenchOptions options_;
    std::string volume_;
    std::shared_ptr<const fields::SampledField> sampled_;
    VolumeLook look_;
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
