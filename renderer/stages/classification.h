// The transfer table as the shaders read it (classification.glsl): on the GPU, corrected for the sample
// distance.
#pragma once

#include "gpu/program.h"
#include "gpu/shader_source.h"
#include "gpu/texture.h"
#include "residency/residency_manager.h"
#include "stages/recent_cache.h"
#include "stages/table_key.h"
#include "volume/transfer_function.h"

#include <memory>
#include <vector>

namespace voxsheet {

/// Texels that classification.glsl fetches, nearest entry: below, the table's n entries, above; each rgb and
/// extinction -log2(1 - opacity) (at most 4096, for opacity 1), from which opacity.glsl makes alpha = 1 -
/// 2^(-extinction e) over a stretch of e unit lengths. (A table corrected for one e and premultiplied
/// beforehand was no faster, and it would hold for cubic voxels and whole stretches only.)
[[nodiscard]] std::vector<glm::vec4> shaderTable(const TransferTable& table);

/// Multiplier and offset pairs of classification.glsl.
struct ClassificationMapping {
    glm::dvec2 mappedFromTexel{1.0, 0.0};
    glm::dvec2 entryFromMapped{1.0, 0.0};
};
[[nodiscard]] ClassificationMapping classificationMapping(const TransferTable& table, double valueScale,
                                                          double valueOffset);

class ClassificationStage {
public:
    static constexpr GLuint volumeUnit = 0;
    static constexpr GLuint tableUnit = 1;
    static constexpr GLuint integralUnit = 17;

    explicit ClassificationStage(gpu::Context& context);

    /// The defines that a program with this table and volume needs.
    /// \param filterFloats  the shader interpolates 32-bit floats itself
    /// \param categories    the shader takes the nearest sample
    [[nodiscard]] static gpu::ShaderDefines defines(const TransferTable& table, const ResidentVolume& volume,
                                                    bool filterFloats, bool categories);
    /// Binds volume and table and sets the uniforms.
    void bind(const gpu::Program& program, const std::shared_ptr<const TransferTable>& table,
              const ResidentVolume& volume);

    /// Binds the integrals of a table (preintegration.glsl).
    void bindIntegrals(const std::shared_ptr<const TransferTable>& table);

    /// Binds a table alone.
    void bindTable(const std::shared_ptr<const TransferTable>& table, GLuint unit);

private:
    gpu::Context& context_;
    using Textures = RecentCache<TableKey, gpu::Texture>;

    Textures textures_;
    Textures integrals_;
};

/// What was made of a table, or of one that is equal; nullptr: nothing yet.
template <typename Value>
Value* madeOf(RecentCache<TableKey, Value>& cache, const std::shared_ptr<const TransferTable>& table) {
    if (auto* made = cache.find([&](const TableKey& key) { return key.isSame(table); })) return made;
    const auto hash = contentHash(*table);
    return cache.find([&](const TableKey& key) { return key.hash() == hash; });
}

} // namespace voxsheet
