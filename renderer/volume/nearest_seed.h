// The nearest of a set of samples, for every sample of a grid.
#pragma once

#include <glm/glm.hpp>

#include <cstdint>
#include <limits>
#include <vector>

namespace voxsheet {

inline constexpr std::uint32_t kNoSeed = std::numeric_limits<std::uint32_t>::max();

/// Exact Euclidean distance transform (Felzenszwalb & Huttenlocher, Theory of Computing 8, 2012) that keeps
/// the argument of the minimum.
/// \param seeds  per sample, x fastest: its own index if it is a seed, else kNoSeed
/// On return: the index of a nearest seed; kNoSeed only if there is none at all.
void findNearestSeeds(const glm::ivec3& dims, std::vector<std::uint32_t>& seeds);

} // namespace voxsheet
