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

bool overlap(const CellPatch& a, const CellPatch& b) {
    for (int axis = 0; axis < 3; ++axis) {
        const double low = std::max(a.low[axis], b.low[axis]);
        const double high = std::min(a.low[axis] + a.cellSize[axis] * a.dims[axis],
                                     b.low[axis] + b.cellSize[axis] * b.dims[axis]);
        if (high - low < kRounding * a.cellSize[axis]) return false;
    }
    return true;
}

} // namespace

void Resampling::checkLevels(const std::string& name, const std::vector<CellPatch>& patches) {
    const CellPatch* ofLevel = nullptr;
    for (const auto& patch : patches) {
        if (!ofLevel || ofLevel->level != patch.level) ofLevel = &patch;
        for (int axis = 0; axis < 3; ++axis) {
            const double ratio = patch.cellSize[axis] / ofLevel->cellSize[axis];
            if (std::abs(ratio - 1.0) > kRounding && !patch.flat[axis])
                throw InvalidInput(name, "patches of its level " + std::to_string(patch.level) +
                                             " have cells of different sizes");
        }
    }
}

double Resampling::mostSamples(const std::vector<CellPatch>& patches) {
    double inPatches = 0.0;
    for (const auto& patch : patches)
        inPatches += static_cast<double>(sampleCount(patch.dims));
    return std::min(kMostCells, std::max(kCellsForAll, kMostPerCell * inPatches));
}

void Resampling::failTooMany(const std::string& name, const char* samples) {
    throw LimitExceeded(name,
                        std::string("a uniform grid over its patches would have too many ") + samples +
                            ", also with those of its coarsest level",
                        "write the part that matters as an image");
}

std::string Resampling::describePatches(const std::vector<CellPatch>& patches, const glm::ivec3& dims,
                                        const char* samples) {
    const int levels = patches.back().level - patches.front().level + 1;
    return "its " + std::to_string(patches.size()) + " patches in " + std::to_string(levels) +
           " levels became a uniform grid of " + std::to_string(dims.x) + " x " + std::to_string(dims.y) +
           " x " + std::to_string(dims.z) + " " + samples;
}

std::vector<std::byte> Resampling::blank(ScalarType source) const {
    const auto type = resultType(source);
    const auto cells = static_cast<std::size_t>(sampleCount(grid().dims));
    std::vector<std::byte> bytes(cells * scalarBytes(type));
    visitScalar(type, [&]<typename T>() {
        if constexpr (std::is_floating_point_v<T>)
            std::fill_n(reinterpret_cast<T*>(bytes.data()), cells, std::numeric_limits<T>::quiet_NaN());
    });
    return bytes;
}

PatchResampling::PatchResampling(const std::string& name, std::vector<CellPatch> patches)
    : patches_(std::move(patches)) {
    low_ = glm::dvec3(std::numeric_limits<double>::infinity());
    high_ = -low_;
    checkLevels(name, patches_);
    for (const auto& patch : patches_) {
        low_ = glm::min(low_, patch.low);
        high_ = glm::max(high_, patch.low + patch.cellSize * glm::dvec3(patch.dims));
        for (int axis = 0; axis < 3; ++axis)
            flat_[axis] = flat_[axis] && patch.flat[axis];
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
    const double most = mostSamples(patches_);
    const auto length = high_ - low_;
    for (auto patch = patches_.rbegin();; ++patch) { // from the finest level on
        if (patch == patches_.rend()) failTooMany(name, "cells");
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

/// The patches of the coarsest level fill the box. Not sure, and so no, if two of them overlap.
bool PatchResampling::coversAll() const {
    double volume = 0.0;
    for (auto patch = patches_.begin(); patch != patches_.end() && patch->level == patches_.front().level;
         ++patch) {
        const auto size = patch->cellSize * glm::dvec3(patch->dims);
        volume += size.x * size.y * size.z;
        if (std::any_of(patches_.begin(), patch, [&](auto& other) { return overlap(other, *patch); }))
            return false;
    }
    const auto box = high_ - low_;
    return volume > (1.0 - kRounding) * box.x * box.y * box.z;
}

std::string PatchResampling::note() const {
    std::string text = "Resampled: " + describePatches(patches_, grid_.dims, "cells");
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
    paintTyped(from, values, type, cells,
               [&]<typename In, typename Out>(std::span<const In> in, std::span<Out> out) {
                   paintAs(from, in, out);
               });
}

} // namespace voxsheet::import
