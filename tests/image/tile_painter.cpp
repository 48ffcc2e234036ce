#include "image/tile_painter.h"

#include <chrono>
#include <utility>

namespace voxsheet::image {
namespace {

constexpr std::uint64_t kBudgetBytes = std::uint64_t{1} << 30;

} // namespace

TilePainter::TilePainter() : TilePainter(std::make_shared<MemoryVolumeProvider>()) {}

TilePainter::TilePainter(std::shared_ptr<MemoryVolumeProvider> volumes)
    : volumes_(std::move(volumes)), withShapes_(std::make_shared<const ClipShapeProvider>(volumes_)),
      residency_(context_, withShapes_, kBudgetBytes), techniques_(context_) {}

// Another context may be current by now; GL objects are destroyed in their own.
TilePainter::~TilePainter() { context_.makeCurrent(); }

fields::Picture TilePainter::draw(const TileSpec& tile) {
    context_.makeCurrent();
    const auto volumes = techniques_.acquire(residency_, tile);
    gpu::Texture target(context_, GL_TEXTURE_2D, GL_RGBA32F, {tile.sizePixels, 1});
    std::vector<float> floats(static_cast<std::size_t>(tile.sizePixels.x) *
                              static_cast<std::size_t>(tile.sizePixels.y) * 4);
    glFinish();
    const auto start = std::chrono::steady_clock::now();
    techniques_.draw(tile, volumes, target);
    glGetTextureImage(target.id(), 0, GL_RGBA, GL_FLOAT, static_cast<GLsizei>(floats.size() * sizeof(float)),
                      floats.data());
    lastMs_ = std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
    context_.checkErrors("reading a tile");
    return fields::pictureFromFloats(tile.sizePixels, floats);
}

} // namespace voxsheet::image
