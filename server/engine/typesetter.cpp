#include "engine/typesetter.h"

#include "base/errors.h"
#include "base/program_file.h"

#include <algorithm>
#include <cstdint>
#include <filesystem>

#include <ft2build.h>
#include FT_FREETYPE_H

namespace voxsheet::engine {

namespace {

constexpr char32_t kReplacement = 0xFFFD;

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

struct Typesetter::Face {
    FT_Library library = nullptr;
    FT_Face face = nullptr;

    Face() {
        if (FT_Init_FreeType(&library) == 0 && FT_New_Face(library, pictureFont().c_str(), 0, &face) == 0)
            return;
        FT_Done_FreeType(library);
        throw Unsupported("text in pictures", "FreeType cannot read " + pictureFont(),
                          "install fonts-dejavu-core anew, or set annotations to none");
    }
    ~Face() {
        FT_Done_Face(face);
        FT_Done_FreeType(library);
    }
    Face(const Face&) = delete;
    Face& operator=(const Face&) = delete;
};

Typesetter::Typesetter() : face_(std::make_unique<Face>()) {}
Typesetter::~Typesetter() = default;

TextMask Typesetter::set(const std::string& line, int fontPixels) {
    FT_Face face = face_->face;
    FT_Set_Pixel_Sizes(face, 0, static_cast<FT_UInt>(std::max(1, fontPixels)));
    TextMask mask;
    mask.baseline = static_cast<int>(face->size->metrics.ascender >> 6);
    const int descent = -static_cast<int>(face->size->metrics.descender >> 6);
    mask.size = {width(line, fontPixels) + fontPixels, mask.baseline + descent};
    mask.coverage.assign(static_cast<std::size_t>(mask.size.x) * static_cast<std::size_t>(mask.size.y), 0);
    FT_UInt previous = 0;
    for (const char32_t character : charactersOf(line)) {
        const FT_UInt glyph = FT_Get_Char_Index(face, character);
        FT_Vector kerning{0, 0};
        if (previous != 0) FT_Get_Kerning(face, previous, glyph, FT_KERNING_DEFAULT, &kerning);
        mask.advance += static_cast<int>(kerning.x >> 6);
        previous = glyph;
        if (FT_Load_Glyph(face, glyph, FT_LOAD_RENDER) != 0) continue;
        const FT_Bitmap& bitmap = face->glyph->bitmap;
        for (int y = 0; y < static_cast<int>(bitmap.rows); ++y) {
            for (int x = 0; x < static_cast<int>(bitmap.width); ++x) {
                const glm::ivec2 at(mask.advance + face->glyph->bitmap_left + x,
                                    mask.baseline - face->glyph->bitmap_top + y);
                if (at.x < 0 || at.y < 0 || at.x >= mask.size.x || at.y >= mask.size.y) continue;
                unsigned char& to =
                    mask.coverage[static_cast<std::size_t>(at.y) * static_cast<std::size_t>(mask.size.x) +
                                  static_cast<std::size_t>(at.x)];
                to = std::max(to, bitmap.buffer[y * bitmap.pitch + x]);
            }
        }
        mask.advance += static_cast<int>(face->glyph->advance.x >> 6);
    }
    return mask;
}

int Typesetter::width(const std::string& line, int fontPixels) {
    FT_Face face = face_->face;
    FT_Set_Pixel_Sizes(face, 0, static_cast<FT_UInt>(std::max(1, fontPixels)));
    int advance = 0;
    FT_UInt previous = 0;
    for (const char32_t character : charactersOf(line)) {
        const FT_UInt glyph = FT_Get_Char_Index(face, character);
        FT_Vector kerning{0, 0};
        if (previous != 0) FT_Get_Kerning(face, previous, glyph, FT_KERNING_DEFAULT, &kerning);
        previous = glyph;
        if (FT_Load_Glyph(face, glyph, FT_LOAD_DEFAULT) != 0) continue;
        advance += static_cast<int>(kerning.x >> 6) + static_cast<int>(face->glyph->advance.x >> 6);
    }
    return advance;
}

} // namespace voxsheet::engine
