// The transfer table as the shaders read it (classification.glsl): on the GPU, corrected for the sample
// distance.
#pragma once

#include "gpu/program.h"
#include "gpu/shader_source.h"
#include "gpu/texture.h"
#include "residency/residency_manager.h"
#include "stages/recent_cache.h"
#include "volume/transfer_function.h"

#include <memory>
#include <optional>

namespace voxsheet {

/// Texels that classification.glsl fetches, nearest entry: below, the table's n entries, above.
/// With an exponent e = (distance of samples) / unitLength, the same for every ray: rgb * alpha and alpha =
/// 1 - (1 - opacity)^e, so that a sample costs one fetch and one blend. Without: rgb and extinction -log2(1 -
/// opacity) (at most 4096, for opacity 1), from which opacity.glsl makes alpha = 1 - 2^(-extinction e) for
/// the ray's own e.
[[nodiscard]] std::vector<glm::vec4> shaderTable(const TransferTable& table, std::optional<double> exponent);

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

    explicit ClassificationStage(gpu::Context& context);

    /// The defines that a program with this table and volume needs.
    [[nodiscard]] static gpu::ShaderDefines defines(const TransferTable& table, const ResidentVolume& volume);
    /// Binds volume and table and sets the uniforms.
    void bind(const gpu::Program& program, const std::shared_ptr<const TransferTable>& table,
              std::optional<double> exponent, const ResidentVolume& volume);

private:
    struct Key {
        std::shared_ptr<const TransferTable> table;
        std::optional<double> exponent;
    };
    gpu::Context& context_;
    RecentCache<Key, gpu::Texture> textures_;
};

} // namespace voxsheet
