// Values at points on several levels, and blocks of images without levels: against a linear field, which
// linear interpolation keeps.
#include "vtk_fixture.h"

#include <cmath>
#include <functional>
#include <sstream>

namespace voxsheet::import::testing {
namespace {

using Field = std::function<double(const glm::dvec3&)>;

double linear(const glm::dvec3& p) { return 1.0 + 2.0 * p.x - 3.0 * p.y + 0.5 * p.z; }

class AmrPoints : public FormatsTest {
protected:
    void SetUp() override {
        FormatsTest::SetUp();
        if (ReaderRegistry().descriptions().find(".vth") == std::string::npos)
            GTEST_SKIP() << "this build is without VTK";
    }

    /// An image whose values at points (or in cells, at their middles) are those of the field.
    void writeImage(const std::string& name, const glm::dvec3& low, const glm::dvec3& spacing,
                    const glm::ivec3& points, const Field& field, const std::string& type = "Float64",
                    bool cells = false) const {
        std::ostringstream text;
        const auto last = points - 1;
        text << "<VTKFile type=\"ImageData\" version=\"0.1\" byte_order=\"LittleEndian\">\n<ImageData "
             << "WholeExtent=\"0 " << last.x << " 0 " << last.y << " 0 " << last.z << "\" Origin=\"" << low.x
             << ' ' << low.y << ' ' << low.z << "\" Spacing=\"" << spacing.x << ' ' << spacing.y << ' '
             << spacing.z << "\">\n<Piece Extent=\"0 " << last.x << " 0 " << last.y << " 0 " << last.z
             << "\"><" << (cells ? "CellData" : "PointData") << "><DataArray type=\"" << type
             << "\" Name=\"rho\" format=\"ascii\">\n";
        const auto dims = cells ? last : points;
        for (int z = 0; z < dims.z; ++z)
            for (int y = 0; y < dims.y; ++y)
                for (int x = 0; x < dims.x; ++x)
                    text << field(low + spacing * (glm::dvec3(x, y, z) + (cells ? 0.5 : 0.0))) << ' ';
        text << "</DataArray></" << (cells ? "CellData" : "PointData") << "></Piece></ImageData></VTKFile>\n";
        write(name, text.str());
    }

    fs::path amr() const {
        return write("a.vth",
                     "<VTKFile type=\"vtkOverlappingAMR\" version=\"1.1\" byte_order=\"LittleEndian\">"
                     "<vtkOverlappingAMR origin=\"0 0 0\" grid_description=\"XYZ\">"
                     "<Block level=\"0\"><DataSet index=\"0\" file=\"p/coarse.vti\"/></Block>"
                     "<Block level=\"1\"><DataSet index=\"0\" file=\"p/fine.vti\"/></Block>"
                     "</vtkOverlappingAMR></VTKFile>\n");
    }
    fs::path blocks(const std::string& more = "") const {
        return write(
            "b.vtm",
            "<?xml version=\"1.0\"?>\n<VTKFile type=\"vtkMultiBlockDataSet\" version=\"1.0\" "
            "byte_order=\"LittleEndian\">\n<vtkMultiBlockDataSet>\n<Block index=\"0\" name=\"fluid\">\n"
            "<DataSet index=\"0\" name=\"near\" file=\"p/fine.vti\"/>\n<DataSet index=\"1\"/>\n"
            "</Block>\n<DataSet index=\"1\" file=\"p/coarse.vti\"/>\n" +
                more + "</vtkMultiBlockDataSet>\n</VTKFile>\n");
    }

