#include "volume/scalar_type.h"

#include <array>

namespace voxsheet {

namespace {

struct TypeRow {
    ScalarType type;
    const char* name;
    std::size_t bytes;
};

constexpr std::array<TypeRow, 10> kTypes{{
    {ScalarType::U8, "u8", 1},
    {ScalarType::I8, "i8", 1},
    {ScalarType::U16, "u16", 2},
    {ScalarType::I16, "i16", 2},
    {ScalarType::U32, "u32", 4},
    {ScalarType::I32, "i32", 4},
    {ScalarType::U64, "u64", 8},
    {ScalarType::I64, "i64", 8},
    {ScalarType::F32, "f32", 4},
    {ScalarType::F64, "f64", 8},
}};

} // namespace

std::size_t scalarBytes(ScalarType type) noexcept { return kTypes[static_cast<std::size_t>(type)].bytes; }

const char* scalarName(ScalarType type) noexcept { return kTypes[static_cast<std::size_t>(type)].name; }

std::optional<ScalarType> scalarFromName(std::string_view name) noexcept {
    for (const auto& row : kTypes)
        if (name == row.name) return row.type;
    return std::nullopt;
}

} // namespace voxsheet
