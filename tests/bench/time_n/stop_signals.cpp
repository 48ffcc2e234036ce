#include "bench/time_n/stop_signals.h"

#include "base/errors.h"

#include <csignal>

namespace voxsheet::bench {

namespace {

volatile std::sig_atomic_t stop = 0;

void noteSignal(int) { stop = 1; }

} // namespace

StopSignals::StopSignals() {
    stop = 0;
    std::signal(SIGINT, noteSignal);
    std::signal(SIGTERM, noteSignal);
}

StopSignals::~StopSignals() {
    std::signal(SIGINT, SIG_DFL);
    std::signal(SIGTERM, SIG_DFL);
}

bool stopRequested() { return stop != 0; }

void throwIfStopRequested() {
    if (stopRequested()) throw Cancelled("the bench", "it was interrupted");
}

} // namespace voxsheet::bench
