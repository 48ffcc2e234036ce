// One child process with its standard output as a stream of lines.
#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <sys/types.h>
#include <vector>

namespace voxsheet::import {

/// The destructor kills the child and waits for it: none outlives its owner.
class ChildProcess {
public:
    /// Starts `executable` with standard input empty, all other descriptors of this process closed in it,
    /// signals at their defaults. Throws IoError.
    ChildProcess(const std::filesystem::path& executable, const std::vector<std::string>& arguments);
    ~ChildProcess();
    ChildProcess(const ChildProcess&) = delete;
    ChildProcess& operator=(const ChildProcess&) = delete;

    [[nodiscard]] pid_t id() const { return id_; }

    /// Waits at most `wait` for output; whole lines are then taken by takeLine. Returns false at the end of
    /// output. Throws LimitExceeded if a line grows beyond 64 MiB.
    bool pump(std::chrono::milliseconds wait);
    [[nodiscard]] std::optional<std::string> takeLine();

    /// The end of what the child wrote to standard error, for the log.
    [[nodiscard]] const std::string& errorTail() const { return errorTail_; }

    /// Processor time used so far, seconds; 0 when the child has ended.
    [[nodiscard]] double cpuSeconds() const;

    void kill() const;
    /// Waits for the end, killing the child after `grace`. Status as of waitpid.
    int wait(std::chrono::milliseconds grace);
    /// Largest resident memory of the child, known after wait(). Linux counts what this process held when it
    /// started the child, too: no less than that.
    [[nodiscard]] std::uint64_t peakMemoryBytes() const { return peakMemoryBytes_; }

private:
    bool takeStatus(int flags);
    void readOutput();
    void readErrors();

    pid_t id_ = -1;
    int output_ = -1;
    int errors_ = -1;
    std::string pending_;
    std::size_t scanned_ = 0; ///< bytes of pending_ that are known to hold no line end
    std::string errorTail_;
    std::optional<int> status_;
    std::uint64_t peakMemoryBytes_ = 0;
};

} // namespace voxsheet::import
