// Draws with the kernels of simd/ what they can draw, where rays are marched by the processor (the workaround
// "simd-rays").
#pragma once

#include "simd/kernels.h"
#include "stages/recent_cache.h"
#include "stages/shared_stages.h"
#include "volume/thread_team.h"

#include <memory>
#include <vector>

namespace voxsheet {

/// Belongs to the render thread, which its kernels help with all cores.
class SimdRays {
public:
    SimdRays();

    /// As TechniqueSet::draw, of pictures with marchesRays() whose volumes are all in host memory.
    void draw(SharedStages& stages, const DrawRequest& request);
    /// Likewise into `pixels`: rgba of the whole picture, row 0 at the bottom, made as large as that takes.
    void drawOnHost(SharedStages& stages, const DrawRequest& request, std::vector<float>& pixels);

private:
    const std::vector<glm::vec4>& tableOf(const std::shared_ptr<const TransferTable>& table);
    [[nodiscard]] simd::PictureJob jobFor(SharedStages& stages, const DrawRequest& request,
                                          std::vector<float>& pixels);
    void readSolids(const DrawRequest& request);
    void setLayers(simd::PictureJob& job, SharedStages& stages, const DrawRequest& request);
    void setSurfaces(simd::SurfaceNumbers& surfaces, const DrawRequest& request);

    using Tables = RecentCache<TableKey, std::vector<glm::vec4>>;

    Tables tables_;
    Tables integrals_;
    std::vector<float> pixels_; ///< rgba
    std::vector<float> solids_; ///< the same of DrawVolumes::solids
    ThreadTeam team_;
};

} // namespace voxsheet
