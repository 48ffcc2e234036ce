// Planes of a crystal's lattice by Miller indices, from file to picture.
#include "engine_picture_fixture.h"

#include <algorithm>
#include <numbers>

namespace voxsheet::engine {
namespace {

/// A triclinic cell with the plane wave cos(2 pi hkl . f) in it, f the fractions along its vectors.
fs::path waveFile(const fs::path& file, const glm::dvec3& hkl) {
    constexpr int edge = 48;
    std::ofstream out(file, std::ios::binary);
    out << "NRRD0004\ntype: float\nendian: little\ndimension: 3\nsizes: 48 48 48\nspace dimension: 3\n"
           "space directions: (0.1,0,0) (0.03,0.12,0) (-0.02,0.04,0.09)\nspace origin: (1,2,3)\nencoding: "
           "raw\n\n";
    for (int k = 0; k < edge; ++k)
        for (int j = 0; j < edge; ++j)
            for (int i = 0; i < edge; ++i) {
                const double turns = glm::dot(hkl, glm::dvec3(i, j, k)) / edge;
                const auto value = static_cast<float>(std::cos(2.0 * std::numbers::pi * turns));
                out.write(reinterpret_cast<const char*>(&value), sizeof value);
            }
    return file;
}

class HklPicture : public EnginePicture {
protected:
    void openPeriodic(const fs::path& file) {
        ImportRequest request;
        request.files = {file};
        request.options["periodic"] = true;
        engine->importDatasets({request});
        ASSERT_TRUE(engine->waitIdle(60));
    }

    /// Grey from -1 to 1 on the plane (hkl) at a place from 0 to 1 through the cell.
    static View viewOf(const glm::dvec3& hkl, double position) {
        View view;
        view.request = {{"technique", std::string("plane")},
                        {"plane.axis", std::string("hkl")},
                        {"plane.hkl", hkl},
                        {"plane.position", position},
                        {"background", sheet::Colour{{0, 0, 0, 0}}},
                        {"transfer.points", sheet::ColourStops{{0.0, sheet::Colour{{0, 0, 0, 255}}},
                                                               {1.0, sheet::Colour{{255, 255, 255, 255}}}}},
                        {"range.mode", std::string("fixed")},
                        {"range.min", -1.0},
                        {"range.max", 1.0}};
        return view;
    }

    /// The values that the picture shows.
    std::vector<double> shown(const View& view) {
        TileQuality quality;
        quality.sizePixels = {120, 120};
        const PreparedTile tile = engine->prepareTile(*engine->snapshot(), "", {0, 0}, view, quality);
        EXPECT_TRUE(tile.spec) << tile.message;
        std::vector<double> values;
        if (!tile.spec) return values;
        const FrameResult frame = engine->render({.tiles = {*tile.spec}}, FramePriority::Final).get();
        for (int y = 0; y < 120; ++y)
            for (int x = 0; x < 120; ++x)
                if (const auto* p = pixel(frame.tiles.at(0), x, y); p[3] == 255)
                    values.push_back(p[0] / 127.5 - 1.0);
        return values;
    }
};

TEST_F(HklPicture, APlaneWaveIsConstantOnItsLatticePlanesAndNowhereElse) {
    for (const glm::dvec3 hkl : {glm::dvec3(1, 1, 1), glm::dvec3(2, -1, 0), glm::dvec3(0, 0, 3)}) {
        openPeriodic(waveFile(folder / ("wave" + std::to_string(int(hkl.x)) + ".nrrd"), hkl));
        const auto name = engine->datasets().back().name;
        for (const auto& dataset : engine->datasets())
            if (dataset.name == "wave" + std::to_string(int(hkl.x)) + ".nrrd")
                engine->apply(sheet::SetSource{"Sheet1", {0, 0}, dataset.name});
        double lowest = 0.0; // hkl . f over the cell
        double highest = 0.0;
        for (int axis = 0; axis < 3; ++axis)
            (hkl[axis] < 0.0 ? lowest : highest) += hkl[axis];
        for (const double position : {0.31, 0.5, 0.66}) {
            const auto values = shown(viewOf(hkl, position));
            ASSERT_GT(values.size(), 1000U);
            const auto [least, most] = std::minmax_element(values.begin(), values.end());
            const double expected =
                std::cos(2.0 * std::numbers::pi * (lowest + position * (highest - lowest)));
            // Interpolation between samples lowers a wave of 16 samples or more by (pi / 16)^2 / 2 at most;
            // colours have 8 bits.
            constexpr double tolerance = 0.02 + 1.5 / 127.5;
            EXPECT_NEAR(*least, expected, tolerance) << hkl.x << hkl.y << hkl.z << " at " << position;
            EXPECT_NEAR(*most, expected, tolerance) << hkl.x << hkl.y << hkl.z << " at " << position;
        }
        // hkl . f then runs through a whole period, as the index that is one more does.
        const glm::dvec3 more = hkl.z == 0.0 || hkl.x == 1.0 ? glm::dvec3(0, 0, 1) : glm::dvec3(1, 0, 0);
        const auto others = shown(viewOf(hkl + more, 0.5));
        const auto [least, most] = std::minmax_element(others.begin(), others.end());
        EXPECT_GT(*most - *least, 1.0) << "another plane crosses crests and troughs";
    }
}

TEST_F(HklPicture, DataWithoutALatticeSayWhatToDo) {
    open({ball("ball.nrrd", 24)});
    TileQuality quality;
    quality.sizePixels = {64, 64};
    const View view = viewOf({1, 1, 0}, 0.5);
    try {
        static_cast<void>(engine->prepareTile(*engine->snapshot(), "", {0, 0}, view, quality));
        FAIL() << "drawn";
    } catch (const InvalidInput& error) {
        EXPECT_EQ(error.field(), "plane.axis");
    }
}

} // namespace
} // namespace voxsheet::engine
