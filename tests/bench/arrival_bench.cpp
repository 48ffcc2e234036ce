#include "bench/arrival_bench.h"

#include "base/errors.h"
#include "bench/json_text.h"
#include "bench/time_n/bench_datasets.h"
#include "bench/time_n/time_n_scene.h"
#include "frame/render_thread.h"
#include "residency/host_volume_cache.h"
#include "store/store_volume_provider.h"

#include <algorithm>
#include <chrono>

namespace voxsheet::bench {

namespace {

constexpr int kVolumes = 16;
constexpr int kMostFrames = 10000; ///< a budget that never lets all arrive

using Clock = std::chrono::steady_clock;

double millisecondsSince(Clock::time_point begun) {
    return std::chrono::duration<double, std::milli>(Clock::now() - begun).count();
}

double median(std::vector<double> values) {
    std::sort(values.begin(), values.end());
    return values[values.size() / 2];
}

std::string summary(const std::vector<double>& ms) {
    return jsonObject({{"frames", std::to_string(ms.size())},
                       {"median_ms", jsonNumber(median(ms))},
                       {"longest_ms", jsonNumber(*std::max_element(ms.begin(), ms.end()))}});
}

class Arrival {
public:
    Arrival(const VolumeBenchOptions& options, const std::function<void(const std::string&)>& progress)
        : options_(options), datasets_(kVolumes, options.samples, [&](int) { progress("writing"); }),
          memory_(std::make_shared<const HostVolumeCache>(
              std::make_shared<const store::StoreVolumeProvider>(datasets_.store()),
              HostCacheOptions{std::uint64_t{4} << 30, PageCacheUse::DropAlways, true})),
          thread_(memory_, renderOptions(options)) {
        dropAllPages();
    }

    std::string run() {
        const auto begun = Clock::now();
        double firstMs = 0.0;
        std::vector<double> arriving;
        Missing missing{kVolumes, kVolumes};
        while (missing.standIns > 0 && arriving.size() < kMostFrames) {
            arriving.push_back(frame(missing));
            if (firstMs == 0.0 && missing.pictures < kVolumes) firstMs = millisecondsSince(begun);
        }
        const double allMs = millisecondsSince(begun);
        std::vector<double> afterwards;
        for (int i = 0; i < std::max(options_.frames, 1); ++i)
            afterwards.push_back(frame(missing));
        const auto textures = thread_.residency();
        return jsonObject({{"renderer", jsonString(thread_.device().renderer)},
                           {"volumes", std::to_string(kVolumes)},
                           {"dim", std::to_string(options_.samples)},
                           {"pixels", std::to_string(options_.pixels)},
                           {"first_picture_ms", jsonNumber(firstMs)},
                           {"all_arrived_ms", jsonNumber(allMs)},
                           {"resident_bytes", std::to_string(textures.residentBytes)},
                           {"upload_ms", jsonNumber(textures.uploadMs)},
                           {"io_ms", jsonNumber(memory_->state().diskMs)},
                           {"arriving", summary(arriving)},
                           {"arrived", summary(afterwards)}});
    }

private:
    struct Missing {
        int pictures; ///< tiles without one
        int standIns; ///< likewise, and tiles whose own level was not drawn
    };

    static RenderOptions renderOptions(const VolumeBenchOptions& options) {
        RenderOptions rendering;
        rendering.device = options.device;
        return rendering;
    }

    /// What was just written is in the page cache: the volumes are to come from the disk.
    void dropAllPages() {
        for (int i = 0; i < kVolumes; ++i) {
            const auto meta = memory_->describe(datasets_.key(i));
            for (int level = 0; level < meta->levels(); ++level)
                memory_->dropPages({datasets_.key(i), 0, 0, level}, 0, levelDims(meta->grid.dims, level).z);
        }
    }

    /// Draws the next view; the time since the frame before ended is this frame's, for one follows another.
    double frame(Missing& missing) {
        FrameSpec spec;
        spec.levels = LevelChoice::AtHand;
        TimeNScene scene;
        scene.tilePixels = glm::ivec2(options_.pixels);
        for (int i = 0; i < kVolumes; ++i)
            spec.tiles.push_back(timeNTile(scene, datasets_.key(i), datasets_.grid(), 0, frame_));
        ++frame_;
        const auto begun = Clock::now();
        const auto result = thread_.submit(std::move(spec), FramePriority::Interactive).get();
        const double ms = millisecondsSince(begun);
        missing = {0, 0};
        for (const auto& tile : result.tiles) {
            if (!tile.error.empty()) throw GpuError("arrival bench", tile.error);
            if (tile.absent) ++missing.pictures;
            if (tile.standIn || tile.absent) ++missing.standIns;
        }
        return ms;
    }

    VolumeBenchOptions options_;
    BenchDatasets datasets_;
    std::shared_ptr<const HostVolumeCache> memory_;
    RenderThread thread_;
    int frame_ = 0;
};

} // namespace

std::string arrivalBench(const VolumeBenchOptions& options,
                         const std::function<void(const std::string&)>& progress) {
    return Arrival(options, progress).run();
}

} // namespace voxsheet::bench
