// Surfaces as volumes of signed distances: against closed forms, and what is refused.
#include "mesh_bytes.h"
#include "vtk_fixture.h"

#include <algorithm>
#include <chrono>
#include <cmath>

namespace voxsheet::import::testing {
namespace {

class Mesh : public FormatsTest {
protected:
    /// The largest difference of the volume from a distance, over all of its samples.
    template <typename Distance>
    static double worst(const Loaded& loaded, Distance distance) {
        const auto values = loaded.values<float>();
        const auto& grid = loaded.meta().grid;
        double largest = 0.0;
        std::size_t i = 0;
        for (int z = 0; z < grid.dims.z; ++z)
            for (int y = 0; y < grid.dims.y; ++y)
                for (int x = 0; x < grid.dims.x; ++x)
                    largest = std::max(largest, std::abs(double(values[i++]) -
                                                         distance(glm::dvec3(grid.worldFromIndex *
                                                                             glm::dvec4(x, y, z, 1.0)))));
        return largest;
    }
    static ImportOptions withResolution(int samples) {
        ImportOptions options;
        options.resolution = samples;
        return options;
    }
    std::string refused(const std::string& name, const std::string& bytes) {
        return sentenceOf(write(name, bytes));
    }
};

double cubeDistance(const glm::dvec3& p, double half) {
    const auto q = glm::abs(p) - half;
    return glm::length(glm::max(q, 0.0)) + std::min(std::max(q.x, std::max(q.y, q.z)), 0.0);
}

TEST_F(Mesh, EveryFormatGivesTheDistancesOfTheCube) {
    const auto cube = cubeMesh(2.0);
    for (const auto& [name, bytes] : std::map<std::string, std::string>{{"a.stl", binaryStl(cube)},
                                                                        {"b.stl", textStl(cube)},
                                                                        {"c.obj", obj(cube)},
                                                                        {"d.ply", textPly(cube)},
                                                                        {"e.ply", binaryPly(cube, false)},
                                                                        {"f.ply", binaryPly(cube, true)},
                                                                        {"no_extension", binaryStl(cube)}}) {
        const auto loaded = loadAny(write(name, bytes), withResolution(24));
        const auto& meta = loaded.meta();
        EXPECT_EQ(meta.fields.at(0).quantity, "signed distance") << name;
        EXPECT_EQ(std::max({meta.grid.dims.x, meta.grid.dims.y, meta.grid.dims.z}), 24) << name;
        EXPECT_LT(worst(loaded, [](const glm::dvec3& p) { return cubeDistance(p, 2.0); }), 1e-5) << name;
        const auto low = glm::dvec3(meta.grid.worldFromIndex[3]);
        EXPECT_NEAR(low.x, -2.0 - 0.12 * 4.0, 1e-6) << "a margin of 12 %";
    }
}

TEST_F(Mesh, SpheresAndToriWithinTheirChords) {
    // A chord over an edge of length e of a sphere of radius r lies at most e^2 / 8 r inside it; a face twice
    // as deep.
    const auto sphere = loadAny(write("sphere.stl", binaryStl(sphereMesh(10.0, 5))), withResolution(40));
    EXPECT_EQ(sphere.meta().format, "stl");
    EXPECT_LT(worst(sphere, [](const glm::dvec3& p) { return glm::length(p) - 10.0; }), 0.02);
    const auto torus =
        loadAny(write("torus.ply", textPly(torusMesh(10.0, 3.0, 160, 64))), withResolution(64));
    EXPECT_LT(
        worst(torus, [](const glm::dvec3& p) { return std::hypot(std::hypot(p.x, p.y) - 10.0, p.z) - 3.0; }),
        0.02);
}

TEST_F(Mesh, RepairsAreNoted) {
    auto cube = cubeMesh(2.0);
    flipped(cube);
    const auto insideOut = loadAny(write("flipped.obj", obj(cube)), withResolution(16));
    EXPECT_LT(worst(insideOut, [](const glm::dvec3& p) { return cubeDistance(p, 2.0); }), 1e-5);
    EXPECT_FALSE(insideOut.meta().notes.empty());
    cube = cubeMesh(2.0);
    std::swap(cube.triangles[3][0], cube.triangles[3][1]);
    const auto oneTurned = loadAny(write("turned.obj", obj(cube)), withResolution(16));
    EXPECT_LT(worst(oneTurned, [](const glm::dvec3& p) { return cubeDistance(p, 2.0); }), 1e-5);
    EXPECT_FALSE(oneTurned.meta().notes.empty());
    cube = cubeMesh(2.0);
    cube.triangles.push_back({0, 0, 1});
    EXPECT_LT(worst(loadAny(write("flat.obj", obj(cube)), withResolution(16)),
                    [](const glm::dvec3& p) { return cubeDistance(p, 2.0); }),
              1e-5);
}

TEST_F(Mesh, ACavityIsOutside) {
    auto shell = cubeMesh(3.0);
    auto inner = cubeMesh(1.0);
    flipped(inner);
    append(shell, inner);
    const auto loaded = loadAny(write("shell.stl", textStl(shell)), withResolution(32));
    EXPECT_LT(
        worst(loaded,
              [](const glm::dvec3& p) { return std::max(cubeDistance(p, 3.0), -cubeDistance(p, 1.0)); }),
        1e-5);
}

TEST_F(Mesh, OpenCrowdedAndSelfIntersectingSurfacesAreRefusedWithTheirPlace) {
    auto open = cubeMesh(2.0);
    open.triangles.pop_back();
    expectMentions(refused("open.stl", textStl(open)), "3 edges");
    auto crowded = cubeMesh(2.0);
    crowded.points.emplace_back(0.0, 0.0, 9.0);
    crowded.triangles.push_back({4, 5, 8});
    expectMentions(refused("crowded.obj", obj(crowded)), "edge");
    auto crossing = cubeMesh(2.0);
    append(crossing, cubeMesh(2.0), {1.5, 1.1, 0.7});
    const auto sentence = refused("crossing.ply", textPly(crossing));
    expectMentions(sentence, "cut");
    expectMentions(sentence, "(");
}

TEST_F(Mesh, DamagedAndLyingFilesEndInASentenceWithinTwoSeconds) {
    const auto cube = cubeMesh(2.0);
    std::map<std::string, std::string> files;
    const auto stl = binaryStl(cube);
    files["short.stl"] = stl.substr(0, stl.size() - 7);
    files["longer.stl"] = stl + "xxxxx";
    files["head.stl"] = stl.substr(0, 40);
    auto lying = stl;
    put(lying, std::uint32_t{0});
    std::memset(lying.data() + 80, 0xFF, 4);
    files["lying.stl"] = lying;
    files["cut.stl"] = textStl(cube).substr(0, 300);
    auto nan = cube;
    nan.points[3].y = std::nan("");
    files["nan.stl"] = binaryStl(nan);
    auto infinite = cube;
    infinite.points[1].x = HUGE_VAL;
    files["inf.ply"] = binaryPly(infinite, false);
    const auto ply = binaryPly(cube, false);
    files["short.ply"] = ply.substr(0, ply.size() - 3);
    std::string many = textPly(cube);
    many.replace(many.find("element vertex 8"), 16, "element vertex 4000000000");
    files["many.ply"] = many;
    files["index.obj"] = obj(cube) + "f 1 2 99\n";
    files["zero.obj"] = obj(cube) + "f 1 2 0\n";
    files["points.obj"] = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
    files["empty.stl"] = "solid nothing\nendsolid nothing\n";
    files["line.obj"] = "v 0 0 0\nv 0 0 0\nv 0 0 0\nf 1 2 3\n";
    for (const auto& [name, bytes] : files) {
        const auto start = std::chrono::steady_clock::now();
        const auto sentence = refused(name, bytes);
        EXPECT_LT(std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count(), 2.0)
            << name;
        EXPECT_GT(sentence.size(), 20U) << name;
    }
}

TEST_F(Mesh, OptionsOfVolumesDoNotFit) {
    ImportOptions options;
    options.spacing = glm::dvec3(2.0);
    EXPECT_THROW((void)loadAny(write("cube.stl", binaryStl(cubeMesh(1.0))), options), InvalidInput);
}

} // namespace
} // namespace voxsheet::import::testing
