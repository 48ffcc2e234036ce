#include "stream/tile_service.h"

#include <chrono>
#include <string>
#include <vector>

namespace voxsheet::stream {

namespace {

using Clock = std::chrono::steady_clock;

double millisecondsSince(Clock::time_point start) {
    return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

/// Throws the cell's own sentence when there is nothing to draw.
const TileSpec& drawable(const engine::PreparedTile& tile) {
    if (tile.spec) return *tile.spec;
    const auto name = sheet::addressName(tile.cell);
    if (tile.progress < 1.0)
        throw Conflict("cell " + name,
                       "what it needs is still being imported or computed (" + tile.message + ")",
                       "ask again when it is ready");
    if (tile.code.empty())
        throw NotFound("cell " + name, "it is empty", "name a cell that holds a dataset or a formula");
    throw InvalidInput("cell " + name, tile.code + " " + tile.message);
}

std::string joined(const std::vector<std::string>& sentences) {
    std::string all;
    for (const std::string& sentence : sentences)
        all += (all.empty() || sentence.empty() ? "" : "; ") + sentence;
    return all;
}

} // namespace

std::string encodedIdentity(const std::string& pixels, const EncodeSettings& encoding) {
    std::string identity = pixels + "-" + formatName(encoding.format);
    if (encoding.format == ImageFormat::Jpeg)
        identity += std::to_string(encoding.quality) + (encoding.subsampleChroma ? "s" : "");
    if (encoding.format == ImageFormat::Webp)
        identity += encoding.lossless ? "l" : std::to_string(encoding.quality);
    return identity + (encoding.fast ? "f" : "");
}

TileService::TileService(engine::Engine& engine, std::uint64_t cacheBytes)
    : engine_(engine), cacheBytes_(cacheBytes) {}

std::string TileService::cellIdentity(const CellImageRequest& request) const {
    const auto tile =
        engine_.prepareTile(*engine_.snapshot(), request.sheet, request.cell, request.view, request.quality);
    static_cast<void>(drawable(tile));
    return encodedIdentity(tile.identity, request.encoding);
}

std::shared_ptr<const EncodedImage> TileService::cellImage(const CellImageRequest& request,
                                                           const std::function<bool()>& cancelled) {
    const auto tile =
        engine_.prepareTile(*engine_.snapshot(), request.sheet, request.cell, request.view, request.quality);
    const auto& spec = drawable(tile);
    const auto identity = encodedIdentity(tile.identity, request.encoding);
    {
        // Whoever comes second waits for the first one's picture instead of drawing it again.
        std::unique_lock lock(mutex_);
        while (underWay_.count(identity) != 0) {
            finished_.wait_for(lock, std::chrono::milliseconds(50));
            if (cancelled && cancelled()) throw Cancelled("picture", "nobody waits for it any more");
        }
        if (const auto found = byIdentity_.find(identity); found != byIdentity_.end()) {
            ++state_.hits;
            order_.splice(order_.begin(), order_, found->second);
            return order_.front();
        }
        ++state_.misses;
        underWay_[identity] = 1;
    }
    struct Done {
        TileService& service;
        const std::string& identity;
        ~Done() {
            const std::lock_guard lock(service.mutex_);
            service.underWay_.erase(identity);
            service.finished_.notify_all();
        }
    };
    const Done done{*this, identity};
    auto frame = engine_.render({.tiles = {spec}}, FramePriority::Final, cancelled).get();
    auto& pixels = frame.tiles.at(0);
    if (!pixels.error.empty()) {
        const auto cell = "cell " + sheet::addressName(tile.cell);
        if (pixels.errorKind == ErrorKind::LimitExceeded) throw LimitExceeded(cell, pixels.error);
        throw GpuError(cell, pixels.error);
    }
    auto image = std::make_shared<EncodedImage>();
    const auto start = Clock::now();
    image->bytes = encodeImage(pixels, request.encoding);
    image->encodeMs = millisecondsSince(start);
    image->identity = identity;
    image->format = request.encoding.format;
    image->size = pixels.size;
    image->level = pixels.level;
    image->renderMs = pixels.renderMs;
    image->note = joined({tile.note, pixels.note});
    image->final = request.quality.level == 0 && request.quality.sampleDistanceFactor == 1.0;
    remember(image);
    return image;
}

std::shared_ptr<const EncodedImage> TileService::sheetImage(const engine::SheetImageRequest& request,
                                                            const EncodeSettings& encoding) {
    const auto drawn = engine_.renderSheet(request);
    auto image = std::make_shared<EncodedImage>();
    const auto start = Clock::now();
    image->bytes = encodeImage(drawn.pixels, encoding);
    image->encodeMs = millisecondsSince(start);
    image->identity = encodedIdentity(drawn.identity, encoding);
    image->format = encoding.format;
    image->size = drawn.pixels.size;
    image->level = drawn.pixels.level;
    image->renderMs = drawn.pixels.renderMs;
    image->note = joined(drawn.notes);
    image->final = drawn.final;
    return image;
}

std::shared_ptr<const EncodedImage> TileService::cached(const std::string& identity) {
    const std::lock_guard lock(mutex_);
    const auto found = byIdentity_.find(identity);
    if (found == byIdentity_.end()) {
        ++state_.misses;
        return nullptr;
    }
    ++state_.hits;
    order_.splice(order_.begin(), order_, found->second);
    return order_.front();
}

void TileService::remember(const std::shared_ptr<const EncodedImage>& image) {
    const std::lock_guard lock(mutex_);
    if (byIdentity_.count(image->identity) != 0 || image->bytes.size() > cacheBytes_) return;
    order_.push_front(image);
    byIdentity_[image->identity] = order_.begin();
    state_.bytes += image->bytes.size();
    while (state_.bytes > cacheBytes_) {
        state_.bytes -= order_.back()->bytes.size();
        byIdentity_.erase(order_.back()->identity);
        order_.pop_back();
    }
}

CacheState TileService::cacheState() const {
    const std::lock_guard lock(mutex_);
    return state_;
}

} // namespace voxsheet::stream
