// How many threads this process may keep busy, and how many it does: the one place that everything which
// makes threads for work asks.
#pragma once

#include <filesystem>
#include <functional>
#include <string>

namespace voxsheet {

/// What is looked at; tests bring their own.
struct ProcessView {
    std::filesystem::path root = "/";                    ///< folder that /proc and /sys are read below
    std::function<const char*(const char*)> environment; ///< empty: std::getenv
};

struct ThreadCount {
    int threads = 1;    ///< >= 1
    std::string reason; ///< a phrase: "2 processors in the affinity mask"
};

/// The least of: processors in the affinity mask (which control groups' cpusets and taskset restrict), the
/// processor quota of the control groups (versions 1 and 2, those above this process's too, rounded up), and
/// what Slurm gave (SLURM_CPUS_PER_TASK, else SLURM_CPUS_ON_NODE).
[[nodiscard]] ThreadCount permittedThreads(const ProcessView& view = {});

/// \param asked  > 0: that many, but never more than permitted, and the reason says so; else all permitted
[[nodiscard]] ThreadCount chooseThreads(int asked, const ThreadCount& permitted);

/// From now on threadCount() is this. Also tells Mesa's software rasterizer, which reads its number from the
/// environment (LP_NUM_THREADS, left alone where the user has set it) when the first OpenGL context is made.
/// To be called before there are other threads: they may read the environment.
void useThreads(const ThreadCount& count);

/// What useThreads() was told; all permitted until then. Thread-safe.
[[nodiscard]] ThreadCount threadCount();

} // namespace voxsheet
