// Hundreds of damaged and hostile files through the real importer process: each ends in one clear sentence,
// soon, and without memory for what it promises; one that is read gives the voxels of the file that it was
// made from.
#include "import/client/child_process.h"
#include "import/client/import_protocol.h"
#include "mutants.h"
#include "process_fixture.h"

#include <sys/resource.h>
#include <unistd.h>

namespace voxsheet::import::testing {
namespace {

namespace fs = std::filesystem;

constexpr double kSeconds = 2.0;
constexpr std::uint64_t kMemoryBytes =
    64ULL << 20; ///< beyond what a child needs to refuse a file that is not there

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr bool kSanitized = true; // memory is a sanitizer's, too
#else
constexpr bool kSanitized = false;
#endif

struct Outcome {
    std::optional<ErrorMessage> error;
    std::string key;
    double seconds = 0.0;
    std::uint64_t peakBytes = 0;
};

class Mutants : public ProcessTest {
protected:
    [[nodiscard]] Outcome importAlone(const fs::path& file) const {
        const auto start = std::chrono::steady_clock::now();
        ChildProcess child(settings_.executable, {"--parent", std::to_string(::getpid()), "--memory-limit",
                                                  std::to_string(4ULL << 30), "--store",
                                                  settings_.storeFolder.string(), "--", file.string()});
        Outcome outcome;
        for (bool more = true; more;) {
            more = child.pump(std::chrono::milliseconds(50));
            while (const auto line = child.takeLine()) {
                auto message = decodeMessage(*line);
                if (auto* error = std::get_if<ErrorMessage>(&message)) outcome.error = *error;
                if (auto* key = std::get_if<KeyMessage>(&message)) outcome.key = key->key;
            }
            if (secondsSince(start) > 20.0) child.kill();
        }
        child.wait(std::chrono::seconds(2));
        outcome.seconds = secondsSince(start);
        outcome.peakBytes = child.peakMemoryBytes();
        return outcome;
    }

    static double secondsSince(std::chrono::steady_clock::time_point start) {
        return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    }

    /// The folder is emptied first: a mutant must not live from the files of another.
    [[nodiscard]] fs::path place(const SampleFile& file) const {
        const auto folder = folder_ / "in";
        fs::remove_all(folder);
        fs::create_directories(folder);
        for (const auto& [name, bytes] : file.beside)
            (void)write("in/" + name, bytes);
        return write("in/" + file.name, file.bytes);
    }

    /// Level 0 of all fields and steps, after a line of the grid's numbers.
    [[nodiscard]] std::string voxelsOf(const std::string& key) const {
        const auto entry = store::VolumeStore(settings_.storeFolder).open(key);
        if (!entry) return "no entry";
        std::ostringstream text;
        const auto& meta = *entry->meta();
        text << meta.grid.dims.x << ' ' << meta.grid.dims.y << ' ' << meta.grid.dims.z << '\n';
        for (std::size_t field = 0; field < meta.fields.size(); ++field)
            for (std::size_t step = 0; step < meta.times.size(); ++step) {
                std::ifstream in(settings_.storeFolder / key /
                                     ("f" + std::to_string(field) + "_s" + std::to_string(step) + ".raw"),
                                 std::ios::binary);
                EXPECT_TRUE(in) << "the store's files are named otherwise now";
                text << in.rdbuf();
            }
        return text.str();
    }

    void expectSentence(const Outcome& outcome, const std::string& what) const {
        ASSERT_TRUE(outcome.error) << what << ": no answer";
        const auto& error = *outcome.error;
        const auto text = error.what + ": " + error.why + "; " + error.toDo;
        EXPECT_NE(error.kind, ErrorKind::Internal) << what << ": " << text;
        EXPECT_TRUE(error.what.find((folder_ / "in").string()) == 0 || !error.field.empty())
            << what << ": " << text;
        EXPECT_FALSE(error.why.empty()) << what << ": " << text;
        EXPECT_FALSE(error.toDo.empty()) << what << ": " << text;
        EXPECT_LT(text.size(), 1000U) << what << ": " << text;
        for (const char letter : text)
            if (static_cast<unsigned char>(letter) < ' ') ADD_FAILURE() << what << " has a control character";
    }

