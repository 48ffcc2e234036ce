#include "cli/bench/bench_volumes.h"

#include "base/errors.h"
#include "cli/demo/analytic_fields.h"
#include "cli/engine_arguments.h"

#include <array>
#include <fstream>

namespace voxsheet::cli {

namespace fs = std::filesystem;

std::vector<std::string> writeBenchVolumes(const fs::path& folder, int count, int dim) {
    const auto signal = marschnerLobb(dim);
    std::vector<std::string> files;
    const auto edge = std::to_string(dim);
    const std::string header = "NRRD0004\ntype: uint8\ndimension: 3\nsizes: " + edge + ' ' + edge + ' ' +
                               edge + "\nspacings: 1 1 1\nencoding: raw\n\n";
    for (int n = 0; n < count; ++n) {
        // Every count has phases of its own, and so names of its own.
        const auto file =
            folder / ("bench_" + edge + "_" + std::to_string(n) + "_of_" + std::to_string(count) + ".nrrd");
        files.push_back(file.string());
        std::error_code absent;
        if (fs::file_size(file, absent) == header.size() + signal.size()) continue;
        std::string voxels(signal.size(), '\0');
        const double shift = static_cast<double>(n) / count;
        for (std::size_t i = 0; i < signal.size(); ++i) {
            const double value = static_cast<double>(signal[i]) + shift;
            voxels[i] =
                static_cast<char>(static_cast<unsigned char>((value >= 1.0 ? value - 1.0 : value) * 255.0));
        }
        std::ofstream out(file, std::ios::binary);
        out << header;
        out.write(voxels.data(), static_cast<std::streamsize>(voxels.size()));
        if (!out.flush()) throw IoError(file.string(), "could not be written");
    }
    return files;
}

engine::EngineOptions benchEngineOptions(const fs::path& folder, int device) {
    EngineArguments arguments;
    arguments.store = (folder / "store").string();
    arguments.uploadDir = (folder / "uploads").string();
    arguments.roots = {folder.string()};
    arguments.device = device;
    return engineOptions(arguments);
}

} // namespace voxsheet::cli
