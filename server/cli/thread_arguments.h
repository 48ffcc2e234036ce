// --threads, and what every command does with it before it starts.
#pragma once

#include <memory>

namespace CLI {
class App;
}

namespace voxsheet::cli {

void addThreadArgument(CLI::App& app);

/// What --threads says, of the command or a subcommand of it; 0 where there is no such option or it was not
/// given.
[[nodiscard]] int threadsAskedFor(const CLI::App& command);

/// Settles threadCount() for the life of this object, and keeps TBB to it, too. Warns where more was asked
/// for than the process may use.
class ThreadLimit {
public:
    explicit ThreadLimit(int asked);
    ~ThreadLimit();
    ThreadLimit(const ThreadLimit&) = delete;
    ThreadLimit& operator=(const ThreadLimit&) = delete;

private:
    struct Tasks;
    std::unique_ptr<Tasks> tasks_;
};

} // namespace voxsheet::cli
