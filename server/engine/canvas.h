// A picture that pictures, boxes and text are put on.
#pragma once

#include "engine/sheet_layout.h"
#include "engine/typesetter.h"
#include "frame/frame_spec.h"

#include <glm/glm.hpp>

#include <string>
#include <vector>

namespace voxsheet::engine {

enum class TextAlign { Left, Centre, Right };

/// Display sRGB, alpha premultiplied, in the format of the pictures that are put on it: what those hold is
/// not touched, and what is drawn over bytes is rounded to bytes each time. Not thread-safe.
class Canvas {
public:
    /// \param background  not premultiplied
    /// \param typesetter  outlives the canvas
    Canvas(glm::ivec2 sizePixels, PixelFormat format, const glm::vec4& background, Typesetter& typesetter);

    /// Over what is there. Parts outside the canvas are left out. \param colour  not premultiplied
    void fill(const PixelRect& area, const glm::vec4& colour);
    /// Smooth, only inside the area. \param colour  not premultiplied
    void line(const glm::dvec2& from, const glm::dvec2& to, const PixelRect& area, const glm::vec4& colour,
              double widthPixels = 1.0);
    /// Replaces what is there. Throws InternalError if the picture has another format.
    void put(const TilePixels& picture, glm::ivec2 at);
    /// One line, its middle at the height of `at`, shortened with "…" to `maxWidth` pixels. Throws
    /// Unsupported as pictureFont.
    void text(glm::ivec2 at, TextAlign align, const std::string& line, int fontPixels,
              const glm::vec4& colour, int maxWidth);
    /// Wrapped at blanks into the area; what does not fit ends in "…". Left: from the area's top; Centre: in
    /// its middle, both ways.
    void paragraph(const PixelRect& area, const std::string& words, int fontPixels, const glm::vec4& colour,
                   TextAlign align = TextAlign::Left);

    /// Throws Unsupported as pictureFont.
    [[nodiscard]] int textWidth(const std::string& line, int fontPixels);
    /// What was drawn.
    [[nodiscard]] TilePixels take() &&;

private:
    [[nodiscard]] std::vector<std::string> wrapped(const std::string& words, int fontPixels, int maxWidth);
    [[nodiscard]] std::string shortened(std::string line, int fontPixels, int maxWidth);
    void blend(glm::ivec2 at, const glm::vec4& premultipliedColour);
    [[nodiscard]] bool isOfBytes() const { return format_ == PixelFormat::Rgba8; }

    glm::ivec2 size_;
    PixelFormat format_;
    Typesetter& typesetter_;
    TilePixels picture_;
};

} // namespace voxsheet::engine
