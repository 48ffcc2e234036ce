// Occupancy on the GPU: what empty_space.glsl reads. Rebuilt only when the volume or the table changes, not
// when an evicted volume comes back.
#pragma once

#include "gpu/program.h"
#include "gpu/texture.h"
#include "residency/residency_manager.h"
#include "stages/occupancy.h"
#include "stages/recent_cache.h"
#include "stages/sample_strides.h"
#include "stages/table_key.h"
#include "volume/transfer_function.h"

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

namespace voxsheet {

/// Samples in a stretch of a ray that one look-up answers for: a power of two in [1, 16], as many as fit into
/// twice the reach of a cell's mark at this distance of samples.
[[nodiscard]] int chunkSamples(double sampleDistanceVoxels, int reachSamples);

/// Bytes of marks that are worth keeping beside textures of this budget. Each change of a table or an
/// isovalue leaves marks behind, of 1/64 of the volume's samples: eight of them for each volume that fits (of
/// one byte a sample), for there are other techniques and other tables to come back to. In [16, 96] MiB.
[[nodiscard]] std::size_t markBytesFor(std::uint64_t textureBudgetBytes);

class EmptySpaceStage {
public:
    static constexpr GLuint cellsUnit = 2;

    /// Keeps the most that markBytesFor() gives.
    explicit EmptySpaceStage(gpu::Context& context);
    /// Of marks on the GPU, and as many in host memory.
    void keepAtMost(std::size_t markBytes);

    /// What bindOccupied() binds, for a volume of the shader's own. The reference holds until more is asked
    /// for.
    const gpu::Texture& occupied(const std::shared_ptr<const TransferTable>& table,
                                 const ResidentVolume& volume, int reachSamples,
                                 const std::optional<StrideSettings>& strides = {});
    /// For compositing: cells are 0 where the table can show something, else emptyDistances().
    /// \param strides  cells of 0 also hold strideExponents() of all within reach, the smallest, from bit
    ///                 kStrideShift on
    void bindOccupied(const gpu::Program& program, const std::shared_ptr<const TransferTable>& table,
                      const ResidentVolume& volume, int reachSamples,
                      const std::optional<StrideSettings>& strides = {});
    /// For isosurfaces: cells are 0 where one of the values may be crossed, else emptyDistances(). Of
    /// shortReach().
    void bindCrossed(const gpu::Program& program, const std::vector<double>& values,
                     const ResidentVolume& volume);
    /// For maximum projection: cells hold the largest texel (or the largest negated one, where values fall
    /// with texels). Of kLongReach.
    void bindLargest(const gpu::Program& program, const ResidentVolume& volume);

    // --- the same in host memory, for rays that the processor marches; the references hold until more is
    // asked for ---
    struct HostCells {
        std::vector<std::uint8_t> marks; ///< and three bytes more that may be read
        std::vector<float> largest;      ///< of MIP instead of marks
    };
    const HostCells& occupiedOnHost(const std::shared_ptr<const TransferTable>& table,
                                    const ResidentVolume& volume, int reachSamples,
                                    const std::optional<StrideSettings>& strides = {});
    const HostCells& crossedOnHost(const std::vector<double>& values, const ResidentVolume& volume);
    const HostCells& largestOnHost(const ResidentVolume& volume);

private:
    struct Key {
        std::uint64_t rangesHash = 0;
        glm::ivec3 dims{0};
        glm::bvec3 periodic{false};
        glm::dvec2 valueFromTexel{1.0, 0.0};
        TableKey table; ///< of none: largest texels, or cells where `values` are crossed
        std::vector<double> values;
        int reachSamples = 0;
        std::optional<StrideSettings> strides;

        /// But for the table.
        [[nodiscard]] bool matches(const Key& other) const;
    };
    /// Without a table.
    static Key keyOf(const ResidentVolume& volume, std::vector<double> values, int reachSamples,
                     const std::optional<StrideSettings>& strides = {});
    /// What was made for the key and the table (null: for none), or for an equal one, which then is the
    /// key's; nullptr: nothing yet.
    template <typename Cache>
    static auto* madeFor(Cache& cache, Key& key, const std::shared_ptr<const TransferTable>& table);

    const gpu::Texture& insertDistances(Key key, const ResidentVolume& volume,
                                        const std::vector<std::uint8_t>& distances);
    const HostCells& insertOnHost(Key key, HostCells cells);
    void bind(const gpu::Program& program, const ResidentVolume& volume, const gpu::Texture& cells) const;

    gpu::Context& context_;
    RecentCache<Key, gpu::Texture> textures_;
    RecentCache<Key, HostCells> hostCells_;
};

} // namespace voxsheet
