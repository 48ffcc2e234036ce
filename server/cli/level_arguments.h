// --dr and --dr-limit: how levels of detail are chosen.
#pragma once

#include "resolution/level_policy.h"

#include <string>

namespace CLI {
class App;
}

namespace voxsheet::cli {

struct LevelArguments {
    std::string policy = "focus";
    std::string limit; ///< empty: the policy's default
};

void addLevelArguments(CLI::App& app, LevelArguments& arguments);

/// Throws InvalidInput (field --dr or --dr-limit).
[[nodiscard]] LevelSettings levelSettings(const LevelArguments& arguments);

} // namespace voxsheet::cli
