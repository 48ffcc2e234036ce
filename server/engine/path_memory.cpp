#include "engine/path_memory.h"

#include "base/errors.h"
#include "base/log.h"
#include "base/thread_count.h"
#include "engine/source_files.h"
#include "engine/tile_identity.h"

#include <nlohmann/json.hpp>

#include <cmath>
#include <fstream>
#include <regex>

namespace voxsheet::engine {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

constexpr const char* kMember = "voxsheet_paths";
constexpr std::uintmax_t kMaxBytes = 64U << 10U;
constexpr const char* kRemedy = "run `voxsheet bench calibrate` again, or with --forget to remove it";

std::string processorName() {
    std::ifstream in("/proc/cpuinfo");
    for (std::string line; std::getline(in, line);) {
        const auto colon = line.find(": ");
        if (line.starts_with("model name") && colon != std::string::npos) return line.substr(colon + 2);
    }
    return "unknown processor";
}

json jsonOf(const CalibratedPath& path) {
    return {{"technique", techniqueName(path.technique)},
            {"path", pathName(path.path)},
            {"ratio", path.ratio},
            {"date", path.date}};
}

InvalidInput damaged(const fs::path& file, const std::string& why) {
    return InvalidInput("remembered paths '" + file.string() + "'", why, kRemedy);
}

CalibratedPath pathFrom(const json& entry, const fs::path& file) {
    static const std::regex date(R"(\d{4}-\d{2}-\d{2})");
    const auto technique = techniqueFromName(entry.at("technique").get<std::string>());
    const auto path = pathFromName(entry.at("path").get<std::string>());
    CalibratedPath read{{}, {}, entry.at("ratio").get<double>(), entry.at("date").get<std::string>()};
    if (!technique || !path) throw damaged(file, "it names a technique or a path that there is not");
    if (!std::isfinite(read.ratio) || read.ratio <= 0.0 || !std::regex_match(read.date, date))
        throw damaged(file, "its ratio or date is none");
    read.technique = *technique;
    read.path = *path;
    return read;
}

std::vector<CalibratedPath> readPaths(const fs::path& file, const std::string& device) {
    if (!fs::is_regular_file(file) || fs::file_size(file) > kMaxBytes)
        throw damaged(file, "it is no regular file of at most 64 KiB");
    std::ifstream in(file, std::ios::binary);
    const std::string text{std::istreambuf_iterator<char>(in), {}};
    if (!in) throw damaged(file, "it could not be read");
    try {
        const auto document = json::parse(text);
        if (document.at(kMember) != kPathFormat || document.at("device") != device)
            throw damaged(file, "it is of another device or version than its name says");
        std::vector<CalibratedPath> paths;
        for (const auto& entry : document.at("paths"))
            paths.push_back(pathFrom(entry, file));
        return paths;
    } catch (const json::exception&) {
        throw damaged(file, "it is not JSON with the members that belong there");
    }
}

} // namespace

std::string pathDevice(const RenderDevice& device) {
    std::string text = device.vendor + "\n" + device.renderer + "\n" + device.version + "\n";
    for (const std::string& workaround : device.workarounds)
        text += workaround + " ";
    return text + "\n" + processorName() + "\n" + std::to_string(threadCount().threads) + " threads\npaths " +
           std::to_string(kPathFormat);
}

fs::path pathMemoryFile(const fs::path& folder, const std::string& device) {
    return folder / (textIdentity(device) + ".json");
}

void rememberPaths(const fs::path& folder, const RenderDevice& device,
                   const std::vector<CalibratedPath>& paths) {
    std::error_code error;
    fs::create_directories(folder, error);
    if (error)
        throw IoError("folder '" + folder.string() + "'", "it cannot be made: " + error.message(),
                      "set XDG_CACHE_HOME to a folder that you may write to");
    const auto key = pathDevice(device);
    auto entries = json::array();
    for (const CalibratedPath& path : paths)
        entries.push_back(jsonOf(path));
    const json document{{kMember, kPathFormat}, {"device", key}, {"paths", std::move(entries)}};
    writeFileAtomically(pathMemoryFile(folder, key), document.dump(1) + "\n");
}

std::vector<CalibratedPath> rememberedPaths(const fs::path& folder, const RenderDevice& device) {
    if (folder.empty()) return {};
    const auto key = pathDevice(device);
    const auto file = pathMemoryFile(folder, key);
    std::error_code error;
    if (!fs::exists(file, error)) return {};
    try {
        return readPaths(file, key);
    } catch (const Error& failure) {
        logWarning(std::string(failure.what()) + "; until then paths are chosen by rule");
        return {};
    } catch (const fs::filesystem_error& failure) {
        logWarning(std::string(damaged(file, failure.code().message()).what()) +
                   "; until then paths are chosen by rule");
        return {};
    }
}

bool forgetPaths(const fs::path& folder, const RenderDevice& device) {
    const auto file = pathMemoryFile(folder, pathDevice(device));
    std::error_code error;
    const bool removed = fs::remove(file, error);
    if (error)
        throw IoError("remembered paths '" + file.string() + "'", "removing failed: " + error.message(),
                      "remove the file yourself");
    return removed;
}

} // namespace voxsheet::engine
