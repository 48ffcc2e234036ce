#include "engine/typesetter.h"

#include "base/errors.h"
#include "base/program_file.h"

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <utility>

#include <ft2build.h>
#include FT_FREETYPE_H

namespace voxsheet::engine {

namespace {

constexpr char32_t kReplacement = 0xFFFD;
constexpr std::size_t kMostGlyphs = 4096; ///< kept; some 100 bytes each

std::vector<char32_t> charactersOf(const std::string& text) {
    std::vector<char32_t> characters;
    for (std::size_t i = 0; i < text.size();) {
        const auto lead = static_cast<unsigned char>(text[i]);
        const std::size_t length = lead < 0x80    ? 1
                                   : lead >= 0xF0 ? 4
                                   : lead >= 0xE0 ? 3
                                   : lead >= 0xC0 ? 2
                                                  : 0;
        if (length == 0 || i + length > text.size()) {
            characters.push_back(kReplacement);
            ++i;
            continue;
        }
        char32_t code = length == 1 ? lead : lead & (0x7FU >> length);
        bool whole = true;
        for (std::size_t k = 1; k < length; ++k) {
            const auto next = static_cast<unsigned char>(text[i + k]);
            whole = whole && (next & 0xC0U) == 0x80U;
            code = (code << 6U) | (next & 0x3FU);
        }
        characters.push_back(whole ? code : kReplacement);
        i += whole ? length : 1;
    }
    return characters;
}

} // namespace

const std::string& pictureFont() {
    static const std::string font = [] {
        const auto bundled = programFile().parent_path() / "../share/fonts/DejaVuSans.ttf";
        if (std::filesystem::exists(bundled)) return bundled.lexically_normal().string();
        for (const char* file :
             {"/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf", "/usr/share/fonts/dejavu/DejaVuSans.ttf",
              "/usr/share/fonts/dejavu-sans-fonts/DejaVuSans.ttf", "/usr/share/fonts/TTF/DejaVuSans.ttf",
              "/usr/share/fonts/truetype/liberation/LiberationSans-Regular.ttf",
              "/usr/share/fonts/truetype/noto/NotoSans-Regular.ttf"}) {
            if (std::filesystem::exists(file)) return std::string(file);
        }
        throw Unsupported("text in pictures", "no font was found",
                          "install fonts-dejavu-core, or set annotations to none");
    }();
    return font;
}

/// The font at one size at a time, and the letters of every size that were drawn. Not thread-safe.
class Typesetter::Face {
public:
    struct Glyph {
        bool drawn = false; ///< false: the font cannot draw it
        int advance = 0;
        glm::ivec2 offset{0}; ///< of the mask's top left corner from the pen, y up
        glm::ivec2 size{0};
        std::vector<unsigned char> coverage; ///< size.x * size.y, top row first
    };

    Face() {
        if (FT_Init_FreeType(&library_) == 0 && FT_New_Face(library_, pictureFont().c_str(), 0, &face_) == 0)
            return;
        FT_Done_FreeType(library_);
        throw Unsupported("text in pictures", "FreeType cannot read " + pictureFont(),
                          "install fonts-dejavu-core anew, or set annotations to none");
    }
    ~Face() {
        FT_Done_Face(face_);
        FT_Done_FreeType(library_);
    }
    Face(const Face&) = delete;
    Face& operator=(const Face&) = delete;

    void setSize(int fontPixels) {
        const int size = std::max(1, fontPixels);
        if (size == size_) return;
        FT_Set_Pixel_Sizes(face_, 0, static_cast<FT_UInt>(size));
        size_ = size;
    }
    [[nodiscard]] int ascent() const { return static_cast<int>(face_->size->metrics.ascender >> 6); }
    [[nodiscard]] int descent() const { return -static_cast<int>(face_->size->metrics.descender >> 6); }

    /// Calls put(glyph, kerning before it in pixels) for every character.
    void forEachGlyph(const std::string& line, const std::function<void(const Glyph&, int)>& put) {
        FT_UInt previous = 0;
        for (const char32_t character : charactersOf(line)) {
            const FT_UInt index = FT_Get_Char_Index(face_, character);
            FT_Vector kerning{0, 0};
            if (previous != 0) FT_Get_Kerning(face_, previous, index, FT_KERNING_DEFAULT, &kerning);
            previous = index;
            put(glyph(index), static_cast<int>(kerning.x >> 6));
        }
    }

private:
    const Glyph& glyph(FT_UInt index) {
        if (glyphs_.size() >= kMostGlyphs) glyphs_.clear();
        const auto [known, isNew] = glyphs_.try_emplace({size_, index});
        Glyph& made = known->second;
        if (!isNew || FT_Load_Glyph(face_, index, FT_LOAD_RENDER) != 0) return made;
        const FT_GlyphSlot slot = face_->glyph;
        made.drawn = true;
        made.advance = static_cast<int>(slot->advance.x >> 6);
        made.offset = {slot->bitmap_left, slot->bitmap_top};
        made.size = {static_cast<int>(slot->bitmap.width), static_cast<int>(slot->bitmap.rows)};
        for (int y = 0; y < made.size.y; ++y) {
            const unsigned char* row = slot->bitmap.buffer + y * slot->bitmap.pitch;
            made.coverage.insert(made.coverage.end(), row, row + made.size.x);
        }
        return made;
    }

    FT_Library library_ = nullptr;
    FT_Face face_ = nullptr;
    int size_ = 0;
    std::map<std::pair<int, FT_UInt>, Glyph> glyphs_; ///< by size and index
};

Typesetter::Typesetter() = default;
Typesetter::~Typesetter() = default;

Typesetter::Face& Typesetter::face(int fontPixels) {
    if (!face_) face_ = std::make_unique<Face>();
    face_->setSize(fontPixels);
    return *face_;
}

TextMask Typesetter::set(const std::string& line, int fontPixels) {
    const int letters = width(line, fontPixels);
    const std::lock_guard lock(mutex_);
    Face& font = face(fontPixels);
    TextMask mask;
    mask.baseline = font.ascent();
    mask.size = {letters + fontPixels, mask.baseline + font.descent()};
    mask.coverage.assign(static_cast<std::size_t>(mask.size.x) * static_cast<std::size_t>(mask.size.y), 0);
    font.forEachGlyph(line, [&](const Face::Glyph& glyph, int kerning) {
        mask.advance += kerning;
        if (!glyph.drawn) return;
        for (int y = 0; y < glyph.size.y; ++y) {
            for (int x = 0; x < glyph.size.x; ++x) {
                const glm::ivec2 at(mask.advance + glyph.offset.x + x, mask.baseline - glyph.offset.y + y);
                if (at.x < 0 || at.y < 0 || at.x >= mask.size.x || at.y >= mask.size.y) continue;
                unsigned char& to =
                    mask.coverage[static_cast<std::size_t>(at.y) * static_cast<std::size_t>(mask.size.x) +
                                  static_cast<std::size_t>(at.x)];
                to = std::max(to, glyph.coverage[static_cast<std::size_t>(y * glyph.size.x + x)]);
            }
        }
        mask.advance += glyph.advance;
    });
    return mask;
}

int Typesetter::width(const std::string& line, int fontPixels) {
    const std::lock_guard lock(mutex_);
    int advance = 0;
    face(fontPixels).forEachGlyph(line, [&](const Face::Glyph& glyph, int kerning) {
        if (glyph.drawn) advance += kerning + glyph.advance;
    });
    return advance;
}

} // namespace voxsheet::engine
