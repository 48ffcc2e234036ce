#include "bench/time_n/other_load.h"

#include <algorithm>
#include <ctime>
#include <fstream>
#include <string>
#include <unistd.h>

namespace voxsheet::bench {

OtherLoad::OtherLoad() : begun_(read()) {}

std::optional<OtherLoad::Clocks> OtherLoad::read() {
    std::ifstream in("/proc/stat");
    std::string name;
    double user = 0.0;
    double nice = 0.0;
    double system = 0.0;
    double idle = 0.0;
    double disk = 0.0;
    double interrupts = 0.0;
    double softInterrupts = 0.0;
    double stolen = 0.0;
    if (!(in >> name >> user >> nice >> system >> idle >> disk >> interrupts >> softInterrupts >> stolen))
        return std::nullopt;
    timespec own{};
    if (clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &own) != 0) return std::nullopt;
    const auto ticks = static_cast<double>(sysconf(_SC_CLK_TCK));
    Clocks clocks;
    clocks.busySeconds = (user + nice + system + interrupts + softInterrupts + stolen) / ticks;
    clocks.allSeconds = clocks.busySeconds + (idle + disk) / ticks;
    clocks.ownSeconds = static_cast<double>(own.tv_sec) + 1e-9 * static_cast<double>(own.tv_nsec);
    return clocks;
}

std::optional<double> OtherLoad::share() const {
    const auto now = read();
    if (!begun_ || !now || now->allSeconds <= begun_->allSeconds) return std::nullopt;
    const double others = (now->busySeconds - begun_->busySeconds) - (now->ownSeconds - begun_->ownSeconds);
    return std::clamp(others / (now->allSeconds - begun_->allSeconds), 0.0, 1.0);
}

} // namespace voxsheet::bench
