// voxsheet-import: reads one source into the volume store, or shows what headers say. A process of its own,
// because files come from anywhere and some readers are not ours: whatever happens here costs one import (see
// client/import_protocol.h).
#include "base/thread_count.h"
#include "import/child/import_job.h"
#include "import/child/process_limits.h"
#include "import/client/import_options_json.h"
#include "import/client/import_protocol.h"
#include "store/meta_json.h"

#include <CLI/CLI.hpp>

#include <chrono>
#include <cstdio>
#include <new>
#include <unistd.h>

namespace {

using namespace voxsheet;
using namespace voxsheet::import;

struct Arguments {
    std::string store;
    std::uint64_t storeLimit = 0;
    std::string options = "{}";
    bool headerOnly = false;
    bool measure = false;
    int threads = 0;
    ProcessLimits process;
    JobLimits job;
    std::vector<std::string> files;
};

class AnswerWriter {
public:
    explicit AnswerWriter(int descriptor) : descriptor_(descriptor) {}

    void write(const ImporterMessage& message) const {
        const auto line = encodeMessage(message) + "\n";
        std::size_t done = 0;
        while (done < line.size()) {
            const auto put = ::write(descriptor_, line.data() + done, line.size() - done);
            if (put < 0 && errno != EINTR) ::_exit(1); // nobody listens any more
            if (put > 0) done += static_cast<std::size_t>(put);
        }
    }

private:
    int descriptor_;
};

/// Runs `work`; whatever it throws becomes an answer. True when it threw nothing.
template <typename Work>
bool answering(const AnswerWriter& answers, const std::string& file, const Work& work) {
    try {
        work();
        return true;
    } catch (const Error& error) {
        answers.write(errorMessage(error));
    } catch (const std::bad_alloc&) {
        answers.write(ErrorMessage{ErrorKind::LimitExceeded,
                                   file,
                                   "reading it needs more memory than an import may use",
                                   "raise --memory-budget, or check the file: it may be damaged",
                                   {}});
    } catch (const std::length_error&) {
        answers.write(ErrorMessage{ErrorKind::InvalidInput,
                                   file,
                                   "it asks for an impossible amount of memory",
                                   "the file is probably damaged",
                                   {}});
    } catch (const std::exception& error) {
        answers.write(ErrorMessage{ErrorKind::Internal, file, error.what(), {}, {}});
    }
    return false;
}

bool showHeaders(const Arguments& arguments, const AnswerWriter& answers) {
    const auto options = importOptionsFromJson(store::parseJson(arguments.options, "--options"));
    const ReaderRegistry readers;
    bool allGood = true;
    for (const auto& file : arguments.files)
        allGood &= answering(answers, file,
                             [&] { answers.write(previewSource(readers, file, options, arguments.job)); });
    return allGood;
}

void measureOne(const Arguments& arguments, const AnswerWriter& answers) {
    const auto options = importOptionsFromJson(store::parseJson(arguments.options, "--options"));
    answers.write(measureSource(ReaderRegistry(), arguments.files.front(), options, arguments.job));
}

void importOne(const Arguments& arguments, const AnswerWriter& answers) {
    if (arguments.store.empty()) throw InvalidInput("volume store", "no folder is named", "use --store DIR");
    using Clock = std::chrono::steady_clock;
    auto lastReport = Clock::time_point{};
    ImportJob job;
    job.files.assign(arguments.files.begin(), arguments.files.end());
    job.options = importOptionsFromJson(store::parseJson(arguments.options, "--options"));
    job.limits = arguments.job;
    job.header = [&](const FilePreview& preview) { answers.write(preview); };
    job.progress = [&](double fraction) {
        if (Clock::now() - lastReport < std::chrono::milliseconds(50)) return;
        lastReport = Clock::now();
        answers.write(ProgressMessage{fraction});
    };
    const ReaderRegistry readers;
    const store::VolumeStore store(arguments.store, arguments.storeLimit);
    answers.write(KeyMessage{importIntoStore(readers, store, job)});
}

void describe(CLI::App& app, Arguments& arguments) {
    app.add_option("--store", arguments.store, "folder of the volume store");
    app.add_option("--store-limit", arguments.storeLimit, "bytes of the whole store, 0 = no limit");
    app.add_option("--options", arguments.options, "options of the import as a JSON object");
    app.add_flag("--header-only", arguments.headerOnly,
                 "show what the headers of the files say, read no voxels");
    app.add_flag("--measure", arguments.measure,
                 "read the voxels of the first file, drop them, show the time it took");
    app.add_option("--memory-limit", arguments.process.memoryBytes,
                   "bytes this process may use, 0 = no limit");
    app.add_option("--max-voxel-bytes", arguments.job.maxVoxelBytes, "bytes of voxels that a file may hold");
    app.add_option("--threads", arguments.threads, "threads to work with, 0 = all that this process may use");
    app.add_option("--cpu-seconds", arguments.process.cpuSeconds, "processor time this process may use");
    app.add_option("--parent", arguments.process.parent, "process to end with");
    app.add_option("files", arguments.files, "files to read: one dataset, except with --header-only")
        ->required();
    app.footer("Example: voxsheet-import --header-only brain.nii.gz");
}

} // namespace

int main(int argc, char** argv) {
    Arguments arguments;
    CLI::App app(
        "Reads a volume file into Voxsheet's volume store; answers are JSON lines on standard output.");
    describe(app, arguments);
    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& error) {
        return app.exit(error) == 0 ? 0 : 2;
    }
    useThreads(chooseThreads(arguments.threads, permittedThreads()));
    arguments.job.memoryBytes = arguments.process.memoryBytes;
    const AnswerWriter answers(takeStandardOutput());
    bool good = true;
    const bool ran = answering(answers, arguments.files.front(), [&] {
        applyProcessLimits(arguments.process);
        if (arguments.headerOnly)
            good = showHeaders(arguments, answers);
        else if (arguments.measure)
            measureOne(arguments, answers);
        else
            importOne(arguments, answers);
    });
    return ran && good ? 0 : 1;
}
