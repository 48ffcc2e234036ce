// What is dear to compute and asked for with every frame: value summaries and transfer tables.
#pragma once

#include "engine/default_look.h"
#include "volume/volume_provider.h"

#include <list>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <tuple>

namespace voxsheet::engine {

/// Thread-safe. Two threads that miss at once may both compute; the results are equal.
class LookCache {
public:
    explicit LookCache(std::shared_ptr<const VolumeProvider> volumes) : volumes_(std::move(volumes)) {}

    /// Throws as summariseField.
    [[nodiscard]] std::shared_ptr<const ValueSummary> summary(const DatasetMeta& meta, int field, int step);
    /// Throws as buildTransferTable.
    [[nodiscard]] std::shared_ptr<const TransferTable> table(const TransferFunction& function);

private:
    static constexpr std::size_t kTables = 512; ///< of 64 KiB each

    using SummaryKey = std::tuple<std::string, int, int>;
    struct Table {
        std::string key;
        std::shared_ptr<const TransferTable> table;
    };
    std::shared_ptr<const VolumeProvider> volumes_;
    std::mutex mutex_;
    std::map<SummaryKey, std::shared_ptr<const ValueSummary>> summaries_;
    std::list<Table> tables_; ///< most recent first
    std::map<std::string, std::list<Table>::iterator> tableByKey_;
};

} // namespace voxsheet::engine
