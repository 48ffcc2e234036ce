// How busy others keep the machine while a bench measures.
#pragma once

#include <optional>

namespace voxsheet::bench {

/// Since it was made: processor time that all other processes took (and, in a virtual machine, other
/// machines) / processor time that there was. From Linux' /proc/stat; nothing where that cannot be read.
class OtherLoad {
public:
    OtherLoad();
    [[nodiscard]] std::optional<double> share() const;

private:
    struct Clocks {
        double allSeconds = 0.0;  ///< of all processors
        double busySeconds = 0.0; ///< of them, not idle or waiting for a disk
        double ownSeconds = 0.0;  ///< of this process
    };
    [[nodiscard]] static std::optional<Clocks> read();

    std::optional<Clocks> begun_;
};

} // namespace voxsheet::bench
