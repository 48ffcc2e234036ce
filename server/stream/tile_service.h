// Encoded pictures by identity: each is rendered and encoded once, however many clients want it.
#pragma once

#include "engine/engine.h"
#include "stream/encoder.h"

#include <condition_variable>
#include <cstdint>
#include <functional>
#include <list>
#include <memory>
#include <mutex>
#include <string>
#include <unordered_map>

namespace voxsheet::stream {

struct EncodedImage {
    std::string identity; ///< of pixels and encoding: the ETag
    std::string bytes;
    ImageFormat format = ImageFormat::Png;
    glm::ivec2 size{0};
    int level = 0;
    double renderMs = 0.0;
    double encodeMs = 0.0;
    bool final = true;    ///< false: drawn from data that is still arriving; not to be stored by anyone
    bool awaited = false; ///< something better is being brought in: to be asked for again
    std::string note;     ///< what to know about it: why it is coarser than asked for, or shows nothing
};

struct CellImageRequest {
    std::string sheet;
    sheet::Address cell;
    engine::View view; ///< overrides from the query
    engine::TileQuality quality;
    EncodeSettings encoding;
};

struct CacheState {
    std::uint64_t bytes = 0;
    std::uint64_t hits = 0;
    std::uint64_t misses = 0;
};

/// Thread-safe.
class TileService {
public:
    /// \param cacheBytes budget of encoded bytes kept, least recently used goes first
    explicit TileService(engine::Engine& engine, std::uint64_t cacheBytes = 64U << 20U);

    /// The identity that cellImage would give, without drawing: for If-None-Match. Throws as cellImage.
    [[nodiscard]] std::string cellIdentity(const CellImageRequest& request) const;

    /// Blocks until drawn. Throws NotFound if the cell is empty or not there, InvalidInput (the cell's own
    /// error sentence) if it holds an error, Conflict while its source is still being imported, Cancelled
    /// when `cancelled` says so.
    [[nodiscard]] std::shared_ptr<const EncodedImage> cellImage(const CellImageRequest& request,
                                                                const std::function<bool()>& cancelled = {});

    /// The whole sheet (or a range) as one picture. Throws as Engine::renderSheet.
    [[nodiscard]] std::shared_ptr<const EncodedImage> sheetImage(const engine::SheetImageRequest& request,
                                                                 const EncodeSettings& encoding);

    [[nodiscard]] std::shared_ptr<const EncodedImage> cached(const std::string& identity);
    void remember(const std::shared_ptr<const EncodedImage>& image);
    [[nodiscard]] CacheState cacheState() const;

private:
    using Order = std::list<std::shared_ptr<const EncodedImage>>;

    engine::Engine& engine_;
    std::uint64_t cacheBytes_;
    mutable std::mutex mutex_;
    std::condition_variable finished_;
    Order order_; ///< most recent first
    std::unordered_map<std::string, Order::iterator> byIdentity_;
    std::unordered_map<std::string, int> underWay_;
    CacheState state_;
};

/// Identity of an encoded picture: the pixels' identity plus everything in `encoding` that changes bytes.
[[nodiscard]] std::string encodedIdentity(const std::string& pixels, const EncodeSettings& encoding);

} // namespace voxsheet::stream
