#include "engine/tile_identity.h"

#include "base/errors.h"

#include <bit>
#include <cstdint>
#include <fstream>
#include <vector>

#define XXH_INLINE_ALL
#include <xxhash.h>

namespace voxsheet::engine {

namespace {

std::string hex(const XXH128_hash_t& hash) {
    static constexpr char digits[] = "0123456789abcdef";
    std::string text(32, '0');
    for (std::size_t i = 0; i < 16; ++i) {
        text[15 - i] = digits[(hash.high64 >> (4 * i)) & 15U];
        text[31 - i] = digits[(hash.low64 >> (4 * i)) & 15U];
    }
    return text;
}

/// Numbers by value, so that padding never counts and -0 equals 0.
class Collector {
public:
    void add(double value) {
        const auto bits = std::bit_cast<std::uint64_t>(value == 0.0 ? 0.0 : value);
        append(&bits, sizeof(bits));
    }
    void add(std::string_view text) {
        add(static_cast<double>(text.size()));
        append(text.data(), text.size());
    }
    void add(const glm::vec4& v) {
        for (int i = 0; i < 4; ++i)
            add(static_cast<double>(v[i]));
    }
    void append(const void* data, std::size_t bytes) {
        const auto* begin = static_cast<const char*>(data);
        bytes_.insert(bytes_.end(), begin, begin + bytes);
    }
    [[nodiscard]] std::string digest() const { return hex(XXH3_128bits(bytes_.data(), bytes_.size())); }

private:
    std::vector<char> bytes_;
};

void addTable(Collector& collector, const TransferTable& table) {
    collector.add(table.low);
    collector.add(table.high);
    collector.add(static_cast<double>(table.scale));
    collector.add(table.symLogThreshold);
    collector.add(table.below);
    collector.add(table.above);
    collector.add(table.nan);
    const XXH128_hash_t entries =
        XXH3_128bits(table.entries.data(), table.entries.size() * sizeof(glm::vec4));
    collector.add(hex(entries));
}

} // namespace

std::string tileIdentity(const TileSpec& tile, std::string_view environment) {
    Collector collector;
    collector.add(environment);
    collector.add(tile.dataset);
    collector.add(tile.field);
    collector.add(tile.step);
    collector.add(tile.level);
    collector.add(static_cast<double>(tile.technique));
    for (int column = 0; column < 4; ++column) {
        for (int row = 0; row < 4; ++row)
            collector.add(tile.camera.viewFromWorld[column][row]);
    }
    collector.add(static_cast<double>(tile.camera.projection));
    // The member that the projection does not use decides nothing.
    const bool perspective = tile.camera.projection == Projection::Perspective;
    collector.add(perspective ? tile.camera.fovYDegrees : tile.camera.heightWorld);
    addTable(collector, *tile.transfer);
    collector.add(tile.unitLengthWorld);
    collector.add(tile.sampleDistanceVoxels);
    collector.add(tile.background);
    collector.add(tile.sizePixels.x);
    collector.add(tile.sizePixels.y);
    return collector.digest();
}

std::string textIdentity(std::string_view text) { return hex(XXH3_128bits(text.data(), text.size())); }

const std::string& buildIdentity() {
    static const std::string identity = [] {
        std::ifstream self("/proc/self/exe", std::ios::binary);
        if (!self) throw IoError("the program", "it cannot read /proc/self/exe", "mount /proc");
        XXH3_state_t* state = XXH3_createState();
        XXH3_128bits_reset(state);
        std::vector<char> block(1U << 20U);
        while (self.read(block.data(), static_cast<std::streamsize>(block.size())) || self.gcount() > 0) {
            XXH3_128bits_update(state, block.data(), static_cast<std::size_t>(self.gcount()));
        }
        const std::string text = hex(XXH3_128bits_digest(state));
        XXH3_freeState(state);
        return text;
    }();
    return identity;
}

} // namespace voxsheet::engine
