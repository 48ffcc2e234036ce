// What to draw, by value: a FrameSpec holds no pointer into the program and can be sent to another process.
#pragma once

#include "base/errors.h"
#include "stages/tile_spec.h"

#include <glm/glm.hpp>

#include <string>
#include <vector>

namespace voxsheet {

enum class PixelFormat {
    Rgba8,  ///< sRGB, premultiplied alpha over nothing (background already blended in)
    Rgba32F ///< display sRGB values as floats, premultiplied
};

/// From which level of detail a tile may be drawn, when the one that it asks for is not resident.
enum class LevelChoice {
    Exact,        ///< the one asked for: the tile waits for it, and fails when the budget cannot hold it
    WithinBudget, ///< likewise, but the finest level that the texture budget can hold
    AtHand ///< the nearest one that is resident; a small one is brought in when none is, and the tile left
           ///< out (TilePixels::absent) while that is read: nothing waits
};

struct FrameSpec {
    std::vector<TileSpec> tiles;
    PixelFormat format = PixelFormat::Rgba8;
    LevelChoice levels = LevelChoice::Exact;
    /// Each tile is copied back before the next is begun, so that TilePixels::timestampMs and hostMs can be
    /// compared (TimerCheck). Slower: no tile is drawn while another is copied.
    bool checkTimers = false;
};

struct TilePixels {
    glm::ivec2 size{0};
    std::vector<unsigned char> rgba8; ///< Rgba8: size.x * size.y * 4, top row first
    std::vector<float> rgba32f;       ///< Rgba32F: size.x * size.y * 4, top row first
    int level = 0;                    ///< that was drawn
    bool standIn = false; ///< AtHand: something was drawn from another level, or without a gradient texture
    bool awaited = false; ///< what the stand-in stands for, or what is absent, is being brought in: ask again
    bool absent = false;  ///< AtHand: nothing is there yet to draw it from; there are no pixels
    std::string note;     ///< not empty: why a coarser level than asked for is as good as it gets
    /// GPU time of drawing and resolving, from timestamps; upload and readback not included. The host's time
    /// where the timestamps are impossible.
    double renderMs = 0.0;
    double timestampMs = 0.0; ///< the same as the driver gave it
    double hostMs = 0.0;      ///< by the host's clock, until the pixels were in host memory
    double uploadMs = 0.0;    ///< host time of conversion, upload and gradients; 0 when all was resident
    double readMs = 0.0;      ///< of waiting for samples to be read; 0 when all was resident
    std::string error;        ///< not empty: this tile failed, there are no pixels; the other tiles are whole
    ErrorKind errorKind = ErrorKind::Internal; ///< of `error`, when that is not empty
};

struct FrameResult {
    std::vector<TilePixels> tiles; ///< one per FrameSpec tile, in order
    double wallMs = 0.0;           ///< from state to host pixels; waiting in the queue not included
};

} // namespace voxsheet
