#include "import/import_client.h"

#include "base/log.h"
#include "base/program_file.h"
#include "base/thread_count.h"
#include "import/client/blocked_watch.h"
#include "import/client/child_process.h"
#include "import/client/import_options_json.h"
#include "import/client/import_protocol.h"

#include <csignal>
#include <cstring>
#include <sys/wait.h>
#include <unistd.h>

namespace voxsheet::import {

namespace {

using Clock = std::chrono::steady_clock;

double secondsSince(Clock::time_point start) {
    return std::chrono::duration<double>(Clock::now() - start).count();
}

std::uint64_t memoryLimit(const ImporterSettings& settings) {
    if (settings.memoryLimitBytes != 0) return settings.memoryLimitBytes;
    const auto pages = ::sysconf(_SC_PHYS_PAGES);
    const auto pageBytes = ::sysconf(_SC_PAGESIZE);
    return static_cast<std::uint64_t>(pages) * static_cast<std::uint64_t>(pageBytes) / 2;
}

std::filesystem::path importerOf(const ImporterSettings& settings) {
    if (!settings.executable.empty()) return settings.executable;
    return programFile().parent_path() / "voxsheet-import";
}

/// Why a child that gave no result ended, as one sentence about the file.
[[noreturn]] void explainEnd(int status, const std::string& file) {
    if (WIFSIGNALED(status)) {
        const int signal = WTERMSIG(status);
        const auto named = "(signal " + std::to_string(signal) + ", " + ::strsignal(signal) + ")";
        if (signal == SIGXCPU)
            throw LimitExceeded(file, "reading it took more processor time than an import may use",
                                "the file is probably damaged");
        if (signal == SIGKILL)
            throw LimitExceeded(file, "the reader was killed by the system " + named,
                                "the machine probably ran out of memory: import fewer files at a time");
        throw InvalidInput(file, "the reader crashed " + named,
                           "the file is probably damaged; other files are not affected");
    }
    throw InternalError(file, "the reader ended without a result (exit code " +
                                  std::to_string(WIFEXITED(status) ? WEXITSTATUS(status) : -1) + ")");
}

/// Runs one child, watches its limits and hands on its messages.
class Session {
public:
    Session(const ImporterSettings& settings, const std::vector<std::string>& arguments,
            const ImportCancelled& cancelled)
        : settings_(settings), cancelled_(cancelled), child_(importerOf(settings), arguments) {}

    /// The next message, or nullopt at the end of the child's output. `file` is named in errors.
    std::optional<ImporterMessage> next(const std::string& file) {
        for (;;) {
            if (const auto line = child_.takeLine()) {
                lastMessage_ = Clock::now();
                blocked_ = {};
                return decodeMessage(*line);
            }
            if (cancelled_ && cancelled_()) throw Cancelled(file, "the import was cancelled");
            checkLimits(file);
            if (!child_.pump(std::chrono::milliseconds(50))) {
                if (auto line = child_.takeLine()) return decodeMessage(*line);
                return std::nullopt;
            }
        }
    }

    /// From now on the limits of the header phase hold, for these files (again, for the next ones).
    void startHeader(const std::vector<std::filesystem::path>& files) {
        constexpr double secondsPerFurtherFile = 0.02;
        headerCpuSeconds_ =
            settings_.headerCpuSeconds + secondsPerFurtherFile * static_cast<double>(files.size() - 1);
        for (const auto& file : files) {
            std::error_code error;
            const auto bytes = std::filesystem::file_size(file, error);
            if (!error) headerCpuSeconds_ += static_cast<double>(bytes) / 100e6;
        }
        cpuAtStart_ = child_.cpuSeconds();
        phaseStart_ = Clock::now();
        inHeader_ = true;
    }
    void startData() { inHeader_ = false; }

    [[noreturn]] void failForEnd(const std::string& file) {
        const int status = child_.wait(std::chrono::seconds(2));
        if (!child_.errorTail().empty()) logWarning("voxsheet-import: " + child_.errorTail());
        explainEnd(status, file);
    }

private:
    void checkLimits(const std::string& file) {
        const char* const advice = "the file is probably damaged, or the disk does not answer";
        const double cpuSeconds = child_.cpuSeconds();
        blocked_.observe(Clock::now(), cpuSeconds, restOf(child_.id()));
        const bool blocked = blocked_.secondsAsleep() >
                             (inHeader_ ? settings_.blockedHeaderSeconds : settings_.blockedDataSeconds);
        if (inHeader_ && cpuSeconds - cpuAtStart_ > headerCpuSeconds_)
            throw LimitExceeded(file, "its header could not be understood in time",
                                "the file is probably damaged");
        if (inHeader_ &&
            (blocked || secondsSince(phaseStart_) > settings_.headerWallSeconds + headerCpuSeconds_))
            throw LimitExceeded(file, "the reader hangs in the file's header", advice);
        if (!inHeader_ && (blocked || secondsSince(lastMessage_) > settings_.stallSeconds))
            throw LimitExceeded(file, "the reader makes no progress any more", advice);
        if (secondsSince(start_) > settings_.totalSeconds)
            throw LimitExceeded(file, "the import took longer than an import may take", advice);
    }

