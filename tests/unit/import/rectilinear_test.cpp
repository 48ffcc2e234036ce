// Rectilinear grids become uniform ones.
#include "import/formats/rectilinear_axes.h"
#include "vtk_fixture.h"

#include <cmath>
#include <limits>

namespace voxsheet::import::testing {
namespace {

class Rectilinear : public FormatsTest {};

const AxisCoordinates kStretched{std::vector<double>{0, 1, 3, 7}, std::vector<double>{5, 4, 2.5},
                                 std::vector<double>{-1, 0, 1}};

double plane(double x, double y, double z) { return 2 * x - 3 * y + 0.5 * z + 1; }

template <typename T>
std::vector<T> onPoints(const AxisCoordinates& points) {
    std::vector<T> values;
    for (const double z : points[2])
        for (const double y : points[1])
            for (const double x : points[0])
                values.push_back(static_cast<T>(plane(x, y, z)));
    return values;
}

template <typename T>
std::vector<T> applied(const UniformResampling& resampling, const std::vector<double>& values,
                       ScalarType type) {
    const auto bytes = visitScalar(
        type, [&]<typename S>() { return bytesOf(std::vector<S>(values.begin(), values.end())); });
    const auto out = resampling.apply(std::as_bytes(std::span(bytes)), type);
    std::vector<T> result(out.size() / sizeof(T));
    std::memcpy(result.data(), out.data(), out.size());
    return result;
}

TEST_F(Rectilinear, PointsAreInterpolatedLinearlyOverTheSameBox) {
    const UniformResampling resampling("a", kStretched, false);
    const auto& grid = resampling.grid();
    EXPECT_FALSE(resampling.isIdentity());
    EXPECT_EQ(grid.dims, glm::ivec3(8, 4, 3)); // steps of 1, of -5/6 (closest: 1), of 1
    EXPECT_EQ(grid.centring, Centring::Point);
    const auto at = [&](int i, int j, int k) {
        return glm::dvec3(grid.worldFromIndex * glm::dvec4(i, j, k, 1));
    };
    EXPECT_EQ(at(0, 0, 0), glm::dvec3(0, 5, -1));
    EXPECT_NEAR(glm::length(at(7, 3, 2) - glm::dvec3(7, 2.5, 1)), 0.0, 1e-12);
    const auto values = applied<double>(resampling, onPoints<double>(kStretched), ScalarType::F64);
    std::size_t index = 0;
    for (int k = 0; k < 3; ++k)
        for (int j = 0; j < 4; ++j)
            for (int i = 0; i < 8; ++i) {
                const auto p = at(i, j, k); // a plane is its own interpolant
                EXPECT_NEAR(values[index++], plane(p.x, p.y, p.z), 1e-9) << i << j << k;
            }
    EXPECT_NE(resampling.note().find("4 x 3 x 3 points became a uniform one of 8 x 4 x 3"), std::string::npos)
        << resampling.note();
}

TEST_F(Rectilinear, SamplesOnPointsHaveTheFilesNumbersAndNaNStaysWhereItIs) {
    const AxisCoordinates points{std::vector<double>{0, 1, 3}, std::vector<double>{0},
                                 std::vector<double>{2}};
    const UniformResampling resampling("a", points, false);
    ASSERT_EQ(resampling.grid().dims, glm::ivec3(4, 1, 1));
    EXPECT_EQ(resampling.resultType(ScalarType::U8), ScalarType::F32);
    EXPECT_EQ(resampling.resultType(ScalarType::I32), ScalarType::F64);
    EXPECT_EQ(applied<float>(resampling, {10, 20, 40}, ScalarType::U8), (std::vector<float>{10, 20, 30, 40}));
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const auto values = applied<float>(resampling, {10, 20, nan}, ScalarType::F32);
    EXPECT_EQ(values[0], 10);
    EXPECT_EQ(values[1], 20) << "its neighbour has no weight there";
    EXPECT_TRUE(std::isnan(values[2]));
    EXPECT_TRUE(std::isnan(values[3]));
}

TEST_F(Rectilinear, CellsGiveTheirValueToTheSamplesInThem) {
    const AxisCoordinates points{std::vector<double>{0, 1, 3, 7}, std::vector<double>{0, 2},
                                 std::vector<double>{5}};
    const UniformResampling resampling("a", points, true);
    EXPECT_EQ(resampling.grid().dims, glm::ivec3(7, 1, 1));
    EXPECT_EQ(resampling.grid().centring, Centring::Cell);
    EXPECT_EQ(glm::dvec3(resampling.grid().worldFromIndex[3]), glm::dvec3(0.5, 1, 5));
    EXPECT_EQ(resampling.resultType(ScalarType::I16), ScalarType::I16);
    EXPECT_EQ(applied<short>(resampling, {-7, 300, 2}, ScalarType::I16),
              (std::vector<short>{-7, 300, 300, 2, 2, 2, 2}));
}

TEST_F(Rectilinear, EquallySpacedOnesStayAsTheyAre) {
    const AxisCoordinates points{std::vector<double>{1, 1.5, 2}, std::vector<double>{3, 1},
                                 std::vector<double>{0}};
    const UniformResampling resampling("a", points, false);
    EXPECT_TRUE(resampling.isIdentity());
    EXPECT_EQ(resampling.note(), "");
    EXPECT_EQ(resampling.grid().dims, glm::ivec3(3, 2, 1));
    EXPECT_EQ(spacingWorld(resampling.grid()), glm::dvec3(0.5, 2, 1));
    EXPECT_EQ(resampling.resultType(ScalarType::U8), ScalarType::U8);
}

TEST_F(Rectilinear, AxesStayWithinFourTimesTheirSamples) {
    const AxisCoordinates points{std::vector<double>{0, 1e-9, 1}, std::vector<double>{0},
                                 std::vector<double>{0}};
    EXPECT_EQ(UniformResampling("a", points, false).grid().dims.x, 9);
    for (const auto& wrong :
         {std::vector<double>{0, 1, 1}, std::vector<double>{0, 2, 1}, std::vector<double>{},
          std::vector<double>{0, std::numeric_limits<double>::quiet_NaN(), 2},
          std::vector<double>{0, std::numeric_limits<double>::infinity()}})
        EXPECT_THROW(UniformResampling("a", {wrong, std::vector<double>{0}, std::vector<double>{0}}, false),
                     InvalidInput);
}

std::string joined(const std::vector<double>& numbers) {
    std::string text;
    for (const double number : numbers)
        text += std::to_string(number) + " ";
    return text;
}

std::string legacyFile(const AxisCoordinates& points, const std::vector<double>& values) {
    std::string text = "# vtk DataFile Version 3.0\nstretched\nASCII\nDATASET RECTILINEAR_GRID\nDIMENSIONS";
    for (const auto& axis : points)
        text += " " + std::to_string(axis.size());
    for (std::size_t axis = 0; axis < 3; ++axis)
        text += std::string("\n") + "XYZ"[axis] + "_COORDINATES " + std::to_string(points[axis].size()) +
                " double\n" + joined(points[axis]);
    return text + "\nPOINT_DATA " + std::to_string(values.size()) +
           "\nSCALARS s double\nLOOKUP_TABLE default\n" + joined(values) + "\n";
}

std::string xmlFile(const AxisCoordinates& points, const std::vector<double>& values) {
    const auto array = [](const std::string& name, const std::vector<double>& numbers) {
        return "<DataArray type=\"Float64\" Name=\"" + name + "\" format=\"ascii\">" + joined(numbers) +
               "</DataArray>\n";
    };
    std::string extent;
    for (const auto& axis : points)
        extent += "0 " + std::to_string(axis.size() - 1) + " ";
    return "<VTKFile type=\"RectilinearGrid\" version=\"1.0\" byte_order=\"LittleEndian\">\n<RectilinearGrid "
           "WholeExtent=\"" +
           extent + "\">\n<Piece Extent=\"" + extent + "\">\n<PointData>\n" + array("s", values) +
           "</PointData>\n<Coordinates>\n" + array("x", points[0]) + array("y", points[1]) +
           array("z", points[2]) + "</Coordinates>\n</Piece>\n</RectilinearGrid>\n</VTKFile>\n";
}

TEST_F(Rectilinear, LegacyFilesAreResampledAndSaySo) {
    const auto values = onPoints<double>(kStretched);
    const auto loaded = loadAny(write("a.vtk", legacyFile(kStretched, values)));
    EXPECT_EQ(loaded.meta().grid, UniformResampling("a", kStretched, false).grid());
    EXPECT_EQ(loaded.values<double>(),
              applied<double>(UniformResampling("a", kStretched, false), values, ScalarType::F64));
    ASSERT_FALSE(loaded.meta().notes.empty());
    expectMentions(loaded.meta().notes.front(), "Resampled");
    EXPECT_EQ(loaded.meta().sourceType, ScalarType::F64);
    auto text = legacyFile(kStretched, values);
    text.replace(text.find("Y_COORDINATES 3"), 15, "Y_COORDINATES 2");
    expectMentions(sentenceOf(write("b.vtk", text)), "Y_COORDINATES");
}

TEST_F(Rectilinear, XmlFilesGiveTheSameVolume) {
    if (ReaderRegistry().descriptions().find(".vtr") == std::string::npos)
        GTEST_SKIP() << "this build is without VTK";
    const auto values = onPoints<double>(kStretched);
    const auto legacy = loadAny(write("a.vtk", legacyFile(kStretched, values)));
    const auto xml = loadAny(write("a.vtr", xmlFile(kStretched, values)));
    EXPECT_EQ(xml.meta().grid, legacy.meta().grid);
    EXPECT_EQ(xml.values<double>(), legacy.values<double>());
    expectMentions(xml.meta().notes.front(), "Resampled");
    auto falling = kStretched;
    falling[0] = {0, 3, 1, 7};
    expectMentions(sentenceOf(write("b.vtr", xmlFile(falling, values))), "neither rise nor fall");
    const auto text = xmlFile(kStretched, values);
    for (std::size_t i = 1; i < 16; ++i)
        (void)sentenceOf(write("cut.vtr", text.substr(0, (text.size() - 12) * i / 16)));
}

} // namespace
} // namespace voxsheet::import::testing
