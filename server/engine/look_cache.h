// What is dear to compute and asked for with every frame: value summaries, transfer functions and tables.
#pragma once

#include "engine/cell_resolver.h"
#include "engine/default_look.h"
#include "stages/recent_cache.h"
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
    /// As resolveTransfer, and throws as it; `maps` is the same table with every call.
    [[nodiscard]] ResolvedTransfer transfer(const sheet::ResolvedStyle& resolved, const ColourMapTable& maps,
                                            const std::shared_ptr<const ValueSummary>& summary,
                                            double boxPathUnitLengths);
    /// Throws as buildTransferTable.
    [[nodiscard]] std::shared_ptr<const TransferTable> table(const TransferFunction& function);

private:
    static constexpr std::size_t kTables = 256; ///< of 64 KiB each

    using SummaryKey = std::tuple<std::string, int, int>;
    /// All that resolveTransfer looks at.
    struct TransferKey {
        std::shared_ptr<const ValueSummary> summary;
        double boxPathUnitLengths = 0.0;
        bool projects = false; ///< technique mip
        sheet::RangeStyle range;
        sheet::TransferStyle transfer;
        bool operator==(const TransferKey&) const = default;
    };
    struct Table {
        std::string key;
        std::shared_ptr<const TransferTable> table;
    };
    std::shared_ptr<const VolumeProvider> volumes_;
    std::mutex mutex_;
    std::map<SummaryKey, std::shared_ptr<const ValueSummary>> summaries_;
    RecentCache<TransferKey, ResolvedTransfer> transfers_{kTables};
    std::list<Table> tables_; ///< most recent first
    std::map<std::string, std::list<Table>::iterator> tableByKey_;
};

} // namespace voxsheet::engine
