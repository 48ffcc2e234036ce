#include "base/errors.h"
#include "engine/source_files.h"
#include "temporary_folder.h"

#include <gtest/gtest.h>

#include <fstream>

#include <sys/stat.h>

namespace voxsheet::engine {
namespace {

namespace fs = std::filesystem;

class SourceFiles : public testing::Test {
protected:
    SourceFiles() {
        fs::create_directories(root);
        fs::create_directories(folder.path() / "root-but-not-it");
        write(root / "a.nrrd");
        write(folder.path() / "root-but-not-it" / "b.nrrd");
        write(folder.path() / "secret");
    }
    static void write(const fs::path& file) { std::ofstream(file) << "data"; }

    test::TemporaryFolder folder;
    fs::path root = folder.path() / "root";
};

TEST_F(SourceFiles, OnlyFilesBelowARootAreResolved) {
    const SourceRoots roots({root, folder.path() / "does not exist"});
    EXPECT_EQ(roots.folders().size(), 1U);
    EXPECT_EQ(roots.resolve(root / "a.nrrd"), root / "a.nrrd");
    EXPECT_EQ(roots.resolve(root / "." / ".." / "root" / "a.nrrd"), root / "a.nrrd");
    EXPECT_THROW(static_cast<void>(roots.resolve(root / ".." / "secret")), InvalidInput);
    EXPECT_THROW(static_cast<void>(roots.resolve(folder.path() / "root-but-not-it" / "b.nrrd")),
                 InvalidInput);
    EXPECT_THROW(static_cast<void>(roots.resolve("/etc/passwd")), InvalidInput);
    EXPECT_THROW(static_cast<void>(roots.resolve(root / "absent")), NotFound);
    EXPECT_THROW(static_cast<void>(roots.resolve(root)), InvalidInput) << "a folder is no file";
}

TEST_F(SourceFiles, LinksThatLeadOutAreRefusedAndThoseThatStayAreFollowed) {
    const SourceRoots roots({root});
    fs::create_symlink(folder.path() / "secret", root / "out");
    fs::create_symlink(root / "a.nrrd", root / "in");
    EXPECT_THROW(static_cast<void>(roots.resolve(root / "out")), InvalidInput);
    EXPECT_EQ(roots.resolve(root / "in"), root / "a.nrrd");
}

TEST_F(SourceFiles, PipesAreRefused) {
    ASSERT_EQ(::mkfifo((root / "pipe").c_str(), 0600), 0);
    EXPECT_THROW(static_cast<void>(SourceRoots({root}).resolve(root / "pipe")), InvalidInput);
}

TEST_F(SourceFiles, WorkbooksNameTheirSourcesRelatively) {
    sheet::Workbook workbook;
    workbook.datasets["a"].files = {"/data/run1/a.nrrd", "/other/b.nrrd"};
    const auto relative = withRelativeSources(workbook, "/data/books");
    EXPECT_EQ(relative.datasets.at("a").files,
              (std::vector<std::string>{"../run1/a.nrrd", "../../other/b.nrrd"}));
    EXPECT_EQ(withAbsoluteSources(relative, "/data/books").datasets, workbook.datasets);
    // Moved together, they still find each other.
    EXPECT_EQ(withAbsoluteSources(relative, "/elsewhere/books").datasets.at("a").files.front(),
              "/elsewhere/run1/a.nrrd");
}

TEST_F(SourceFiles, AtomicWritesReplaceOrFailWhole) {
    const fs::path file = root / "book.json";
    writeFileAtomically(file, "one");
    writeFileAtomically(file, "two and more");
    std::ifstream stream(file);
    EXPECT_EQ(std::string(std::istreambuf_iterator<char>(stream), {}), "two and more");
    EXPECT_THROW(writeFileAtomically(root / "absent" / "book.json", "x"), IoError);
    fs::create_directories(root / "folder.json" / "full");
    EXPECT_THROW(writeFileAtomically(root / "folder.json", "x"), IoError);
    for (const auto& entry : fs::directory_iterator(root)) {
        EXPECT_EQ(entry.path().string().find(".part"), std::string::npos) << entry.path();
    }
}

TEST(SafeFileName, NothingLeadsOutOfTheFolder) {
    EXPECT_EQ(safeFileName("a.nii.gz"), "a.nii.gz");
    EXPECT_EQ(safeFileName("../../etc/passwd"), "passwd");
    EXPECT_EQ(safeFileName("C:\\data\\a.nrrd"), "a.nrrd");
    EXPECT_EQ(safeFileName(".."), "upload");
    EXPECT_EQ(safeFileName(".hidden"), "hidden");
    EXPECT_EQ(safeFileName("a\nb\x01.nrrd"), "a_b_.nrrd");
    EXPECT_EQ(safeFileName(std::string("a\0b", 3)), "a_b");
    EXPECT_EQ(safeFileName(""), "upload");
    const std::string longName = safeFileName(std::string(500, 'x') + ".nii.gz");
    EXPECT_LE(longName.size(), 120U);
    EXPECT_TRUE(longName.ends_with(".nii.gz"));
}

TEST_F(SourceFiles, ChecksumsTellContentsApart) {
    const std::string a = checksumOf({(root / "a.nrrd").string()});
    EXPECT_EQ(a.size(), 5U + 16U);
    EXPECT_EQ(a, checksumOf({(folder.path() / "secret").string()})) << "equal contents";
    std::ofstream(root / "c") << "Data";
    EXPECT_NE(a, checksumOf({(root / "c").string()}));
    EXPECT_THROW(static_cast<void>(checksumOf({(root / "absent").string()})), IoError);
}

} // namespace
} // namespace voxsheet::engine
