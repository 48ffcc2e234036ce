#include "bench/svg_plot.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace voxsheet::bench {

namespace {

constexpr double kWidth = 760.0;
constexpr double kLeft = 74.0;
constexpr double kRight = 18.0;
constexpr double kTop = 58.0;
constexpr double kPanelGap = 22.0;
constexpr double kBottom = 52.0;
constexpr double kLegendRow = 17.0;
constexpr double kNoteRow = 15.0;

std::string number(double value) {
    char text[32];
    std::snprintf(text, sizeof text, "%.2f", value);
    return text;
}

std::string tickText(double value) {
    char text[32];
    std::snprintf(text, sizeof text, "%g", value);
    return text;
}

std::string escaped(const std::string& text) {
    std::string result;
    for (const char c : text) {
        if (c == '&')
            result += "&amp;";
        else if (c == '<')
            result += "&lt;";
        else
            result += c;
    }
    // The one symbol with an index that plots here have.
    for (auto at = result.find("T_N"); at != std::string::npos; at = result.find("T_N", at))
        result.replace(at, 3, "T<tspan dy=\"3\" style=\"font-size:75%\">N</tspan><tspan dy=\"-3\"> </tspan>");
    return result;
}

std::string line(double x1, double y1, double x2, double y2, const std::string& colour, double width,
                 const std::string& more = {}) {
    return "<line x1=\"" + number(x1) + "\" y1=\"" + number(y1) + "\" x2=\"" + number(x2) + "\" y2=\"" +
           number(y2) + "\" stroke=\"" + colour + "\" stroke-width=\"" + number(width) + "\"" + more + "/>\n";
}

std::string textAt(double x, double y, const std::string& text, const std::string& more) {
    return "<text x=\"" + number(x) + "\" y=\"" + number(y) + "\" " + more + ">" + escaped(text) +
           "</text>\n";
}

double largestOf(const PlotPanel& panel) {
    if (panel.yLargest) return *panel.yLargest;
    double largest = 0.0;
    for (const auto& series : panel.series)
        for (const auto& point : series.points)
            largest = std::max({largest, point.y, point.high});
    return largest > 0.0 ? 1.05 * largest : 1.0;
}

/// Draws one panel whose upper left corner is at (kLeft, top).
class PanelDrawing {
public:
    PanelDrawing(const PlotPanel& panel, double xLargest, double top, bool namesX)
        : panel_(panel), xLargest_(xLargest), yLargest_(largestOf(panel)), top_(top), namesX_(namesX) {}

    [[nodiscard]] std::string draw() const {
        std::string svg = grid();
        for (const auto& rule : panel_.horizontal)
            svg +=
                line(kLeft, y(rule.at), right(), y(rule.at), rule.colour, 1.0, " stroke-dasharray=\"5 3\"") +
                textAt(right() - 4.0, y(rule.at) - 4.0, rule.label,
                       "class=\"note\" text-anchor=\"end\" style=\"fill:" + rule.colour + "\"");
        svg += verticals();
        for (const auto& series : panel_.series)
            svg += curve(series);
        return svg + frame();
    }

private:
    [[nodiscard]] double right() const { return kWidth - kRight; }
    [[nodiscard]] double bottom() const { return top_ + panel_.heightPixels; }
    [[nodiscard]] double x(double value) const { return kLeft + value / xLargest_ * (right() - kLeft); }
    [[nodiscard]] double y(double value) const {
        return bottom() - std::clamp(value / yLargest_, 0.0, 1.0) * panel_.heightPixels;
    }

