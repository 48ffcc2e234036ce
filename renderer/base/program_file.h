// Where this program's own file lies, and with it what is installed beside it.
#pragma once

#include <filesystem>

namespace voxsheet {

/// The file that this program's code was mapped from. Not always /proc/self/exe: a bundle starts its own
/// dynamic loader with the program as an argument, and then that link names the loader. Throws IoError
/// without /proc.
[[nodiscard]] std::filesystem::path programFile();

/// A name under which this program's bytes can be read, also when its file was replaced after the start.
[[nodiscard]] std::filesystem::path programBytes();

} // namespace voxsheet
