// Patches of cells of different sizes (adaptive mesh refinement) onto one uniform grid of cells.
#pragma once

#include "base/errors.h"
#include "volume/grid.h"
#include "volume/scalar_type.h"

#include <array>
#include <cstddef>
#include <span>
#include <string>
#include <vector>

namespace voxsheet::import {

/// A box of equal cells whose edges are parallel to the world's axes.
struct CellPatch {
    int level = 0; ///< of refinement: where patches overlap, the highest counts
    glm::dvec3 low{0.0};
    glm::dvec3 cellSize{1.0}; ///< > 0
    glm::ivec3 dims{1};       ///< cells
    glm::bvec3 flat{false};   ///< has no extent along the axis: one cell, whatever its size
};

/// Many patches onto one uniform grid.
class Resampling {
public:
    Resampling() = default;
    virtual ~Resampling() = default;
    Resampling(const Resampling&) = delete;
    Resampling& operator=(const Resampling&) = delete;

    /// In the coordinates of the patches.
    [[nodiscard]] virtual const Grid& grid() const = 0;
    /// For people.
    [[nodiscard]] virtual std::string note() const = 0;
    [[nodiscard]] virtual ScalarType resultType(ScalarType source) const = 0;

    /// Values of the grid's samples before anything is painted: no value, or 0 of an integer type.
    [[nodiscard]] std::vector<std::byte> blank(ScalarType source) const;
    /// Puts a patch's values (as many as it has samples) over what lies there: to be called in the order of
    /// the patches.
    virtual void paint(std::size_t patch, std::span<const std::byte> values, ScalarType type,
                       std::vector<std::byte>& samples) const = 0;

protected:
    /// Throws InvalidInput (subject `name`) if patches of one level have cells of different sizes. Patches
    /// are in the order of their levels.
    static void checkLevels(const std::string& name, const std::vector<CellPatch>& patches);
    /// A grid may have at most 2^27 samples, and at most 64 times as many as the patches have together (or
    /// 2^20), since a small file must not become a huge volume.
    [[nodiscard]] static double mostSamples(const std::vector<CellPatch>& patches);
    [[noreturn]] static void failTooMany(const std::string& name, const char* samples);
    /// "its 2 patches in 2 levels became a uniform grid of 4 x 4 x 2 cells"
    [[nodiscard]] static std::string describePatches(const std::vector<CellPatch>& patches,
                                                     const glm::ivec3& dims, const char* samples);
    /// Calls paintAs(span of In, span of Out) with the types of the patch's values and of the result's.
    template <typename PaintAs>
    void paintTyped(const CellPatch& patch, std::span<const std::byte> values, ScalarType type,
                    std::vector<std::byte>& samples, const PaintAs& paintAs) const;
};

class PatchResampling : public Resampling {
public:
    /// The uniform grid spans all patches, with cells as those of the finest level that gives no more than
    /// mostSamples(). Patches are in the order of their levels. Throws InvalidInput (subject `name`)
    /// if patches of one level have cells of different sizes, LimitExceeded if not even the coarsest level
    /// gives so few.
    PatchResampling(const std::string& name, std::vector<CellPatch> patches);

    [[nodiscard]] const Grid& grid() const override { return grid_; } ///< of cells
    [[nodiscard]] std::string note() const override;
    /// Integers stay integers unless cells are averaged, or some place has no patch (F64 from 32 bits on).
    [[nodiscard]] ScalarType resultType(ScalarType source) const override;
    /// A cell of the grid takes the value of the patch's cell that holds its centre; where the
    /// patch's cells are smaller, their mean.
    void paint(std::size_t patch, std::span<const std::byte> values, ScalarType type,
               std::vector<std::byte>& cells) const override;

private:
    struct Pair {
        int from = 0; ///< of the patch
        int to = 0;   ///< of the grid
    };
    [[nodiscard]] std::array<std::vector<Pair>, 3> pairsOf(const CellPatch& patch) const;
    template <typename In, typename Out>
    void paintAs(const CellPatch& patch, std::span<const In> in, std::span<Out> out) const;

    void placeGrid(const std::string& name);
    [[nodiscard]] bool isFiner(const CellPatch& patch, int axis) const;
    [[nodiscard]] bool coversAll() const;

    std::vector<CellPatch> patches_;
    glm::dvec3 low_{0.0};
    glm::dvec3 high_{0.0};
    glm::dvec3 cellSize_{1.0};
    glm::bvec3 flat_{true}; ///< all patches are
    int level_ = 0;         ///< whose cells the grid has
    bool averages_ = false;
    bool gaps_ = false;
    Grid grid_;
};

template <typename PaintAs>
void Resampling::paintTyped(const CellPatch& patch, std::span<const std::byte> values, ScalarType type,
                            std::vector<std::byte>& samples, const PaintAs& paintAs) const {
    const auto result = resultType(type);
    visitScalar(type, [&]<typename In>() {
        const std::span<const In> in(reinterpret_cast<const In*>(values.data()), values.size() / sizeof(In));
        if (in.size() != static_cast<std::size_t>(sampleCount(patch.dims)))
            throw InternalError("AMR patch", "an array is not as large as its header said");
        const auto paintInto = [&]<typename Out>(Out) {
            paintAs(in, std::span(reinterpret_cast<Out*>(samples.data()), samples.size() / sizeof(Out)));
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