    [[nodiscard]] std::string grid() const {
        std::string svg;
        for (const double tick : roundTicks(yLargest_, static_cast<int>(panel_.heightPixels / 42.0)))
            svg += line(kLeft, y(tick), right(), y(tick), "#e4e4e4", 0.8) +
                   line(kLeft - 5.0, y(tick), kLeft, y(tick), "#222222", 1.0) +
                   textAt(kLeft - 9.0, y(tick) + 4.0, tickText(tick), "text-anchor=\"end\"");
        for (const double tick : roundTicks(xLargest_, 12)) {
            svg += line(x(tick), top_, x(tick), bottom(), "#efefef", 0.8) +
                   line(x(tick), bottom(), x(tick), bottom() + 5.0, "#222222", 1.0);
            if (namesX_) svg += textAt(x(tick), bottom() + 19.0, tickText(tick), "text-anchor=\"middle\"");
        }
        return svg;
    }

    /// Words beside upright lines, one step lower each, so that neighbours do not cover each other.
    [[nodiscard]] std::string verticals() const {
        std::string svg;
        double row = 0.0;
        for (const auto& rule : panel_.vertical) {
            svg +=
                line(x(rule.at), top_, x(rule.at), bottom(), rule.colour, 1.0, " stroke-dasharray=\"2 3\"");
            const bool fits = x(rule.at) < kLeft + 0.66 * (right() - kLeft);
            svg += textAt(x(rule.at) + (fits ? 5.0 : -5.0), bottom() - 8.0 - 14.0 * row, rule.label,
                          "class=\"note\" text-anchor=\"" + std::string(fits ? "start" : "end") +
                              "\" style=\"fill:" + rule.colour + "\"");
            row = row >= 3.0 ? 0.0 : row + 1.0;
        }
        return svg;
    }

    [[nodiscard]] std::string curve(const PlotSeries& series) const {
        std::string svg;
        if (series.lineWidth > 0.0 && series.points.size() > 1) {
            svg += "<polyline fill=\"none\" stroke=\"" + series.colour + "\" stroke-width=\"" +
                   number(series.lineWidth) + "\"" + (series.dashed ? " stroke-dasharray=\"6 4\"" : "") +
                   " points=\"";
            for (const auto& point : series.points)
                svg += number(x(point.x)) + "," + number(y(point.y)) + " ";
            svg += "\"/>\n";
        }
        for (const auto& point : series.points) {
            if (point.high > point.low)
                svg += line(x(point.x), y(point.low), x(point.x), y(point.high), series.colour, 1.0,
                            " stroke-opacity=\"0.55\"");
            svg += marker(series, point);
        }
        return svg;
    }

    [[nodiscard]] std::string marker(const PlotSeries& series, const PlotPoint& point) const {
        if (series.marker == PlotMarker::None) return {};
        if (point.y > yLargest_ || point.y < 0.0) return edgeMarker(series, point);
        return markerAt(series, x(point.x), y(point.y));
    }

    /// A triangle at the edge that the point lies beyond.
    [[nodiscard]] std::string edgeMarker(const PlotSeries& series, const PlotPoint& point) const {
        const bool above = point.y > 0.0;
        const double tip = above ? top_ + 1.0 : bottom() - 1.0;
        const double base = above ? tip + 5.0 : tip - 5.0;
        return "<path d=\"M" + number(x(point.x)) + " " + number(tip) + "L" + number(x(point.x) - 3.0) + " " +
               number(base) + "L" + number(x(point.x) + 3.0) + " " + number(base) + "Z\" fill=\"" +
               series.colour + "\" fill-opacity=\"0.6\"/>\n";
    }

public:
    static std::string markerAt(const PlotSeries& series, double px, double py) {
        const std::string circle = "<circle cx=\"" + number(px) + "\" cy=\"" + number(py) + "\" r=\"" +
                                   number(series.markerRadius) + "\" ";
        if (series.marker == PlotMarker::Dot) return circle + "fill=\"" + series.colour + "\"/>\n";
        return circle + "fill=\"#ffffff\" stroke=\"" + series.colour + "\" stroke-width=\"1.2\"/>\n";
    }

private:
    [[nodiscard]] std::string frame() const {
        const double middle = 0.5 * (top_ + bottom());
        return "<rect x=\"" + number(kLeft) + "\" y=\"" + number(top_) + "\" width=\"" +
               number(right() - kLeft) + "\" height=\"" + number(panel_.heightPixels) +
               "\" fill=\"none\" stroke=\"#222222\"/>\n" +
               textAt(0.0, 0.0, panel_.yLabel,
                      "class=\"label\" text-anchor=\"middle\" transform=\"translate(20 " + number(middle) +
                          ") rotate(-90)\"") +
               legend();
    }

