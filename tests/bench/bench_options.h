// The command line of the bench programs: --samples N --pixels N --scans FOLDER --frames N --device N --type
// u8|u16|f32
// --json --help.
#pragma once

#include "bench/volume_bench.h"

#include <optional>
#include <string>

namespace voxsheet::bench {

/// Throws InvalidInput for an unknown option or a number out of range. Nothing when help was asked for (and
/// printed).
[[nodiscard]] std::optional<VolumeBenchOptions> parseOptions(int count, char** arguments,
                                                             const std::string& usage);

/// Runs a bench's main part: prints its one JSON line, or a failure's one line on stderr. Returns the exit
/// code.
int runBenchProgram(int count, char** arguments, const std::string& usage,
                    const std::function<std::string(const VolumeBenchOptions&)>& bench);

/// Whether the case of this name was asked for (--only).
[[nodiscard]] bool isWanted(const VolumeBenchOptions& options, const std::string& name);

/// Progress, on stderr.
void tellProgress(const std::string& name);

} // namespace voxsheet::bench
