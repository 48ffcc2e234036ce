#include "engine/sheet_image.h"

#include "base/errors.h"
#include "engine/canvas.h"
#include "engine/colour_bar_painter.h"
#include "engine/crosshair.h"
#include "engine/orientation_marks.h"
#include "engine/tile_identity.h"

#include <algorithm>
#include <optional>

namespace voxsheet::engine {

namespace {

/// As on the page.
constexpr float kHiddenStrength = 0.35F; // of the crosshair's lines within a volume
constexpr glm::vec4 kCrosshairEdge{0.0F, 0.0F, 0.0F, 0.4F};
constexpr glm::vec4 kCrosshairColour{1.0F, 0.84F, 0.2F, 0.75F};

/// One cell on its way into the picture.
struct DrawnCell {
    sheet::Address address;
    const sheet::Cell* cell = nullptr; ///< null: blank
    PreparedTile tile;
    sheet::Annotations annotations = sheet::Annotations::All;
    std::optional<CellLook> look;
    glm::vec4 background{0.0F};
};

/// Colours that fit the sheet's own background, so that a white background gives a white figure.
struct Palette {
    glm::vec4 page;
    glm::vec4 text;
    glm::vec4 quiet;
    glm::vec4 strip;
    glm::vec4 error;
};

float luminance(const glm::vec4& c) { return 0.2126F * c.x + 0.7152F * c.y + 0.0722F * c.z; }

bool isDark(const glm::vec4& background) { return background.w < 0.5F || luminance(background) < 0.5F; }

Palette paletteFor(const glm::vec4& background) {
    Palette palette;
    const bool dark = isDark(background);
    const glm::vec3 shade = dark ? glm::vec3(1.0F) : glm::vec3(0.0F);
    palette.page = {glm::mix(glm::vec3(background), shade, 0.05F), background.w};
    palette.strip = {glm::mix(glm::vec3(background), shade, 0.10F), background.w};
    palette.text = dark ? glm::vec4(0.90F, 0.92F, 0.94F, 1.0F) : glm::vec4(0.10F, 0.11F, 0.12F, 1.0F);
    palette.quiet = dark ? glm::vec4(0.60F, 0.64F, 0.68F, 1.0F) : glm::vec4(0.35F, 0.37F, 0.40F, 1.0F);
    palette.error = dark ? glm::vec4(1.0F, 0.55F, 0.45F, 1.0F) : glm::vec4(0.75F, 0.12F, 0.05F, 1.0F);
    return palette;
}

glm::vec4 colourOf(const sheet::Colour& colour) {
    return glm::vec4(glm::dvec4(colour.red(), colour.green(), colour.blue(), colour.alpha()));
}

sheet::AddressRange usedRange(const sheet::Sheet& sheet) {
    sheet::AddressRange range{{0, 0}, {0, 0}};
    for (const auto& [address, cell] : sheet.cells) {
        if (cell.source.empty()) continue;
        range.last.column = std::max(range.last.column, address.column);
        range.last.row = std::max(range.last.row, address.row);
    }
    return range;
}

std::string headerText(const std::map<int, sheet::Header>& headers, int line, const std::string& name) {
    const auto found = headers.find(line);
    return found == headers.end() || found->second.title.empty() ? name : name + "  " + found->second.title;
}

/// Of a plane, its picture's identity has only what lies along the normal.
std::string crosshairText(const sheet::ResolvedStyle& resolved) {
    return sheet::styleValueText(resolved.values.at("plane.crosshair").value) +
           sheet::styleValueText(resolved.values.at("plane.units").value);
}

class Composer {
public:
    Composer(const SheetImageRequest& request, const sheet::Workbook& workbook,
             const std::shared_ptr<const CellContents>& contents, const SheetImageSources& sources)
        : request_(request), workbook_(workbook), contents_(contents), sources_(sources),
          sheetIndex_(request.sheet.empty() ? 0 : sheet::sheetIndex(workbook, request.sheet)),
          sheet_(workbook.sheets[sheetIndex_]), range_(request.range.value_or(usedRange(sheet_))) {
        if (!sheet_.contains(range_.last)) {
            throw InvalidInput("range " + sheet::rangeName(range_), "it reaches beyond the sheet",
                               "the sheet ends at " +
                                   sheet::addressName(sheet::Address{sheet_.columns - 1, sheet_.rows - 1}))
                .withField("range");
        }
    }

    SheetImage compose() {
        styleCells();
        layout_ = layoutSheet(layoutRequest());
        prepareTiles();
        const FrameResult frame = renderTiles();
        Canvas canvas(layout_.sizePixels, request_.format, palette_.page, sources_.typesetter);
        drawHeaders(canvas);
        std::size_t next = 0;
        for (std::size_t i = 0; i < cells_.size(); ++i) {
            const TilePixels* picture = cells_[i].tile.spec ? &frame.tiles.at(next++) : nullptr;
            drawCell(canvas, i, picture);
        }
        image_.pixels = std::move(canvas).take();
        for (const TilePixels& tile : frame.tiles) {
            image_.pixels.renderMs += tile.renderMs;
            image_.pixels.level = std::max(image_.pixels.level, tile.level);
        }
        image_.identity = textIdentity(identity_);
        return std::move(image_);
    }

private:
    sheet::StyleOverlay overlay() const {
        return {request_.view.all, request_.view.cells, request_.view.request};
    }

