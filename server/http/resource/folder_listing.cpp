#include "http/resource/folder_listing.h"

#include "base/errors.h"
#include "engine/source_files.h"
#include "sheet/dataset_names.h"

#include <algorithm>
#include <fnmatch.h>
#include <map>

namespace voxsheet::http {

namespace fs = std::filesystem;

namespace {

bool isDigit(char c) { return c >= '0' && c <= '9'; }

struct NumberRun {
    std::size_t begin = 0;
    std::size_t end = 0;
};

std::vector<NumberRun> numberRuns(const std::string& name) {
    std::vector<NumberRun> runs;
    for (std::size_t i = 0; i < name.size();) {
        if (!isDigit(name[i])) {
            ++i;
            continue;
        }
        auto end = i;
        while (end < name.size() && isDigit(name[end]))
            ++end;
        runs.push_back({i, end});
        i = end;
    }
    return runs;
}

bool belowAny(const fs::path& path, const std::vector<fs::path>& roots) {
    return std::any_of(roots.begin(), roots.end(),
                       [&](const fs::path& root) { return engine::isBelow(path, root); });
}

/// Follows a link only as far as the roots reach. False: leave it out.
bool describe(const fs::directory_entry& item, const std::vector<fs::path>& roots, FolderEntry& out) {
    std::error_code error;
    if (item.is_symlink(error)) {
        const auto target = fs::canonical(item.path(), error);
        if (error || !belowAny(target, roots)) return false;
    }
    const auto status = item.status(error);
    if (error) return false;
    out.folder = fs::is_directory(status);
    if (!out.folder && !fs::is_regular_file(status)) return false;
    if (!out.folder) out.bytes = item.file_size(error);
    return !error;
}

std::vector<FolderEntry> withSeries(std::vector<FolderEntry> files) {
    std::vector<std::string> names;
    names.reserve(files.size());
    for (const auto& file : files)
        names.push_back(file.name);
    std::map<std::size_t, FolderEntry> before; // by the index of the first member
    for (const auto& series : findSeries(names)) {
        FolderEntry entry;
        entry.name = series.label;
        entry.path = files[series.members.front()].path;
        for (const auto member : series.members) {
            entry.files.push_back(files[member].path);
            entry.bytes += files[member].bytes;
        }
        before.emplace(series.members.front(), std::move(entry));
    }
    std::vector<FolderEntry> out;
    for (std::size_t i = 0; i < files.size(); ++i) {
        if (const auto found = before.find(i); found != before.end()) out.push_back(std::move(found->second));
        out.push_back(std::move(files[i]));
    }
    return out;
}

} // namespace

std::vector<NumberedSeries> findSeries(const std::vector<std::string>& names) {
    // Every name votes for each of its numbers being the one that counts; the largest group wins.
    std::map<std::pair<std::string, std::string>, std::vector<std::size_t>>
        groups; // by the text around the number
    for (std::size_t i = 0; i < names.size(); ++i)
        for (const auto& run : numberRuns(names[i]))
            groups[{names[i].substr(0, run.begin), names[i].substr(run.end)}].push_back(i);
    std::vector<std::pair<std::pair<std::string, std::string>, std::vector<std::size_t>>> bySize(
        groups.begin(), groups.end());
    std::stable_sort(bySize.begin(), bySize.end(),
                     [](const auto& a, const auto& b) { return a.second.size() > b.second.size(); });
    std::vector<bool> taken(names.size(), false);
    std::vector<NumberedSeries> out;
    for (const auto& [around, members] : bySize) {
        NumberedSeries series;
        for (const auto member : members)
            if (!taken[member]) series.members.push_back(member);
        if (series.members.size() < 3) continue;
        for (const auto member : series.members)
            taken[member] = true;
        const auto numberOf = [&, &text = around](std::size_t member) {
            const auto& name = names[member];
            return name.substr(text.first.size(), name.size() - text.first.size() - text.second.size());
        };
        series.label = around.first + "[" + numberOf(series.members.front()) + "-" +
                       numberOf(series.members.back()) + "]" + around.second;
        out.push_back(std::move(series));
    }
    return out;
}

FolderListing listFolder(const fs::path& folder, const std::vector<fs::path>& roots, const std::string& glob,
                         bool group, std::size_t limit) {
    std::error_code error;
    fs::directory_iterator items(folder, error);
    if (error) throw IoError("folder '" + folder.string() + "'", error.message());
    FolderListing listing;
    std::vector<FolderEntry> folders;
    std::vector<FolderEntry> files;
    for (; items != fs::directory_iterator(); items.increment(error)) {
        if (error) break;
        FolderEntry entry;
        entry.name = items->path().filename().string();
        entry.path = items->path();
        if (entry.name.starts_with('.') || !describe(*items, roots, entry)) continue;
        if (!entry.folder && !glob.empty() && ::fnmatch(glob.c_str(), entry.name.c_str(), 0) != 0) continue;
        if (folders.size() + files.size() >= limit) {
            listing.truncated = true;
            break;
        }
        (entry.folder ? folders : files).push_back(std::move(entry));
    }
    const auto byName = [](const FolderEntry& a, const FolderEntry& b) {
        return sheet::naturalLess(a.name, b.name);
    };
    std::sort(folders.begin(), folders.end(), byName);
    std::sort(files.begin(), files.end(), byName);
    if (group) files = withSeries(std::move(files));
    listing.entries = std::move(folders);
    std::move(files.begin(), files.end(), std::back_inserter(listing.entries));
    return listing;
}

} // namespace voxsheet::http
