#include "http/resource/folder_listing.h"
#include "http/resource/format_guess.h"

#include <gtest/gtest.h>

#include <bzlib.h>
#include <cstdlib>
#include <fstream>
#include <sys/stat.h>

using namespace voxsheet::http;
namespace fs = std::filesystem;

namespace {

class FolderListingTest : public testing::Test {
protected:
    void SetUp() override {
        std::string name = (fs::temp_directory_path() / "voxsheet_listing_XXXXXX").string();
        ASSERT_NE(::mkdtemp(name.data()), nullptr);
        base_ = fs::canonical(name);
        fs::create_directories(base_ / "root" / "sub");
        fs::create_directories(base_ / "outside");
    }
    void TearDown() override { fs::remove_all(base_); }

    void write(const fs::path& path, const std::string& text = "x") const {
        std::ofstream(base_ / path, std::ios::binary) << text;
    }
    [[nodiscard]] std::vector<std::string> names(const std::string& glob = {}, bool group = false) const {
        std::vector<std::string> out;
        for (const auto& entry : listFolder(base_ / "root", {base_ / "root"}, glob, group).entries)
            out.push_back(entry.name);
        return out;
    }

    fs::path base_;
};

using Names = std::vector<std::string>;

TEST_F(FolderListingTest, FoldersFirstInNaturalOrderWithoutHidden) {
    for (const auto* name : {"run10.raw", "run2.raw", ".hidden", "A.nrrd"})
        write(fs::path("root") / name);
    EXPECT_EQ(names(), (Names{"sub", "A.nrrd", "run2.raw", "run10.raw"}));
    EXPECT_EQ(names("*.raw"), (Names{"sub", "run2.raw", "run10.raw"}));
}

TEST_F(FolderListingTest, LinksStayBelowTheRootsAndOddThingsAreLeftOut) {
    write("root/inside.raw");
    write("outside/secret.raw");
    fs::create_symlink(base_ / "outside" / "secret.raw", base_ / "root" / "escape.raw");
    fs::create_symlink(base_ / "outside", base_ / "root" / "way_out");
    fs::create_symlink("inside.raw", base_ / "root" / "alias.raw");
    fs::create_symlink("nowhere", base_ / "root" / "dangling");
    ASSERT_EQ(::mkfifo((base_ / "root" / "pipe").c_str(), 0600), 0);
    EXPECT_EQ(names(), (Names{"sub", "alias.raw", "inside.raw"}));
}

TEST_F(FolderListingTest, SeriesStandBeforeTheirMembers) {
    for (const auto* name : {"s_1.raw", "s_2.raw", "s_10.raw", "other.raw"})
        write(fs::path("root") / name, "abc");
    EXPECT_EQ(names({}, true), (Names{"sub", "other.raw", "s_[1-10].raw", "s_1.raw", "s_2.raw", "s_10.raw"}));
    const auto listing = listFolder(base_ / "root", {base_ / "root"}, {}, true);
    EXPECT_EQ(listing.entries[2].files.size(), 3U);
    EXPECT_EQ(listing.entries[2].bytes, 9U);
}

TEST_F(FolderListingTest, LimitIsSaid) {
    for (int i = 0; i < 20; ++i)
        write("root/f" + std::to_string(i));
    EXPECT_TRUE(listFolder(base_ / "root", {base_ / "root"}, {}, false, 10).truncated);
}

TEST(FindSeries, NeedsThreeAndTakesTheNumberThatVaries) {
    EXPECT_TRUE(findSeries({"a1", "a2", "b"}).empty());
    const auto series = findSeries({"run1_t01.raw", "run1_t02.raw", "run1_t03.raw", "run2_t01.raw"});
    ASSERT_EQ(series.size(), 1U);
    EXPECT_EQ(series[0].label, "run1_t[01-03].raw");
    EXPECT_EQ(series[0].members, (std::vector<std::size_t>{0, 1, 2}));
}

TEST_F(FolderListingTest, FormatsByContent) {
    write("root/a.bin", "NRRD0004\ntype: float\n");
    write("root/b.bin", "ObjectType = Image\nNDims = 3\n");
    write("root/c.bin", "# vtk DataFile Version 3.0\nx\nASCII\nDATASET STRUCTURED_POINTS\n");
    write("root/CHGCAR_3", "MgSiO3\n 1.0\n 4.7 0 0\n 0 4.9 0\n 0 0 6.8\n Mg Si O\n");
    write("root/e.bin", "11111\n66 66 66 8\n1.0 1.0 1.0\n");
    write("root/f.bin", "water\ndensity\n 1 0 0 0\n 9 .1D0 0 0\n 9 0 .1 0\n 9 0 0 .1\n 8 8.0 0 0 0\n");
    write("root/g.bin", std::string("II*\0", 4));
    write("root/h.bin", "# made by hand\n CRYSTAL\n\nPRIMVEC\n 4 0 0\n 0 4 0\n 0 0 4\n");
    write("root/i.bin", "# vtk DataFile Version 3.0\nx\nASCII\nDATASET RECTILINEAR_GRID\n");
    write("root/j.bin", "<VTKFile type=\"RectilinearGrid\" version=\"0.1\">\n");
    write("root/k.bin", "<?xml version=\"1.0\"?>\n<VTKFile type=\"vtkOverlappingAMR\" version=\"1.1\">\n");
    write("root/l.bin", "<VTKFile type=\"UnstructuredGrid\" version=\"0.1\">\n");
    write("root/d.txt", "just a text\n");
    EXPECT_EQ(guessFormat(base_ / "root/a.bin"), "nrrd");
    EXPECT_EQ(guessFormat(base_ / "root/b.bin"), "metaimage");
    EXPECT_EQ(guessFormat(base_ / "root/c.bin"), "vtk");
    EXPECT_EQ(guessFormat(base_ / "root/CHGCAR_3"), "chgcar");
    EXPECT_EQ(guessFormat(base_ / "root/e.bin"), "slc");
    EXPECT_EQ(guessFormat(base_ / "root/f.bin"), "cube");
    EXPECT_EQ(guessFormat(base_ / "root/g.bin"), "tiff");
    EXPECT_EQ(guessFormat(base_ / "root/h.bin"), "xsf");
    EXPECT_EQ(guessFormat(base_ / "root/i.bin"), "vtk");
    EXPECT_EQ(guessFormat(base_ / "root/j.bin"), "vti");
    EXPECT_EQ(guessFormat(base_ / "root/k.bin"), "amr");
    EXPECT_FALSE(guessFormat(base_ / "root/l.bin"));
    EXPECT_FALSE(guessFormat(base_ / "root/d.txt"));
    EXPECT_FALSE(guessFormat(base_ / "root/absent"));
}

TEST_F(FolderListingTest, FormatsAreGuessedInsideOfBzip2) {
    const std::string text = "NRRD0004\ntype: uint8\ndimension: 3\nsizes: 100 100 100\nencoding: raw\n\n";
    std::string plain = text;
    std::uint32_t state = 1;
    for (int i = 0; i < 2'000'000; ++i) // incompressible: the first block is as long as it can be
        plain += static_cast<char>((state = state * 1664525U + 1013904223U) >> 24U);
    std::string packed(plain.size() + plain.size() / 100 + 600, '\0');
    auto size = static_cast<unsigned>(packed.size());
    ASSERT_EQ(BZ2_bzBuffToBuffCompress(packed.data(), &size, plain.data(),
                                       static_cast<unsigned>(plain.size()), 9, 0, 0),
              BZ_OK);
    packed.resize(size);
    write("root/volume.nrrd.bz2", packed);
    EXPECT_EQ(guessFormat(base_ / "root" / "volume.nrrd.bz2"), "nrrd");
    write("root/damaged.bz2", packed.substr(0, 50'000));
    write("root/liar.bz2", "BZh9 and nothing of the kind");
    EXPECT_EQ(guessFormat(base_ / "root" / "damaged.bz2"), std::nullopt);
    EXPECT_EQ(guessFormat(base_ / "root" / "liar.bz2"), std::nullopt);
}

} // namespace