    void expectBounds(const Outcome& outcome, const std::string& what) const {
        EXPECT_LT(outcome.seconds, kSeconds * fields::patience()) << what;
        if (!kSanitized) {
            EXPECT_LT(outcome.peakBytes, baseBytes_ + kMemoryBytes) << what;
        }
    }

    /// Runs all; `original` is what they were made from, and is read.
    void run(const SampleFile& original, const std::vector<Mutant>& mutants) {
        measureBase();
        const auto good = importAlone(place(original));
        ASSERT_FALSE(good.key.empty())
            << original.name << ": " << (good.error ? good.error->why : "no answer");
        const auto voxels = voxelsOf(good.key);
        for (const auto& mutant : mutants) {
            const auto what = original.name + ", " + mutant.what;
            const auto outcome = importAlone(place(mutant.file));
            ++count_;
            expectBounds(outcome, what);
            if (outcome.key.empty())
                expectSentence(outcome, what);
            else if (mutant.mayBeWhole)
                EXPECT_EQ(voxelsOf(outcome.key), voxels) << what << ": it was read with other voxels";
            else
                ADD_FAILURE() << what << ": it was read";
            if (::testing::Test::HasFatalFailure()) return;
        }
    }

    void measureBase() {
        baseBytes_ = importAlone(folder_ / "in" / "nothing").peakBytes;
        ASSERT_GT(baseBytes_, 0U);
        ASSERT_LT(baseBytes_, kMemoryBytes) << "the test itself holds too much for a measurement";
    }

    std::uint64_t baseBytes_ = 0;
    int count_ = 0;
};

class MutantsOfSample : public Mutants, public ::testing::WithParamInterface<std::string> {};

std::vector<std::string> sampleNames() {
    std::vector<std::string> names;
    for (const auto& sample : allSamples(fs::temp_directory_path()))
        names.push_back(sample.name);
    return names;
}

std::string testName(const ::testing::TestParamInfo<std::string>& info) {
    auto name = info.param;
    std::replace_if(
        name.begin(), name.end(), [](char letter) { return std::isalnum(letter) == 0; }, '_');
    return name;
}

INSTANTIATE_TEST_SUITE_P(Of, MutantsOfSample, ::testing::ValuesIn(sampleNames()), testName);

TEST_P(MutantsOfSample, AreRefusedOrWhole) {
    for (const auto& sample : allSamples(folder_))
        if (sample.name == GetParam()) {
            auto mutants = truncations(sample);
            for (auto&& lie : lies(sample))
                mutants.push_back(std::move(lie));
            run(sample, mutants);
        }
}

TEST_F(Mutants, BombsAreRefusedInLittleMemory) {
    measureBase();
    for (const auto& bomb : bombs()) {
        const auto what = bomb.file.name + ", " + bomb.what;
        const auto outcome = importAlone(place(bomb.file));
        expectBounds(outcome, what);
        EXPECT_TRUE(outcome.key.empty()) << what << ": it was read";
        expectSentence(outcome, what);
    }
}

TEST_F(Mutants, ALinkOutOfTheFolderIsRefused) {
    (void)write("secret.raw", std::string(420, 's'));
    for (const auto& sample : detachedSamples()) {
        if (sample.beside.size() != 1 || sample.name == "pair.hdr") continue;
        const auto opened = place(sample);
        const auto data = opened.parent_path() / sample.beside[0].first;
        fs::remove(data);
        fs::create_symlink(folder_ / "secret.raw", data);
        const auto outcome = importAlone(opened);
        EXPECT_TRUE(outcome.key.empty()) << sample.name;
        expectSentence(outcome, sample.name);
        if (outcome.error) {
            EXPECT_NE(outcome.error->why.find("own folder"), std::string::npos) << outcome.error->why;
        }
    }
}

TEST(MutantsCount, ThereAreAtLeastThreeHundred) {
    auto count = bombs().size();
    for (const auto& sample : allSamples(fs::temp_directory_path()))
        count += truncations(sample).size() + lies(sample).size();
    EXPECT_GE(count, 300U);
    RecordProperty("mutants", static_cast<int>(count));
}

} // namespace
} // namespace voxsheet::import::testing
