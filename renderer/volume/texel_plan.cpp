#include "volume/texel_plan.h"

#include <algorithm>

namespace voxsheet {

TexelPlan planTexels(const VolumeProvider& provider, const VolumeKey& key, bool exactR8Filtering,
                     FloatTexels floatTexels) {
    TexelPlan plan;
    plan.meta = provider.describe(key.dataset);
    validateVolumeKey(*plan.meta, key);
    const FieldMeta& field = plan.meta->fields[static_cast<std::size_t>(key.field)];
    const ValueStatistics& values = field.steps[static_cast<std::size_t>(key.step)].statistics;
    plan.type = levelType(field.storedType, key.level);
    plan.dims = levelDims(plan.meta->grid.dims, key.level);

    // Statistics are in values; a negative slope swaps the ends.
    const double atMin = (values.min - field.valueOffset) / field.valueScale;
    const double atMax = (values.max - field.valueOffset) / field.valueScale;
    plan.encoding = chooseTextureEncoding(plan.type, std::min(atMin, atMax), std::max(atMin, atMax),
                                          exactR8Filtering, floatTexels);
    plan.valueScale = field.valueScale * plan.encoding.storedScale;
    plan.valueOffset = field.valueScale * plan.encoding.storedOffset + field.valueOffset;
    return plan;
}

} // namespace voxsheet
