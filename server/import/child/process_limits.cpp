#include "import/child/process_limits.h"

#include "base/errors.h"

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <fcntl.h>
#include <string>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <unistd.h>

namespace voxsheet::import {

namespace {

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr bool kSanitized = true;
#else
constexpr bool kSanitized = false;
#endif

void setLimit(__rlimit_resource resource, std::uint64_t soft, std::uint64_t hard) {
    struct rlimit limit {};
    ::getrlimit(resource, &limit);
    limit.rlim_max = std::min<rlim_t>(hard, limit.rlim_max);
    limit.rlim_cur = std::min<rlim_t>(soft, limit.rlim_max);
    if (::setrlimit(resource, &limit) != 0)
        throw InternalError("limits of the importer", std::strerror(errno));
}

void preferAsVictim() {
    const int file = ::open("/proc/self/oom_score_adj", O_WRONLY | O_CLOEXEC);
    if (file < 0) return;
    // Refused in some containers; then the kernel chooses by size alone.
    if (::write(file, "1000", 4) != 4) errno = 0;
    ::close(file);
}

} // namespace

void applyProcessLimits(const ProcessLimits& limits) {
    if (limits.parent != 0) {
        ::prctl(PR_SET_PDEATHSIG, SIGKILL);
        if (::getppid() != limits.parent) ::_exit(1); // it ended before the line above took effect
    }
    ::signal(SIGPIPE, SIG_DFL);
    setLimit(RLIMIT_CORE, 0, 0);
    // The soft limit's signal tells the parent why; the hard one cannot be ignored.
    if (limits.cpuSeconds != 0) setLimit(RLIMIT_CPU, limits.cpuSeconds, limits.cpuSeconds + 5);
    const auto addressSpace = limits.memoryBytes + kProgramAddressSpace;
    if (limits.memoryBytes != 0 && !kSanitized) setLimit(RLIMIT_AS, addressSpace, addressSpace);
    preferAsVictim();
}

int takeStandardOutput() {
    const int output = ::fcntl(STDOUT_FILENO, F_DUPFD_CLOEXEC, STDERR_FILENO + 1);
    if (output < 0 || ::dup2(STDERR_FILENO, STDOUT_FILENO) < 0)
        throw InternalError("standard output", std::strerror(errno));
    return output;
}

} // namespace voxsheet::import
