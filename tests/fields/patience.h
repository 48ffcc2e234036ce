// Bounds on time for tests that run beside other work.
#pragma once

#include <algorithm>
#include <fstream>
#include <string>
#include <thread>

namespace voxsheet::fields {

/// 1 on a machine that is idle but for the test; else about how many times longer everything takes: threads
/// that run or wait for a processor, for each processor (proc(5), loadavg; the mean of the last minute and
/// the present). What users are promised is tested on an idle machine to the letter, and on a busy one in
/// proportion.
inline double patience() {
    std::ifstream file("/proc/loadavg");
    double lastMinute = 0.0;
    double ignored = 0.0;
    std::string runnable; // "7/512"
    if (!(file >> lastMinute >> ignored >> ignored >> runnable)) return 1.0;
    const double threads = std::max(lastMinute, std::stod(runnable)) + 1.0;
    return std::max(1.0, threads / std::max(1U, std::thread::hardware_concurrency()));
}

} // namespace voxsheet::fields
