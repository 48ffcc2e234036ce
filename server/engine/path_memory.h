// What `voxsheet bench calibrate` found, one small JSON file for each device: a device is what draws and what
// it draws with, so that another GPU, driver, processor or number of threads finds nothing.
#pragma once

#include "frame/path_choice.h"
#include "gpu/render_device.h"

#include <filesystem>
#include <string>
#include <vector>

namespace voxsheet::engine {

/// One line each: vendor, renderer and version of OpenGL, workarounds in force, processor, threads
/// (threadCount()), and kPathFormat.
[[nodiscard]] std::string pathDevice(const RenderDevice& device);

/// Below `folder`, named by a hash of `device` (pathDevice).
[[nodiscard]] std::filesystem::path pathMemoryFile(const std::filesystem::path& folder,
                                                   const std::string& device);

/// Replaces what is remembered of this device. Throws IoError.
void rememberPaths(const std::filesystem::path& folder, const RenderDevice& device,
                   const std::vector<CalibratedPath>& paths);

/// Nothing if nothing is remembered, or `folder` is empty. A file that cannot be read is named in a warning,
/// and counts as none: pictures do not fail by it.
[[nodiscard]] std::vector<CalibratedPath> rememberedPaths(const std::filesystem::path& folder,
                                                          const RenderDevice& device);

/// True if there was something to forget. Throws IoError.
bool forgetPaths(const std::filesystem::path& folder, const RenderDevice& device);

} // namespace voxsheet::engine
