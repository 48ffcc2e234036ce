// AMR data sets of VTK, written here by hand.
#include "vtk_fixture.h"

#include <sstream>

namespace voxsheet::import::testing {
namespace {

class Amr : public FormatsTest {
protected:
    void SetUp() override {
        FormatsTest::SetUp();
        if (ReaderRegistry().descriptions().find(".vth") == std::string::npos)
            GTEST_SKIP() << "this build is without VTK";
        writePatch("p/coarse.vti", {0, 0, 0}, 2.0, {2, 2, 1}, "1 2 3 4");
        writePatch("p/fine.vti", {2, 0, 0}, 1.0, {2, 2, 2}, "10 11 12 13 14 15 16 17");
    }

    void writePatch(const std::string& name, const glm::ivec3& low, double cell, const glm::ivec3& cells,
                    const std::string& values, const std::string& kind = "CellData",
                    const std::string& more = "") const {
        std::ostringstream extent;
        extent << "0 " << cells.x << " 0 " << cells.y << " 0 " << cells.z;
        std::ostringstream place;
        place << "Origin=\"" << low.x << ' ' << low.y << ' ' << low.z << "\" Spacing=\"" << cell << ' '
              << cell << ' ' << cell << "\"" << more;
        write(name, "<VTKFile type=\"ImageData\" version=\"0.1\" byte_order=\"LittleEndian\">\n<ImageData "
                    "WholeExtent=\"" +
                        extent.str() + "\" " + place.str() + ">\n<Piece Extent=\"" + extent.str() + "\"><" +
                        kind + "><DataArray type=\"Int16\" Name=\"rho\" format=\"ascii\">" + values +
                        "</DataArray></" + kind + "></Piece></ImageData></VTKFile>\n");
    }

