// The arrows between rooms go one way: reads every #include below renderer/ and server/ and fails on one that
// points back.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <set>
#include <string>
#include <vector>

namespace voxsheet {
namespace {

namespace fs = std::filesystem;

/// room -> rooms that it may include directly; what those may include is allowed too.
const std::map<std::string, std::set<std::string>>& arrows() {
    static const std::map<std::string, std::set<std::string>> table{
        {"base", {}},
        {"volume", {"base"}},
        {"resolution", {"base"}},
        {"gpu", {"base"}},
        {"store", {"volume"}},
        {"residency", {"gpu", "volume"}},
        {"stages", {"gpu", "residency", "volume"}},
        {"simd", {"volume"}},
        {"techniques", {"stages", "simd"}},
        {"frame", {"techniques", "resolution"}},
        {"sheet", {"volume", "resolution"}},
        {"import", {"volume", "store"}},
        {"engine", {"sheet", "frame", "resolution", "store", "import", "configs"}},
        {"stream", {"engine"}},
        {"http", {"stream", "embedded"}}, // embedded: the page (web/)
        {"cli", {"http", "bench"}},
        {"launcher", {}}, // starts the others on machines that have nothing
    };
    return table;
}

std::set<std::string> reachable(const std::string& room) {
    std::set<std::string> result{room};
    const auto found = arrows().find(room);
    if (found == arrows().end()) return result;
    for (const auto& next : found->second)
        result.merge(reachable(next));
    return result;
}

struct Include {
    fs::path file;
    int line = 0;
    std::string room;
};

std::vector<Include> includesOf(const fs::path& file) {
    static const std::regex pattern(R"re(^\s*#\s*include\s*"([^"/]+)/[^"]*")re");
    std::vector<Include> includes;
    std::ifstream in(file);
    std::string text;
    for (int line = 1; std::getline(in, text); ++line) {
        std::smatch match;
        if (std::regex_search(text, match, pattern)) includes.push_back({file, line, match[1]});
    }
    return includes;
}

bool isCode(const fs::path& file) { return file.extension() == ".cpp" || file.extension() == ".h"; }

std::vector<fs::path> filesBelow(const fs::path& folder) {
    std::vector<fs::path> files;
    for (const auto& entry : fs::recursive_directory_iterator(folder))
        if (entry.is_regular_file() && isCode(entry.path())) files.push_back(entry.path());
    return files;
}

TEST(Arrows, PointOneWay) {
    const fs::path source = VOXSHEET_SOURCE_DIR;
    int checked = 0;
    for (const std::string part : {"renderer", "server"})
        for (const auto& room : fs::directory_iterator(source / part)) {
            if (!room.is_directory()) continue;
            const auto name = room.path().filename().string();
            ASSERT_TRUE(arrows().count(name) == 1)
                << name << " is no room of the design: add its arrows here and in README.md";
            const auto allowed = reachable(name);
            for (const auto& file : filesBelow(room.path()))
                for (const auto& include : includesOf(file)) {
                    ++checked;
                    EXPECT_TRUE(allowed.count(include.room) == 1)
                        << fs::relative(include.file, source).string() << ":" << include.line << ": " << name
                        << " must not include " << include.room;
                }
        }
    EXPECT_GT(checked, 100) << "the sources were not found";
}

TEST(Arrows, HaveNoCycle) {
    for (const auto& [room, next] : arrows())
        for (const auto& other : next)
            EXPECT_EQ(reachable(other).count(room), 0U) << room << " <-> " << other;
}

TEST(Arrows, OpenGlObjectsAreMadeInGpuOnly) {
    static const std::regex creating(R"(\bgl(Create|Gen|Delete)[A-Z]\w*\s*\()");
    for (const auto& file : filesBelow(fs::path(VOXSHEET_SOURCE_DIR) / "renderer")) {
        if (file.string().find("/gpu/") != std::string::npos) continue;
        std::ifstream in(file);
        std::string text;
        for (int line = 1; std::getline(in, text); ++line)
            EXPECT_FALSE(std::regex_search(text, creating)) << file.string() << ":" << line << ": " << text;
    }
}

} // namespace
} // namespace voxsheet
