#include "import/formats/bit_mask.h"

#include "base/errors.h"

#include <algorithm>
#include <cstring>
#include <sstream>
#include <type_traits>

namespace voxsheet::import {

namespace {

std::string hexadecimal(std::uint64_t mask) {
    std::ostringstream out;
    out << "0x" << std::hex << mask;
    return out.str();
}

[[noreturn]] void refuse(std::uint64_t mask, const std::string& why, const std::string& toDo) {
    throw InvalidInput("import option bit_mask " + hexadecimal(mask), why, toDo)
        .withField("options.bit_mask");
}

} // namespace

void checkBitMask(DatasetMeta& meta, std::uint64_t mask) {
    const auto isWhole = [](const FieldMeta& field) { return !isFloat(field.storedType); };
    if (std::none_of(meta.fields.begin(), meta.fields.end(), isWhole))
        refuse(mask, "the file has no whole numbers, only floats", "leave it out");
    for (const auto& field : meta.fields) {
        const auto bits = 8 * scalarBytes(field.storedType);
        if (isWhole(field) && bits < 64 && (mask & ((std::uint64_t{1} << bits) - 1)) == 0)
            refuse(mask, std::string("it leaves nothing of values of ") + scalarName(field.storedType),
                   "name some of their " + std::to_string(bits) + " lowest bits");
    }
    meta.notes.push_back("Only the bits " + hexadecimal(mask) + " of each stored number are kept.");
}

void keepBits(std::span<std::byte> voxels, ScalarType type, std::uint64_t mask) {
    visitScalar(type, [&]<typename T>() {
        if constexpr (std::is_integral_v<T>) {
            using Bits = std::make_unsigned_t<T>;
            const auto kept = static_cast<Bits>(mask);
            for (std::size_t at = 0; at + sizeof(T) <= voxels.size(); at += sizeof(T)) {
                Bits value{};
                std::memcpy(&value, voxels.data() + at, sizeof(T));
                value = static_cast<Bits>(value & kept);
                std::memcpy(voxels.data() + at, &value, sizeof(T));
            }
        }
    });
}

} // namespace voxsheet::import
