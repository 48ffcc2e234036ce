#include "cli/thread_arguments.h"

#include "base/log.h"
#include "base/thread_count.h"

#include <CLI/CLI.hpp>
#include <tbb/global_control.h>

namespace voxsheet::cli {

namespace {

constexpr const char* kOption = "--threads";

} // namespace

void addThreadArgument(CLI::App& app) {
    app.add_option(kOption,
                   "Threads that work, of drawing and imports, too (default: as many as affinity, control "
                   "groups and Slurm leave to this process; never more)")
        ->check(CLI::Range(0, 1024));
}

int threadsAskedFor(const CLI::App& command) {
    const auto* option = command.get_option_no_throw(kOption);
    if (option != nullptr && option->count() > 0) return option->as<int>();
    for (const auto* further : command.get_subcommands())
        if (const int asked = threadsAskedFor(*further)) return asked;
    return 0;
}

struct ThreadLimit::Tasks {
    explicit Tasks(int threads)
        : control(tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(threads)) {}
    tbb::global_control control;
};

ThreadLimit::ThreadLimit(int asked) {
    const auto count = chooseThreads(asked, permittedThreads());
    if (asked > count.threads)
        logWarning("threads: " + std::to_string(count.threads) + ", not " + std::to_string(asked) + ": " +
                   count.reason);
    useThreads(count);
    tasks_ = std::make_unique<Tasks>(count.threads);
}

ThreadLimit::~ThreadLimit() = default;

} // namespace voxsheet::cli
