#include "engine/orientation_marks.h"

#include <algorithm>
#include <array>
#include <utility>

namespace voxsheet::engine {

namespace {

/// As on the page.
constexpr double kLeastShare = 0.35; ///< of a direction's length that lies towards an edge, to be named there
constexpr std::array<glm::vec4, 3> kAxisColours{
    {{0.898F, 0.451F, 0.373F, 1.0F}, {0.475F, 0.710F, 0.388F, 1.0F}, {0.416F, 0.627F, 0.910F, 1.0F}}};
constexpr std::array<const char*, 3> kAxisNames{"x", "y", "z"};

class MarkPainter {
public:
    MarkPainter(Canvas& canvas, const OrientationMarks& marks, const PixelRect& area)
        : canvas_(canvas), marks_(marks), area_(area) {}

    void paint() {
        if (area_.size().x < 12 * font() || area_.size().y < 6 * font()) return;
        if (marks_.anatomical)
            paintLetters();
        else
            paintAxes();
    }

private:
    [[nodiscard]] int font() const { return marks_.fontPixels; }

    void label(glm::ivec2 at, TextAlign align, const std::string& word) {
        glm::vec4 outline = marks_.background;
        outline.w = 0.7F;
        for (const glm::ivec2 shift : {glm::ivec2(1, 0), {-1, 0}, {0, 1}, {0, -1}})
            canvas_.text(at + shift, align, word, font(), outline, area_.size().x);
        canvas_.text(at, align, word, font(), marks_.text, area_.size().x);
    }

    void paintLetters() {
        const int middle = (area_.low.x + area_.high.x) / 2;
        const int below = area_.high.y - font();
        const auto letters = [&](double right, double up) {
            return edgeLetters(marks_.viewFromWorld, {right, up});
        };
        label({middle, area_.low.y + font()}, TextAlign::Centre, letters(0, 1));
        label({middle, below}, TextAlign::Centre, letters(0, -1));
        label({area_.low.x + font() / 2, below}, TextAlign::Left, letters(-1, 0));
        label({area_.high.x - font() / 2, below}, TextAlign::Right, letters(1, 0));
    }

    void paintAxes() {
        const double arm = 1.4 * font();
        const glm::dvec2 centre(area_.low.x + 2.2 * font(), area_.high.y - 2.2 * font());
        std::array<int, 3> order{0, 1, 2}; // the farthest from the eye first
        std::sort(order.begin(), order.end(),
                  [&](int a, int b) { return marks_.viewFromWorld[a].z < marks_.viewFromWorld[b].z; });
        for (const int axis : order) {
            const glm::dvec3& direction = marks_.viewFromWorld[axis];
            const glm::dvec2 towards(direction.x, -direction.y);
            const auto at = static_cast<std::size_t>(axis);
            canvas_.line(centre, centre + arm * towards, area_, kAxisColours[at],
                         std::max(1.5, font() / 8.0));
            label(glm::ivec2(glm::round(centre + (arm + 0.5 * font()) * towards)), TextAlign::Centre,
                  kAxisNames[at]);
        }
    }

    Canvas& canvas_;
    const OrientationMarks& marks_;
    const PixelRect& area_;
};

} // namespace

std::string edgeLetters(const glm::dmat3& viewFromWorld, const glm::dvec2& rightUp) {
    constexpr std::array<const char*, 3> kSides{"RL", "AP", "SI"};
    std::array<std::pair<double, char>, 6> along;
    for (std::size_t i = 0; i < along.size(); ++i) {
        const double sign = i % 2 == 0 ? 1.0 : -1.0;
        const glm::dvec3 direction = sign * viewFromWorld[static_cast<int>(i / 2)];
        along[i] = {glm::dot(glm::dvec2(direction), rightUp), kSides[i / 2][i % 2]};
    }
    std::sort(along.begin(), along.end(), [](const auto& a, const auto& b) { return a.first > b.first; });
    std::string letters;
    for (const auto& [share, letter] : along)
        if (share > kLeastShare && letters.size() < 2) letters += letter;
    return letters;
}

void paintOrientation(Canvas& canvas, const OrientationMarks& marks, const PixelRect& area) {
    MarkPainter(canvas, marks, area).paint();
}

} // namespace voxsheet::engine
