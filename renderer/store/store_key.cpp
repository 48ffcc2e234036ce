#include "store/store_key.h"

#include "base/errors.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <sys/stat.h>
#include <vector>
#include <xxhash.h>

namespace voxsheet::store {

FileStamp stampOf(const std::filesystem::path& path) {
    std::error_code error;
    const auto canonical = std::filesystem::canonical(path, error);
    struct stat info {};
    if (error || ::stat(canonical.c_str(), &info) != 0) {
        const int reason = error ? error.value() : errno;
        if (reason == ENOENT || reason == ENOTDIR)
            throw NotFound(path.string(), "there is no such file", "check the path");
        throw IoError(path.string(), std::strerror(reason));
    }
    return {canonical.string(), static_cast<std::uint64_t>(info.st_size),
            static_cast<std::int64_t>(info.st_mtim.tv_sec) * 1'000'000'000 + info.st_mtim.tv_nsec};
}

std::string storeKey(std::span<const std::string> parts) {
    std::string text;
    for (const auto& part : parts)
        text += std::to_string(part.size()) + ":" + part;
    const auto hash = XXH3_128bits(text.data(), text.size());
    XXH128_canonical_t bytes;
    XXH128_canonicalFromHash(&bytes, hash);
    constexpr std::array<char, 17> digits{"0123456789abcdef"};
    std::string key;
    for (const unsigned char byte : bytes.digest) {
        key += digits[byte >> 4U];
        key += digits[byte & 15U];
    }
    return key;
}

std::string importKey(std::span<const FileStamp> files, std::string_view importerVersion,
                      std::string_view options) {
    std::vector<std::string> parts{"import", std::string(importerVersion), std::string(options)};
    for (const auto& file : files) {
        parts.push_back(file.path);
        parts.push_back(std::to_string(file.bytes));
        parts.push_back(std::to_string(file.modifiedNs));
    }
    return storeKey(parts);
}

std::string formulaKey(std::string_view canonicalText, std::span<const std::string> inputKeys) {
    std::vector<std::string> parts{"formula", std::string(canonicalText)};
    parts.insert(parts.end(), inputKeys.begin(), inputKeys.end());
    return storeKey(parts);
}

bool isStoreKey(std::string_view text) noexcept {
    return !text.empty() && text.size() <= 64 && std::all_of(text.begin(), text.end(), [](char c) {
        return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') || c == '_';
    });
}

} // namespace voxsheet::store
