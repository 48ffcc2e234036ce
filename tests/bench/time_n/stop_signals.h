// SIGINT and SIGTERM end a bench in good order, so that it removes its files.
#pragma once

namespace voxsheet::bench {

/// While it lives, the signals are taken down instead of ending the program.
class StopSignals {
public:
    StopSignals();
    ~StopSignals();
    StopSignals(const StopSignals&) = delete;
    StopSignals& operator=(const StopSignals&) = delete;
};

/// Whether a signal came since the last StopSignals began.
[[nodiscard]] bool stopRequested();
/// Throws Cancelled if one came.
void throwIfStopRequested();

} // namespace voxsheet::bench
