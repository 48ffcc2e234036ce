// A transfer table as the key of what was made of it: caches remember thousands of edits, and would keep each
// one's table alive.
#pragma once

#include "volume/transfer_function.h"

#include <cstdint>
#include <memory>

namespace voxsheet {

/// Of content: equal for equal tables, and only by chance (1 in 2^64) for others.
[[nodiscard]] std::uint64_t contentHash(const TransferTable& table);

class TableKey {
public:
    TableKey() = default; ///< of no table
    explicit TableKey(const std::shared_ptr<const TransferTable>& table);

    /// The very same table; false once it is gone.
    [[nodiscard]] bool isSame(const std::shared_ptr<const TransferTable>& table) const;
    [[nodiscard]] std::uint64_t hash() const { return hash_; } ///< contentHash(); 0: no table

private:
    std::weak_ptr<const TransferTable> table_;
    std::uint64_t hash_ = 0;
};

} // namespace voxsheet
