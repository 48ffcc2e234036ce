#include "http/resource/upload.h"

#include "base/errors.h"
#include "http/guard/token.h"
#include "http/net/unique_fd.h"

#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <system_error>

namespace voxsheet::http {

namespace fs = std::filesystem;

namespace {

constexpr std::uint64_t kSpareBytes = std::uint64_t{64} << 20U;
constexpr std::size_t kBufferBytes = std::size_t{1} << 20U;

void writeAll(int fd, const std::string& bytes, const fs::path& file) {
    std::size_t done = 0;
    while (done < bytes.size()) {
        const auto count = ::write(fd, bytes.data() + done, bytes.size() - done);
        if (count < 0 && errno == EINTR) continue;
        if (count < 0) throw IoError("upload to '" + file.parent_path().string() + "'", std::strerror(errno));
        done += static_cast<std::size_t>(count);
    }
}

void checkSpace(const fs::path& folder) {
    std::error_code error;
    const auto space = fs::space(folder, error);
    if (!error && space.available < kSpareBytes)
        throw LimitExceeded("upload", "the disk of the upload folder is full",
                            "remove old uploads or start the server with --upload-dir on another disk");
}

} // namespace

ReceivedFile::~ReceivedFile() {
    std::error_code ignored; // it may have been moved away, which is the good case
    if (!path_.empty()) fs::remove(path_, ignored);
}

ReceivedFile receiveFile(BodyReader& body, const fs::path& folder) {
    std::error_code error;
    fs::create_directories(folder, error);
    if (error) throw IoError("upload folder '" + folder.string() + "'", error.message());
    ReceivedFile file(folder / (".receiving-" + randomToken()));
    const UniqueFd fd(::open(file.path().c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0600));
    if (!fd.valid()) throw IoError("upload folder '" + folder.string() + "'", std::strerror(errno));
    std::string buffer;
    for (bool more = true; more;) {
        more = body.read(buffer);
        if (more && buffer.size() < kBufferBytes) continue;
        checkSpace(folder);
        writeAll(fd.get(), buffer, file.path());
        buffer.clear();
    }
    return file;
}

} // namespace voxsheet::http
