// How far a dataset is, and what went wrong.
#pragma once

#include "base/errors.h"

#include <string>

namespace voxsheet::engine {

enum class DatasetState { Queued, Importing, Ready, Failed };

/// A failure kept as a value: shown in the cell, in the API and on the command line.
struct Failure {
    ErrorKind kind = ErrorKind::Internal;
    std::string message;
};

} // namespace voxsheet::engine
