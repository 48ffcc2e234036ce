// A picture that pictures, boxes and text are put on.
#pragma once

#include "base/huge_page_block.h"
#include "engine/sheet_layout.h"
#include "engine/typesetter.h"
#include "frame/frame_spec.h"

#include <glm/glm.hpp>

#include <span>
#include <string>
#include <vector>

namespace voxsheet::engine {

enum class TextAlign { Left, Centre, Right };

/// Display sRGB floats, alpha premultiplied. Not thread-safe.
class Canvas {
public:
    /// \param background  not premultiplied
    /// \param typesetter  outlives the canvas
    Canvas(glm::ivec2 sizePixels, const glm::vec4& background, Typesetter& typesetter);

    /// Over what is there. Parts outside the canvas are left out. \param colour  not premultiplied
    void fill(const PixelRect& area, const glm::vec4& colour);
    /// Smooth, only inside the area. \param colour  not premultiplied
    void line(const glm::dvec2& from, const glm::dvec2& to, const PixelRect& area, const glm::vec4& colour,
              double widthPixels = 1.0);
    /// Replaces what is there.
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
    [[nodiscard]] TilePixels pixels(PixelFormat format) const;

private:
    [[nodiscard]] std::vector<std::string> wrapped(const std::string& words, int fontPixels, int maxWidth);
    [[nodiscard]] std::string shortened(std::string line, int fontPixels, int maxWidth);
    void blend(glm::ivec2 at, const glm::vec4& premultipliedColour);

    glm::ivec2 size_;
    Typesetter& typesetter_;
    HugePageBlock block_;   ///< of rgba_: megabytes that every picture writes anew
    std::span<float> rgba_; ///< top row first
};

} // namespace voxsheet::engine
