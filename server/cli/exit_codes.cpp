#include "cli/exit_codes.h"

#include "base/errors.h"

#include <algorithm>
#include <cstdio>
#include <new>

namespace voxsheet::cli {

namespace {

void printLine(const char* kind, std::string text) {
    std::replace(text.begin(), text.end(), '\n', ' ');
    std::fprintf(stderr, "voxsheet: %s: %s\n", kind, text.c_str());
}

} // namespace

void reportWarning(const std::string& text) { printLine("warning", text); }

int reportFailure(const std::string& text) {
    printLine("error", text);
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
