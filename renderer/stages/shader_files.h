// The .glsl files of renderer/, embedded by the build; paths are relative to renderer/ ("stages/box.glsl").
#pragma once

#include "base/embedded.h"

#include <cstddef>
#include <span>

namespace voxsheet {

extern const EmbeddedFile shaderFiles[];
extern const std::size_t shaderFilesCount;

[[nodiscard]] inline std::span<const EmbeddedFile> embeddedShaders() {
    return {shaderFiles, shaderFilesCount};
}

} // namespace voxsheet
