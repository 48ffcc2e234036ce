#include "stages/table_key.h"

#include <functional>
#include <string_view>

namespace voxsheet {
namespace {

template <typename T>
std::uint64_t hashOf(const T* items, std::size_t count) {
    static_assert(sizeof(std::size_t) == sizeof(std::uint64_t));
    return std::hash<std::string_view>{}({reinterpret_cast<const char*>(items), count * sizeof(T)});
}

} // namespace

std::uint64_t contentHash(const TransferTable& table) {
    std::uint64_t hash = hashOf(table.entries.data(), table.entries.size());
    const auto add = [&](std::uint64_t more) { hash = hash * 0x9E3779B97F4A7C15U + more; };
    const double numbers[] = {table.low, table.high, table.symLogThreshold, static_cast<double>(table.scale)};
    add(hashOf(numbers, std::size(numbers)));
    for (const auto& colour : {table.below, table.above, table.nan})
        add(hashOf(&colour, 1));
    return hash;
}

TableKey::TableKey(const std::shared_ptr<const TransferTable>& table)
    : table_(table), hash_(table ? contentHash(*table) : 0) {}

bool TableKey::isSame(const std::shared_ptr<const TransferTable>& table) const {
    return table && !table_.owner_before(table) && !table.owner_before(table_);
}

} // namespace voxsheet
