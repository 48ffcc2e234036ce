#include "stream/time_measurement.h"

#include "stream/frame_planner.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <numeric>

#include <glm/gtc/matrix_transform.hpp>

namespace voxsheet::stream {

namespace {

constexpr int kMostPoints = 12;
constexpr double kSteadySpread = 0.1;

void validate(const MeasureRequest& request) {
    if (request.repeats < 3 || request.repeats > 25)
        throw InvalidInput("repeats", "it must be from 3 to 25", "leave it out for 5").withField("repeats");
    if (!(request.seconds > 0.0) || request.seconds > 300.0)
        throw InvalidInput("seconds", "it must be above 0 and at most 300", "leave it out for 30")
            .withField("seconds");
}

/// The whole sheet first, then from small to large.
std::vector<int> sheetSizes(int n, bool curve) {
    std::vector<int> sizes{n};
    if (!curve) return sizes;
    const int points = std::min(n, kMostPoints);
    for (int i = 1; i < points; ++i) {
        const int size = static_cast<int>(std::lround(static_cast<double>(n) * i / points));
        if (size >= 1 && size < n && size != sizes.back()) sizes.push_back(size);
    }
    return sizes;
}

class Measurement {
public:
    Measurement(engine::Engine& engine, SheetLevels& levels, FramePlan plan, std::string kind,
                const std::function<bool()>& cancelled)
        : engine_(engine), levels_(levels), plan_(std::move(plan)), kind_(std::move(kind)),
          cancelled_(cancelled) {}

    [[nodiscard]] int n() const { return static_cast<int>(plan_.tiles.size()); }

    /// ms with every tile of kTimedTilePixels.
    [[nodiscard]] double redraw(int n, double rollDegrees) {
        FrameSpec frame;
        frame.levels = LevelChoice::WithinBudget;
        for (int i = 0; i < n; ++i) {
            TileSpec spec = *plan_.tiles[static_cast<std::size_t>(i)].prepared.spec;
            spec.camera.viewFromWorld =
                glm::rotate(glm::dmat4(1.0), glm::radians(rollDegrees), glm::dvec3(0, 0, 1)) *
                spec.camera.viewFromWorld;
            frame.tiles.push_back(std::move(spec));
        }
        const FrameResult drawn = engine_.render(std::move(frame), FramePriority::Export, cancelled_).get();
        double ms = 0.0;
        for (std::size_t i = 0; i < drawn.tiles.size(); ++i) {
            const TilePixels& tile = drawn.tiles[i];
            const PlannedTile& planned = plan_.tiles[i];
            if (!tile.error.empty())
                throw GpuError("cell " + sheet::addressName(planned.tile.cell), tile.error);
            ms += (tile.renderMs + tile.uploadMs + tile.readMs) * kTimedTilePixels /
                  (static_cast<double>(tile.size.x) * tile.size.y);
        }
        return ms;
    }

    void tell(int n, double ms) {
        int coarsest = 0;
        for (int i = 0; i < n; ++i)
            coarsest = std::max(coarsest, plan_.tiles[static_cast<std::size_t>(i)].prepared.spec->level);
        levels_.redrawn({n, ms, coarsest, kind_, engine_.residency().residentBytes, 0.0});
    }

private:
    engine::Engine& engine_;
    SheetLevels& levels_;
    FramePlan plan_;
    std::string kind_;
    const std::function<bool()>& cancelled_;
};

std::string spreadWarning(const std::vector<double>& ms) {
    const auto [least, most] = std::minmax_element(ms.begin(), ms.end());
    const double middle = std::accumulate(ms.begin(), ms.end(), 0.0) / static_cast<double>(ms.size());
    if (*most - *least <= kSteadySpread * middle) return {};
    char text[160];
    std::snprintf(
        text, sizeof text,
        "frames of the whole sheet took %.1f to %.1f ms: the machine was busy, or memory is too small",
        *least, *most);
    return text;
}

} // namespace

MeasureResult measureTimeN(engine::Engine& engine, SheetLevels& levels, const std::string& sheet,
                           const ClientView& view, const MeasureRequest& request,
                           const std::function<bool()>& cancelled) {
    validate(request);
    TileService uncached(engine, 0);
    FramePlanner planner({}, sheet, engine, uncached, levels);
    FramePlan plan = planner.planAll(view);
    if (plan.tiles.empty())
        throw Conflict("measurement", "no cell of sheet '" + sheet + "' shows a volume",
                       "wait for the imports, or open a dataset");
    Measurement measurement(engine, levels, std::move(plan), planner.kindOfWork(), cancelled);
    MeasureResult result;
    result.n = measurement.n();
    static_cast<void>(measurement.redraw(result.n, 0.0)); // brings the textures in
    const auto start = std::chrono::steady_clock::now();
    for (const int n : sheetSizes(result.n, request.curve)) {
        const std::chrono::duration<double> passed = std::chrono::steady_clock::now() - start;
        result.stoppedEarly = n != result.n && passed.count() > request.seconds;
        if (result.stoppedEarly) break;
        std::vector<double> times;
        for (int i = 0; i < request.repeats; ++i) {
            times.push_back(measurement.redraw(n, i + 1.0));
            ++result.frames;
            measurement.tell(n, times.back());
        }
        if (n == result.n) result.warning = spreadWarning(times);
    }
    levels.judge();
    return result;
}

} // namespace voxsheet::stream
