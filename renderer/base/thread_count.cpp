#include "base/thread_count.h"

#include "base/control_group.h"

#include <sched.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <mutex>
#include <optional>
#include <string_view>
#include <thread>

namespace voxsheet {

namespace {

std::string processorsText(double processors) {
    char text[32];
    std::snprintf(text, sizeof text, "%g", std::round(processors * 100.0) / 100.0);
    return std::string(text) + (processors == 1.0 ? " processor" : " processors");
}

int affinityProcessors() {
    // Larger masks than the caller's fail: there are machines with more than the usual 1024 processors.
    for (int processors = CPU_SETSIZE; processors <= 1 << 18; processors *= 2) {
        cpu_set_t* set = CPU_ALLOC(static_cast<std::size_t>(processors));
        if (set == nullptr) break;
        const auto bytes = CPU_ALLOC_SIZE(static_cast<std::size_t>(processors));
        const bool known = sched_getaffinity(0, bytes, set) == 0;
        const int count = known ? CPU_COUNT_S(bytes, set) : 0;
        CPU_FREE(set);
        if (known) return std::max(count, 1);
    }
    return static_cast<int>(std::max(std::thread::hardware_concurrency(), 1U));
}

/// Processors that one group may keep busy on average; nullopt: no limit, or none stated.
std::optional<double> unifiedQuota(const std::filesystem::path& folder) {
    std::ifstream in(folder / "cpu.max"); // "max 100000" where there is no limit
    double quota = 0.0;
    double period = 0.0;
    if (!(in >> quota >> period) || quota <= 0.0 || period <= 0.0) return std::nullopt;
    return quota / period;
}

std::optional<double> controllerQuota(const std::filesystem::path& folder) {
    std::ifstream quotaFile(folder / "cpu.cfs_quota_us"); // -1 where there is no limit
    std::ifstream periodFile(folder / "cpu.cfs_period_us");
    double quota = 0.0;
    double period = 0.0;
    if (!(quotaFile >> quota) || !(periodFile >> period) || quota <= 0.0 || period <= 0.0)
        return std::nullopt;
    return quota / period;
}

std::optional<double> quotaProcessors(const std::filesystem::path& root) {
    const auto groups = controlGroups("cpu", root);
    std::optional<double> least;
    const auto consider = [&](const std::optional<double>& quota) {
        if (quota && (!least || *quota < *least)) least = quota;
    };
    for (const auto& folder : groups.unified)
        consider(unifiedQuota(folder));
    for (const auto& folder : groups.controller)
        consider(controllerQuota(folder));
    return least;
}

std::optional<int> positiveNumber(const char* text) {
    if (text == nullptr) return std::nullopt;
    const std::string_view all(text);
    int number = 0;
    const auto [end, error] = std::from_chars(all.data(), all.data() + all.size(), number);
    if (error != std::errc() || end != all.data() + all.size() || number < 1) return std::nullopt;
    return number;
}

std::optional<ThreadCount> slurmThreads(const ProcessView& view) {
    for (const char* name : {"SLURM_CPUS_PER_TASK", "SLURM_CPUS_ON_NODE"}) {
        const char* text = view.environment ? view.environment(name) : std::getenv(name);
        if (const auto number = positiveNumber(text))
            return ThreadCount{*number, std::string(name) + "=" + std::to_string(*number)};
    }
    return std::nullopt;
}

std::mutex& countMutex() {
    static std::mutex mutex;
    return mutex;
}

std::optional<ThreadCount>& countInUse() {
    static std::optional<ThreadCount> count;
    return count;
}

} // namespace

ThreadCount permittedThreads(const ProcessView& view) {
    const int affinity = affinityProcessors();
    ThreadCount least{affinity, processorsText(affinity) + " in the affinity mask"};
    if (const auto quota = quotaProcessors(view.root)) {
        // Rounded up: 1.5 processors keep two threads busy most of the time.
        const int threads = static_cast<int>(std::min(std::ceil(*quota - 1e-9), 1e6));
        if (threads < least.threads)
            least = {std::max(threads, 1), "the control group's quota of " + processorsText(*quota)};
    }
    if (const auto slurm = slurmThreads(view); slurm && slurm->threads < least.threads) least = *slurm;
    return least;
}

ThreadCount chooseThreads(int asked, const ThreadCount& permitted) {
    if (asked <= 0) return permitted;
    const auto option = "--threads " + std::to_string(asked);
    if (asked <= permitted.threads) return {asked, option};
    return {permitted.threads, permitted.reason + "; " + option + " is more than that"};
}

void useThreads(const ThreadCount& count) {
    // As Mesa's own default: one thread alone draws where it is called.
    setenv("LP_NUM_THREADS", std::to_string(count.threads > 1 ? count.threads : 0).c_str(), 0);
    const std::lock_guard lock(countMutex());
    countInUse() = count;
}

ThreadCount threadCount() {
    const std::lock_guard lock(countMutex());
    if (!countInUse()) countInUse() = permittedThreads();
    return *countInUse();
}

} // namespace voxsheet
