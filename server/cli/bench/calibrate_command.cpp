#include "cli/bench/calibrate_command.h"

#include "cli/engine_arguments.h"
#include "cli/exit_codes.h"
#include "engine/path_memory.h"
#include "volume/memory_volume_provider.h"

#include <array>
#include <cstdio>
#include <ctime>

namespace voxsheet::cli {
namespace {

std::string today() {
    const std::time_t now = std::time(nullptr);
    std::tm parts{};
    gmtime_r(&now, &parts);
    std::array<char, 16> text{};
    std::strftime(text.data(), text.size(), "%Y-%m-%d", &parts);
    return text.data();
}

std::string fileOf(const RenderDevice& device) {
    return engine::pathMemoryFile(calibrationFolder(), engine::pathDevice(device)).string();
}

void addCases(nlohmann::json& cases, const bench::CalibratedTechnique& technique) {
    const std::string name = techniqueName(technique.chosen.technique);
    for (const MeasuredPath& each : technique.measured) {
        const bool same = each.distance.isSamePicture();
        if (!same)
            reportWarning(name + ": the path " + pathName(each.path) +
                          " is refused: " + std::to_string(each.distance.pixelsApart) + " of " +
                          std::to_string(each.distance.pixels) +
                          " pixels are more than 1/255 from those of the shaders");
        cases.push_back({{"technique", name},
                         {"path", pathName(each.path)},
                         {"ms", each.ms.value},
                         {"ms_low", each.ms.low},
                         {"ms_high", each.ms.high},
                         {"pixels_apart", each.distance.pixelsApart},
                         {"same_picture", same},
                         {"rule", each.path == technique.rule},
                         {"chosen", each.path == technique.chosen.path}});
    }
}

} // namespace

nlohmann::json runCalibration(const bench::CalibrateOptions& options) {
    const auto calibration = bench::calibrate(options, [](const std::string& name) {
        std::fprintf(stderr, "bench calibrate: %s\n", name.c_str());
    });
    auto cases = nlohmann::json::array();
    auto chosen = nlohmann::json::object();
    std::vector<CalibratedPath> paths;
    for (const auto& technique : calibration.techniques) {
        addCases(cases, technique);
        paths.push_back(technique.chosen);
        paths.back().date = today();
        const auto& path = paths.back();
        chosen[techniqueName(path.technique)] = {
            {"path", pathName(path.path)}, {"ratio", path.ratio}, {"date", path.date}};
    }
    engine::rememberPaths(calibrationFolder(), calibration.device, paths);
    const auto file = fileOf(calibration.device);
    std::fprintf(stderr, "bench calibrate: remembered in %s\n", file.c_str());
    return {{"device", calibration.device.eglPlatform},
            {"renderer", calibration.device.renderer},
            {"file", file},
            {"cases", std::move(cases)},
            {"chosen", std::move(chosen)}};
}

nlohmann::json forgetCalibration(int device) {
    RenderOptions options;
    options.device = device;
    const RenderThread thread(std::make_shared<MemoryVolumeProvider>(), options);
    const bool forgotten = engine::forgetPaths(calibrationFolder(), thread.device());
    return {{"file", fileOf(thread.device())}, {"cases", {{{"forgotten", forgotten}}}}};
}

} // namespace voxsheet::cli
