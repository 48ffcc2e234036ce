// Atoms, bonds, unit cells and the crosshair in the picture of a volume, opaque and at their depth with every
// technique.
//
// Before the technique draws, the solids are rasterised: a rectangle around each, whose fragments meet it
// exactly (ray casting of quadrics; Sigg et al., "GPU-Based Ray-Casting of Quadratic Surfaces", 2006), give a
// texture of lit colours and depths on the pixels' rays. The technique then shows only what lies before them
// (stages/solids.glsl), and the solids' colours go under its picture. One ray a pixel, as volumes have.
//
// Solids are lit by the picture's lights and material, also where the volume is not; lines are not. Clips:
// an atom stays whole where its centre is kept, or lies less than a quarter of its radius beyond the cut, and
// is gone otherwise, so that no sphere is cut open; a bond stays where both its atoms do; edges of cells are
// cut where the volume is; the crosshair never is.
//
// With Technique::Plane, which shows a cut, the solids are cut too: flat discs of the atoms and flat bands of
// the bonds that the plane passes through, unlit, on the volume's values; and the outlines of the cells.
#pragma once

#include "gpu/framebuffer.h"
#include "stages/recent_cache.h"
#include "stages/shared_stages.h"

#include <optional>
#include <string>

namespace voxsheet {

/// Whether the tile's picture of such a dataset has any: then it is drawn by the GL.
[[nodiscard]] bool showsSolids(const TileSpec& tile, const DatasetMeta& meta);

/// Keeps the solids of the last tiles and its textures from picture to picture.
class SolidsOverlay {
public:
    explicit SolidsOverlay(gpu::Context& context) : context_(context), crystals_(kCrystals) {}

    /// For DrawVolumes::solids; null: the tile shows none. The texture holds until the next draw. Throws as
    /// crystalSites.
    [[nodiscard]] const gpu::Texture* draw(SharedStages& stages, const DrawRequest& request);
    /// Puts their colours under the picture that the technique has drawn.
    void drawUnder(SharedStages& stages, const DrawRequest& request);

private:
    static constexpr std::size_t kCrystals = 8;
    struct Key {
        std::string dataset;
        CrystalSpec crystal;
        std::optional<glm::dvec3> crosshair;
        PeriodicWindow periodic;
        bool flat;
        glm::dvec4 plane; ///< where `flat`
        bool operator==(const Key&) const = default;
    };
    struct Solids {
        std::optional<gpu::Buffer> buffer;
        int count = 0;
    };

    const Solids& solidsOf(const DrawRequest& request);
    void prepareTextures(glm::ivec2 sizePixels);
    void bind(const gpu::Program& program, const DrawRequest& request) const;

    gpu::Context& context_;
    RecentCache<Key, Solids> crystals_;
    std::optional<gpu::Texture> colours_;
    std::optional<gpu::Texture> depth_;
    std::optional<gpu::VertexArray> layout_;
};

} // namespace voxsheet
