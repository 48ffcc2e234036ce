// What to draw, by value: a FrameSpec holds no pointer into the program and can be sent to another process.
#pragma once

#include "stages/tile_spec.h"

#include <glm/glm.hpp>

#include <string>
#include <vector>

namespace voxsheet {

enum class PixelFormat {
    Rgba8,  ///< sRGB, premultiplied alpha over nothing (background already blended in)
    Rgba32F ///< display sRGB values as floats, premultiplied
};

struct FrameSpec {
    std::vector<TileSpec> tiles;
    PixelFormat format = PixelFormat::Rgba8;
};

struct TilePixels {
    glm::ivec2 size{0};
    std::vector<unsigned char> rgba8; ///< Rgba8: size.x * size.y * 4, top row first
    std::vector<float> rgba32f;       ///< Rgba32F: size.x * size.y * 4, top row first
    int level = 0;
    double renderMs = 0.0; ///< GPU time of the draw, from timestamps; upload and readback not included
    double uploadMs = 0.0;
    std::string error;     ///< not empty: this tile failed, there are no pixels; the other tiles are whole
};

struct FrameResult {
    std::vector<TilePixels> tiles; ///< one per FrameSpec tile, in order
    double wallMs = 0.0;           ///< from state to host pixels
};

} // namespace voxsheet