    [[nodiscard]] std::string legend() const {
        std::string rows;
        std::size_t longest = 0;
        double count = 0.0;
        for (const auto& series : panel_.series) {
            if (series.label.empty()) continue;
            longest = std::max(longest, series.label.size());
            const double py = top_ + 20.0 + kLegendRow * count++;
            if (series.lineWidth > 0.0)
                rows += line(kLeft + 16.0, py, kLeft + 38.0, py, series.colour, series.lineWidth,
                             series.dashed ? " stroke-dasharray=\"6 4\"" : "");
            if (series.marker != PlotMarker::None) rows += markerAt(series, kLeft + 27.0, py);
            rows += textAt(kLeft + 45.0, py + 4.0, series.label, "");
        }
        if (count == 0.0) return {};
        return "<rect x=\"" + number(kLeft + 10.0) + "\" y=\"" + number(top_ + 8.0) + "\" width=\"" +
               number(46.0 + 6.7 * static_cast<double>(longest)) + "\" height=\"" +
               number(8.0 + kLegendRow * count) +
               "\" fill=\"#ffffff\" fill-opacity=\"0.88\" stroke=\"#c8c8c8\"/>\n" + rows;
    }

    const PlotPanel& panel_;
    double xLargest_;
    double yLargest_;
    double top_;
    bool namesX_;
};

} // namespace

std::vector<double> roundTicks(double largest, int most) {
    if (!(largest > 0.0) || most < 1) return {0.0};
    double step = std::pow(10.0, std::floor(std::log10(largest / most)));
    for (const double factor : {1.0, 2.0, 5.0, 10.0})
        if (largest / (step * factor) <= most) {
            step *= factor;
            break;
        }
    std::vector<double> ticks;
    for (int i = 0; i * step <= largest * (1.0 + 1e-9); ++i)
        ticks.push_back(i * step);
    return ticks;
}

std::string svgOf(const PlotFigure& figure) {
    double height = kTop + kBottom - kPanelGap;
    for (const auto& panel : figure.panels)
        height += panel.heightPixels + kPanelGap;
    const double labelY = height - 12.0;
    height += kNoteRow * static_cast<double>(figure.notes.size());
    std::string svg =
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"" + number(kWidth) + "\" height=\"" +
        number(height) + "\" viewBox=\"0 0 " + number(kWidth) + " " + number(height) + "\">\n" +
        "<style>text{font-family:'DejaVu Sans',Helvetica,Arial,sans-serif;font-size:12px;fill:#222}"
        ".title{font-size:15px;font-weight:bold}.label{font-size:13px}.note{font-size:11px;"
        "paint-order:stroke;stroke:#fff;stroke-width:3px;stroke-linejoin:round}</style>\n"
        "<rect width=\"100%\" height=\"100%\" fill=\"#ffffff\"/>\n" +
        textAt(kLeft, 24.0, figure.title, "class=\"title\"") +
        textAt(kLeft, 43.0, figure.subtitle, "class=\"note\"");
    double top = kTop;
    for (const auto& panel : figure.panels) {
        svg += PanelDrawing(panel, figure.xLargest, top, &panel == &figure.panels.back()).draw();
        top += panel.heightPixels + kPanelGap;
    }
    svg += textAt(0.5 * (kLeft + kWidth - kRight), labelY, figure.xLabel,
                  "class=\"label\" text-anchor=\"middle\"");
    double noteY = labelY;
    for (const auto& note : figure.notes)
        svg += textAt(kLeft, noteY += kNoteRow, note, "class=\"note\"");
    return svg + "</svg>\n";
}

} // namespace voxsheet::bench
