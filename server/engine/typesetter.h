// Lines of text as coverage masks, by FreeType. (OpenImageIO 2.4's render_text cuts characters beyond ASCII
// to a byte: the Å of a unit comes out as a box.)
#pragma once

#include <glm/glm.hpp>

#include <memory>
#include <mutex>
#include <string>
#include <vector>

namespace voxsheet::engine {

/// The font that text in pictures is set in. Throws Unsupported, naming the package, if none of the usual
/// ones is installed.
[[nodiscard]] const std::string& pictureFont();

/// One line of text, drawn.
struct TextMask {
    glm::ivec2 size{0};
    int baseline = 0;                    ///< row of the baseline, from the top
    int advance = 0;                     ///< where the next letter would begin, from the left edge
    std::vector<unsigned char> coverage; ///< size.x * size.y, top row first
};

/// Thread-safe. Keeps the letters that it has drawn: hinting them costs more than all the rest of a small
/// picture.
class Typesetter {
public:
    /// Opens no font yet: pictures without text need none.
    Typesetter();
    ~Typesetter();
    Typesetter(const Typesetter&) = delete;
    Typesetter& operator=(const Typesetter&) = delete;

    /// \param line  UTF-8; bytes that are not become U+FFFD
    /// Throws Unsupported as pictureFont, or if the font cannot be read.
    [[nodiscard]] TextMask set(const std::string& line, int fontPixels);
    /// Pixels from the first letter's beginning to the last one's end. Throws as set.
    [[nodiscard]] int width(const std::string& line, int fontPixels);

private:
    class Face;
    [[nodiscard]] Face& face(int fontPixels);

    std::mutex mutex_;
    std::unique_ptr<Face> face_;
};

} // namespace voxsheet::engine
