#include "engine/colour_bar_painter.h"

#include "engine/axis_ticks.h"
#include "engine/colour_bar.h"
#include "engine/unit_text.h"

#include <algorithm>
#include <string>

namespace voxsheet::engine {

namespace {

glm::vec4 opaque(const glm::dvec4& colour) { return {glm::vec3(colour), 1.0F}; }

std::string fusedText(const CellLook& look) {
    const bool flat = look.resolved.style.technique == sheet::Technique::Plane;
    std::string text = flat ? "overlay" : "fused with";
    for (std::size_t i = 0; i < look.layers.size(); ++i)
        text += (i == 0 ? " " : ", ") + look.layers[i].name;
    return text;
}

class BarPainter {
public:
    BarPainter(Canvas& canvas, const CellLook& look, const PixelRect& area, int fontPixels,
               const BarColours& colours)
        : canvas_(canvas), look_(look), colours_(colours), font_(std::max(8, fontPixels)),
          maxWidth_(area.size().x * 3 / 4),
          function_((look.colouredBy ? look.colouredBy->transfer : look.transfer).function) {
        const int height = area.size().y * 11 / 20;
        fits_ = height >= 5 * font_ && area.size().x >= 12 * font_;
        const int width = std::max(5, font_ * 3 / 4);
        const int right = area.high.x - font_;
        const int top = area.low.y + (area.size().y - height) / 2 + font_ / 2;
        bar_ = {{right - width, top}, {right, top + height}};
    }

    void paint() {
        if (!fits_) return;
        if (look_.labels) {
            drawLegend(*look_.labels, bar_.low.y);
            if (!look_.layers.empty())
                label({bar_.high.x, bar_.low.y - font_}, fusedText(look_), colours_.text);
            return;
        }
        drawColours();
        drawTicks();
        drawEnds();
        if (!look_.colouredBy) drawIsovalues();
        drawCaption();
    }

private:
    [[nodiscard]] int width() const { return bar_.size().x; }
    [[nodiscard]] int height() const { return bar_.size().y; }
    [[nodiscard]] int rowAt(double position) const {
        return bar_.low.y + static_cast<int>((1.0 - position) * (height() - 1));
    }
    [[nodiscard]] const FieldMeta& field() const {
        const auto& by = look_.colouredBy;
        const DatasetMeta& meta = by ? *by->meta : *look_.meta;
        return meta.fields.at(static_cast<std::size_t>(by ? by->shown.field : look_.shown.field));
    }

    /// Ends at `at`, with an outline: what is behind it may have any colour.
    void label(glm::ivec2 at, const std::string& text, const glm::vec4& colour) {
        const glm::vec4 outline{glm::vec3(colours_.background), 0.6F};
        for (const glm::ivec2 aside : {glm::ivec2(-1, 0), {1, 0}, {0, -1}, {0, 1}})
            canvas_.text(at + aside, TextAlign::Right, text, font_, outline, maxWidth_);
        canvas_.text(at, TextAlign::Right, text, font_, colour, maxWidth_);
    }

    /// The labels that are shown, one below the other, as many as fit.
    void drawLegend(const LabelTable& table, int top) {
        const int row = font_ * 5 / 4;
        int y = top;
        for (const Label& each : table.labels) {
            if (each.hidden) continue;
            if (y + 2 * row > bar_.high.y) {
                label({bar_.high.x, y + row / 2}, "…", colours_.quiet);
                return;
            }
            canvas_.fill({{bar_.low.x - 1, y - 1}, {bar_.high.x + 1, y + width() + 1}}, colours_.background);
            canvas_.fill({{bar_.low.x, y}, {bar_.high.x, y + width()}}, {glm::vec3(each.rgb), 1.0F});
            label({bar_.low.x - font_ / 2, y + width() / 2}, each.name, colours_.text);
            y += row;
        }
    }

    void drawColours() {
        canvas_.fill({bar_.low - 1, bar_.high + 1}, {glm::vec3(colours_.background), 0.6F});
        for (int y = 0; y < height(); ++y) {
            const double position = 1.0 - (y + 0.5) / height();
            canvas_.fill({{bar_.low.x, bar_.low.y + y}, {bar_.high.x, bar_.low.y + y + 1}},
                         opaque(evaluateTransfer(function_, transferValue(function_, position))));
        }
    }

    void drawTicks() {
        for (const Tick& tick : axisTicks(function_, std::clamp(height() / (font_ * 3), 2, 6))) {
            const int y = rowAt(tick.position);
            canvas_.fill({{bar_.low.x - font_ / 4, y}, {bar_.low.x, y + 1}}, colours_.quiet);
            label({bar_.low.x - font_ / 2, y}, tick.label, colours_.text);
        }
    }

    /// Beyond the bar's ends, where they are set: the colours of values outside the range.
    void drawEnds() {
        const auto block = [&](int top, const glm::dvec4& colour) {
            canvas_.fill({{bar_.low.x - 1, top - 1}, {bar_.high.x + 1, top + width() + 1}}, colours_.quiet);
            canvas_.fill({{bar_.low.x, top}, {bar_.high.x, top + width()}}, opaque(colour));
        };
        if (function_.hasAbove) block(bar_.low.y - width() - 1, function_.above);
        if (function_.hasBelow) block(bar_.high.y + 1, function_.below);
        if (!hasGaps(field()) || function_.nan.w <= 0.0) return;
        const int top = bar_.high.y + 2 * width();
        block(top, function_.nan);
        label({bar_.low.x - font_ / 2, top + width() / 2}, "no value", colours_.text);
    }

    /// A line across the bar at each surface's value, and its colour beside it.
    void drawIsovalues() {
        const int half = std::max(1, width() / 6);
        for (const Isosurface& surface : look_.isosurface.surfaces) {
            const auto position = barPosition(function_, surface.value);
            if (!position) continue;
            const int y = rowAt(*position);
            canvas_.fill({{bar_.low.x, y}, {bar_.high.x, y + 1}}, colours_.text);
            canvas_.fill({{bar_.high.x, y - half}, {bar_.high.x + 4 * half, y + half + 1}},
                         {glm::vec3(surface.colour), 1.0F});
        }
    }

    void drawCaption() {
        std::string caption = field().quantity;
        if (!field().unit.empty()) caption += (caption.empty() ? "" : " / ") + unitText(field().unit);
        const auto add = [&](const std::string& word) { caption += (caption.empty() ? "" : ", ") + word; };
        if (function_.scale != ValueScale::Linear) add(scaleName(function_.scale));
        if (look_.sharedRange && !look_.colouredBy) add("shared");
        const int y = bar_.low.y - font_ - (function_.hasAbove ? width() : 0);
        label({bar_.high.x, y}, caption, colours_.text);
        if (!look_.layers.empty()) label({bar_.high.x, y - font_ * 3 / 2}, fusedText(look_), colours_.text);
    }

    Canvas& canvas_;
    const CellLook& look_;
    const BarColours& colours_;
    int font_;
    int maxWidth_;
    const TransferFunction& function_;
    PixelRect bar_;
    bool fits_ = false;
};

} // namespace

void paintColourBar(Canvas& canvas, const CellLook& look, const PixelRect& area, int fontPixels,
                    const BarColours& colours) {
    BarPainter(canvas, look, area, fontPixels, colours).paint();
}

} // namespace voxsheet::engine
