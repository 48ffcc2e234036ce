// Which volumes and gradients are 3D textures on the GPU: one texture per VolumeKey and kind however many
// cells show it, within a byte budget, least recently used goes first.
#pragma once

#include "gpu/texture.h"
#include "residency/residency_state.h"
#include "volume/texture_encoding.h"
#include "volume/volume_provider.h"

#include <glm/glm.hpp>

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <string>

namespace voxsheet {

class VolumeUpload;

/// A volume that can be drawn. Texel centres: texture coordinate (i + 1/2) / dims; linear filter; REPEAT on
/// periodic axes, else CLAMP_TO_EDGE (set on the texture itself).
struct ResidentVolume {
    const gpu::Texture* texture = nullptr; ///< GL_TEXTURE_3D, one channel, normalised or float
    double valueScale = 1.0; ///< value = valueScale * texel + valueOffset, slope and intercept included
    double valueOffset = 0.0;
    /// In values. Keep the pointer, not its address, when caching what was derived from it: an evicted
    /// volume's grid is freed, and another may take its address.
    std::shared_ptr<const MinMaxGrid> minMax;
    std::shared_ptr<const DatasetMeta> meta;
    int field = 0;
    int step = 0;
    int level = 0;
    glm::ivec3 dims{0}; ///< levelDims(meta->grid.dims, level) = texture->size()
};

/// A resident volume that is not evicted while the lease lives. Ends before its ResidencyManager.
class VolumeLease {
public:
    VolumeLease(const VolumeLease&) = delete;
    VolumeLease& operator=(const VolumeLease&) = delete;
    VolumeLease(VolumeLease&& other) noexcept;
    VolumeLease& operator=(VolumeLease&& other) noexcept;
    ~VolumeLease();

    [[nodiscard]] const ResidentVolume& volume() const;
    double uploadMs = 0.0; ///< host time spent on conversion and upload by this acquire; 0 when resident
    double readMs = 0.0;   ///< host time spent in the provider by this acquire; 0 when resident

private:
    friend class ResidencyManager;
    struct Entry;
    explicit VolumeLease(std::shared_ptr<Entry> entry);
    std::shared_ptr<Entry> entry_;
};

/// Fills the RGBA16F texture of a volume's size with what was derived from the volume's own.
using DerivedTextureBuilder = std::function<void(const ResidentVolume& volume, gpu::Texture& rgba16f)>;

/// Belongs to the thread of its Context.
class ResidencyManager {
public:
    ResidencyManager(gpu::Context& context, std::shared_ptr<const VolumeProvider> provider,
                     std::uint64_t budgetBytes);
    ~ResidencyManager();
    ResidencyManager(const ResidencyManager&) = delete;
    ResidencyManager& operator=(const ResidencyManager&) = delete;

    /// Uploads the volume if it is not resident, evicting the least recently used ones without a lease as far
    /// as the budget asks. Throws what the provider throws; NotFound for a field, step or level that the
    /// dataset does not have; LimitExceeded when the volume alone, or with the leased ones, breaks the budget
    /// or the device's limits.
    [[nodiscard]] VolumeLease acquire(const VolumeKey& key, FloatTexels floatTexels = FloatTexels::Full);

    /// The gradient texture of a volume: the lease's volume() is as acquire() gives it but for `texture`.
    /// Built by `build` when it is not resident; the volume itself is then made resident too. Throws as
    /// acquire.
    [[nodiscard]] VolumeLease acquireGradients(const VolumeKey& key, FloatTexels floatTexels,
                                               const DerivedTextureBuilder& build);

    [[nodiscard]] bool isResident(const VolumeKey& key, FloatTexels floatTexels = FloatTexels::Full) const;

    /// Drops every texture of a dataset. One under lease is freed when its lease ends, and is not handed out
    /// again.
    void forget(const std::string& dataset);

    [[nodiscard]] ResidencyState state() const;

private:
    using Entry = VolumeLease::Entry;
    enum class Kind { Samples, HalfSamples, Gradients, HalfGradients };
    using EntryKey = std::pair<VolumeKey, Kind>;
    using Entries = std::map<EntryKey, std::shared_ptr<Entry>>;

    [[nodiscard]] std::shared_ptr<Entry> find(const EntryKey& key);
    [[nodiscard]] VolumeLease load(const VolumeKey& key, FloatTexels floatTexels);
    [[nodiscard]] VolumeLease keep(const EntryKey& key, std::shared_ptr<Entry> entry);
    void makeRoom(std::uint64_t bytes);
    [[nodiscard]] gpu::Texture createTexture(const std::function<gpu::Texture()>& create, bool roomHelps);
    bool evictOne();
    Entries::iterator drop(Entries::iterator entry);

    gpu::Context& context_;
    std::shared_ptr<const VolumeProvider> provider_;
    Entries entries_;
    std::uint64_t clock_ = 0;
    ResidencyState state_;
};

} // namespace voxsheet
