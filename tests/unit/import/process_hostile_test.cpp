// Children that misbehave in the importer's place: the server sees one failed import and one sentence.
#include "import/child/process_limits.h"
#include "import/client/blocked_watch.h"
#include "import/client/child_process.h"
#include "import/client/import_protocol.h"
#include "process_fixture.h"

#include <atomic>
#include <csignal>
#include <new>
#include <sys/stat.h>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>

namespace voxsheet::import {
namespace {

bool contains(const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
}

constexpr const char* kGoodHeader =
    R"({"header":{"dataset":{"anatomical":false,"fields":[{"name":"v","quantity":"","steps":[],"stored_type":"u8",)"
    R"("unit":"","value_offset":0.0,"value_scale":1.0}],"format":"nrrd","grid":{"centring":"point","dims":[1,1,1],)"
    R"("periodic":[false,false,false],"world_from_index_columns":[[1,0,0],[0,1,0],[0,0,1],[0,0,0]]},"length_unit":"",)"
    R"("notes":[],"source_path":"x","source_type":"u8","times":[0.0]},"files":["x"],"voxel_bytes":1}})";

using ProcessHostile = ProcessTest;

TEST_F(ProcessHostile, Crashes) {
    for (const auto* signal : {"SEGV", "ABRT", "BUS", "FPE"}) {
        replaceImporter(std::string("kill -") + signal + " $$");
        const auto text = failure(smallVolume(), ErrorKind::InvalidInput);
        EXPECT_TRUE(contains(text, "crashed (signal")) << text;
        EXPECT_TRUE(contains(text, "small.nrrd")) << text;
    }
    replaceImporter("kill -KILL $$");
    EXPECT_TRUE(contains(failure(smallVolume(), ErrorKind::LimitExceeded), "signal 9"));
    replaceImporter("kill -XCPU $$");
    EXPECT_TRUE(contains(failure(smallVolume(), ErrorKind::LimitExceeded), "processor time"));
}

TEST_F(ProcessHostile, EndsWithoutAResult) {
    replaceImporter("exit 0");
    EXPECT_TRUE(contains(failure(smallVolume(), ErrorKind::Internal), "exit code 0"));
    replaceImporter("echo '{\"progress\":0.5}'; exit 3");
    EXPECT_TRUE(contains(failure(smallVolume(), ErrorKind::Internal), "exit code 3"));
}

TEST_F(ProcessHostile, SpeaksNonsense) {
    for (const auto* words :
         {"hello", "{}", "[1]", "{\"key\":\"../../etc\"}", "{\"key\":5}", "{\"error\":{}}",
          "{\"header\":{\"dataset\":{}}}", "\"\"", "{\"progress\":\"x\"}"}) {
        replaceImporter("echo '" + std::string(words) + "'");
        failure(smallVolume(), ErrorKind::InvalidInput);
    }
    replaceImporter("head -c 100000 /dev/zero | tr '\\0' '['; echo");
    failure(smallVolume(), ErrorKind::InvalidInput);
    replaceImporter(
        "echo "
        "'{\"error\":{\"kind\":\"nonsense\",\"what\":\"a\",\"why\":\"b\",\"todo\":\"c\",\"field\":\"\"}}'");
    failure(smallVolume(), ErrorKind::Internal);
}

TEST_F(ProcessHostile, AnEndlessLineIsCut) {
    replaceImporter("exec cat /dev/zero");
    failure(smallVolume(), ErrorKind::LimitExceeded, 20.0);
}

TEST_F(ProcessHostile, ABlockedReaderEndsWithinTwoSeconds) {
    replaceImporter("exec sleep 60");
    EXPECT_TRUE(contains(failure(smallVolume(), ErrorKind::LimitExceeded), "hangs"));
    replaceImporter("kill -STOP $$");
    EXPECT_TRUE(contains(failure(smallVolume(), ErrorKind::LimitExceeded), "hangs"));
    const auto fifo = folder_ / "fifo";
    ASSERT_EQ(::mkfifo(fifo.c_str(), 0600), 0);
    replaceImporter("exec cat '" + fifo.string() + "'"); // waits for a writer
    EXPECT_TRUE(contains(failure(smallVolume(), ErrorKind::LimitExceeded), "hangs"));
}

TEST_F(ProcessHostile, AReaderBlockedAmongTheVoxelsEndsAfterALongerTime) {
    settings_.blockedHeaderSeconds = 0.1; // holds no longer
    settings_.blockedDataSeconds = 0.6;
    replaceImporter("cat <<'END'\n" + std::string(kGoodHeader) + "\nEND\nexec sleep 60");
    EXPECT_TRUE(contains(failure(smallVolume(), ErrorKind::LimitExceeded), "no progress"));
}

TEST_F(ProcessHostile, AReaderThatOnlyRestsBetweenStepsIsLeftAlone) {
    // A third of the time that counts as blocked, four times; one long sleep in their place would be ended.
    settings_.blockedHeaderSeconds = 1.2;
    replaceImporter("for step in 1 2 3 4; do sleep 0.4; done; exit 3");
    EXPECT_TRUE(contains(failure(smallVolume(), ErrorKind::Internal, 20.0), "exit code 3"));
}

TEST_F(ProcessHostile, NoAnswerFromTheDiskEndsByTheClock) {
    settings_.blockedHeaderSeconds = 60.0;
    settings_.headerWallSeconds = 0.2;
    settings_.headerCpuSeconds = 0.3;
    replaceImporter("exec sleep 60");
    EXPECT_TRUE(contains(failure(smallVolume(), ErrorKind::LimitExceeded), "hangs"));
}

TEST(BlockedWatch, OnlySleepWithNothingDoneCounts) {
    using Clock = BlockedWatch::Clock;
    const auto at = [](int ms) { return Clock::time_point{} + std::chrono::milliseconds(ms); };
    BlockedWatch watch;
    watch.observe(at(0), 0.1, ProcessRest::Asleep);
    watch.observe(at(50), 0.1, ProcessRest::Asleep);
    watch.observe(at(150), 0.1, ProcessRest::Asleep);
    EXPECT_DOUBLE_EQ(watch.secondsAsleep(), 0.15);
    watch.observe(at(5000), 0.1 + 1e-6, ProcessRest::Asleep); // it did something, and sleeps again
    EXPECT_EQ(watch.secondsAsleep(), 0.0);
    watch.observe(at(6000), 0.1 + 1e-6, ProcessRest::Active); // starved: it wants to run
    watch.observe(at(9000), 0.1 + 1e-6, ProcessRest::Active);
    watch.observe(at(12000), 0.1 + 1e-6, ProcessRest::OnDisk);
    watch.observe(at(15000), 0.1 + 1e-6, ProcessRest::OnDisk);
    watch.observe(at(18000), 0.1 + 1e-6, ProcessRest::Asleep);
    EXPECT_EQ(watch.secondsAsleep(), 0.0);
    watch.observe(at(18100), 0.1 + 1e-6, ProcessRest::Asleep);
    EXPECT_DOUBLE_EQ(watch.secondsAsleep(), 0.1);
    watch.observe(at(60000), 0.1 + 1e-6, ProcessRest::Asleep); // nobody looked for a minute
    EXPECT_DOUBLE_EQ(watch.secondsAsleep(), 0.35);
}

TEST(BlockedWatch, SeesWhatThreadsDo) {
    EXPECT_EQ(restOf(::getpid()), ProcessRest::Active); // this very thread runs
    EXPECT_EQ(restOf(1 << 22), ProcessRest::Active);    // no such process: not known
    const auto child = ::fork();
    if (child == 0) {
        ::pause();
        ::_exit(0);
    }
    auto rest = ProcessRest::Active;
    for (int i = 0; i < 500 && rest != ProcessRest::Asleep; ++i) {
        rest = restOf(child);
        std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    EXPECT_EQ(rest, ProcessRest::Asleep);
    ::kill(child, SIGKILL);
    ::waitpid(child, nullptr, 0);
}

TEST_F(ProcessHostile, SpinsInTheHeader) {
    settings_.headerWallSeconds = 30.0;
    settings_.headerCpuSeconds = 0.3;
    replaceImporter("while :; do :; done");
    EXPECT_TRUE(contains(failure(smallVolume(), ErrorKind::LimitExceeded, 20.0), "header"));
}

TEST_F(ProcessHostile, StallsWhileReading) {
    settings_.blockedDataSeconds = 60.0;
    settings_.stallSeconds = 0.3;
    replaceImporter("cat <<'END'\n" + std::string(kGoodHeader) + "\nEND\nexec sleep 60");
    EXPECT_TRUE(contains(failure(smallVolume(), ErrorKind::LimitExceeded), "no progress"));
}

TEST_F(ProcessHostile, ReportsProgressForEver) {
    settings_.totalSeconds = 0.5;
    replaceImporter("cat <<'END'\n" + std::string(kGoodHeader) +
                    "\nEND\nwhile :; do echo '{\"progress\":0.5}'; sleep 0.05; done");
    EXPECT_TRUE(contains(failure(smallVolume(), ErrorKind::LimitExceeded, 20.0), "longer"));
}

TEST_F(ProcessHostile, ClosesItsOutputAndStays) {
    replaceImporter("exec 1>&-; exec sleep 60");
    failure(smallVolume(), ErrorKind::LimitExceeded, 8.0);
}

TEST_F(ProcessHostile, CannotBeStarted) {
    settings_.executable = folder_ / "nothing";
    EXPECT_TRUE(contains(failure(smallVolume(), ErrorKind::IoError), "voxsheet-import"));
}

TEST_F(ProcessHostile, APreviewThatCrashesLosesOneFile) {
    // Crashes at files whose name has "evil" in it; before, it answers with a header.
    replaceImporter("for f; do case \"$f\" in *evil*) kill -SEGV $$;; *.nrrd) cat <<'END'\n" +
                    std::string(kGoodHeader) + "\nEND\n;; esac; done");
    const auto previews = previewFiles(settings_, {"/a.nrrd", "/evil.nrrd", "/b.nrrd", "/evil2.nrrd"});
    ASSERT_EQ(previews.size(), 4U);
    for (const std::size_t good : {0U, 2U})
        EXPECT_TRUE(std::holds_alternative<FilePreview>(previews[good]));
    for (const std::size_t bad : {1U, 3U})
        EXPECT_THROW(std::rethrow_exception(std::get<std::exception_ptr>(previews[bad])), InvalidInput);
}

TEST_F(ProcessHostile, TheChildSeesNoDescriptorOfOurs) {
    const int descriptor = ::dup(STDERR_FILENO); // not close-on-exec
    replaceImporter("if [ -e /proc/$$/fd/" + std::to_string(descriptor) + " ]; then exit 5; else exit 4; fi");
    EXPECT_TRUE(contains(failure(smallVolume(), ErrorKind::Internal), "exit code 4"));
    ::close(descriptor);
}

/// Runs `body` in a process of its own; its result is the exit code.
template <typename Body>
int inChild(const Body& body) {
    const auto child = ::fork();
    if (child == 0) ::_exit(body());
    int status = 0;
    ::waitpid(child, &status, 0);
    return WIFEXITED(status) ? WEXITSTATUS(status) : 100 + WTERMSIG(status);
}

TEST(ProcessLimits, AMemoryBombIsAnExceptionAndNotTheMachinesEnd) {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
    GTEST_SKIP() << "sanitizers need the address space";
#endif
    EXPECT_EQ(inChild([] {
                  applyProcessLimits({64U << 20U, 0, 0});
                  try {
                      std::vector<std::vector<char>> hoard;
                      for (int i = 0; i < 1000; ++i)
                          hoard.emplace_back(64U << 20U);
                  } catch (const std::bad_alloc&) {
                      return 7;
                  }
                  return 0;
              }),
              7);
}

TEST(ProcessLimits, ProcessorTimeEnds) {
    EXPECT_EQ(inChild([] {
                  applyProcessLimits({0, 1, 0});
                  for (std::atomic<unsigned long> i{0};;)
                      ++i;
                  return 0;
              }),
              100 + SIGXCPU);
}

TEST(ProcessLimits, AProcessWhoseParentIsGoneEnds) {
    EXPECT_EQ(inChild([] {
                  applyProcessLimits({0, 0, 1 << 22});
                  return 0;
              }),
              1);
}

TEST(ProcessLimits, TheChildEndsWithItsParent) {
    // A middle process starts a child that asks to end with it, tells us its id, and dies.
    std::array<int, 2> ends{};
    ASSERT_EQ(::pipe(ends.data()), 0);
    const auto middle = ::fork();
    if (middle == 0) {
        const auto me = ::getpid();
        const auto child = ::fork();
        if (child == 0) {
            applyProcessLimits({0, 0, me});
            const auto self = ::getpid();
            if (::write(ends[1], &self, sizeof self) != sizeof self) ::_exit(1);
            ::pause();
        }
        ::pause();
    }
    pid_t grandchild = 0;
    ASSERT_EQ(::read(ends[0], &grandchild, sizeof grandchild), static_cast<ssize_t>(sizeof grandchild));
    ::kill(middle, SIGKILL);
    ::waitpid(middle, nullptr, 0);
    bool gone = false;
    for (int i = 0; i < 100 && !gone; ++i) {
        std::ifstream status("/proc/" + std::to_string(grandchild) + "/stat");
        std::string text;
        std::getline(status, text);
        gone = text.empty() || contains(text, ") Z ") || contains(text, ") X ");
        if (!gone) std::this_thread::sleep_for(std::chrono::milliseconds(20));
    }
    EXPECT_TRUE(gone);
    ::close(ends[0]);
    ::close(ends[1]);
}

TEST(ImportProtocol, ErrorsKeepTheirKindAndWords) {
    for (const auto kind :
         {ErrorKind::InvalidInput, ErrorKind::NotFound, ErrorKind::Unsupported, ErrorKind::LimitExceeded,
          ErrorKind::IoError, ErrorKind::Conflict, ErrorKind::Internal}) {
        Error error(kind, "file \"x\"\n", "why \xff", "do");
        error.withField("options.dims");
        const auto line = encodeMessage(errorMessage(error));
        EXPECT_FALSE(contains(line, "\n"));
        const auto message = decodeMessage(line);
        ASSERT_TRUE(std::holds_alternative<ErrorMessage>(message));
        try {
            throwError(std::get<ErrorMessage>(message));
        } catch (const Error& back) {
            EXPECT_EQ(back.kind(), kind);
            EXPECT_EQ(back.subject(), "file \"x\"\n");
            EXPECT_EQ(back.toDo(), "do");
            EXPECT_EQ(back.field(), "options.dims");
        }
    }
}

} // namespace
} // namespace voxsheet::import
