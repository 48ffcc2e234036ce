#include "stages/crystal_spec.h"

#include "base/errors.h"

namespace voxsheet {

void validateCrystal(const CrystalSpec& crystal) {
    if (!(crystal.radiusScale > 0.0 && crystal.radiusScale <= 4.0))
        throw InvalidInput("crystal.radius", "it is outside (0, 4]").withField("crystal.radius");
}

} // namespace voxsheet