    void styleCells() {
        for (int row = range_.first.row; row <= range_.last.row; ++row) {
            for (int column = range_.first.column; column <= range_.last.column; ++column) {
                DrawnCell cell;
                cell.address = {column, row};
                cell.cell = sheet_.find(cell.address);
                const auto style = sheet::resolveStyle(sources_.keys, sheet_, cell.address, overlay()).style;
                cell.annotations = request_.annotate ? style.annotations : sheet::Annotations::None;
                cell.background = colourOf(style.background);
                cells_.push_back(std::move(cell));
            }
        }
        const auto values = sheet::resolveLayer(sources_.keys, sheet_, sheet::Layer::sheet());
        const auto* background = std::get_if<sheet::Colour>(&values.at("background").value);
        palette_ =
            paletteFor(background != nullptr ? colourOf(*background) : glm::vec4(0.0F, 0.0F, 0.0F, 1.0F));
        annotated_ = std::any_of(cells_.begin(), cells_.end(), [](const DrawnCell& cell) {
            return cell.annotations != sheet::Annotations::None;
        });
    }

    SheetLayoutRequest layoutRequest() const {
        SheetLayoutRequest layout;
        layout.sizePixels = request_.sizePixels;
        layout.columns = range_.columns();
        layout.rows = range_.rows();
        layout.title = !request_.title.empty();
        layout.headers = annotated_ && (layout.columns > 1 || layout.rows > 1);
        layout.cellTitles = annotated_;
        for (int row = range_.first.row; row <= range_.last.row; ++row) {
            const auto letters = headerText(sheet_.rowHeaders, row, sheet::rowName(row)).size();
            layout.rowHeaderLetters = std::max(layout.rowHeaderLetters, static_cast<int>(letters));
        }
        return layout;
    }

    void prepareTiles() {
        identity_ = request_.title + "\n" + sheet::rangeName(range_) + "\n" +
                    std::to_string(layout_.sizePixels.x) + "x" + std::to_string(layout_.sizePixels.y) +
                    (request_.annotate ? "a" : "-") + std::to_string(static_cast<int>(request_.format));
        for (std::size_t i = 0; i < cells_.size(); ++i) {
            DrawnCell& cell = cells_[i];
            TileQuality quality;
            quality.sizePixels = layout_.pictures[i].size();
            quality.crosshair = cell.annotations == sheet::Annotations::All;
            cell.tile = sources_.tiles.prepare(workbook_, sheetIndex_, cell.address, request_.view, quality,
                                               contents_);
            if (cell.tile.spec) {
                cell.look =
                    sources_.tiles.look(workbook_, sheetIndex_, cell.address, request_.view, contents_);
            }
            if (cell.tile.progress < 1.0) image_.final = false;
            if (!cell.tile.note.empty())
                image_.notes.push_back("cell " + sheet::addressName(cell.address) + ": " + cell.tile.note);
            if (cell.look) identity_ += crosshairText(cell.look->resolved);
            identity_ += "\n" + cell.tile.identity + std::to_string(static_cast<int>(cell.annotations)) +
                         (cell.cell != nullptr ? sheet::cellTitle(*cell.cell) : "");
        }
    }

    FrameResult renderTiles() const {
        std::vector<TileSpec> specs;
        for (const DrawnCell& cell : cells_) {
            if (cell.tile.spec) specs.push_back(*cell.tile.spec);
        }
        return specs.empty() ? FrameResult{} : sources_.render(specs, request_.format);
    }

    void drawHeaders(Canvas& canvas) {
        const int font = layout_.fontPixels;
        if (!request_.title.empty()) {
            const PixelRect& area = layout_.title;
            canvas.text({layout_.pictures.front().low.x, (area.low.y + area.high.y) / 2}, TextAlign::Left,
                        request_.title, font * 3 / 2, palette_.text, area.size().x - 2 * font);
        }
        for (std::size_t i = 0; i < layout_.columnHeaders.size(); ++i) {
            const PixelRect& area = layout_.columnHeaders[i];
            const int column = range_.first.column + static_cast<int>(i);
            const std::string text = headerText(sheet_.columnHeaders, column, sheet::columnName(column));
            canvas.text((area.low + area.high) / 2, TextAlign::Centre, text, font, palette_.quiet,
                        area.size().x);
            identity_ += "\n" + text;
        }
        for (std::size_t i = 0; i < layout_.rowHeaders.size(); ++i) {
            const PixelRect& area = layout_.rowHeaders[i];
            const int row = range_.first.row + static_cast<int>(i);
            const std::string text = headerText(sheet_.rowHeaders, row, sheet::rowName(row));
            const PixelRect inside{area.low + glm::ivec2(font / 3, 0), area.high - glm::ivec2(font / 3, 0)};
            canvas.paragraph(inside, text, font, palette_.quiet, TextAlign::Centre);
            identity_ += "\n" + text;
        }
    }

