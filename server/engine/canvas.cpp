#include "engine/canvas.h"

#include "base/errors.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>

namespace voxsheet::engine {

namespace {

glm::vec4 premultiplied(const glm::vec4& colour) { return {glm::vec3(colour) * colour.w, colour.w}; }

/// To the nearest, ties up, like std::lround but without a call. NaN gives 0.
unsigned char roundedByte(float part) {
    const float above = part > 0.0F ? part : 0.0F;
    const float value = (above < 1.0F ? above : 1.0F) * 255.0F;
    const auto whole = static_cast<int>(value);
    return static_cast<unsigned char>(whole + (value - static_cast<float>(whole) >= 0.5F ? 1 : 0));
}

template <typename Value>
void fillPixels(std::vector<Value>& rgba, std::size_t pixels, const std::array<Value, 4>& colour) {
    rgba.resize(pixels * colour.size());
    for (std::size_t i = 0; i < rgba.size(); i += colour.size())
        std::copy(colour.begin(), colour.end(), rgba.begin() + static_cast<std::ptrdiff_t>(i));
}

/// Rows of the picture at `at`, as far as they lie on the canvas.
template <typename Value>
void copyRows(const std::vector<Value>& from, glm::ivec2 fromSize, std::vector<Value>& to, glm::ivec2 toSize,
              glm::ivec2 at) {
    const int left = std::max(0, -at.x);
    const int right = std::min(fromSize.x, toSize.x - at.x);
    if (right <= left) return;
    const auto indexOf = [](glm::ivec2 pixel, glm::ivec2 size) {
        return (static_cast<std::ptrdiff_t>(pixel.y) * size.x + pixel.x) * 4;
    };
    for (int y = std::max(0, -at.y); y < std::min(fromSize.y, toSize.y - at.y); ++y)
        std::copy_n(from.begin() + indexOf({left, y}, fromSize), 4 * (right - left),
                    to.begin() + indexOf(at + glm::ivec2(left, y), toSize));
}

/// Drops whole UTF-8 characters from the end.
void dropLastCharacter(std::string& text) {
    while (!text.empty() && (static_cast<unsigned char>(text.back()) & 0xC0U) == 0x80U)
        text.pop_back();
    if (!text.empty()) text.pop_back();
}

} // namespace

Canvas::Canvas(glm::ivec2 sizePixels, PixelFormat format, const glm::vec4& background, Typesetter& typesetter)
    : size_(sizePixels), format_(format), typesetter_(typesetter) {
    const glm::vec4 c = premultiplied(background);
    const auto pixels = static_cast<std::size_t>(size_.x) * static_cast<std::size_t>(size_.y);
    picture_.size = size_;
    if (isOfBytes())
        fillPixels<unsigned char>(picture_.rgba8, pixels,
                                  {roundedByte(c.x), roundedByte(c.y), roundedByte(c.z), roundedByte(c.w)});
    else
        fillPixels<float>(picture_.rgba32f, pixels, {c.x, c.y, c.z, c.w});
}

void Canvas::blend(glm::ivec2 at, const glm::vec4& colour) {
    const std::size_t pixel = (static_cast<std::size_t>(at.y) * static_cast<std::size_t>(size_.x) +
                               static_cast<std::size_t>(at.x)) *
                              4;
    const float seen = 1.0F - colour.w;
    for (int c = 0; c < 4; ++c) {
        const std::size_t i = pixel + static_cast<std::size_t>(c);
        if (isOfBytes())
            picture_.rgba8[i] =
                roundedByte(colour[c] + static_cast<float>(picture_.rgba8[i]) / 255.0F * seen);
        else
            picture_.rgba32f[i] = colour[c] + picture_.rgba32f[i] * seen;
    }
}

void Canvas::fill(const PixelRect& area, const glm::vec4& colour) {
    const glm::vec4 source = premultiplied(colour);
    const glm::ivec2 low = glm::max(area.low, glm::ivec2(0));
    const glm::ivec2 high = glm::min(area.high, size_);
    for (int y = low.y; y < high.y; ++y) {
        for (int x = low.x; x < high.x; ++x)
            blend({x, y}, source);
    }
}

void Canvas::line(const glm::dvec2& from, const glm::dvec2& to, const PixelRect& area,
                  const glm::vec4& colour, double widthPixels) {
    const int reach = static_cast<int>(std::ceil(widthPixels / 2.0)) + 1;
    const glm::ivec2 low =
        glm::max(glm::max(area.low, glm::ivec2(0)), glm::ivec2(glm::min(from, to)) - reach);
    const glm::ivec2 high = glm::min(glm::min(area.high, size_), glm::ivec2(glm::max(from, to)) + reach + 1);
    const glm::dvec2 along = to - from;
    const double length = glm::length(along);
    if (length <= 0.0) return;
    for (int y = low.y; y < high.y; ++y) {
        for (int x = low.x; x < high.x; ++x) {
            const glm::dvec2 at = glm::dvec2(x, y) + 0.5 - from;
            const double part = glm::dot(at, along) / length;
            const double aside = std::abs(at.x * along.y - at.y * along.x) / length;
            const double beyond = std::max({0.0, -part, part - length});
            const double cover = std::clamp(widthPixels / 2.0 + 0.5 - std::hypot(aside, beyond), 0.0, 1.0);
            if (cover <= 0.0) continue;
            blend({x, y}, premultiplied({glm::vec3(colour), colour.w * static_cast<float>(cover)}));
        }
    }
}

void Canvas::put(const TilePixels& picture, glm::ivec2 at) {
    const auto values =
        static_cast<std::size_t>(picture.size.x) * static_cast<std::size_t>(picture.size.y) * 4;
    if ((isOfBytes() ? picture.rgba8.size() : picture.rgba32f.size()) != values)
        throw InternalError("picture on a canvas", "it has another format");
    if (isOfBytes())
        copyRows(picture.rgba8, picture.size, picture_.rgba8, size_, at);
    else
        copyRows(picture.rgba32f, picture.size, picture_.rgba32f, size_, at);
}

int Canvas::textWidth(const std::string& line, int fontPixels) { return typesetter_.width(line, fontPixels); }

std::string Canvas::shortened(std::string line, int fontPixels, int maxWidth) {
    if (textWidth(line, fontPixels) <= maxWidth) return line;
    while (!line.empty() && textWidth(line + "…", fontPixels) > maxWidth)
        dropLastCharacter(line);
    return line + "…";
}

void Canvas::text(glm::ivec2 at, TextAlign align, const std::string& line, int fontPixels,
                  const glm::vec4& colour, int maxWidth) {
    if (line.empty()) return;
    const TextMask mask = typesetter_.set(shortened(line, fontPixels, maxWidth), fontPixels);
    const int shift = align == TextAlign::Left    ? 0
                      : align == TextAlign::Right ? mask.advance
                                                  : mask.advance / 2;
    // Capitals of DejaVu Sans are 0.73 of the size high: this puts their middle at `at`.
    const glm::ivec2 low(at.x - shift,
                         at.y + static_cast<int>(std::lround(0.36 * fontPixels)) - mask.baseline);
    for (int y = std::max(0, -low.y); y < std::min(mask.size.y, size_.y - low.y); ++y) {
        for (int x = std::max(0, -low.x); x < std::min(mask.size.x, size_.x - low.x); ++x) {
            const unsigned char coverage =
                mask.coverage[static_cast<std::size_t>(y) * static_cast<std::size_t>(mask.size.x) +
                              static_cast<std::size_t>(x)];
            if (coverage == 0) continue;
            blend(low + glm::ivec2(x, y),
                  premultiplied({glm::vec3(colour), colour.w * static_cast<float>(coverage) / 255.0F}));
        }
    }
}

std::vector<std::string> Canvas::wrapped(const std::string& words, int fontPixels, int maxWidth) {
    std::vector<std::string> lines{""};
    std::size_t begin = 0;
    while (begin < words.size()) {
        std::size_t end = words.find(' ', begin);
        if (end == std::string::npos) end = words.size();
        const std::string word = words.substr(begin, end - begin);
        begin = end + 1;
        std::string& last = lines.back();
        const std::string longer = last.empty() ? word : last + " " + word;
        if (last.empty() || textWidth(longer, fontPixels) <= maxWidth) {
            last = longer;
        } else {
            lines.push_back(word);
        }
    }
    return lines;
}

void Canvas::paragraph(const PixelRect& area, const std::string& words, int fontPixels,
                       const glm::vec4& colour, TextAlign align) {
    const int width = area.size().x;
    const int lineHeight = fontPixels * 3 / 2;
    const auto mostLines = static_cast<std::size_t>(std::max(1, area.size().y / lineHeight));
    auto lines = wrapped(words, fontPixels, width);
    if (lines.size() > mostLines) {
        lines.resize(mostLines);
        lines.back() += "…";
    }
    const bool centred = align == TextAlign::Centre;
    const int height = static_cast<int>(lines.size()) * lineHeight;
    int y = area.low.y + lineHeight / 2 + (centred ? (area.size().y - height) / 2 : 0);
    const int x = centred ? (area.low.x + area.high.x) / 2 : area.low.x;
    for (const std::string& line : lines) {
        text({x, y}, centred ? TextAlign::Centre : TextAlign::Left, line, fontPixels, colour, width);
        y += lineHeight;
    }
}

TilePixels Canvas::take() && { return std::move(picture_); }

} // namespace voxsheet::engine
