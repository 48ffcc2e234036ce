#include "volume/neighbour_cells.h"

#include <algorithm>
#include <cmath>

namespace voxsheet {
namespace {

constexpr double kMostCellsPerAxis = 128.0;

/// Points sorted into cubes at least `reach` wide.
class Cells {
public:
    Cells(const std::vector<glm::dvec3>& points, double reach) {
        glm::dvec3 high = low_ = points.front();
        for (const glm::dvec3& point : points) {
            low_ = glm::min(low_, point);
            high = glm::max(high, point);
        }
        const auto extent = high - low_;
        width_ = std::max(reach, std::max({extent.x, extent.y, extent.z}) / kMostCellsPerAxis);
        count_ = glm::ivec3(glm::floor(extent / width_)) + 1;
        begins_.assign(static_cast<std::size_t>(count_.x * count_.y * count_.z) + 1, 0);
        for (const glm::dvec3& point : points)
            ++begins_[indexOf(cellOf(point)) + 1];
        for (std::size_t i = 1; i < begins_.size(); ++i)
            begins_[i] += begins_[i - 1];
        auto next = begins_;
        members_.resize(points.size());
        for (std::size_t i = 0; i < points.size(); ++i)
            members_[next[indexOf(cellOf(points[i]))]++] = i;
    }

    [[nodiscard]] glm::ivec3 cellOf(const glm::dvec3& point) const {
        return glm::min(glm::ivec3((point - low_) / width_), count_ - 1);
    }

    template <typename Visit>
    void visitAround(const glm::ivec3& cell, Visit visit) const {
        const auto first = glm::max(cell - 1, glm::ivec3(0));
        const auto last = glm::min(cell + 1, count_ - 1);
        for (int z = first.z; z <= last.z; ++z)
            for (int y = first.y; y <= last.y; ++y)
                for (int x = first.x; x <= last.x; ++x) {
                    const std::size_t index = indexOf({x, y, z});
                    for (std::size_t i = begins_[index]; i < begins_[index + 1]; ++i)
                        visit(members_[i]);
                }
    }

private:
    [[nodiscard]] std::size_t indexOf(const glm::ivec3& cell) const {
        return static_cast<std::size_t>(cell.x + count_.x * (cell.y + count_.y * cell.z));
    }

    glm::dvec3 low_;
    double width_ = 1.0;
    glm::ivec3 count_{1};
    std::vector<std::size_t> begins_; ///< of each cell in members_, and their end
    std::vector<std::size_t> members_;
};

} // namespace

void forEachPairWithin(const std::vector<glm::dvec3>& points, double reach,
                       const std::function<void(std::size_t, std::size_t)>& visit) {
    if (points.empty()) return;
    const Cells cells(points, reach);
    for (std::size_t i = 0; i < points.size(); ++i)
        cells.visitAround(cells.cellOf(points[i]), [&](std::size_t j) {
            if (i < j && glm::distance(points[i], points[j]) <= reach) visit(i, j);
        });
}

} // namespace voxsheet
