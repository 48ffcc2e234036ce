#include "cli/exit_codes.h"

#include "base/errors.h"

#include <algorithm>
#include <cstdio>
#include <new>

namespace voxsheet::cli {

int reportFailure(const std::string& text) {
    std::string line = text;
    std::replace(line.begin(), line.end(), '\n', ' ');
    std::fprintf(stderr, "voxsheet: error: %s\n", line.c_str());
    return kExitFailed;
}

int reportFailure(const std::exception& error) {
    if (const auto* known = dynamic_cast<const Error*>(&error)) {
        const int code = reportFailure(std::string(error.what()));
        return known->field().rfind("--", 0) == 0 ? kExitUsage : code;
    }
    if (dynamic_cast<const std::bad_alloc*>(&error) != nullptr)
        return reportFailure(
            std::string("memory: there is not enough of it; close other programs or load fewer datasets"));
    return reportFailure(std::string("voxsheet: ") + error.what() +
                         "; this is a fault of the program, please report it");
}

} // namespace voxsheet::cli
