#include "base/program_file.h"

#include "base/errors.h"

#include <cinttypes>
#include <cstdint>
#include <cstdio>
#include <fstream>
#include <string>

namespace voxsheet {

namespace fs = std::filesystem;

namespace {

constexpr const char* kExecutable = "/proc/self/exe";

const char anywhereInTheProgram = 0;

/// proc_pid_maps(5): "begin-end permissions offset device inode path".
fs::path mappedFile() {
    const auto address = reinterpret_cast<std::uintptr_t>(&anywhereInTheProgram);
    std::ifstream maps("/proc/self/maps");
    for (std::string line; std::getline(maps, line);) {
        std::uintptr_t begin = 0;
        std::uintptr_t end = 0;
        if (std::sscanf(line.c_str(), "%" SCNxPTR "-%" SCNxPTR, &begin, &end) != 2) continue;
        const auto path = line.find('/');
        if (begin <= address && address < end && path != std::string::npos) return line.substr(path);
    }
    throw IoError("the program", "its own file is not to be found in /proc/self/maps", "mount /proc");
}

} // namespace

fs::path programFile() {
    static const fs::path file = mappedFile();
    return file;
}

fs::path programBytes() {
    std::error_code error;
    const auto executable = fs::read_symlink(kExecutable, error);
    return !error && executable == programFile() ? fs::path(kExecutable) : programFile();
}

} // namespace voxsheet
