#include "cli/bench/edit_bench.h"

#include "base/errors.h"
#include "bench/scratch_folder.h"
#include "cli/bench/bench_volumes.h"
#include "cli/bench/percentile.h"
#include "cli/engine_arguments.h"
#include "engine/engine.h"
#include "stream/frame_planner.h"

#include <chrono>
#include <filesystem>
#include <set>
#include <string>
#include <vector>

namespace voxsheet::cli {

namespace {

using Clock = std::chrono::steady_clock;

/// A sheet of different volumes, and a page that looks at all of it.
class WatchedSheet {
public:
    WatchedSheet(const EditBenchOptions& options, const std::filesystem::path& scratch)
        : engine_(benchEngineOptions(scratch, options.device)), tileSize_(options.width, options.height) {
        EngineArguments arguments;
        arguments.sources = writeBenchVolumes(scratch, options.cells, options.dim);
        openSources(engine_, arguments);
        if (!engine_.waitIdle(300.0)) throw IoError("bench edit", "no volume came within 300 s");
        name_ = engine_.snapshot()->sheets.front().name;
        for (const auto& [address, cell] : engine_.snapshot()->sheets.front().cells) {
            cells_.push_back(address);
            view_.tiles.push_back({address, tileSize_});
        }
        planner_ = std::make_unique<stream::FramePlanner>("bench", name_, engine_, tiles_, levels_);
        static_cast<void>(drawDirty()); // uploads, compiles shaders
    }

    [[nodiscard]] const std::vector<sheet::Address>& cells() const { return cells_; }

    /// Milliseconds until everything that the edit made dirty, which must be `expected` cells, is drawn.
    double editMs(const sheet::Layer& layer, double opacity, std::size_t expected) {
        sheet::SetStyle edit;
        edit.sheet = name_;
        edit.layer = layer;
        edit.patch = sheet::parseStylePatch(
            engine_.keys(), {{"transfer.opacity", {{0.0, 0.0}, {0.5, 0.5 * opacity}, {1.0, opacity}}}});
        edit.clearNearer = true;
        const auto start = Clock::now();
        engine_.apply(edit);
        const std::size_t drawn = drawDirty();
        const double ms = std::chrono::duration<double, std::milli>(Clock::now() - start).count();
        if (drawn != expected)
            throw InternalError("bench edit", "an edit that makes " + std::to_string(expected) +
                                                  " cells dirty had " + std::to_string(drawn) + " drawn");
        return ms;
    }

private:
    /// Number of cells drawn; a cell that is drawn twice counts twice.
    std::size_t drawDirty() {
        std::size_t count = 0;
        for (auto plan = planner_->plan(view_, false); !plan.empty(); plan = planner_->plan(view_, false)) {
            const auto start = Clock::now();
            if (!plan.notices.empty())
                throw IoError("bench edit", "a cell shows no picture: " + plan.notices.front().message);
            FrameSpec frame;
            for (const auto& tile : plan.tiles)
                frame.tiles.push_back(*tile.prepared.spec);
            const auto pictures = engine_.render(std::move(frame), FramePriority::Final).get();
            for (std::size_t i = 0; i < plan.tiles.size(); ++i) {
                const TilePixels& pixels = pictures.tiles.at(i);
                if (!pixels.error.empty()) throw GpuError("bench edit", pixels.error);
                if (pixels.level != 0)
                    throw InternalError("bench edit", "a tile was drawn at a coarser level");
                auto image = std::make_shared<stream::EncodedImage>();
                image->size = pixels.size;
                plan.tiles[i].image = std::move(image);
                planner_->pictureSent(plan.tiles[i]);
            }
            planner_->frameDrawn(plan, plan.pixels,
                                 std::chrono::duration<double, std::milli>(Clock::now() - start).count());
            count += plan.tiles.size();
        }
        return count;
    }

    engine::Engine engine_;
    stream::TileService tiles_{engine_};
    stream::SheetLevels levels_{LevelSettings{.policy = LevelPolicy::Off}, [] {}};
    std::unique_ptr<stream::FramePlanner> planner_;
    std::string name_;
    std::vector<sheet::Address> cells_;
    stream::ClientView view_;
    glm::ivec2 tileSize_;
};

} // namespace

nlohmann::json runEditBench(const EditBenchOptions& options) {
    const bench::ScratchFolder scratch;
    WatchedSheet sheet(options, scratch.path());
    std::vector<double> all;
    std::vector<double> dirty;
    const auto cells = sheet.cells().size();
    for (int turn = 0; turn < options.repeats; ++turn) {
        // Never the same value twice, and so little apart that the work is the same.
        const double opacity = 0.8 + 1e-4 * turn;
        all.push_back(sheet.editMs(sheet::Layer::sheet(), opacity, cells));
        const auto& one = sheet.cells()[static_cast<std::size_t>(turn) % cells];
        dirty.push_back(sheet.editMs(sheet::Layer::ofCell(one), opacity + 5e-5, 1));
    }
    const double allMs = percentile(all, 0.5);
    const double dirtyMs = percentile(dirty, 0.5);
    return {{"bench", "edit"},
            {"dim", options.dim},
            {"tile", {options.width, options.height}},
            {"level", 0},
            {"repeats", options.repeats},
            {"cases",
             {{{"cells", cells},
               {"dirty_ms", dirtyMs},
               {"dirty_ms_p95", percentile(dirty, 0.95)},
               {"all_ms", allMs},
               {"all_ms_p95", percentile(all, 0.95)},
               {"ratio", allMs / dirtyMs}}}}};
}

} // namespace voxsheet::cli
