// Splits a loop over the threads that this process may use, plain ones: renderer/ builds without TBB.
#pragma once

#include <functional>

namespace voxsheet {

/// Calls body(begin, end) on disjoint ranges of at most `grain` indices that together cover [0, count), on up
/// to threadCount() threads, and returns when all are done. The body must be safe to call from several
/// threads. The first exception of a body is thrown again here, once the others have stopped. grain < 1
/// counts as 1.
void parallelFor(long count, long grain, const std::function<void(long begin, long end)>& body);

} // namespace voxsheet
