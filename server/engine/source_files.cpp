#include "engine/source_files.h"

#include "base/errors.h"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <system_error>

#include <fcntl.h>
#include <unistd.h>

#define XXH_INLINE_ALL
#include <xxhash.h>

namespace voxsheet::engine {

namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMaxNameBytes = 120;

/// Closes on every way out.
struct Descriptor {
    int value = -1;
    ~Descriptor() {
        if (value >= 0) ::close(value);
    }
};

IoError ioError(const fs::path& file, const std::string& doing) {
    return IoError("file '" + file.string() + "'", doing + " failed: " + std::strerror(errno),
                   "check the folder's permissions and the space left");
}

void writeAll(int descriptor, std::string_view text, const fs::path& file) {
    while (!text.empty()) {
        const ssize_t written = ::write(descriptor, text.data(), text.size());
        if (written < 0) {
            if (errno == EINTR) continue;
            throw ioError(file, "writing");
        }
        text.remove_prefix(static_cast<std::size_t>(written));
    }
}

void syncFolder(const fs::path& folder) {
    const Descriptor descriptor{::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC)};
    if (descriptor.value >= 0) ::fsync(descriptor.value);
}

template <typename Change>
sheet::Workbook withSources(sheet::Workbook workbook, const Change& change) {
    for (auto& [name, source] : workbook.datasets) {
        for (std::string& file : source.files)
            file = change(fs::path(file)).string();
    }
    return workbook;
}

} // namespace

SourceRoots::SourceRoots(const std::vector<fs::path>& folders) {
    for (const fs::path& folder : folders) {
        std::error_code error;
        fs::path canonical = fs::canonical(folder, error);
        if (error || !fs::is_directory(canonical, error)) continue;
        if (std::find(folders_.begin(), folders_.end(), canonical) == folders_.end()) {
            folders_.push_back(std::move(canonical));
        }
    }
}

fs::path SourceRoots::resolve(const fs::path& file) const {
    std::error_code error;
    const fs::path canonical = fs::canonical(file, error);
    if (error) {
        throw NotFound("file '" + file.string() + "'", "it does not exist or cannot be reached",
                       "check the path")
            .withField("files");
    }
    const bool allowed = std::any_of(folders_.begin(), folders_.end(),
                                     [&](const fs::path& folder) { return isBelow(canonical, folder); });
    if (!allowed) {
        throw InvalidInput("file '" + file.string() + "'",
                           "it lies outside the folders that this server may read",
                           "start the server with --root and the file's folder")
            .withField("files");
    }
    if (!fs::is_regular_file(canonical, error)) {
        throw InvalidInput("file '" + file.string() + "'", "it is not a regular file",
                           "name a file that holds a volume")
            .withField("files");
    }
    return canonical;
}

bool isBelow(const fs::path& path, const fs::path& folder) {
    const auto mismatch = std::mismatch(folder.begin(), folder.end(), path.begin(), path.end());
    // A folder written with a trailing '/' ends in an empty component.
    return mismatch.first == folder.end() ||
           (mismatch.first->empty() && std::next(mismatch.first) == folder.end());
}

sheet::Workbook withAbsoluteSources(sheet::Workbook workbook, const fs::path& folder) {
    const fs::path start = fs::absolute(folder);
    return withSources(std::move(workbook),
                       [&](const fs::path& file) { return (start / file).lexically_normal(); });
}

sheet::Workbook withRelativeSources(sheet::Workbook workbook, const fs::path& folder) {
    const fs::path start = fs::absolute(folder).lexically_normal();
    return withSources(std::move(workbook), [&](const fs::path& file) {
        const fs::path relative = fs::absolute(file).lexically_normal().lexically_relative(start);
        return relative.empty() ? file : relative;
    });
}

void writeFileAtomically(const fs::path& file, std::string_view text) {
    const fs::path folder = file.has_parent_path() ? file.parent_path() : fs::path(".");
    const fs::path partial =
        folder / ("." + file.filename().string() + "." + std::to_string(::getpid()) + ".part");
    try {
        const Descriptor descriptor{::open(partial.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0644)};
        if (descriptor.value < 0) throw ioError(file, "making a file beside it");
        writeAll(descriptor.value, text, file);
        if (::fsync(descriptor.value) != 0) throw ioError(file, "syncing");
        if (::rename(partial.c_str(), file.c_str()) != 0) throw ioError(file, "renaming");
    } catch (...) {
        ::unlink(partial.c_str());
        throw;
    }
    syncFolder(folder);
}

std::string safeFileName(const std::string& name) {
    const auto slash = name.find_last_of("/\\");
    std::string safe = slash == std::string::npos ? name : name.substr(slash + 1);
    for (char& c : safe) {
        const bool plain = (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') ||
                           std::strchr(" ._-+@()", c) != nullptr;
        if (!plain || c == '\0') c = '_';
    }
    safe.erase(0, safe.find_first_not_of(". "));
    if (const auto last = safe.find_last_not_of(' '); last != std::string::npos) safe.erase(last + 1);
    // The end carries the format (".nii.gz").
    if (safe.size() > kMaxNameBytes) safe = safe.substr(safe.size() - kMaxNameBytes);
    return safe.empty() ? "upload" : safe;
}

std::string checksumOf(const std::vector<std::string>& files) {
    XXH3_state_t* state = XXH3_createState();
    XXH3_64bits_reset(state);
    std::vector<char> block(1U << 20U);
    for (const std::string& file : files) {
        std::ifstream stream(file, std::ios::binary);
        if (!stream) {
            XXH3_freeState(state);
            throw IoError("file '" + file + "'", "it cannot be read", "check its permissions");
        }
        while (stream.read(block.data(), static_cast<std::streamsize>(block.size())) || stream.gcount() > 0) {
            XXH3_64bits_update(state, block.data(), static_cast<std::size_t>(stream.gcount()));
        }
    }
    const XXH64_hash_t hash = XXH3_64bits_digest(state);
    XXH3_freeState(state);
    std::string text = "xxh3:";
    for (int shift = 60; shift >= 0; shift -= 4)
        text += "0123456789abcdef"[(hash >> shift) & 15U];
    return text;
}

} // namespace voxsheet::engine
