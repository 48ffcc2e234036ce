// The engine with a renderer: from files to the picture of a sheet.
#include "engine_picture_fixture.h"

namespace voxsheet::engine {
namespace {

TEST_F(EnginePicture, AVolumeIsSeenWithNoFurtherSetting) {
    open({ball("ball.nrrd", 32)});
    SheetImageRequest request;
    request.annotate = false;
    request.sizePixels = {200, 200};
    const SheetImage image = engine->renderSheet(request);
    EXPECT_EQ(image.failedCells, 0);
    EXPECT_TRUE(image.final);
    const unsigned char* middle = pixel(image.pixels, 100, 100);
    const unsigned char* corner = pixel(image.pixels, 10, 10);
    EXPECT_GT(middle[0] + middle[1] + middle[2], corner[0] + corner[1] + corner[2] + 60);
    EXPECT_EQ(corner[3], 255);
}

TEST_F(EnginePicture, EqualIdentitiesHaveEqualPixels) {
    open({ball("ball.nrrd", 24)});
    SheetImageRequest request;
    request.sizePixels = {160, 160};
    const SheetImage first = engine->renderSheet(request);
    const SheetImage second = engine->renderSheet(request);
    EXPECT_EQ(first.identity, second.identity);
    EXPECT_EQ(first.pixels.rgba8, second.pixels.rgba8);
    request.view.request["camera.azimuth"] = 12.0;
    request.view.request["transfer.opacity"] = sheet::OpacityStops{{0.0, 0.0}, {1.0, 0.9}};
    const SheetImage changed = engine->renderSheet(request);
    EXPECT_NE(first.identity, changed.identity);
    EXPECT_NE(first.pixels.rgba8, changed.pixels.rgba8);
}

TEST_F(EnginePicture, ABadFileIsALabelledTileAmongTheOthers) {
    const fs::path bad = ball("bad.nrrd", 24);
    fs::resize_file(bad, 500);
    open({bad, ball("good.nrrd", 24)});
    SheetImageRequest request;
    request.sizePixels = {480, 260};
    request.title = "Two balls";
    SheetImage image;
    try {
        image = engine->renderSheet(request);
    } catch (const Unsupported& error) {
        GTEST_SKIP() << error.what();
    }
    EXPECT_EQ(image.failedCells, 1);
    EXPECT_EQ(image.pixels.size, glm::ivec2(480, 260));
    int reddish = 0; // the error's code
    for (int y = 0; y < 260; ++y)
        for (int x = 0; x < 240; ++x) {
            const unsigned char* p = pixel(image.pixels, x, y);
            reddish += p[0] > 150 && p[2] < 140 ? 1 : 0;
        }
    EXPECT_GT(reddish, 20);
}

TEST_F(EnginePicture, ATransparentBackgroundStaysTransparentInFloatsToo) {
    open({ball("ball.nrrd", 24)});
    SheetImageRequest request;
    request.annotate = false;
    request.sizePixels = {120, 120};
    request.format = PixelFormat::Rgba32F;
    engine->apply(sheet::SetStyle{
        "Sheet1", sheet::Layer::sheet(), {{"background", sheet::Colour{{0, 0, 0, 0}}}}, false});
    const SheetImage image = engine->renderSheet(request);
    ASSERT_EQ(image.pixels.rgba32f.size(), 120U * 120U * 4U);
    EXPECT_EQ(image.pixels.rgba32f[3], 0.0F);
    EXPECT_GT(image.pixels.rgba32f[(60 * 120 + 60) * 4 + 3], 0.2F);
}

TEST_F(EnginePicture, OneTextureServesAllCellsOfADataset) {
    open({ball("ball.nrrd", 24)});
    const std::string name = engine->datasets().front().name;
    engine->apply(sheet::InsertLines{"Sheet1", sheet::Axis::Columns, 1, 3});
    for (const char* cell : {"B1", "C1", "D1"})
        engine->apply(sheet::SetSource{"Sheet1", sheet::parseAddress(cell), name});
    SheetImageRequest request;
    request.annotate = false;
    request.sizePixels = {400, 110};
    EXPECT_EQ(engine->renderSheet(request).failedCells, 0);
    EXPECT_EQ(engine->residency().textures, 1);
}

/// What the picture shows and what a probe under the pixel meets, at every fourth pixel.
struct Agreement {
    int shown = 0;
    int differ = 0;
};

TEST_F(EnginePicture, PickingMeetsWhatThePictureShows) {
    open({ball("ball.nrrd", 40)});
    for (const char* technique : {"isosurface", "surface"}) {
        for (const char* mode : {"probe", "clip"}) {
            View view;
            view.request = {
                {"technique", std::string(technique)},
                {"background", sheet::Colour{{0, 0, 0, 0}}},
                {"clip.shape", std::string("torus")},
                {"clip.mode", std::string(mode)},
                {"clip.transform", sheet::NumberTable{{{0.1, 0, 0, 40, 20, 0, 0.9, 0.9, 0.9}}}},
                {"clip.planes", sheet::NumberTable{{{1, 1, 0, 0.3}}}},
            };
            TileQuality quality;
            quality.sizePixels = {200, 200};
            const PreparedTile tile = engine->prepareTile(*engine->snapshot(), "", {0, 0}, view, quality);
            ASSERT_TRUE(tile.spec) << tile.message;
            const FrameResult frame = engine->render({.tiles = {*tile.spec}}, FramePriority::Final).get();
            ASSERT_EQ(frame.tiles.at(0).error, "");
            Agreement agreement;
            for (int y = 2; y < 200; y += 4) {
                for (int x = 2; x < 200; x += 4) {
                    const bool shown = pixel(frame.tiles[0], x, y)[3] > 0;
                    const auto values = engine->probePixel("", {0, 0}, view, {x + 0.5, y + 0.5}, {200, 200});
                    const bool met = !values.empty() && values[0].hit != "middle";
                    agreement.shown += shown ? 1 : 0;
                    agreement.differ += shown != met ? 1 : 0;
                }
            }
            EXPECT_GT(agreement.shown, 100) << technique << ", " << mode;
            // Silhouettes: the picture's floats against double precision.
            EXPECT_LE(agreement.differ, agreement.shown / 100) << technique << ", " << mode;
        }
    }
}

TEST_F(EnginePicture, ExportedSheetsShowTheCrosshairWhereItLies) {
    open({ball("ball.nrrd", 32)});
    SheetImageRequest request;
    request.sizePixels = {300, 300};
    request.view.all["technique"] = std::string("plane");
    request.view.all["transfer.map"] = std::string("grey");
    const SheetImage without = engine->renderSheet(request);
    request.view.all["plane.crosshair"] = glm::dvec3(0.5, 0.75, 0.5);
    const SheetImage with = engine->renderSheet(request);
    EXPECT_NE(with.identity, without.identity);
    const auto yellowIn = [](const TilePixels& picture, int x, int y) {
        const unsigned char* p = pixel(picture, x, y);
        return p[0] > p[2] + 30 && p[1] > p[2] + 30;
    };
    // Rows that are yellow at the picture's left and right, columns that are so at its top and bottom.
    std::vector<int> rows;
    std::vector<int> columns;
    for (int at = 40; at < 290; ++at) {
        if (yellowIn(with.pixels, 30, at)) rows.push_back(at);
        if (yellowIn(with.pixels, at, 290)) columns.push_back(at);
    }
    ASSERT_FALSE(rows.empty());
    ASSERT_FALSE(columns.empty());
    EXPECT_LE(rows.size(), 2U) << "one smooth line";
    EXPECT_LE(columns.size(), 2U);
    EXPECT_LT(rows.front(), columns.front()) << "a quarter of the box above the middle, which x is at";
    for (int at = 40; at < 290; ++at)
        EXPECT_FALSE(yellowIn(without.pixels, 30, at) || yellowIn(without.pixels, at, 290));
    request.annotate = false;
    EXPECT_FALSE(yellowIn(engine->renderSheet(request).pixels, 150, 290)) << "an annotation";
}

TEST_F(EnginePicture, AClipObjectMovesByItsMatrixAloneAndOneTextureServesAllCells) {
    open({ball("a.nrrd", 24), ball("b.nrrd", 24)});
    SheetImageRequest request;
    request.annotate = false;
    request.sizePixels = {220, 110};
    request.view.request = {{"clip.shape", std::string("A1 > 100")}};
    static_cast<void>(engine->renderSheet(request));
    ASSERT_TRUE(engine->waitIdle(60));
    const SheetImage first = engine->renderSheet(request);
    ASSERT_TRUE(first.final);
    ASSERT_EQ(first.failedCells, 0);
    EXPECT_EQ(engine->residency().textures, 3) << "two volumes and one clip object";
    const auto uploaded = engine->residency().uploadedBytes;
    request.view.request["clip.transform"] = sheet::NumberTable{{{0.2, 0, 0, 0, 30, 0, 0.7, 0.7, 0.7}}};
    const SheetImage moved = engine->renderSheet(request);
    EXPECT_EQ(engine->residency().uploadedBytes, uploaded);
    EXPECT_NE(first.pixels.rgba8, moved.pixels.rgba8);
    EXPECT_NE(first.identity, moved.identity);
}

} // namespace
} // namespace voxsheet::engine
