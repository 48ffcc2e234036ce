// Shared by the GL tests: skips where there is no OpenGL, and small volumes with known values.
#pragma once

#include "frame/frame_spec.h"
#include "gpu/context.h"
#include "volume/memory_volume_provider.h"

#include <gtest/gtest.h>

#include <functional>
#include <memory>
#include <string>

namespace voxsheet {

/// False (with the reason in the test's output) when no EGL device gives OpenGL 4.5.
[[nodiscard]] bool haveOpenGl();

/// A test with a context that is current, and that must have no GL object left at the end.
class GlTest : public ::testing::Test {
protected:
    void SetUp() override;
    void TearDown() override;
    gpu::Context& context() { return *context_; }

private:
    std::unique_ptr<gpu::Context> context_;
};

using FieldFunction = std::function<double(int x, int y, int z)>;

/// Adds a dataset of one field and step; the values are converted to the stored type.
void addVolume(MemoryVolumeProvider& provider, const std::string& key, glm::ivec3 dims, ScalarType type,
               const FieldFunction& value, glm::bvec3 periodic = glm::bvec3(false), double valueScale = 1.0,
               double valueOffset = 0.0);

/// Red to white over [0, high], opaque enough to be seen.
[[nodiscard]] std::shared_ptr<const TransferTable> brightTable(double high);

/// The volume from the front, orthographic, filling the picture.
[[nodiscard]] TileSpec frontTile(const std::string& dataset, int dim, double high, int pixels);

} // namespace voxsheet
