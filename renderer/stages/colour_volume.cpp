#include "stages/colour_volume.h"

#include <string>

namespace voxsheet {

gpu::ShaderDefines ColourVolumeStage::defines(const std::optional<ColourVolume>& spec,
                                              const ResidentVolume* colours, bool filterFloats) {
    if (colours == nullptr) return {{"COLOUR_VOLUME", "0"}};
    const bool filter = filterFloats && colours->texture->internalFormat() == GL_R32F;
    return {{"COLOUR_VOLUME", "1"},
            {"COLOUR_SCALE", std::to_string(static_cast<int>(spec->transfer->scale))},
            {"COLOUR_FILTER", filter ? "1" : "0"}};
}

void ColourVolumeStage::bind(const gpu::Program& program, const std::optional<ColourVolume>& spec,
                             const Grid& grid, const ResidentVolume* colours,
                             ClassificationStage& classification) {
    if (colours == nullptr) return;
    const auto& other = colours->meta->grid;
    colours->texture->bind(volumeUnit);
    classification.bindTable(spec->transfer, tableUnit);
    const auto mapping = classificationMapping(*spec->transfer, colours->valueScale, colours->valueOffset);
    const auto box = boxIndex(other);
    program.set("colourFromTexture",
                glm::mat4(glm::inverse(worldFromTexture(other)) * worldFromTexture(grid)));
    program.set("colourBoxLow", glm::vec3((box.low + 0.5) / glm::dvec3(other.dims)));
    program.set("colourBoxHigh", glm::vec3((box.high + 0.5) / glm::dvec3(other.dims)));
    program.set("colourMappedFromTexel", glm::vec2(mapping.mappedFromTexel));
    program.set("colourEntryFromMapped", glm::vec2(mapping.entryFromMapped));
    program.set("colourLastEntry", static_cast<float>(spec->transfer->entries.size() + 1));
    program.set("colourPeriodic", glm::vec3(other.periodic));
}

} // namespace voxsheet
