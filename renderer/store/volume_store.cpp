#include "store/volume_store.h"

#include "base/errors.h"
#include "store/store_key.h"

#include <algorithm>
#include <atomic>
#include <cstdlib>
#include <cstring>
#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>
#include <vector>

namespace voxsheet::store {

namespace {

namespace fs = std::filesystem;

constexpr const char* kTemporaryPrefix = ".tmp-";
constexpr const char* kTrashPrefix = ".trash-";

std::string uniqueSuffix() {
    static std::atomic<unsigned> counter{0};
    struct timespec now {};
    ::clock_gettime(CLOCK_REALTIME, &now);
    return std::to_string(::getpid()) + "-" + std::to_string(now.tv_sec) + std::to_string(now.tv_nsec) + "-" +
           std::to_string(counter++);
}

std::uint64_t folderBytes(const fs::path& folder) {
    std::uint64_t bytes = 0;
    std::error_code error;
    for (fs::directory_iterator it(folder, error), end; !error && it != end; it.increment(error)) {
        const auto size = it->file_size(error);
        if (!error) bytes += size;
        error.clear();
    }
    return bytes;
}

struct Usage {
    std::string key;
    std::uint64_t bytes = 0;
    struct timespec lastUse {};
};

std::vector<Usage> listEntries(const fs::path& folder) {
    std::vector<Usage> entries;
    std::error_code error;
    for (fs::directory_iterator it(folder, error), end; !error && it != end; it.increment(error)) {
        Usage usage{it->path().filename().string(), 0, {}};
        struct stat info {};
        if (!isStoreKey(usage.key) || ::stat((it->path() / kLockFile).c_str(), &info) != 0) continue;
        usage.bytes = folderBytes(it->path());
        usage.lastUse = info.st_mtim;
        entries.push_back(std::move(usage));
    }
    return entries;
}

/// True if some live process holds the folder's lock. A folder without a lock file is in use only while it is
/// young: its writer may be about to make the file.
bool isHeld(const fs::path& folder, FileHandle& lock) {
    std::error_code error;
    try {
        lock = FileHandle(folder / kLockFile, O_RDWR);
        return !lock.tryLock(true);
    } catch (const NotFound&) {
        const auto age = fs::file_time_type::clock::now() - fs::last_write_time(folder, error);
        return !error && age < std::chrono::minutes(10);
    }
}

void discard(const fs::path& store, const fs::path& folder) {
    // Renamed first, so that nobody finds half an entry under its key.
    std::error_code error;
    const auto trash = store / (kTrashPrefix + uniqueSuffix());
    fs::rename(folder, trash, error);
    fs::remove_all(error ? folder : trash, error);
}

} // namespace

VolumeStore::VolumeStore(std::filesystem::path folder, std::uint64_t limitBytes)
    : folder_(std::move(folder)), limitBytes_(limitBytes) {
    std::error_code error;
    const bool created = fs::create_directories(folder_, error);
    if (error)
        throw IoError("volume store '" + folder_.string() + "'",
                      "the folder cannot be made: " + error.message(), "choose another with --store");
    if (created) fs::permissions(folder_, fs::perms::owner_all, error);
    if (::access(folder_.c_str(), R_OK | W_OK | X_OK) != 0)
        throw IoError("volume store '" + folder_.string() + "'", std::strerror(errno),
                      "choose another with --store");
    removeLeftovers();
}

std::shared_ptr<const StoreEntry> VolumeStore::open(const std::string& key) const {
    if (!isStoreKey(key)) throw InvalidInput("store key '" + key.substr(0, 80) + "'", "it is no key");
    bool damaged = false;
    auto entry = StoreEntry::open(folder_ / key, damaged);
    if (damaged) remove(key);
    return entry;
}

bool VolumeStore::remove(const std::string& key) const {
    if (!isStoreKey(key)) return true;
    const auto entry = folder_ / key;
    FileHandle lock;
    std::error_code error;
    if (!fs::exists(entry, error)) return true;
    try {
        lock = FileHandle(entry / kLockFile, O_RDWR);
        if (!lock.tryLock(true)) return false;
        // Somebody else may have removed it, and made it anew.
        if (!lock.isStillAt(entry / kLockFile)) return true;
    } catch (const NotFound&) {
        // No lock file: nobody can have it open as an entry.
    }
    discard(folder_, entry);
    return !fs::exists(entry, error);
}

std::uint64_t VolumeStore::usedBytes() const {
    std::uint64_t bytes = 0;
    for (const auto& entry : listEntries(folder_))
        bytes += entry.bytes;
    return bytes;
}

void VolumeStore::makeRoom(std::uint64_t incomingBytes, const std::string& keep) const {
    if (limitBytes_ == 0) return;
    auto entries = listEntries(folder_);
    std::uint64_t used = incomingBytes;
    for (const auto& entry : entries)
        used += entry.bytes;
    std::sort(entries.begin(), entries.end(), [](const Usage& a, const Usage& b) {
        return std::pair(a.lastUse.tv_sec, a.lastUse.tv_nsec) <
               std::pair(b.lastUse.tv_sec, b.lastUse.tv_nsec);
    });
    for (const auto& entry : entries) {
        if (used <= limitBytes_) return;
        if (entry.key != keep && remove(entry.key)) used -= entry.bytes;
    }
}

void VolumeStore::removeLeftovers() const {
    std::error_code error;
    for (fs::directory_iterator it(folder_, error), end; !error && it != end; it.increment(error)) {
        const auto name = it->path().filename().string();
        if (!name.starts_with(kTemporaryPrefix) && !name.starts_with(kTrashPrefix)) continue;
        FileHandle lock;
        std::error_code ignored;
        if (!isHeld(it->path(), lock)) fs::remove_all(it->path(), ignored);
    }
}

std::filesystem::path VolumeStore::newTemporaryFolder() const {
    auto path = folder_ / (kTemporaryPrefix + uniqueSuffix());
    if (::mkdir(path.c_str(), 0700) != 0)
        throw IoError("volume store '" + folder_.string() + "'", std::strerror(errno),
                      "free space on this disk, or choose another folder with --store");
    return path;
}

std::filesystem::path defaultStoreFolder() {
    if (const char* cache = std::getenv("XDG_CACHE_HOME"); cache && *cache == '/')
        return fs::path(cache) / "voxsheet" / "store";
    if (const char* home = std::getenv("HOME"); home && *home == '/')
        return fs::path(home) / ".cache" / "voxsheet" / "store";
    throw NotFound("volume store", "neither XDG_CACHE_HOME nor HOME is set", "name a folder with --store");
}

} // namespace voxsheet::store
