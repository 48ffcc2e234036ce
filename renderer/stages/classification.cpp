#include "stages/classification.h"

#include "stages/preintegration.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>

namespace voxsheet {
namespace {

constexpr std::size_t kCachedTables = 256; ///< of 64 KiB each: one for each of many cells
constexpr double kMaxExtinction = 4096.0;

glm::vec4 shaderEntry(const glm::vec4& entry) {
    const double opacity = entry.w;
    const double extinction = opacity < 1.0 ? -std::log1p(-opacity) / std::numbers::ln2 : kMaxExtinction;
    return {glm::vec3(entry), static_cast<float>(std::min(extinction, kMaxExtinction))};
}

} // namespace

std::vector<glm::vec4> shaderTable(const TransferTable& table) {
    std::vector<glm::vec4> texels;
    texels.reserve(table.entries.size() + 2);
    texels.push_back(shaderEntry(table.below));
    for (const auto& entry : table.entries)
        texels.push_back(shaderEntry(entry));
    texels.push_back(shaderEntry(table.above));
    return texels;
}

ClassificationMapping classificationMapping(const TransferTable& table, double valueScale,
                                            double valueOffset) {
    const double steps = static_cast<double>(table.entries.size() - 1);
    constexpr double firstEntry = 1.5; // entry 0 is `below`; half an entry rounds to nearest
    ClassificationMapping mapping;
    switch (table.scale) {
    case ValueScale::Linear: {
        const double range = table.high - table.low;
        mapping.mappedFromTexel = {valueScale / range, (valueOffset - table.low) / range};
        mapping.entryFromMapped = {steps, firstEntry};
        break;
    }
    case ValueScale::Log: // in units of the low end, so that every range fits a float
        mapping.mappedFromTexel = {valueScale / table.low, valueOffset / table.low};
        mapping.entryFromMapped = {steps / std::log2(table.high / table.low), firstEntry};
        break;
    case ValueScale::SymLog: {
        mapping.mappedFromTexel = {valueScale / table.symLogThreshold, valueOffset / table.symLogThreshold};
        const double atZero = tablePosition(table, 0.0);
        const double perUnit = tablePosition(table, table.symLogThreshold) - atZero;
        mapping.entryFromMapped = {steps * perUnit, steps * atZero + firstEntry};
        break;
    }
    }
    return mapping;
}

ClassificationStage::ClassificationStage(gpu::Context& context)
    : context_(context), textures_(kCachedTables), integrals_(kCachedTables) {}

gpu::ShaderDefines ClassificationStage::defines(const TransferTable& table, const ResidentVolume& volume,
                                                bool filterFloats, bool categories) {
    const auto format = volume.texture->internalFormat();
    const bool isFloat = format == GL_R32F || format == GL_R16F;
    const char* filter = categories ? "2" : filterFloats && format == GL_R32F ? "1" : "0";
    return {{"VALUE_SCALE", std::to_string(static_cast<int>(table.scale))},
            {"MAY_BE_NAN", isFloat ? "1" : "0"},
            {"SHADER_FILTER", filter}};
}

namespace {

/// A table as a texture, made when it is new.
template <typename Cache, typename MakeTexels>
const gpu::Texture& tableTexture(Cache& cache, gpu::Context& context,
                                 const std::shared_ptr<const TransferTable>& table, MakeTexels makeTexels) {
    if (const auto* texture = madeOf(cache, table)) return *texture;
    const std::vector<glm::vec4> texels = makeTexels(*table);
    const glm::ivec3 size(static_cast<int>(texels.size()), 1, 1);
    gpu::Texture fresh(context, GL_TEXTURE_1D, GL_RGBA32F, size);
    fresh.upload(glm::ivec3(0), size, GL_RGBA, GL_FLOAT, std::as_bytes(std::span(texels)));
    return cache.insert(TableKey(table), std::move(fresh));
}

} // namespace

void ClassificationStage::bindTable(const std::shared_ptr<const TransferTable>& table, GLuint unit) {
    tableTexture(textures_, context_, table, shaderTable).bind(unit);
}

void ClassificationStage::bindIntegrals(const std::shared_ptr<const TransferTable>& table) {
    tableTexture(integrals_, context_, table, integralTable).bind(integralUnit);
}

void ClassificationStage::bind(const gpu::Program& program, const std::shared_ptr<const TransferTable>& table,
                               const ResidentVolume& volume) {
    volume.texture->bind(volumeUnit);
    bindTable(table, tableUnit);
    program.set("filterPeriodic", glm::vec3(volume.meta->grid.periodic));
    const auto mapping = classificationMapping(*table, volume.valueScale, volume.valueOffset);
    program.set("mappedFromTexel", glm::vec2(mapping.mappedFromTexel));
    program.set("entryFromMapped", glm::vec2(mapping.entryFromMapped));
    program.set("lastEntry", static_cast<float>(table->entries.size() + 1));
}

} // namespace voxsheet
