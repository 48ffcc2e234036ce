#include "import/formats/patch_resampling.h"

#include "base/errors.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

namespace voxsheet::import {

namespace {

constexpr double kRounding = 1e-4; // of a cell
constexpr double kMostCells = 1U << 27;
constexpr double kCellsForAll = 1U << 20;
constexpr double kMostPerCell = 64.0;

} // namespace

PatchResampling::PatchResampling(const std::string& name, std::vector<CellPatch> patches)
    : patches_(std::move(patches)) {
    low_ = glm::dvec3(std::numeric_limits<double>::infinity());
    high_ = -low_;
    const CellPatch* ofLevel = nullptr;
    for (const auto& patch : patches_) {
        low_ = glm::min(low_, patch.low);
        high_ = glm::max(high_, patch.low + patch.cellSize * glm::dvec3(patch.dims));
        if (!ofLevel || ofLevel->level != patch.level) ofLevel = &patch;
        for (int axis = 0; axis < 3; ++axis) {
            flat_[axis] = flat_[axis] && patch.flat[axis];
            const double ratio = patch.cellSize[axis] / ofLevel->cellSize[axis];
            if (std::abs(ratio - 1.0) > kRounding && !patch.flat[axis])
                throw InvalidInput(name, "patches of its level " + std::to_string(patch.level) +
                                             " have cells of different sizes");
        }
    }
    placeGrid(name);
    for (const auto& patch : patches_)
        for (int axis = 0; axis < 3; ++axis)
            averages_ = averages_ || isFiner(patch, axis);
    gaps_ = !coversAll();
}

bool PatchResampling::isFiner(const CellPatch& patch, int axis) const {
    return !flat_[axis] && patch.cellSize[axis] < (1.0 - kRounding) * cellSize_[axis];
}

void PatchResampling::placeGrid(const std::string& name) {
    double inPatches = 0.0;
    for (const auto& patch : patches_)
        inPatches += static_cast<double>(sampleCount(patch.dims));
    const double most = std::min(kMostCells, std::max(kCellsForAll, kMostPerCell * inPatches));
    const auto length = high_ - low_;
    for (auto patch = patches_.rbegin();; ++patch) { // from the finest level on
        if (patch == patches_.rend())
            throw LimitExceeded(
                name,
                "a uniform grid over its patches would have too many cells, also with those of "
                "its coarsest level",
                "write the part that matters as an image");
        glm::dvec3 counts(1.0);
        for (int axis = 0; axis < 3; ++axis)
            if (!flat_[axis]) counts[axis] = std::max(1.0, std::round(length[axis] / patch->cellSize[axis]));
        if (!(counts.x * counts.y * counts.z <= most)) continue;
        level_ = patch->level;
        grid_.dims = glm::ivec3(counts);
        cellSize_ = length / counts;
        break;
    }
    grid_.centring = Centring::Cell;
    for (int axis = 0; axis < 3; ++axis) {
        grid_.worldFromIndex[axis] = glm::dvec4(0.0);
        grid_.worldFromIndex[axis][axis] = cellSize_[axis];
        grid_.worldFromIndex[3][axis] = low_[axis] + 0.5 * cellSize_[axis];
    }
    validateGrid(grid_);
}

/// The patches of the coarsest level fill the box. Patches of one level do not overlap.
bool PatchResampling::coversAll() const {
    double volume = 0.0;
    for (const auto& patch : patches_)
        if (patch.level == patches_.front().level) {
            const auto size = patch.cellSize * glm::dvec3(patch.dims);
            volume += size.x * size.y * size.z;
        }
    const auto box = high_ - low_;
    return volume > (1.0 - kRounding) * box.x * box.y * box.z;
}

std::string PatchResampling::note() const {
    const auto& dims = grid_.dims;
    const int levels = patches_.back().level - patches_.front().level + 1;
    std::string text = "Resampled: its " + std::to_string(patches_.size()) + " patches in " +
                       std::to_string(levels) + " levels became a uniform grid of " + std::to_string(dims.x) +
                       " x " + std::to_string(dims.y) + " x " + std::to_string(dims.z) + " cells";
    text += averages_
                ? ", as large as those of level " + std::to_string(level_) + "; smaller ones were averaged."
                : ", each with the value of the finest patch there.";
    if (gaps_) text += " Places without a patch have no value.";
    return text;
}

ScalarType PatchResampling::resultType(ScalarType source) const {
    if (isFloat(source) || (!averages_ && !gaps_)) return source;
    return scalarBytes(source) <= 2 ? ScalarType::F32 : ScalarType::F64;
}

std::vector<std::byte> PatchResampling::blank(ScalarType source) const {
    const auto type = resultType(source);
    const auto cells = static_cast<std::size_t>(sampleCount(grid_.dims));
    std::vector<std::byte> bytes(cells * scalarBytes(type));
    visitScalar(type, [&]<typename T>() {
        if constexpr (std::is_floating_point_v<T>)
            std::fill_n(reinterpret_cast<T*>(bytes.data()), cells, std::numeric_limits<T>::quiet_NaN());
    });
    return bytes;
}

std::array<std::vector<PatchResampling::Pair>, 3> PatchResampling::pairsOf(const CellPatch& patch) const {
    std::array<std::vector<Pair>, 3> pairs;
    for (int axis = 0; axis < 3; ++axis) {
        auto& list = pairs[static_cast<std::size_t>(axis)];
        if (flat_[axis]) {
            list.push_back({0, 0});
            continue;
        }
        const double cell = patch.cellSize[axis];
        const double size = cellSize_[axis];
        const double start = patch.low[axis] - low_[axis];
        const int last = grid_.dims[axis] - 1;
        if (isFiner(patch, axis)) {
            for (int from = 0; from < patch.dims[axis]; ++from)
                list.push_back(
                    {from, std::clamp(static_cast<int>((start + (from + 0.5) * cell) / size), 0, last)});
            continue;
        }
        const double end = start + cell * patch.dims[axis];
        const int first = std::max(0, static_cast<int>(std::ceil(start / size - 0.5 - kRounding)));
        for (int to = first; to <= last && (to + 0.5) * size < end + kRounding * size; ++to) {
            const int from = static_cast<int>(std::floor(((to + 0.5) * size - start) / cell));
            list.push_back({std::clamp(from, 0, patch.dims[axis] - 1), to});
        }
    }
    return pairs;
}

template <typename In, typename Out>
void PatchResampling::paintAs(const CellPatch& patch, std::span<const In> in, std::span<Out> out) const {
    const auto pairs = pairsOf(patch);
    const auto inAt = [&](const Pair& x, const Pair& y, const Pair& z) {
        return (static_cast<std::size_t>(z.from) * static_cast<std::size_t>(patch.dims.y) +
                static_cast<std::size_t>(y.from)) *
                   static_cast<std::size_t>(patch.dims.x) +
               static_cast<std::size_t>(x.from);
    };
    const auto each = [&](const auto& visit) {
        for (const auto& z : pairs[2])
            for (const auto& y : pairs[1])
                for (const auto& x : pairs[0])
                    visit(x, y, z);
    };
    const auto outAt = [&](const Pair& x, const Pair& y, const Pair& z) {
        return (static_cast<std::size_t>(z.to) * static_cast<std::size_t>(grid_.dims.y) +
                static_cast<std::size_t>(y.to)) *
                   static_cast<std::size_t>(grid_.dims.x) +
               static_cast<std::size_t>(x.to);
    };
    bool finer = false;
    for (int axis = 0; axis < 3; ++axis)
        finer = finer || isFiner(patch, axis);
    if (!finer) {
        each([&](auto& x, auto& y, auto& z) { out[outAt(x, y, z)] = static_cast<Out>(in[inAt(x, y, z)]); });
        return;
    }
    // Sums over the part of the grid that the patch meets.
    glm::ivec3 first(0);
    glm::ivec3 size(0);
    for (int axis = 0; axis < 3; ++axis) {
        const auto& list = pairs[static_cast<std::size_t>(axis)];
        if (list.empty()) return;
        first[axis] = list.front().to;
        size[axis] = list.back().to - list.front().to + 1;
    }
    struct Sum {
        double value = 0.0;
        double count = 0.0;
    };
    std::vector<Sum> sums(static_cast<std::size_t>(sampleCount(size)));
    const auto sumAt = [&](const Pair& x, const Pair& y, const Pair& z) -> Sum& {
        return sums[(static_cast<std::size_t>(z.to - first.z) * static_cast<std::size_t>(size.y) +
                     static_cast<std::size_t>(y.to - first.y)) *
                        static_cast<std::size_t>(size.x) +
                    static_cast<std::size_t>(x.to - first.x)];
    };
    each([&](auto& x, auto& y, auto& z) {
        auto& sum = sumAt(x, y, z);
        sum.value += static_cast<double>(in[inAt(x, y, z)]);
        sum.count += 1.0;
    });
    each([&](auto& x, auto& y, auto& z) {
        const auto& sum = sumAt(x, y, z);
        out[outAt(x, y, z)] = static_cast<Out>(sum.value / sum.count);
    });
}

void PatchResampling::paint(std::size_t patch, std::span<const std::byte> values, ScalarType type,
                            std::vector<std::byte>& cells) const {
    const auto& from = patches_.at(patch);
    const auto result = resultType(type);
    visitScalar(type, [&]<typename In>() {
        const std::span<const In> in(reinterpret_cast<const In*>(values.data()), values.size() / sizeof(In));
        if (in.size() != static_cast<std::size_t>(sampleCount(from.dims)))
            throw InternalError("AMR patch", "an array is not as large as its header said");
        const auto paintInto = [&]<typename Out>(Out) {
            paintAs<In, Out>(from, in, {reinterpret_cast<Out*>(cells.data()), cells.size() / sizeof(Out)});
        };
        if (result == type)
            paintInto(In{});
        else if (result == ScalarType::F32)
            paintInto(float{});
        else
            paintInto(double{});
    });
}

} // namespace voxsheet::import