    void drawCell(Canvas& canvas, std::size_t index, const TilePixels* picture) {
        const DrawnCell& cell = cells_[index];
        const PixelRect& area = layout_.pictures[index];
        if (picture != nullptr && picture->error.empty()) {
            canvas.put(*picture, area.low);
            if (cell.annotations == sheet::Annotations::All) {
                drawCrosshair(canvas, cell, area);
                const Palette colours = paletteFor(cell.background);
                paintOrientation(canvas,
                                 {glm::dmat3(cell.tile.spec->camera.viewFromWorld),
                                  cell.look->meta->anatomical, layout_.fontPixels, colours.text,
                                  cell.background},
                                 area);
                paintColourBar(canvas, *cell.look, area, layout_.fontPixels * 4 / 5,
                               {colours.text, colours.quiet, cell.background});
            }
        } else {
            canvas.fill(area, cell.background);
            drawState(canvas, cell, area, picture);
        }
        if (layout_.cellTitles.empty() || cell.cell == nullptr || cell.cell->source.empty()) return;
        if (cell.annotations == sheet::Annotations::None) return;
        const PixelRect& strip = layout_.cellTitles[index];
        canvas.fill(strip, palette_.strip);
        const int font = layout_.fontPixels;
        const int middle = (strip.low.y + strip.high.y) / 2;
        const int level = picture != nullptr ? picture->level : 0;
        const int levelWidth = level > 0 ? 5 * font : 0;
        if (level > 0) {
            canvas.text({strip.high.x - font / 2, middle}, TextAlign::Right, "level " + std::to_string(level),
                        font, palette_.quiet, levelWidth);
        }
        canvas.text({strip.low.x + font / 2, middle}, TextAlign::Left, sheet::cellTitle(*cell.cell), font,
                    palette_.text, strip.size().x - font - levelWidth);
    }

    void drawState(Canvas& canvas, const DrawnCell& cell, const PixelRect& area, const TilePixels* picture) {
        std::string code = cell.tile.code;
        std::string sentence = cell.tile.message;
        if (picture != nullptr) {
            code = picture->errorKind == ErrorKind::LimitExceeded ? "#MEM!" : "#GPU!";
            sentence = picture->error;
        }
        const Palette colours = paletteFor(cell.background);
        const int font = layout_.fontPixels;
        PixelRect inside{area.low + glm::ivec2(font), area.high - glm::ivec2(font)};
        if (!code.empty()) {
            ++image_.failedCells;
            image_.failures.push_back("cell " + sheet::addressName(cell.address) + ": " + code + " " +
                                      sentence);
            canvas.text({inside.low.x, inside.low.y + font}, TextAlign::Left, code, font * 3 / 2,
                        colours.error, inside.size().x);
            inside.low.y += font * 5 / 2;
        }
        if (!sentence.empty()) canvas.paragraph(inside, sentence, font, colours.text);
    }

    static void drawCrosshair(Canvas& canvas, const DrawnCell& cell, const PixelRect& area) {
        const Grid drawn = drawnGrid(cell.look->meta->grid, cell.tile.spec->periodic);
        const auto crosshair = crosshairWorld(cell.look->resolved.style.plane, drawn);
        if (!crosshair) return;
        const auto lines = crosshairLines(*cell.tile.spec, drawn, *crosshair);
        // Before and beside a volume, the picture itself has it: its lines shine through what hides them.
        const float strength = cell.tile.spec->technique == Technique::Plane ? 1.0F : kHiddenStrength;
        const auto draw = [&](glm::vec4 colour, double widthPixels) {
            colour.w *= strength;
            for (const PixelLine& line : lines)
                canvas.line(glm::dvec2(area.low) + line.from, glm::dvec2(area.low) + line.to, area, colour,
                            widthPixels);
        };
        draw(kCrosshairEdge, 3.0);
        draw(kCrosshairColour, 1.0);
    }

    const SheetImageRequest& request_;
    const sheet::Workbook& workbook_;
    const std::shared_ptr<const CellContents>& contents_;
    const SheetImageSources& sources_;
    std::size_t sheetIndex_;
    const sheet::Sheet& sheet_;
    sheet::AddressRange range_;
    std::vector<DrawnCell> cells_; ///< row by row
    Palette palette_{};
    bool annotated_ = false;
    SheetLayout layout_;
    std::string identity_; ///< text over everything that decides the picture
    SheetImage image_;
};

} // namespace

SheetImage composeSheet(const SheetImageRequest& request, const sheet::Workbook& workbook,
                        const std::shared_ptr<const CellContents>& contents,
                        const SheetImageSources& sources) {
    return Composer(request, workbook, contents, sources).compose();
}

} // namespace voxsheet::engine
