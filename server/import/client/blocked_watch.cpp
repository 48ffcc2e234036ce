#include "import/client/blocked_watch.h"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <string>

namespace voxsheet::import {

namespace {

/// A watcher that was itself held up for longer (stopped, starved) does not know what it missed.
constexpr double kLongestInterval = 0.25;

/// The state's letter; 'R' if it cannot be read. The name before it is in parentheses and may hold any byte.
char threadState(const std::filesystem::path& statFile) {
    std::ifstream in(statFile);
    std::string text;
    std::getline(in, text, '\0');
    const auto end = text.rfind(") ");
    return end == std::string::npos || end + 2 >= text.size() ? 'R' : text[end + 2];
}

} // namespace

ProcessRest restOf(pid_t process) {
    std::error_code error;
    auto rest = ProcessRest::Active;
    std::filesystem::directory_iterator thread("/proc/" + std::to_string(process) + "/task", error);
    for (; !error && thread != std::filesystem::directory_iterator(); thread.increment(error)) {
        switch (threadState(thread->path() / "stat")) {
        case 'S':
        case 'T':
            if (rest == ProcessRest::Active) rest = ProcessRest::Asleep;
            break;
        case 'D':
            rest = ProcessRest::OnDisk;
            break;
        default:
            return ProcessRest::Active;
        }
    }
    return error ? ProcessRest::Active : rest;
}

void BlockedWatch::observe(Clock::time_point now, double cpuSeconds, ProcessRest rest) {
    const bool idle =
        rest == ProcessRest::Asleep && lastRest_ == ProcessRest::Asleep && cpuSeconds == lastCpuSeconds_;
    const double seconds = std::chrono::duration<double>(now - lastTime_).count();
    secondsAsleep_ = idle ? secondsAsleep_ + std::min(seconds, kLongestInterval) : 0.0;
    lastTime_ = now;
    lastCpuSeconds_ = cpuSeconds;
    lastRest_ = rest;
}

} // namespace voxsheet::import
