// The book of the textures that are whole: by key, with their bytes, leases, last use and priority. Private
// to this room; knows no GL.
#pragma once

#include "residency/residency_state.h"
#include "residency/resident_volume.h"
#include "residency/wanted_volume.h"

#include <compare>
#include <cstdint>
#include <exception>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace voxsheet {

/// Samples on the host are held for rays, and are no textures though they count as such here.
enum class TextureKind { Samples, HalfSamples, HostSamples, HalfHostSamples, Gradients, HalfGradients };

struct TextureKey {
    VolumeKey volume;
    TextureKind kind = TextureKind::Samples;

    auto operator<=>(const TextureKey&) const = default;
};

[[nodiscard]] TextureKind samplesKind(FloatTexels floatTexels, bool onHost) noexcept;
[[nodiscard]] TextureKind gradientsKind(FloatTexels floatTexels) noexcept;
[[nodiscard]] bool isGradients(TextureKind kind) noexcept;
[[nodiscard]] bool isOnHost(TextureKind kind) noexcept;

struct TextureEntry {
    std::optional<gpu::Texture> texture;
    ResidentVolume volume;
    std::uint64_t bytes = 0;
    std::uint64_t lastUse = 0;
    int leases = 0;
    bool clipObject = false; ///< used for nothing but clipping so far
    double uploadMs = 0.0;   ///< not yet told to a lease
    double readMs = 0.0;     ///< likewise
};

/// Adds the bytes to the kind that they belong to.
void countBytes(ResidencyState& state, TextureKind kind, bool clipObject, std::uint64_t bytes);

class TextureTable {
public:
    [[nodiscard]] bool contains(const TextureKey& key) const { return entries_.count(key) != 0; }
    /// Marks it as used now; null if it is not there.
    [[nodiscard]] std::shared_ptr<TextureEntry> use(const TextureKey& key);
    /// As used now. The key must be free.
    void add(const TextureKey& key, std::shared_ptr<TextureEntry> entry);
    /// What it was; null if it is not there.
    std::shared_ptr<TextureEntry> remove(const TextureKey& key);
    void removeDataset(const std::string& dataset);

    /// What bringing a texture in ended with, until it is thrown or other volumes are wanted.
    void keepFailure(const TextureKey& key, std::exception_ptr error);
    [[nodiscard]] bool hasFailed(const TextureKey& key) const { return failures_.count(key) != 0; }
    void throwIfFailed(const TextureKey& key); ///< once

    /// What failed may be tried again.
    void setWanted(const std::vector<WantedVolume>& wanted);
    /// A level that is coarser than a wanted one stands in for it: it counts as wanted soon.
    [[nodiscard]] WantedPriority priority(const VolumeKey& key) const;

    /// Without a lease, of the lowest priority and there the least recently used, if that priority is below
    /// `below`.
    [[nodiscard]] std::optional<TextureKey> evictable(std::optional<WantedPriority> below) const;
    /// Of all that evictable(below) would give in turn.
    [[nodiscard]] std::uint64_t evictableBytes(std::optional<WantedPriority> below) const;

    [[nodiscard]] std::uint64_t bytes() const { return bytes_; }
    [[nodiscard]] std::uint64_t leasedBytes() const;
    void describe(ResidencyState& state) const; ///< adds to its counts

private:
    [[nodiscard]] bool isEvictable(const TextureKey& key, const TextureEntry& entry,
                                   std::optional<WantedPriority> below) const;

    std::map<TextureKey, std::shared_ptr<TextureEntry>> entries_;
    std::map<VolumeKey, WantedPriority> wanted_;
    std::map<TextureKey, std::exception_ptr> failures_;
    std::uint64_t bytes_ = 0;
    std::uint64_t clock_ = 0;
};

} // namespace voxsheet
