#include "import/formats/input_file.h"

#include "base/errors.h"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <utility>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

namespace voxsheet::import {

namespace fs = std::filesystem;

namespace {

std::string systemReason(int code) { return std::error_code(code, std::generic_category()).message(); }

[[noreturn]] void throwOpenError(const std::string& name, int code) {
    if (code == ENOENT || code == ENOTDIR) throw NotFound(name, "there is no such file", "check the name");
    if (code == EACCES || code == EPERM)
        throw IoError(name, "reading it is not permitted", "check its permissions");
    throw IoError(name, "it cannot be opened (" + systemReason(code) + ")");
}

} // namespace

InputFile::InputFile(fs::path path) : path_(std::move(path)) {
    // O_NONBLOCK: opening a FIFO without a writer would otherwise wait for ever.
    descriptor_ = ::open(path_.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK | O_NOCTTY);
    if (descriptor_ < 0) throwOpenError(name(), errno);
    try {
        struct stat status {};
        if (::fstat(descriptor_, &status) != 0) throwOpenError(name(), errno);
        if (S_ISDIR(status.st_mode)) throw InvalidInput(name(), "it is a folder", "name a file in it");
        if (!S_ISREG(status.st_mode))
            throw InvalidInput(name(), "it is a pipe, socket or device", "name a regular file");
        bytes_ = static_cast<std::uint64_t>(status.st_size);
        refuseGitLfsPointer();
    } catch (...) {
        ::close(descriptor_);
        throw;
    }
}

InputFile::~InputFile() { ::close(descriptor_); }

std::size_t InputFile::readAt(std::uint64_t offset, std::span<std::byte> out) const {
    std::size_t done = 0;
    while (done < out.size() && offset + done < bytes_) {
        const auto got =
            ::pread(descriptor_, out.data() + done, out.size() - done, static_cast<off_t>(offset + done));
        if (got < 0 && errno == EINTR) continue;
        if (got < 0) throw IoError(name(), "reading failed (" + systemReason(errno) + ")");
        if (got == 0) break; // truncated while it is read: callers compare with what they expect
        done += static_cast<std::size_t>(got);
    }
    return done;
}

std::string InputFile::textAt(std::uint64_t offset, std::size_t count) const {
    if (offset >= bytes_) return {};
    std::string text(static_cast<std::size_t>(std::min<std::uint64_t>(count, bytes_ - offset)), '\0');
    text.resize(readAt(offset, std::as_writable_bytes(std::span(text))));
    return text;
}

void InputFile::refuseGitLfsPointer() const {
    // Pointer files are text below 1024 bytes: https://github.com/git-lfs/git-lfs/blob/main/docs/spec.md
    constexpr std::string_view signature = "version https://git-lfs.github.com/spec/";
    if (bytes_ >= 1024) return;
    const auto text = textAt(0, 1024);
    if (!text.starts_with(signature)) return;
    std::string size;
    if (const auto at = text.find("\nsize "); at != std::string::npos)
        size = " of " + printable(text.substr(at + 6, text.find('\n', at + 6) - at - 6)) + " bytes";
    throw InvalidInput(name(), "it is a Git LFS pointer, the data file" + size + " was never downloaded",
                       "run `git lfs pull` in its repository");
}

fs::path canonicalPath(const fs::path& path) {
    std::error_code code;
    auto result = fs::canonical(path, code);
    if (code) throwOpenError(path.string(), code.value());
    return result;
}

fs::path resolveBeside(const fs::path& header, std::string_view name) {
    const auto subject = header.string();
    if (name.empty() || name.find('\0') != std::string_view::npos)
        throw InvalidInput(subject, "the header names no data file");
    const fs::path relative{std::string(name)};
    const auto refuse = [&] {
        throw InvalidInput(subject,
                           "the header names the data file '" + printable(name) +
                               "', which is not in the header's own folder",
                           "put both files into one folder and name the data file without a path");
    };
    if (relative.is_absolute()) refuse();
    const auto folder = canonicalPath(header.has_parent_path() ? header.parent_path() : fs::path("."));
    // Judged by name first: whether a file outside exists must not be told.
    const auto plain = (folder / relative).lexically_normal();
    const auto inside = [&](const fs::path& path) {
        return std::mismatch(folder.begin(), folder.end(), path.begin(), path.end()).first == folder.end();
    };
    if (!inside(plain)) refuse();
    std::error_code code;
    const auto target = fs::canonical(folder / relative, code);
    if (code)
        throw NotFound(subject, "its data file '" + printable(name) + "' is missing (" + code.message() + ")",
                       "put it beside the header");
    if (!inside(target)) refuse();
    return target;
}

std::string printable(std::string_view text) {
    constexpr std::size_t longest = 80;
    std::string result(text.substr(0, longest));
    for (auto& letter : result)
        if (static_cast<unsigned char>(letter) < 0x20 || static_cast<unsigned char>(letter) > 0x7e)
            letter = '?';
    if (text.size() > longest) result += "...";
    return result;
}

} // namespace voxsheet::import
