// The one place where failures become exit codes and a line on stderr.
#pragma once

#include <exception>
#include <string>

namespace voxsheet::cli {

inline constexpr int kExitDone = 0;
inline constexpr int kExitFailed = 1;
inline constexpr int kExitUsage = 2;

/// Prints `voxsheet: error: WHAT: WHY; WHAT TO DO` and gives the exit code: kExitUsage if an option is at
/// fault (Error::field() is its name).
int reportFailure(const std::exception& error);
/// The same for a text; always kExitFailed.
int reportFailure(const std::string& text);
/// Prints `voxsheet: warning: TEXT` on stderr.
void reportWarning(const std::string& text);

} // namespace voxsheet::cli
