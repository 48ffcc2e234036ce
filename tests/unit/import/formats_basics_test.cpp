// Numbers, names, files and streams underneath the readers.
#include "formats_fixture.h"

#include "import/formats/byte_stream.h"
#include "import/formats/file_pattern.h"
#include "import/formats/input_file.h"
#include "import/formats/number_text.h"
#include "import/formats/text_scanner.h"

#include <cmath>

#include <sys/stat.h>

namespace voxsheet::import::testing {
namespace {

TEST(FormatsNumbers, TakesWholeNumbersOnly) {
    EXPECT_EQ(parseInteger("42"), 42);
    EXPECT_EQ(parseInteger("+42"), 42);
    EXPECT_EQ(parseInteger("-7"), -7);
    for (const auto* text : {"", " 1", "1 ", "1x", "1.0", "0x10", "--1", "+-1", "9223372036854775808", "1e3"})
        EXPECT_FALSE(parseInteger(text)) << text;
}

TEST(FormatsNumbers, TakesWholeDecimalsOnly) {
    EXPECT_EQ(parseNumber("1.5e2"), 150.0);
    EXPECT_EQ(parseNumber("-.5"), -0.5);
    EXPECT_EQ(parseNumber("1e-999"), 0.0);
    EXPECT_TRUE(std::isnan(*parseNumber("nan")));
    for (const auto* text : {"", "1,5", "1.5 ", "e5", "1e999", "0x1p3", "1.2.3"})
        EXPECT_FALSE(parseNumber(text)) << text;
}

TEST(FormatsNumbers, TakesFortranForms) {
    EXPECT_EQ(parseFortranNumber("0.15D+01"), 1.5);
    EXPECT_DOUBLE_EQ(*parseFortranNumber("0.123-100"), 0.123e-100);
    EXPECT_DOUBLE_EQ(*parseFortranNumber("-.427+101"), -0.427e101);
    EXPECT_DOUBLE_EQ(*parseFortranNumber("-.427E+01"), -4.27);
    for (const auto* text : {"", "****", "1-2-3", "1E+2-3"})
        EXPECT_FALSE(parseFortranNumber(text)) << text;
}

TEST(FormatsNumbers, ExpandsNumberedFileNames) {
    EXPECT_EQ(expandFilePattern("a.%03d.raw 8 12 2"),
              (std::vector<std::string>{"a.008.raw", "a.010.raw", "a.012.raw"}));
    EXPECT_EQ(expandFilePattern("a%d 2 0 -1 2"), (std::vector<std::string>{"a2", "a1", "a0"}));
    for (const auto* text :
         {"a%s 1 2 1", "a%n 1 2 1", "a%d%d 1 2 1", "a%d 1 2 0", "a%d 2 1 1", "a%d 1 2", "a 1 2 1",
          "a%*d 1 2 1", "a%99999d 1 2 1", "a%d 0 999999999 1", "a%d 1 2 1 2 3", "a%d x 2 1", "%", "a% 1 2 1"})
        EXPECT_FALSE(expandFilePattern(text)) << text;
}

class FormatsFiles : public FormatsTest {};

TEST_F(FormatsFiles, RefusesWhatIsNoRegularFile) {
    EXPECT_THROW(InputFile(folder_ / "absent"), NotFound);
    EXPECT_THROW(InputFile{folder_}, InvalidInput);
    EXPECT_THROW(InputFile("/dev/zero"), InvalidInput);
    const auto fifo = folder_ / "fifo";
    ASSERT_EQ(::mkfifo(fifo.c_str(), 0600), 0);
    EXPECT_THROW(InputFile{fifo}, InvalidInput); // and does not wait for a writer
    EXPECT_THROW((void)readFileHead(write("empty.nrrd", "")), InvalidInput);
}

TEST_F(FormatsFiles, NamesGitLfsPointers) {
    const auto path =
        write("x.nrrd", "version https://git-lfs.github.com/spec/v1\noid sha256:00\nsize 1234\n");
    const auto message = loadError(path);
    expectMentions(message, "Git LFS pointer");
    expectMentions(message, "1234 bytes");
}

TEST_F(FormatsFiles, ResolvesOnlyInsideTheHeadersFolder) {
    const auto header = write("data/x.nhdr", "h");
    write("data/x.raw", "v");
    write("data/sub/y.raw", "v");
    write("secret", "s");
    write("data2/z.raw", "s");
    EXPECT_EQ(resolveBeside(header, "x.raw"), fs::canonical(folder_ / "data/x.raw"));
    EXPECT_EQ(resolveBeside(header, "./x.raw"), fs::canonical(folder_ / "data/x.raw"));
    EXPECT_EQ(resolveBeside(header, "sub/y.raw"), fs::canonical(folder_ / "data/sub/y.raw"));
    for (const std::string name :
         {"", "/etc/passwd", "../secret", "sub/../../secret", "../data2/z.raw", "sub/../../absent", ".."})
        EXPECT_THROW((void)resolveBeside(header, name), InvalidInput) << name;
    EXPECT_THROW((void)resolveBeside(header, "absent.raw"), NotFound);
    EXPECT_THROW((void)resolveBeside(header, std::string_view("x.raw\0.txt", 10)), InvalidInput);
    fs::create_symlink(folder_ / "secret", folder_ / "data/link");
    EXPECT_THROW((void)resolveBeside(header, "link"), InvalidInput);
    fs::create_symlink("x.raw", folder_ / "data/inner");
    EXPECT_EQ(resolveBeside(header, "inner"), fs::canonical(folder_ / "data/x.raw"));
}

std::string readAll(const fs::path& path, Compression compression, std::size_t most) {
    const InputFile file(path);
    std::string out(most, '\0');
    out.resize(openStream(file, 0, compression)->read(std::as_writable_bytes(std::span(out))));
    return out;
}

TEST_F(FormatsFiles, Decompresses) {
    std::string text;
    for (int i = 0; i < 200'000; ++i)
        text += static_cast<char>('a' + i % 251 * (i % 13) % 26);
    EXPECT_EQ(readAll(write("a", gzipped(text)), Compression::Gzip, 1 << 20), text);
    EXPECT_EQ(readAll(write("b", zlibbed(text)), Compression::Gzip, 1 << 20), text);
    EXPECT_EQ(readAll(write("c", bzipped(text)), Compression::Bzip2, 1 << 20), text);
    EXPECT_EQ(readAll(write("d", gzipped(text) + gzipped("tail")), Compression::Gzip, 1 << 20),
              text + "tail");
    EXPECT_EQ(readAll(write("e", bzipped(text) + bzipped("tail")), Compression::Bzip2, 1 << 20),
              text + "tail");
    EXPECT_EQ(readAll(write("f", gzipped(text) + "garbage"), Compression::Gzip, 1 << 20), text);
    EXPECT_EQ(readAll(write("g", gzipped(text)), Compression::Gzip, 100), text.substr(0, 100));
}

TEST_F(FormatsFiles, NoticesDamagedCompression) {
    const auto packed = gzipped(std::string(10'000, 'x') + "yz");
    EXPECT_THROW((void)readAll(write("a", packed.substr(0, packed.size() / 2)), Compression::Gzip, 1 << 20),
                 InvalidInput);
    auto wrongChecksum = packed;
    wrongChecksum[wrongChecksum.size() - 6] = static_cast<char>(wrongChecksum[wrongChecksum.size() - 6] ^ 1);
    EXPECT_THROW((void)readAll(write("b", wrongChecksum), Compression::Gzip, 1 << 20), InvalidInput);
    const auto packed2 = bzipped(std::string(10'000, 'x') + "yz");
    EXPECT_THROW(
        (void)readAll(write("c", packed2.substr(0, packed2.size() - 3)), Compression::Bzip2, 1 << 20),
        InvalidInput);
    EXPECT_THROW((void)readAll(write("d", "no compression at all"), Compression::Bzip2, 10), InvalidInput);
}

TEST_F(FormatsFiles, RatioBoundHoldsForTheBestCase) {
    const std::string zeros(9'000'000, '\0');
    EXPECT_LE(zeros.size(), largestDecompressedBytes(gzipped(zeros).size(), Compression::Gzip));
    EXPECT_LE(zeros.size(), largestDecompressedBytes(bzipped(zeros).size(), Compression::Bzip2));
}

TEST_F(FormatsFiles, ScansWordsAndLinesAcrossBlocks) {
    std::string text;
    std::size_t words = 0;
    for (; text.size() < 700'000; ++words)
        text += "w" + std::to_string(words) + (words % 5 == 0 ? "\r\n" : "  ");
    text += "\nlast line";
    const InputFile file(write("text", text));
    TextScanner first(openStream(file, 0, Compression::None), "text");
    for (std::size_t i = 0; i < words; ++i)
        ASSERT_EQ(first.word(), "w" + std::to_string(i));
    TextScanner second(openStream(file, 0, Compression::None), "text");
    EXPECT_EQ(second.skipWords(words - 1, 1 << 20), words - 1);
    EXPECT_EQ(second.word(), "w" + std::to_string(words - 1));
    std::string last;
    while (const auto line = second.line())
        last = *line;
    EXPECT_EQ(last, "last line");
    EXPECT_TRUE(second.atEnd());
    EXPECT_EQ(TextScanner(openStream(file, 0, Compression::None), "text").skipWords(1'000'000, 1 << 20),
              words + 2);
}

TEST_F(FormatsFiles, RefusesEndlessLinesAndWords) {
    const InputFile file(write("text", std::string(1'000'000, 'x')));
    EXPECT_THROW((void)TextScanner(openStream(file, 0, Compression::None), "text").line(), InvalidInput);
    EXPECT_THROW((void)TextScanner(openStream(file, 0, Compression::None), "text").word(), InvalidInput);
    const InputFile blanks(write("blanks", std::string(2'000'000, ' ') + "1"));
    EXPECT_THROW((void)TextScanner(openStream(blanks, 0, Compression::None), "text").skipWords(1, 1'000'000),
                 InvalidInput);
}

} // namespace
} // namespace voxsheet::import::testing
