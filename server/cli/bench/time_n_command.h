// `voxsheet bench time-n`.
#pragma once

#include "cli/commands.h"

namespace voxsheet::cli {

Action addTimeN(CLI::App& app);

} // namespace voxsheet::cli
