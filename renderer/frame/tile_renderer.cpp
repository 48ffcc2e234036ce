#include "frame/tile_renderer.h"

#include "base/byte_size.h"
#include "base/errors.h"
#include "base/log.h"
#include "frame/host_resolver.h"
#include "volume/clip_shape_provider.h"

#include <algorithm>
#include <cstring>
#include <utility>

namespace voxsheet {

namespace {

using Clock = std::chrono::steady_clock;

constexpr int kMaxTilePixels = 8192; ///< per axis, as TileSpec::sizePixels documents
/// Slots beyond this size are not kept: a poster would pin its memory for ever.
constexpr std::size_t kKeptSlotBytes = std::size_t{32} << 20;
constexpr std::size_t kKeptSlots = 2;

void checkSize(glm::ivec2 size) {
    if (size.x >= 1 && size.y >= 1 && size.x <= kMaxTilePixels && size.y <= kMaxTilePixels) return;
    throw InvalidInput("a picture of " + std::to_string(size.x) + " x " + std::to_string(size.y) + " pixels",
                       "each side must have 1 to " + std::to_string(kMaxTilePixels) + " pixels")
        .withField("width");
}

double millisecondsSince(Clock::time_point begun) {
    return std::chrono::duration<double, std::milli>(Clock::now() - begun).count();
}

std::string budgetNote(const TileSpec& tile, const TileLevels& levels, std::uint64_t budgetBytes) {
    const TileLevels asked = askedLevels(tile);
    if (levels == asked) return {};
    const std::string what = levels.volume != asked.volume
                                 ? "drawn at level " + std::to_string(levels.volume) + " instead of " +
                                       std::to_string(asked.volume)
                                 : std::string("a clip object, colouring volume or layer is drawn coarser");
    return what + ": the texture budget of " + byteText(budgetBytes) +
           " does not hold more; raise --texture-budget";
}

/// At most: along the diagonal of the drawn level.
double samplesPerPixel(const TileSpec& tile, const TileVolumes& volumes) {
    return glm::length(glm::dvec3(volumes.volume.volume().dims)) / tile.sampleDistanceVoxels;
}

RenderDevice withBudget(RenderDevice device, std::uint64_t budgetBytes) {
    if (budgetBytes == 0) return device;
    if (device.memoryBytes > 0 && budgetBytes > device.memoryBytes) {
        throw InvalidInput("--texture-budget",
                           byteText(budgetBytes) + " is more than the " + byteText(device.memoryBytes) +
                               " that " + device.renderer + " has",
                           "give at most that, or leave it out for " + byteText(device.textureBudgetBytes))
            .withField("--texture-budget");
    }
    device.textureBudgetBytes = budgetBytes;
    device.textureBudgetReason = "as asked for";
    return device;
}

} // namespace

TileRenderer::TileRenderer(std::shared_ptr<const VolumeProvider> volumes, int device,
                           std::uint64_t textureBudgetBytes)
    : context_(device), device_(withBudget(context_.device(), textureBudgetBytes)),
      residency_(context_, std::make_shared<const ClipShapeProvider>(std::move(volumes)),
                 device_.textureBudgetBytes),
      techniques_(context_), resolver_(context_), targets_(context_) {
    techniques_.setTextureBudget(device_.textureBudgetBytes);
}

std::unique_ptr<ReadbackSlot> TileRenderer::takeSlot(std::size_t bytes) {
    const auto fits = [&](const auto& slot) { return slot->readback.capacityBytes() >= bytes; };
    const auto slot = std::find_if(slots_.begin(), slots_.end(), fits);
    if (slot != slots_.end()) {
        auto taken = std::move(*slot);
        slots_.erase(slot);
        return taken;
    }
    return std::make_unique<ReadbackSlot>(ReadbackSlot{
        gpu::TimerQuery(context_), gpu::Buffer(context_, bytes, 0), gpu::PixelReadback(context_, bytes)});
}

TileLevels TileRenderer::levelsFor(const TileSpec& tile, LevelChoice choice) const {
    return choice == LevelChoice::Exact ? askedLevels(tile)
                                        : levelsWithinBudget(residency_, tile, techniques_.paths());
}

bool TileRenderer::isResident(const TileSpec& tile, const TileLevels& levels) const {
    return isTileResident(residency_, tile, techniques_.paths(), levels);
}

std::vector<WantedVolume> TileRenderer::missing(const TileSpec& tile, const TileLevels& levels) const {
    return missingVolumes(residency_, tile, techniques_.paths(), levels);
}

void TileRenderer::bringIn(const TileSpec& tile, const TileLevels& levels, Deadline deadline) {
    static_cast<void>(techniques_.acquireBy(residency_, tile, levels, deadline));
}

std::optional<TileVolumes> TileRenderer::acquire(const TileSpec& tile, LevelChoice choice,
                                                 const TileLevels& levels, Deadline deadline) {
    if (choice == LevelChoice::AtHand) return techniques_.acquireAtHand(residency_, tile, levels, deadline);
    return techniques_.acquireBy(residency_, tile, levels, deadline);
}

std::unique_ptr<TileInFlight> TileRenderer::begin(const TileSpec& tile, const FrameSpec& frame,
                                                  const TileLevels& levels, Deadline deadline,
                                                  TileBreaks breaks) {
    checkSize(tile.sizePixels);
    const std::size_t bytes = static_cast<std::size_t>(tile.sizePixels.x) *
                              static_cast<std::size_t>(tile.sizePixels.y) * pixelBytes(frame.format);
    const auto acquired = acquire(tile, frame.levels, levels, deadline);
    if (!acquired) return nullptr;
    const TileVolumes& volumes = *acquired;
    auto drawing = std::make_unique<TileInFlight>();
    drawing->pixels.size = tile.sizePixels;
    drawing->pixels.level = volumes.volume.volume().level;
    drawing->pixels.standIn = volumes.standIn;
    drawing->pixels.awaited = volumes.awaited;
    drawing->pixels.note = budgetNote(tile, levels, residency_.budgetBytes());
    drawing->pixels.uploadMs = volumes.uploadMs();
    drawing->pixels.readMs = volumes.readMs();
    drawing->format = frame.format;
    drawing->bytes = bytes;
    drawing->begun = Clock::now();
    // Timers are checked on the device: a picture of the host has none.
    if (!frame.checkTimers && techniques_.drawsOnHost(tile, volumes))
        drawing->onHost = std::exchange(spare_, {});
    else
        drawing->slot = takeSlot(bytes);
    drawing->inBands = breaks == TileBreaks::BetweenBands &&
                       pace_.rows(tile.sizePixels, samplesPerPixel(tile, volumes)) < tile.sizePixels.y;
    if (drawing->inBands) {
        if (drawing->slot)
            drawing->target.emplace(context_, GL_TEXTURE_2D, GL_RGBA32F, glm::ivec3(tile.sizePixels, 1));
        drawBand(*drawing, tile, volumes);
        return drawing;
    }
    drawing->nextRow = tile.sizePixels.y;
    if (!drawing->slot) {
        techniques_.drawOnHost(tile, volumes, drawing->onHost);
        resolveOnHost(*drawing, tile.background);
        drawing->pixels.renderMs = millisecondsSince(drawing->begun);
        return drawing;
    }
    const gpu::Texture& target = targets_.acquire(tile.sizePixels);
    ReadbackSlot& slot = *drawing->slot;
    slot.timer.begin();
    techniques_.draw(tile, volumes, target);
    resolver_.resolve(target, tile.background, frame.format, slot.packed);
    slot.timer.end();
    slot.readback.start(slot.packed, bytes);
    context_.checkErrors("drawing a tile");
    return drawing;
}

void TileRenderer::resume(TileInFlight& tile, const TileSpec& spec, const FrameSpec& frame,
                          const TileLevels& levels, Deadline deadline) {
    // Volumes are not held between bands: tiles in between may need their room.
    if (const auto volumes = acquire(spec, frame.levels, levels, deadline)) drawBand(tile, spec, *volumes);
}

void TileRenderer::drawBand(TileInFlight& tile, const TileSpec& spec, const TileVolumes& volumes) {
    const auto begun = Clock::now();
    const double samples = samplesPerPixel(spec, volumes);
    const int first = tile.nextRow;
    const int end = std::min(first + pace_.rows(spec.sizePixels, samples), spec.sizePixels.y);
    if (tile.slot) {
        techniques_.draw(spec, volumes, *tile.target, {first, end});
        glFinish(); // so that the time is known, and nothing of it is left for the tiles in between
    } else {
        techniques_.drawOnHost(spec, volumes, tile.onHost, {first, end});
    }
    tile.nextRow = end;
    pace_.observe(end - first, spec.sizePixels.x, samples, millisecondsSince(begun));
    if (tile.isDrawn() && tile.slot) {
        resolver_.resolve(*tile.target, spec.background, tile.format, tile.slot->packed);
        tile.slot->readback.start(tile.slot->packed, tile.bytes);
    } else if (tile.isDrawn()) {
        resolveOnHost(tile, spec.background);
    }
    tile.bandsMs += millisecondsSince(begun);
    context_.checkErrors("drawing a tile");
}

void TileRenderer::resolveOnHost(TileInFlight& tile, const glm::vec4& background) {
    TilePixels& pixels = tile.pixels;
    if (tile.format == PixelFormat::Rgba8)
        pixels.rgba8 = resolvedRgba8(tile.onHost, pixels.size, background);
    else
        pixels.rgba32f = resolvedRgba32f(tile.onHost, pixels.size, background);
    spare_ = std::move(tile.onHost);
}

TilePixels TileRenderer::finish(std::unique_ptr<TileInFlight> tile) {
    TilePixels pixels = std::move(tile->pixels);
    if (!tile->slot) {
        if (tile->inBands) pixels.renderMs = tile->bandsMs;
        pixels.hostMs = pixels.timestampMs = pixels.renderMs;
        return pixels;
    }
    ReadbackSlot& slot = *tile->slot;
    const std::span<const std::byte> bytes = slot.readback.finish();
    if (tile->inBands) { // other tiles were drawn in between: only the host knows its own share
        pixels.hostMs = pixels.timestampMs = pixels.renderMs = tile->bandsMs;
    } else {
        pixels.hostMs = millisecondsSince(tile->begun);
        pixels.timestampMs = slot.timer.milliseconds();
        pixels.renderMs = plausibleRenderMs(pixels.timestampMs, pixels.hostMs);
    }
    const std::size_t values =
        static_cast<std::size_t>(pixels.size.x) * static_cast<std::size_t>(pixels.size.y) * 4;
    if (tile->format == PixelFormat::Rgba8) {
        pixels.rgba8.resize(values);
        std::memcpy(pixels.rgba8.data(), bytes.data(), bytes.size());
    } else {
        pixels.rgba32f.resize(values);
        std::memcpy(pixels.rgba32f.data(), bytes.data(), bytes.size());
    }
    if (slot.readback.capacityBytes() <= kKeptSlotBytes && slots_.size() < kKeptSlots)
        slots_.push_back(std::move(tile->slot));
    return pixels;
}

double TileRenderer::plausibleRenderMs(double gpuMs, double wallMs) {
    // The GPU cannot have drawn for longer than we waited, nor in no time at all; a driver that says so has a
    // broken timer, and the host's clock is the better witness.
    constexpr double kClockSlackMs = 1.0;
    if (gpuMs > 0.0 && gpuMs <= wallMs + kClockSlackMs) return gpuMs;
    if (!warnedOfTimer_) {
        warnedOfTimer_ = true;
        logWarning("the GPU timer reads " + std::to_string(gpuMs) + " ms for a tile that took " +
                   std::to_string(wallMs) +
                   " ms on the host's clock: render times are the host's from here on");
    }
    return wallMs;
}

} // namespace voxsheet