    fs::path overlapping(const std::string& more = "") const {
        return write("a.vth", "<?xml version=\"1.0\"?>\n<VTKFile type=\"vtkOverlappingAMR\" version=\"1.1\" "
                              "byte_order=\"LittleEndian\">\n<vtkOverlappingAMR origin=\"0 0 0\" "
                              "grid_description=\"XYZ\">\n<Block level=\"0\" spacing=\"2 2 2\">\n"
                              "<DataSet index=\"0\" amr_box=\"0 1 0 1 0 0\" file=\"p/coarse.vti\"/>\n"
                              "<DataSet index=\"1\" amr_box=\"0 1 0 1 0 0\"/>\n</Block>\n"
                              "<Block level=\"1\" spacing=\"1 1 1\">\n<DataSet index=\"0\" "
                              "amr_box=\"2 3 0 1 0 1\" file=\"p/fine.vti\"/>\n" +
                                  more + "</Block>\n</vtkOverlappingAMR>\n</VTKFile>\n");
    }
    static void expectVolume(const Loaded& loaded) {
        const auto& meta = loaded.meta();
        EXPECT_EQ(meta.format, "amr");
        EXPECT_EQ(meta.grid.dims, glm::ivec3(4, 4, 2));
        EXPECT_EQ(meta.grid.centring, Centring::Cell);
        EXPECT_EQ(glm::dvec3(meta.grid.worldFromIndex[3]), glm::dvec3(0.5));
        ASSERT_EQ(meta.fields.size(), 1U);
        EXPECT_EQ(meta.fields[0].name, "rho");
        EXPECT_EQ(loaded.values<short>(),
                  (std::vector<short>{1, 1, 10, 11, 1, 1, 12, 13, 3, 3, 4, 4, 3, 3, 4, 4,
                                      1, 1, 14, 15, 1, 1, 16, 17, 3, 3, 4, 4, 3, 3, 4, 4}));
        expectMentions(meta.notes.at(0), "Resampled: its 2 patches in 2 levels");
        EXPECT_EQ(loaded.header.files.size(), 3U);
    }
    /// The error with one piece of the file replaced.
    std::string refusal(const std::string& from, const std::string& to) const {
        std::ifstream in(overlapping());
        std::string bytes((std::istreambuf_iterator<char>(in)), {});
        const auto at = bytes.find(from);
        EXPECT_NE(at, std::string::npos) << from;
        return sentenceOf(write("a.vth", bytes.replace(at, from.size(), to)));
    }
};

TEST_F(Amr, PatchesBecomeOneGrid) { expectVolume(loadAny(overlapping())); }

TEST_F(Amr, TheOlderKindNamesTheLevelWithEachPatch) {
    expectVolume(loadAny(
        write("a.vtm", "<?xml version=\"1.0\"?>\n<VTKFile type=\"vtkHierarchicalBoxDataSet\" version=\"0.1\" "
                       "byte_order=\"LittleEndian\">\n<vtkHierarchicalBoxDataSet>\n"
                       "<RefinementRatio level=\"0\" refinement=\"2\"/>\n"
                       "<DataSet group=\"1\" dataset=\"0\" amr_box=\"2 3 0 1 0 1\" file=\"p/fine.vti\"/>\n"
                       "<DataSet group=\"0\" dataset=\"0\" amr_box=\"0 1 0 1 0 0\" file=\"p/coarse.vti\"/>\n"
                       "</vtkHierarchicalBoxDataSet>\n</VTKFile>\n")));
}

TEST_F(Amr, GhostMarksAreNoField) {
    for (const auto* name : {"p/coarse.vti", "p/fine.vti"}) {
        std::ifstream in(folder_ / name);
        std::string bytes((std::istreambuf_iterator<char>(in)), {});
        const std::string marks = name[2] == 'c' ? "0 8 0 0" : "0 0 0 0 0 0 0 0";
        const auto at = bytes.find("<DataArray");
        bytes.insert(at, "<DataArray type=\"UInt8\" Name=\"vtkGhostType\" format=\"ascii\">" + marks +
                             "</DataArray>");
        write(name, bytes);
    }
    expectVolume(loadAny(overlapping()));
}

TEST_F(Amr, WrongHeadersAreRefused) {
    expectMentions(refusal("p/fine.vti", "../../etc/passwd"), "own folder");
    expectMentions(refusal("p/fine.vti", "/etc/passwd"), "own folder");
    EXPECT_FALSE(refusal("p/fine.vti", "p/missing.vti").empty());
    expectMentions(refusal("level=\"1\"", "level=\"-1\""), "level '-1'");
    expectMentions(refusal("level=\"1\"", "level=\"99999999999\""), "is none");
    expectMentions(refusal("level=\"1\"", "level=\"0\""), "cells of different sizes");
    expectMentions(refusal("<Block level=\"0\" spacing=\"2 2 2\">", "<Block>"), "none");
    expectMentions(refusal("</Block>", ""), "line");
    expectMentions(refusal("<?xml version=\"1.0\"?>", "<!DOCTYPE x [<!ENTITY a \"b\">]>"), "document type");
    expectMentions(
        sentenceOf(write("b.vth", "<VTKFile type=\"vtkOverlappingAMR\" version=\"1.1\"></VTKFile>")),
        "names no patches");
}

TEST_F(Amr, WrongPatchesAreRefused) {
    // About the patch, and so by its name; the patches' place is the header's.
    const auto refusalOf = [&] {
        try {
            (void)loadAny(overlapping());
        } catch (const Error& error) {
            return std::string(error.what());
        }
        ADD_FAILURE() << "it was read";
        return std::string();
    };
    writePatch("p/fine.vti", {2, 0, 0}, 1.0, {2, 2, 2}, "10 11 12 13 14 15 16");
    expectMentions(refusalOf(), "fine.vti: the array 'rho' has 7 numbers");
    writePatch("p/fine.vti", {1 << 30, 0, 0}, 1.0, {2, 2, 2}, "10 11 12 13 14 15 16 17");
    expectMentions(refusalOf(), "too many cells");
    writePatch("p/fine.vti", {2, 0, 0}, -1.0, {2, 2, 2}, "10 11 12 13 14 15 16 17");
    expectMentions(refusalOf(), "below zero");
    writePatch("p/fine.vti", {2, 0, 0}, 1.0, {1, 1, 1}, "1 2 3 4 5 6 7 8", "PointData");
    expectMentions(refusalOf(), "those of points");
    writePatch("p/fine.vti", {2, 0, 0}, 1.0, {2, 2, 2}, "1 2 3 4 5 6 7 8", "CellData",
               " Direction=\"0 1 0 -1 0 0 0 0 1\"");
    expectMentions(refusalOf(), "turned");
}

TEST_F(Amr, TooManyPatchesAreRefused) {
    std::string many;
    for (int i = 0; i < 10001; ++i)
        many += "<DataSet index=\"1\" file=\"p/fine.vti\"/>\n";
    expectMentions(sentenceOf(overlapping(many)), "more than 10000 patches");
}

TEST_F(Amr, RealPatches) {
    const fs::path data = fs::path(VOXSHEET_DATA_DIR) / "amr_chombo3d";
    if (!fs::exists(data)) GTEST_SKIP() << "the real data are not beside the project";
    const auto loaded = loadAny(data / "chombo3d.vtm");
    const auto& meta = loaded.meta();
    EXPECT_EQ(meta.grid.dims, glm::ivec3(32));
    EXPECT_EQ(spacingWorld(meta.grid), glm::dvec3(0.25));
    EXPECT_EQ(loaded.header.files.size(), 17U);
    const auto values = loaded.values<double>();
    // Each patch alone: where no finer one lies, its cells are found again.
    const auto patch = [&](int index) {
        return loadAny(data / ("chombo3d_" + std::to_string(index) + ".vti"));
    };
    const auto at = [&](const Loaded& part, const glm::dvec3& world) {
        const auto index = glm::inverse(part.meta().grid.worldFromIndex) * glm::dvec4(world, 1.0);
        const auto cell = glm::ivec3(glm::round(glm::dvec3(index)));
        const auto& dims = part.meta().grid.dims;
        if (glm::any(glm::lessThan(cell, glm::ivec3(0))) || glm::any(glm::greaterThanEqual(cell, dims)))
            return std::optional<double>();
        return std::optional(
            part.values<double>()[static_cast<std::size_t>(cell.x + dims.x * (cell.y + dims.y * cell.z))]);
    };
    std::vector<Loaded> parts;
    for (int index = 0; index < 16; ++index)
        parts.push_back(patch(index));
    for (int z = 0; z < 32; z += 3)
        for (int y = 1; y < 32; y += 3)
            for (int x = 0; x < 32; ++x) {
                const glm::dvec3 world(meta.grid.worldFromIndex * glm::dvec4(x, y, z, 1.0));
                std::optional<double> expected;
                for (const auto& part : parts)
                    if (const auto value = at(part, world)) expected = value; // finer ones come later
                ASSERT_EQ(values[static_cast<std::size_t>(x + 32 * (y + 32 * z))], expected)
                    << x << ' ' << y << ' ' << z;
            }
}

} // namespace
} // namespace voxsheet::import::testing
