// What the C library keeps of freed memory for later.
#pragma once

namespace voxsheet {

/// To be called once, at the start: arrays of volumes go back to the system when they are freed. Left to
/// itself, glibc keeps blocks of up to 32 MiB once it has seen one freed, in an arena for each of many
/// threads. Nothing with other libraries.
void keepNoLargeBlocks();

/// After work that took much: pages that hold nothing any more go back to the system. Takes milliseconds, in
/// which other threads may wait for memory.
void giveFreePagesBack();

} // namespace voxsheet
