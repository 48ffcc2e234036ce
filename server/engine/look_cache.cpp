#include "engine/look_cache.h"

#include "engine/sample_reader.h"

namespace voxsheet::engine {

namespace {

/// Every number of the function, bit by bit.
std::string keyOf(const TransferFunction& function) {
    std::string key;
    const auto add = [&key](double value) {
        key.append(reinterpret_cast<const char*>(&value), sizeof(value));
    };
    const auto addVector = [&add](const glm::dvec4& v) {
        for (int i = 0; i < 4; ++i)
            add(v[i]);
    };
    add(static_cast<double>(function.shape));
    add(static_cast<double>(function.colours.size()));
    for (const ColourPoint& point : function.colours)
        addVector({point.position, point.rgb});
    for (const OpacityPoint& point : function.opacities) {
        add(point.position);
        add(point.opacity);
    }
    for (const double value : {function.cut1, function.cut2, function.low, function.high,
                               function.symLogThreshold, static_cast<double>(function.scale),
                               function.hasBelow ? 1.0 : 0.0, function.hasAbove ? 1.0 : 0.0}) {
        add(value);
    }
    addVector(function.below);
    addVector(function.above);
    addVector(function.nan);
    return key;
}

} // namespace

std::shared_ptr<const ValueSummary> LookCache::summary(const DatasetMeta& meta, int field, int step) {
    const SummaryKey key{meta.key, field, step};
    {
        const std::lock_guard lock(mutex_);
        if (const auto found = summaries_.find(key); found != summaries_.end()) return found->second;
    }
    auto made = std::make_shared<const ValueSummary>(summariseField(*volumes_, meta, field, step));
    const std::lock_guard lock(mutex_);
    return summaries_.try_emplace(key, std::move(made)).first->second;
}

ResolvedTransfer LookCache::transfer(const sheet::ResolvedStyle& resolved, const ColourMapTable& maps,
                                     const std::shared_ptr<const ValueSummary>& summary,
                                     double boxPathUnitLengths) {
    const auto& style = resolved.style;
    TransferKey key{summary, boxPathUnitLengths, style.technique == sheet::Technique::Mip, style.range,
                    style.transfer};
    {
        const std::lock_guard lock(mutex_);
        if (const auto* found = transfers_.find([&](const TransferKey& other) { return other == key; }))
            return *found;
    }
    auto made = resolveTransfer(resolved, maps, *summary, boxPathUnitLengths);
    const std::lock_guard lock(mutex_);
    return transfers_.insert(std::move(key), std::move(made));
}

std::shared_ptr<const TransferTable> LookCache::table(const TransferFunction& function) {
    const std::string key = keyOf(function);
    {
        const std::lock_guard lock(mutex_);
        if (const auto found = tableByKey_.find(key); found != tableByKey_.end()) {
            tables_.splice(tables_.begin(), tables_, found->second);
            return found->second->table;
        }
    }
    auto made = buildTransferTable(function);
    const std::lock_guard lock(mutex_);
    if (tableByKey_.count(key) == 0) {
        tables_.push_front({key, made});
        tableByKey_[key] = tables_.begin();
        if (tables_.size() > kTables) {
            tableByKey_.erase(tables_.back().key);
            tables_.pop_back();
        }
    }
    return made;
}

} // namespace voxsheet::engine
