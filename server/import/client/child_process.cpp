#include "import/client/child_process.h"

#include "base/errors.h"

#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <ctime>
#include <fcntl.h>
#include <poll.h>
#include <spawn.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>
#include <utility>

extern char** environ; // NOLINT: POSIX

namespace voxsheet::import {

namespace {

constexpr std::size_t kLongestLine = 64U << 20U;
constexpr std::size_t kErrorTail = 2000;

struct Pipe {
    int read = -1;
    int write = -1;

    Pipe() {
        std::array<int, 2> ends{};
        if (::pipe2(ends.data(), O_CLOEXEC) != 0)
            throw IoError("importer", std::string("no pipe for it: ") + std::strerror(errno));
        read = ends[0];
        write = ends[1];
    }
    ~Pipe() {
        if (read >= 0) ::close(read);
        if (write >= 0) ::close(write);
    }
    Pipe(const Pipe&) = delete;
    Pipe& operator=(const Pipe&) = delete;

    int takeRead() { return std::exchange(read, -1); }
};

class SpawnSetup {
public:
    SpawnSetup(int output, int errors) {
        posix_spawn_file_actions_init(&actions_);
        posix_spawn_file_actions_addopen(&actions_, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
        posix_spawn_file_actions_adddup2(&actions_, output, STDOUT_FILENO);
        posix_spawn_file_actions_adddup2(&actions_, errors, STDERR_FILENO);
        // Sockets of the server are not all close-on-exec; a child must not keep its port busy.
        posix_spawn_file_actions_addclosefrom_np(&actions_, STDERR_FILENO + 1);

        sigset_t none;
        sigset_t all;
        sigemptyset(&none);
        sigfillset(&all);
        posix_spawnattr_init(&attributes_);
        posix_spawnattr_setsigmask(&attributes_, &none);
        posix_spawnattr_setsigdefault(&attributes_, &all);
        posix_spawnattr_setpgroup(&attributes_, 0); // Ctrl-C is for the server, which then ends its children
        posix_spawnattr_setflags(&attributes_,
                                 POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETSIGDEF | POSIX_SPAWN_SETPGROUP);
    }
    ~SpawnSetup() {
        posix_spawn_file_actions_destroy(&actions_);
        posix_spawnattr_destroy(&attributes_);
    }
    SpawnSetup(const SpawnSetup&) = delete;
    SpawnSetup& operator=(const SpawnSetup&) = delete;

    [[nodiscard]] const posix_spawn_file_actions_t* actions() const { return &actions_; }
    [[nodiscard]] const posix_spawnattr_t* attributes() const { return &attributes_; }

private:
    posix_spawn_file_actions_t actions_{};
    posix_spawnattr_t attributes_{};
};

/// Appends what is there; closes the descriptor at its end. True while more may come.
template <typename Sink>
void drain(int& descriptor, const Sink& sink) {
    std::array<char, 65536> buffer;
    const auto got = ::read(descriptor, buffer.data(), buffer.size());
    if (got > 0) {
        sink(std::string_view(buffer.data(), static_cast<std::size_t>(got)));
    } else if (got == 0 || (errno != EINTR && errno != EAGAIN)) {
        ::close(descriptor);
        descriptor = -1;
    }
}

} // namespace

ChildProcess::ChildProcess(const std::filesystem::path& executable,
                           const std::vector<std::string>& arguments) {
    Pipe output;
    Pipe errors;
    const SpawnSetup setup(output.write, errors.write);
    std::vector<std::string> words{executable.string()};
    words.insert(words.end(), arguments.begin(), arguments.end());
    std::vector<char*> argv;
    for (auto& word : words)
        argv.push_back(word.data());
    argv.push_back(nullptr);
    const int failure =
        ::posix_spawn(&id_, executable.c_str(), setup.actions(), setup.attributes(), argv.data(), environ);
    if (failure != 0)
        throw IoError("importer '" + executable.string() + "'",
                      std::string("it cannot be started: ") + std::strerror(failure),
                      "voxsheet-import must stand beside voxsheet");
    output_ = output.takeRead();
    errors_ = errors.takeRead();
}

ChildProcess::~ChildProcess() {
    wait(std::chrono::milliseconds(0));
    if (output_ >= 0) ::close(output_);
    if (errors_ >= 0) ::close(errors_);
}

bool ChildProcess::pump(std::chrono::milliseconds wait) {
    if (output_ < 0) return false;
    std::array<struct pollfd, 2> ends{{{output_, POLLIN, 0}, {errors_, POLLIN, 0}}}; // poll ignores -1
    if (::poll(ends.data(), ends.size(), static_cast<int>(wait.count())) > 0) {
        if (ends[1].revents != 0) readErrors();
        if (ends[0].revents != 0) readOutput();
    }
    return output_ >= 0;
}

void ChildProcess::readOutput() {
    drain(output_, [this](std::string_view text) { pending_ += text; });
    if (pending_.size() > kLongestLine && pending_.find('\n') == std::string::npos)
        throw LimitExceeded("importer", "one line of its answer is longer than 64 MiB");
}

void ChildProcess::readErrors() {
    drain(errors_, [this](std::string_view text) {
        // Libraries quote what they read: a log must not pass control characters on to a terminal.
        for (const char c : text)
            errorTail_ += c == '\n' || (c >= ' ' && c <= '~') ? c : '?';
        if (errorTail_.size() > kErrorTail) errorTail_.erase(0, errorTail_.size() - kErrorTail);
    });
}

std::optional<std::string> ChildProcess::takeLine() {
    const auto end = pending_.find('\n', scanned_);
    if (end == std::string::npos) {
        scanned_ = pending_.size();
        return std::nullopt;
    }
    auto line = pending_.substr(0, end);
    pending_.erase(0, end + 1);
    scanned_ = 0;
    return line;
}

double ChildProcess::cpuSeconds() const {
    clockid_t clock{};
    struct timespec used {};
    if (status_ || ::clock_getcpuclockid(id_, &clock) != 0 || ::clock_gettime(clock, &used) != 0) return 0.0;
    return static_cast<double>(used.tv_sec) + 1e-9 * static_cast<double>(used.tv_nsec);
}

void ChildProcess::kill() const {
    if (!status_) ::kill(id_, SIGKILL);
}

/// True when the child has ended.
bool ChildProcess::takeStatus(int flags) {
    int status = 0;
    struct rusage usage {};
    const auto ended = ::wait4(id_, &status, flags, &usage);
    if (ended != id_ && !(ended < 0 && errno == ECHILD)) return false;
    status_ = status;
    peakMemoryBytes_ = static_cast<std::uint64_t>(usage.ru_maxrss) * 1024;
    return true;
}

int ChildProcess::wait(std::chrono::milliseconds grace) {
    const auto deadline = std::chrono::steady_clock::now() + grace;
    while (!status_ && !takeStatus(WNOHANG)) {
        if (std::chrono::steady_clock::now() >= deadline) {
            kill();
            (void)takeStatus(0);
            break;
        }
        std::this_thread::sleep_for(std::chrono::milliseconds(2));
    }
    return status_.value_or(0);
}

} // namespace voxsheet::import