    const ImporterSettings& settings_;
    const ImportCancelled& cancelled_;
    ChildProcess child_;
    Clock::time_point start_ = Clock::now();
    Clock::time_point phaseStart_ = start_;
    Clock::time_point lastMessage_ = start_;
    double headerCpuSeconds_ = 0.0;
    double cpuAtStart_ = 0.0;
    BlockedWatch blocked_;
    bool inHeader_ = true;
};

std::vector<std::string> commonArguments(const ImporterSettings& settings, const nlohmann::json& options) {
    return {"--parent",          std::to_string(::getpid()),
            "--options",         canonicalOptions(importOptionsFromJson(options)),
            "--memory-limit",    std::to_string(memoryLimit(settings)),
            "--max-voxel-bytes", std::to_string(settings.maxVoxelBytes),
            "--threads",         std::to_string(threadCount().threads),
            "--cpu-seconds",     std::to_string(static_cast<long>(settings.totalSeconds) + 1)};
}

/// The child may run in another folder, and a name may start with '-'.
std::string argumentFor(const std::filesystem::path& file) {
    return std::filesystem::absolute(file).string();
}

} // namespace

ImportResult runImport(const ImporterSettings& settings, const ImportRequest& request,
                       const ImportProgress& progress, const ImportCancelled& cancelled) {
    if (request.files.empty()) throw InvalidInput("import", "no file is named").withField("files");
    const auto file = request.files.front().string();
    auto arguments = commonArguments(settings, request.options);
    arguments.insert(arguments.end(), {"--store", std::filesystem::absolute(settings.storeFolder).string(),
                                       "--store-limit", std::to_string(settings.storeLimitBytes), "--"});
    for (const auto& each : request.files)
        arguments.push_back(argumentFor(each));

    Session session(settings, arguments, cancelled);
    session.startHeader(request.files);
    double shown = 0.0;
    while (auto message = session.next(file)) {
        if (const auto* key = std::get_if<KeyMessage>(&*message)) {
            if (progress) progress(1.0);
            return {key->key};
        }
        if (const auto* error = std::get_if<ErrorMessage>(&*message)) throwError(*error);
        if (const auto* step = std::get_if<ProgressMessage>(&*message); step && step->fraction > shown) {
            shown = step->fraction;
            if (progress) progress(shown);
        }
        if (std::holds_alternative<FilePreview>(*message)) session.startData();
    }
    session.failForEnd(file);
}

ReadingTime measureReading(const ImporterSettings& settings, const std::filesystem::path& file,
                           const nlohmann::json& options) {
    auto arguments = commonArguments(settings, options);
    arguments.insert(arguments.end(), {"--measure", "--", argumentFor(file)});
    const ImportCancelled never; // a session keeps a reference
    Session session(settings, arguments, never);
    session.startData(); // its one answer comes after the voxels
    const auto message = session.next(file.string());
    if (!message) session.failForEnd(file.string());
    if (const auto* error = std::get_if<ErrorMessage>(&*message)) throwError(*error);
    if (const auto* time = std::get_if<ReadingTime>(&*message)) return *time;
    throw InternalError(file.string(), "the importer gave no time");
}

std::vector<std::variant<FilePreview, std::exception_ptr>>
previewFiles(const ImporterSettings& settings, const std::vector<std::filesystem::path>& files,
             const nlohmann::json& options, const ImportCancelled& cancelled) {
    std::vector<std::variant<FilePreview, std::exception_ptr>> results;
    while (results.size() < files.size()) {
        auto arguments = commonArguments(settings, options);
        arguments.insert(arguments.end(), {"--header-only", "--"});
        for (auto i = results.size(); i < files.size(); ++i)
            arguments.push_back(argumentFor(files[i]));
        Session session(settings, arguments, cancelled);
        // Until all files are answered for or the child is lost; the one that it was lost with has failed.
        try {
            while (results.size() < files.size()) {
                const auto file = files[results.size()].string();
                session.startHeader({files[results.size()]});
                auto message = session.next(file);
                if (!message) session.failForEnd(file);
                if (const auto* error = std::get_if<ErrorMessage>(&*message)) {
                    try {
                        throwError(*error);
                    } catch (const Error&) {
                        results.emplace_back(std::current_exception());
                    }
                } else if (auto* preview = std::get_if<FilePreview>(&*message)) {
                    results.emplace_back(std::move(*preview));
                }
            }
        } catch (const Cancelled&) {
            throw;
        } catch (const Error&) {
            results.emplace_back(std::current_exception());
        }
    }
    return results;
}

FilePreview previewFile(const ImporterSettings& settings, const std::filesystem::path& file,
                        const nlohmann::json& options) {
    auto results = previewFiles(settings, {file}, options);
    if (const auto* failure = std::get_if<std::exception_ptr>(results.data()))
        std::rethrow_exception(*failure);
    return std::get<FilePreview>(std::move(results.front()));
}

} // namespace voxsheet::import
