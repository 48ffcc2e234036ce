// The subcommands of `voxsheet`. Each adds its options to the parser and returns what to run when it was
// chosen.
#pragma once

#include <functional>

namespace CLI {
class App;
}

namespace voxsheet::cli {

/// Runs the command; returns the exit code. Throws the error family.
using Action = std::function<int()>;

Action addServe(CLI::App& app);
Action addRender(CLI::App& app);
Action addInfo(CLI::App& app);
Action addDemo(CLI::App& app);
Action addBench(CLI::App& app);

/// The whole program: parses, runs, maps failures to exit codes (exit_codes.h).
int runProgram(int argc, char** argv);

} // namespace voxsheet::cli
