#include "volume/dataset.h"

namespace voxsheet {

ScalarType pyramidType(ScalarType storedType) noexcept {
    switch (storedType) {
    case ScalarType::U8:
    case ScalarType::I8:
    case ScalarType::U16:
    case ScalarType::I16:
        return storedType;
    default:
        return ScalarType::F32;
    }
}

ScalarType levelType(ScalarType storedType, int level) noexcept {
    return level == 0 ? storedType : pyramidType(storedType);
}

} // namespace voxsheet
