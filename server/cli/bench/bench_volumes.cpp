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
    for (int n = 0; n < count; ++n) {
        std::string voxels(signal.size(), '\0');
        const double shift = static_cast<double>(n) / count;
        for (std::size_t i = 0; i < signal.size(); ++i) {
            const double value = static_cast<double>(signal[i]) + shift;
            voxels[i] =
                static_cast<char>(static_cast<unsigned char>((value >= 1.0 ? value - 1.0 : value) * 255.0));
        }
        const auto file = folder / ("bench_" + std::to_string(n) + ".nrrd");
        const auto size = std::to_string(dim);
        std::ofstream out(file, std::ios::binary);
        out << "NRRD0004\ntype: uint8\ndimension: 3\nsizes: " << size << ' ' << size << ' ' << size
            << "\nspacings: 1 1 1\nencoding: raw\n\n";
        out.write(voxels.data(), static_cast<std::streamsize>(voxels.size()));
        if (!out.flush()) throw IoError(file.string(), "could not be written");
        files.push_back(file.string());
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