    /// Every value is that of the field at its place, or none where `inside` says no.
    template <typename T>
    static void expectField(const Loaded& loaded, const Field& field,
                            const std::function<bool(const glm::dvec3&)>& inside) {
        const auto& grid = loaded.meta().grid;
        const auto values = loaded.values<T>();
        ASSERT_EQ(values.size(), static_cast<std::size_t>(sampleCount(grid.dims)));
        std::size_t at = 0;
        for (int z = 0; z < grid.dims.z; ++z)
            for (int y = 0; y < grid.dims.y; ++y)
                for (int x = 0; x < grid.dims.x; ++x, ++at) {
                    const glm::dvec3 place(grid.worldFromIndex * glm::dvec4(x, y, z, 1.0));
                    if (inside(place))
                        EXPECT_NEAR(values[at], field(place), 1e-9)
                            << place.x << ' ' << place.y << ' ' << place.z;
                    else
                        EXPECT_TRUE(std::isnan(values[at])) << place.x << ' ' << place.y << ' ' << place.z;
                }
    }
    static bool everywhere(const glm::dvec3&) { return true; }
};

TEST_F(AmrPoints, ALinearFieldStaysItself) {
    writeImage("p/coarse.vti", {-1, 0, 2}, {2, 2, 2}, {5, 4, 3}, linear);
    writeImage("p/fine.vti", {1, 2, 3}, {0.5, 1, 0.5}, {5, 3, 4}, linear);
    for (const auto& file : {amr(), blocks()}) {
        const auto loaded = loadAny(file);
        const auto& meta = loaded.meta();
        EXPECT_EQ(meta.grid.dims, glm::ivec3(17, 7, 9)) << file;
        EXPECT_EQ(meta.grid.centring, Centring::Point) << file;
        EXPECT_EQ(glm::dvec3(meta.grid.worldFromIndex[3]), glm::dvec3(-1, 0, 2)) << file;
        EXPECT_EQ(spacingWorld(meta.grid), glm::dvec3(0.5, 1, 0.5)) << file;
        EXPECT_EQ(meta.fields.at(0).storedType, ScalarType::F64) << file;
        expectMentions(meta.notes.at(0), "2 patches in 2 levels became a uniform grid of 17 x 7 x 9 points");
        expectField<double>(loaded, linear, everywhere);
    }
}

TEST_F(AmrPoints, TheFinestPatchCounts) {
    const auto far = [](const glm::dvec3& p) { return linear(p) + 1000.0; };
    writeImage("p/coarse.vti", {0, 0, 0}, {2, 2, 2}, {4, 3, 2}, linear);
    writeImage("p/fine.vti", {1, 1, 0}, {1, 1, 1}, {3, 2, 3}, far);
    const auto inFine = [](const glm::dvec3& p) { return p.x >= 1 && p.x <= 3 && p.y >= 1 && p.y <= 2; };
    const auto expected = [&](const glm::dvec3& p) { return inFine(p) ? far(p) : linear(p); };
    expectField<double>(loadAny(amr()), expected, everywhere);
    expectField<double>(loadAny(blocks()), expected, everywhere); // whatever their order in the file
}

TEST_F(AmrPoints, PlacesWithoutABlockHaveNoValueAndIntegersBecomeFloats) {
    writeImage(
        "p/coarse.vti", {0, 0, 0}, {1, 1, 1}, {2, 2, 2}, [](auto& p) { return 3 * p.x + p.y; }, "Int16");
    writeImage(
        "p/fine.vti", {3, 0, 0}, {1, 1, 1}, {2, 2, 2}, [](auto& p) { return 3 * p.x + p.y; }, "Int16");
    const auto loaded = loadAny(blocks());
    EXPECT_EQ(loaded.meta().grid.dims, glm::ivec3(5, 2, 2));
    EXPECT_EQ(loaded.meta().fields[0].storedType, ScalarType::F32);
    EXPECT_EQ(loaded.meta().sourceType, ScalarType::I16);
    expectMentions(loaded.meta().notes.at(0), "2 patches in 1 levels");
    expectField<float>(
        loaded, [](auto& p) { return 3 * p.x + p.y; }, [](auto& p) { return p.x < 1.5 || p.x > 2.5; });
}

TEST_F(AmrPoints, BlocksOfCellsAreResampledAsAmrIs) {
    const auto steps = [](const glm::dvec3& p) { return std::floor(p.x) + 10.0 * std::floor(p.y); };
    writeImage("p/coarse.vti", {0, 0, 0}, {1, 1, 1}, {3, 3, 2}, steps, "Int32", true);
    writeImage("p/fine.vti", {2, 0, 0}, {1, 1, 1}, {3, 3, 2}, steps, "Int32", true);
    const auto loaded = loadAny(blocks());
    EXPECT_EQ(loaded.meta().grid.centring, Centring::Cell);
    EXPECT_EQ(loaded.values<int>(), (std::vector<int>{0, 1, 2, 3, 10, 11, 12, 13}));
    // Blocks that overlap leave a gap elsewhere, though their volumes add up to more than the box.
    writeImage("p/coarse.vti", {0, 0, 0}, {1, 1, 1}, {4, 3, 2}, steps, "Int32", true);
    writeImage("p/fine.vti", {1, 0, 0}, {1, 1, 1}, {4, 2, 2}, steps, "Int32", true);
    const auto gap = loadAny(blocks());
    ASSERT_EQ(gap.meta().fields[0].storedType, ScalarType::F64);
    const auto values = gap.values<double>();
    EXPECT_EQ(values[6], 12.0);
    EXPECT_TRUE(std::isnan(values[7]));
}

TEST_F(AmrPoints, AFlatSetStaysFlat) {
    writeImage("p/coarse.vti", {0, 0, 5}, {2, 2, 7}, {3, 3, 1}, linear);
    writeImage("p/fine.vti", {0, 0, 5}, {1, 1, 1}, {3, 3, 1}, linear);
    const auto loaded = loadAny(amr());
    EXPECT_EQ(loaded.meta().grid.dims, glm::ivec3(5, 5, 1));
    expectField<double>(loaded, linear, everywhere);
}

TEST_F(AmrPoints, WrongBlocksAreRefused) {
    const auto refusal = [&](const fs::path& file) {
        try {
            (void)loadAny(file);
        } catch (const Error& error) {
            return std::string(error.what());
        }
        ADD_FAILURE() << "it was read";
        return std::string();
    };
    writeImage("p/coarse.vti", {0, 0, 0}, {2, 2, 2}, {3, 3, 3}, linear);
    writeImage("p/fine.vti", {0, 0, 0}, {1, 1, 1}, {3, 3, 3}, linear, "Float64", true);
    expectMentions(refusal(amr()),
                   "fine.vti: its values are those of cells, and those of the first patch of points");
    writeImage("p/fine.vti", {1e9, 0, 0}, {1, 1, 1}, {3, 3, 3}, linear);
    expectMentions(refusal(amr()), "too many points");
    writeImage("p/fine.vti", {0, 0, 0}, {1, -1, 1}, {3, 3, 3}, linear);
    expectMentions(refusal(blocks()), "below zero");
    writeImage("p/fine.vti", {0, 0, 0}, {1, 1, 1}, {3, 3, 3}, linear, "Float32");
    expectMentions(refusal(blocks()), "not those of the first patch");
    writeImage("p/fine.vti", {0, 0, 0}, {1, 1, 1}, {3, 3, 3}, linear);
    expectMentions(refusal(blocks("<DataSet index=\"2\" file=\"../x.vti\"/>")), "own folder");
    write("p/mesh.vtu", "<VTKFile type=\"UnstructuredGrid\" version=\"0.1\" byte_order=\"LittleEndian\">"
                        "<UnstructuredGrid></UnstructuredGrid></VTKFile>\n");
    expectMentions(refusal(blocks("<DataSet index=\"2\" file=\"p/mesh.vtu\"/>")), "mesh.vtu");
    expectMentions(refusal(write("c.vtm", "<VTKFile type=\"vtkMultiBlockDataSet\" version=\"1.0\">"
                                          "<vtkMultiBlockDataSet/></VTKFile>\n")),
                   "names no patches");
}

} // namespace
} // namespace voxsheet::import::testing
