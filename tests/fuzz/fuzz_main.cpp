// voxsheet-fuzz TARGET [libFuzzer's options and corpus folders]; voxsheet-fuzz --list;
// voxsheet-fuzz --seeds FOLDER writes the seeds into a folder per target.
#include "fuzz_target.h"

#include "base/errors.h"

#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <fstream>

namespace {

using voxsheet::fuzz::FuzzTarget;

const FuzzTarget* chosen = nullptr;

[[noreturn]] void list(const std::vector<FuzzTarget>& targets) {
    for (const auto& target : targets)
        std::puts(target.name.c_str());
    std::exit(0);
}

[[noreturn]] void writeSeeds(const std::vector<FuzzTarget>& targets, const std::filesystem::path& folder) {
    for (const auto& target : targets) {
        std::filesystem::create_directories(folder / target.name);
        int number = 0;
        for (const auto& seed : target.seeds)
            std::ofstream(folder / target.name / ("seed" + std::to_string(number++)), std::ios::binary)
                << seed;
    }
    std::exit(0);
}

} // namespace

extern "C" int LLVMFuzzerInitialize(int* argc, char*** argv) {
    static const auto targets = voxsheet::fuzz::allTargets();
    const std::string first = *argc > 1 ? (*argv)[1] : "";
    if (first == "--list") list(targets);
    if (first == "--seeds" && *argc > 2) writeSeeds(targets, (*argv)[2]);
    for (const auto& target : targets)
        if (target.name == first) chosen = &target;
    if (!chosen) {
        std::fputs("usage: voxsheet-fuzz TARGET [options] [folders] | --list | --seeds FOLDER\n", stderr);
        std::exit(2);
    }
    (*argv)[1] = (*argv)[0]; // libFuzzer's own arguments follow
    ++*argv;
    --*argc;
    return 0;
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
    try {
        chosen->run({reinterpret_cast<const char*>(bytes), size});
    } catch (const voxsheet::Error&) { // an answer
    } catch (const std::exception& error) {
        std::fprintf(stderr, "finding: %s\n", error.what());
        std::abort();
    }
    return 0;
}
