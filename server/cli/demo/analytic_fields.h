// Volumes with a formula: a test of reconstruction and a short time series.
#pragma once

#include <vector>

namespace voxsheet::cli {

/// The test signal of Marschner & Lobb (Visualization '94, equation 4 with f_M = 6, alpha = 0.25) on n^3
/// samples over
/// [-1, 1]^3, x fastest; values in [0, 1].
[[nodiscard]] std::vector<float> marschnerLobb(int n);

/// Probability density of a hydrogen atom in the superposition (1s + 2p_z) / sqrt(2), in 1/a0^3, on n^3
/// samples over
/// [-extent, extent]^3 Bohr radii, at a phase in [0, 1) of the beat (period 2 pi hbar / (E_2 - E_1) = 0.405
/// fs):
///   |psi|^2 = (psi_1s^2 + psi_2p^2) / 2 + psi_1s psi_2p cos(2 pi phase).
[[nodiscard]] std::vector<float> hydrogenBeat(int n, double extent, double phase);

} // namespace voxsheet::cli
