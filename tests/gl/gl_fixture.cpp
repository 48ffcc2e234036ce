#include "gl_fixture.h"

#include "base/errors.h"

#include <cstring>
#include <iostream>

namespace voxsheet {

bool haveOpenGl() {
    static const bool usable = [] {
        try {
            const gpu::Context probe;
            return true;
        } catch (const GpuError& error) {
            std::cout << "no OpenGL: " << error.what() << '\n';
            return false;
        }
    }();
    return usable;
}

void GlTest::SetUp() {
    if (!haveOpenGl()) GTEST_SKIP() << "no EGL device gives OpenGL 4.5";
    context_ = std::make_unique<gpu::Context>();
}

void GlTest::TearDown() {
    if (!context_) return;
    EXPECT_NO_THROW(context_->checkErrors("the test"));
    EXPECT_EQ(context_->counts(), gpu::ObjectCounts{}) << "GL objects were left behind";
}

namespace {

struct StoreSample {
    std::vector<std::byte>& bytes;
    std::size_t index;
    double value;
    template <typename T>
    void operator()() const {
        const T sample = static_cast<T>(value);
        std::memcpy(bytes.data() + index * sizeof(T), &sample, sizeof(T));
    }
};

} // namespace

void addVolume(MemoryVolumeProvider& provider, const std::string& key, glm::ivec3 dims, ScalarType type,
               const FieldFunction& value, glm::bvec3 periodic, double valueScale, double valueOffset) {
    DatasetMeta meta;
    meta.key = key;
    meta.grid.dims = dims;
    meta.grid.periodic = periodic;
    meta.grid.centring = Centring::Cell;
    meta.sourceType = type;
    FieldMeta field;
    field.name = "value";
    field.storedType = type;
    field.valueScale = valueScale;
    field.valueOffset = valueOffset;
    meta.fields.push_back(field);
    std::vector<std::byte> samples(static_cast<std::size_t>(sampleCount(dims)) * scalarBytes(type));
    std::size_t index = 0;
    for (int z = 0; z < dims.z; ++z)
        for (int y = 0; y < dims.y; ++y)
            for (int x = 0; x < dims.x; ++x)
                visitScalar(type, StoreSample{samples, index++, value(x, y, z)});
    provider.add(std::move(meta), {std::move(samples)});
}

std::shared_ptr<const TransferTable> brightTable(double high) {
    TransferFunction function;
    function.colours = {{0.0, {1.0, 0.0, 0.0}}, {1.0, {1.0, 1.0, 1.0}}};
    function.opacities = {{0.0, 0.0}, {1.0, 0.5}};
    function.low = 0.0;
    function.high = high;
    return buildTransferTable(function);
}

TileSpec frontTile(const std::string& dataset, int dim, double high, int pixels) {
    TileSpec tile;
    tile.dataset = dataset;
    tile.transfer = brightTable(high);
    tile.sizePixels = glm::ivec2(pixels);
    tile.camera.projection = Projection::Orthographic;
    tile.camera.heightWorld = dim;
    const double centre = 0.5 * (dim - 1);
    // The eye stands in front, at +z, looking along -z.
    tile.camera.viewFromWorld[3] = glm::dvec4(-centre, -centre, -centre - 2.0 * dim, 1.0);
    return tile;
}

} // namespace voxsheet
