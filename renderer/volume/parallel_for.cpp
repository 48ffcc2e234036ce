#include "volume/parallel_for.h"

#include "base/thread_count.h"
#include "volume/shared_loop.h"

#include <algorithm>
#include <system_error>
#include <thread>
#include <vector>

namespace voxsheet {

void parallelFor(long count, long grain, const std::function<void(long, long)>& body) {
    if (count <= 0) return;
    grain = std::max(grain, 1L);
    const long chunks = (count + grain - 1) / grain;
    const long threads = threadCount().threads;
    SharedLoop loop(count, grain, body);
    std::vector<std::jthread> helpers;
    try {
        for (long i = 1; i < std::min(threads, chunks); ++i)
            helpers.emplace_back([&loop] { loop.work(); });
    } catch (const std::system_error&) {
        // The process may start no more threads: this one does the rest alone.
    }
    loop.work();
    helpers.clear();
    loop.rethrow();
}

} // namespace voxsheet
