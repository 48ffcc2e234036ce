// Direct volume rendering by a compute shader: one ray per pixel, through the pixel's centre.
//
// Along a ray that is inside the box (in front of the eye) over the depths [a, b], let ds be the depth over
// which the ray advances tile.sampleDistanceVoxels in the drawn level's index frame. The path is cut into
// floor((b - a) / ds) whole stretches from a on, and a shorter rest. Each has one sample in its middle:
// sample i of the whole ones at a + (i + 1/2) ds. Its alpha is 1 - (1 - opacity)^(length / unitLength) with
// the stretch's world length, the rest's own length included, so the whole path counts exactly once. Colour =
// sum of alpha_i rgb_i prod_{j<i} (1 - alpha_j), in 32-bit floats, front to back; a ray may end once its
// transmittance is below 1/1024. Where other volumes are blended (stages/layer_spec.h), opacity and rgb are
// those of all of them at the sample.
//
// Light: where pairsShareLight(), samples 2k and 2k + 1 of the whole stretches have the normal half-way
// between them; not in chunks that an object clips.
// Adaptive (adaptsSampling()): the whole stretches are taken by chunks of chunkSamples(). The cell of empty
// space at a chunk's middle has a stride (stages/sample_strides.h): so many stretches have one sample
// together, in the middle of all of them; at a ray's end of those that are left. In chunks that an object
// clips it is 2 at most. What is said of pairs and their light then holds for the samples of a chunk.
// Pre-integrated (preIntegrates()), a whole stretch shows the mean over the values between its ends instead;
// the rest has its sample.
#pragma once

#include "stages/sample_strides.h"
#include "stages/shared_stages.h"

#include <optional>

namespace voxsheet {

/// What decides a tile's strides; nothing where it is sampled evenly.
[[nodiscard]] std::optional<StrideSettings> strideSettings(const TileSpec& tile,
                                                           const ResidentVolume& volume);

void drawRaycast(SharedStages& stages, const DrawRequest& request);

} // namespace voxsheet
