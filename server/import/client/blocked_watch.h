// Telling a reader that is blocked (in a pipe, a lock, a stopped state) from one that is slow.
#pragma once

#include <chrono>
#include <sys/types.h>

namespace voxsheet::import {

/// What the threads of a process are doing.
enum class ProcessRest {
    Active, ///< one of them runs or waits for a processor; also: not known
    OnDisk, ///< none runs, one is in an uninterruptible wait: a disk or network file system has to answer
    Asleep, ///< all sleep or are stopped
};

/// From /proc/ID/task/*/stat (proc(5), field 3).
[[nodiscard]] ProcessRest restOf(pid_t process);

/// How long a process has done nothing at all. Processor time tells: it is counted in nanoseconds, and every
/// system call that comes back has used some. A reader that is starved by a busy machine is Active, one whose
/// disk is slow is OnDisk, so that neither adds to the time asleep.
class BlockedWatch {
public:
    using Clock = std::chrono::steady_clock;

    /// To be told a few times a second. The time since the last call counts as asleep if the process was
    /// asleep at both ends and has used no processor time in between; at most a quarter of a second of it.
    void observe(Clock::time_point now, double cpuSeconds, ProcessRest rest);

    [[nodiscard]] double secondsAsleep() const { return secondsAsleep_; }

private:
    Clock::time_point lastTime_{};
    double lastCpuSeconds_ = -1.0;
    ProcessRest lastRest_ = ProcessRest::Active;
    double secondsAsleep_ = 0.0;
};

} // namespace voxsheet::import
