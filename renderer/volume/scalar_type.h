// Sample types of sources and store arrays.
#pragma once

#include <cstddef>
#include <optional>
#include <string_view>

namespace voxsheet {

enum class ScalarType { U8, I8, U16, I16, U32, I32, U64, I64, F32, F64 };

[[nodiscard]] std::size_t scalarBytes(ScalarType type) noexcept;
/// "u8", "i16", "f32", …, as in `info --json` and the raw sidecar.
[[nodiscard]] const char* scalarName(ScalarType type) noexcept;
[[nodiscard]] std::optional<ScalarType> scalarFromName(std::string_view name) noexcept;
[[nodiscard]] inline bool isFloat(ScalarType type) noexcept {
    return type == ScalarType::F32 || type == ScalarType::F64;
}

/// Calls `visitor.template operator()<T>()` with the C++ type of `type`.
template <typename Visitor>
decltype(auto) visitScalar(ScalarType type, Visitor&& visitor) {
    switch (type) {
    case ScalarType::U8:
        return visitor.template operator()<unsigned char>();
    case ScalarType::I8:
        return visitor.template operator()<signed char>();
    case ScalarType::U16:
        return visitor.template operator()<unsigned short>();
    case ScalarType::I16:
        return visitor.template operator()<short>();
    case ScalarType::U32:
        return visitor.template operator()<unsigned int>();
    case ScalarType::I32:
        return visitor.template operator()<int>();
    case ScalarType::U64:
        return visitor.template operator()<unsigned long>();
    case ScalarType::I64:
        return visitor.template operator()<long>();
    case ScalarType::F32:
        return visitor.template operator()<float>();
    case ScalarType::F64:
        break;
    }
    return visitor.template operator()<double>();
}

} // namespace voxsheet
