#include "base/log.h"

#include <cstdio>
#include <mutex>
#include <utility>

namespace voxsheet {

namespace {

struct SinkSlot {
    std::mutex mutex;
    LogSink sink;
};

SinkSlot& sinkSlot() {
    static SinkSlot slot;
    return slot;
}

} // namespace

void setLogSink(LogSink sink) {
    auto& slot = sinkSlot();
    const std::lock_guard lock(slot.mutex);
    slot.sink = std::move(sink);
}

void logMessage(LogLevel level, std::string_view message) {
    auto& slot = sinkSlot();
    const std::lock_guard lock(slot.mutex);
    if (slot.sink) {
        slot.sink(level, message);
        return;
    }
    if (level == LogLevel::Debug) return;
    std::fprintf(stderr, "%.*s\n", static_cast<int>(message.size()), message.data());
}

} // namespace voxsheet
