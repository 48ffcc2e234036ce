#if VOXSHEET_SIMD
#include "techniques/simd_rays.h"

#include "base/thread_count.h"
#include "stages/gradient_frame.h"
#include "stages/layer_stage.h"
#include "stages/preintegration.h"
#include "techniques/isosurface/surface_texels.h"
#include "techniques/raycast/raycast.h"
#include "techniques/slicing/slicing.h"

#include <algorithm>
#include <span>

namespace voxsheet {
namespace {

constexpr std::size_t kCachedTables = 256; ///< of 64 KiB each: one for each of many cells
constexpr int kRowsPerTask = 2;

template <std::size_t n, typename Vector>
void put(float (&to)[n], const Vector& from) {
    for (std::size_t i = 0; i < n; ++i)
        to[i] = static_cast<float>(from[static_cast<int>(i)]);
}

void putPlaced(float (&to)[12], const glm::mat4& matrix) {
    for (int column = 0; column < 4; ++column)
        for (int row = 0; row < 3; ++row)
            to[column * 3 + row] = matrix[column][row];
}

void putMatrix(float (&to)[9], const glm::mat3& matrix) {
    for (int column = 0; column < 3; ++column)
        for (int row = 0; row < 3; ++row)
            to[column * 3 + row] = matrix[column][row];
}

simd::RayNumbers raysOf(const RayFrame& frame, glm::ivec2 size) {
    simd::RayNumbers rays{};
    put(rays.pictureOfPixel, glm::dvec4(2.0 * frame.pictureHalf / glm::dvec2(size), -frame.pictureHalf));
    put(rays.origin, frame.origin);
    put(rays.originX, frame.originX);
    put(rays.originY, frame.originY);
    put(rays.direction, frame.direction);
    put(rays.directionX, frame.directionX);
    put(rays.directionY, frame.directionY);
    rays.nearest = static_cast<float>(frame.nearest);
    rays.lengthPerspective = frame.perspective ? 1.0F : 0.0F;
    put(rays.boxLow, frame.boxLow);
    put(rays.boxHigh, frame.boxHigh);
    return rays;
}

simd::SampledVolume sampledVolume(const HostTexels& texels) {
    simd::SampledVolume volume;
    volume.first = texels.first();
    volume.format = texels.format();
    volume.rowTexels = static_cast<std::int32_t>(texels.rowTexels());
    volume.sliceTexels = static_cast<std::int32_t>(texels.sliceTexels());
    put(volume.samples, texels.dims());
    for (int axis = 0; axis < 3; ++axis)
        volume.periodic[axis] = texels.periodic()[axis];
    return volume;
}

simd::SampledTable sampledTable(const std::vector<glm::vec4>& entries, const TransferTable& table,
                                const ResidentVolume& volume) {
    const auto mapping = classificationMapping(table, volume.valueScale, volume.valueOffset);
    simd::SampledTable sampled;
    sampled.entries = &entries.front().x;
    sampled.scale = static_cast<int>(table.scale);
    put(sampled.mappedFromTexel, mapping.mappedFromTexel);
    put(sampled.entryFromMapped, mapping.entryFromMapped);
    sampled.lastEntry = static_cast<float>(entries.size() - 1);
    const auto shows = [](const glm::vec4& entry) { return entry.w > 0.0F; };
    const auto begin = std::find_if(entries.begin(), entries.end(), shows);
    const auto end = std::find_if(entries.rbegin(), entries.rend(), shows).base();
    sampled.shownBegin = static_cast<float>(begin - entries.begin());
    sampled.shownEnd = static_cast<float>(end - entries.begin());
    return sampled;
}

simd::SampledCells sampledCells(const EmptySpaceStage::HostCells& cells, const ResidentVolume& volume) {
    const auto layout = CellLayout::of(volume.dims);
    simd::SampledCells sampled;
    sampled.marks = cells.marks.empty() ? nullptr : cells.marks.data();
    sampled.largest = cells.largest.empty() ? nullptr : cells.largest.data();
    sampled.cellSamples = static_cast<float>(layout.cellSamples);
    for (int axis = 0; axis < 3; ++axis) {
        sampled.cellsPerTexture[axis] =
            static_cast<float>(volume.dims[axis]) / static_cast<float>(layout.cellSamples);
        sampled.cells[axis] = layout.cells[axis];
        sampled.periodic[axis] = volume.meta->grid.periodic[axis];
    }
    return sampled;
}

simd::ClipNumbers clipOf(const DrawRequest& request) {
    const auto& tile = request.tile;
    const auto grid = placedGrid(request.volumes.volume.meta->grid, tile.periodic);
    simd::ClipNumbers clip;
    const auto planes = clipPlanesInTexture(tile.clip.planes, grid);
    clip.planeCount = static_cast<int>(planes.size());
    for (std::size_t i = 0; i < planes.size(); ++i) {
        put(clip.planes[i], planes[i]);
        put(clip.cutNormals[i], glm::dmat3(tile.camera.viewFromWorld) * tile.clip.planes[i].normal);
    }
    const auto* object = request.volumes.clipObject;
    if (object == nullptr) return clip;
    const auto frame = clipObjectFrame(tile, grid, *object);
    clip.hasObject = true;
    clip.binary = tile.clip.object->binary;
    clip.distances = sampledVolume(*object->host);
    putPlaced(clip.clipFromTexture, frame.clipFromTexture);
    putMatrix(clip.objectFromTexture, frame.objectFromTexture);
    put(clip.measureFromTexel, frame.measureFromTexel);
    clip.nearestSampleSlack = frame.nearestSampleSlack;
    putMatrix(clip.viewFromClipGradient, frame.viewFromClipGradient);
    put(clip.keptLow, frame.keptLow);
    put(clip.keptHigh, frame.keptHigh);
    return clip;
}

simd::LightNumbers lightOf(const TileSpec& tile, const ResidentVolume& volume) {
    const auto& shading = tile.shading;
    simd::LightNumbers light;
    if (!shading.enabled) return light;
    light.enabled = true;
    put(light.material, glm::dvec4(shading.ambient, shading.diffuse, shading.specular, shading.shininess));
    light.betweenSamples = shading.gradient == GradientSource::Texture;
    light.headLight = static_cast<float>(shading.headLight);
    light.lightCount = static_cast<int>(shading.lightsView.size());
    for (std::size_t i = 0; i < shading.lightsView.size(); ++i)
        put(light.lights[i], glm::dvec4(shading.lightsView[i], shading.lightIntensity));
    putMatrix(light.viewFromGradient,
              viewFromGradient(viewFromVoxels(tile.camera.viewFromWorld, volume.meta->grid, volume.dims)));
    return light;
}

std::span<float> drawnRows(std::vector<float>& picture, const DrawRequest& request) {
    const auto rows = request.rows.within(request.tile.sizePixels);
    const auto row = static_cast<std::size_t>(request.tile.sizePixels.x) * 4;
    return std::span(picture).subspan(row * static_cast<std::size_t>(rows.first),
                                      row * static_cast<std::size_t>(rows.end - rows.first));
}

simd::Kernel kernelOf(Technique technique) {
    switch (technique) {
    case Technique::Isosurface:
        return simd::isosurfaceRows;
    case Technique::Mip:
        return simd::mipRows;
    case Technique::Slices:
        return simd::slicingRows;
    default:
        return simd::raycastRows;
    }
}

template <typename Cache, typename Make>
const std::vector<glm::vec4>& cached(Cache& cache, const std::shared_ptr<const TransferTable>& table,
                                     Make make) {
    const auto* entries = madeOf(cache, table);
    return entries != nullptr ? *entries : cache.insert(TableKey(table), make(*table));
}

} // namespace

SimdRays::SimdRays() : tables_(kCachedTables), integrals_(kCachedTables), team_(threadCount().threads - 1) {}

const std::vector<glm::vec4>& SimdRays::tableOf(const std::shared_ptr<const TransferTable>& table) {
    return cached(tables_, table, shaderTable);
}

void SimdRays::setSurfaces(simd::SurfaceNumbers& surfaces, const DrawRequest& request) {
    const auto& [tile, volumes, frame, target, rows] = request;
    const auto texels = surfaceTexels(tile.isosurface, volumes.volume);
    surfaces.count = static_cast<int>(texels.texels.size());
    for (std::size_t i = 0; i < texels.texels.size(); ++i) {
        surfaces.texels[i] = texels.texels[i];
        put(surfaces.colours[i], texels.colours[i]);
    }
    surfaces.caps = tile.isosurface.caps;
    surfaces.plainTest = tile.isosurface.method == IsosurfaceMethod::AlphaTest;
    surfaces.tolerance = texels.plainTestTolerance;
    put(surfaces.capTexels, texels.cap);
    put(surfaces.mirroredCapTexels, texels.mirroredCap);
    if (volumes.colours == nullptr) return;
    const auto& other = volumes.colours->meta->grid;
    const auto& table = tile.isosurface.colouredBy->transfer;
    const auto grid = placedGrid(volumes.volume.meta->grid, tile.periodic);
    const auto box = boxIndex(other);
    surfaces.hasColours = true;
    surfaces.colours3d = sampledVolume(*volumes.colours->host);
    surfaces.colourTable = sampledTable(tableOf(table), *table, *volumes.colours);
    putPlaced(surfaces.colourFromTexture,
              glm::mat4(glm::inverse(worldFromTexture(other)) * worldFromTexture(grid)));
    put(surfaces.colourBoxLow, (box.low + 0.5) / glm::dvec3(other.dims));
    put(surfaces.colourBoxHigh, (box.high + 0.5) / glm::dvec3(other.dims));
}

void SimdRays::setLayers(simd::PictureJob& job, SharedStages& stages, const DrawRequest& request) {
    const auto& [tile, volumes, frame, target, rows] = request;
    job.ownDensity = static_cast<float>(tile.layers.ownWeight);
    job.layerCount = static_cast<int>(volumes.layers.size());
    for (std::size_t i = 0; i < volumes.layers.size(); ++i) {
        const auto& resident = *volumes.layers[i];
        const auto& transfer = tile.layers.volumes[i].transfer;
        const auto placement = placementOf(tile, i, volumes.volume, resident);
        auto& layer = job.layers[i];
        layer.volume = sampledVolume(*resident.host);
        layer.table = sampledTable(tableOf(transfer), *transfer, resident);
        putPlaced(layer.fromTexture, glm::mat4(placement.fromTexture));
        put(layer.boxLow, placement.boxLow);
        put(layer.boxHigh, placement.boxHigh);
        layer.density = static_cast<float>(placement.density);
        putMatrix(layer.viewFromGradient, placement.viewFromGradient);
        if (!stages.skipEmptySpace) continue;
        const int reach =
            layerReachSamples(volumes.volume, resident, job.chunkSamples * tile.sampleDistanceVoxels);
        layer.cells = sampledCells(stages.emptySpace.occupiedOnHost(transfer, resident, reach), resident);
    }
}

simd::PictureJob SimdRays::jobFor(SharedStages& stages, const DrawRequest& request,
                                  std::vector<float>& pixels) {
    const auto& [tile, volumes, frame, target, rows] = request;
    const auto& volume = volumes.volume;
    simd::PictureJob job;
    job.width = tile.sizePixels.x;
    job.height = tile.sizePixels.y;
    job.pixels = pixels.data();
    job.solids = volumes.solids != nullptr ? solids_.data() : nullptr;
    job.rays = raysOf(frame, tile.sizePixels);
    job.clip = clipOf(request);
    job.volume = sampledVolume(*volume.host);
    job.sampleDistanceVoxels = static_cast<float>(tile.sampleDistanceVoxels);
    job.light = lightOf(tile, volume);
    job.unitsPerRadius = static_cast<float>(frame.radiusWorld / tile.unitLengthWorld);
    const int reach = tile.technique == Technique::Mip ? kLongReach : shortReach(volume.dims);
    if (tile.technique == Technique::Slices) {
        const auto slabs = slabsOf(tile, frame, volume.dims);
        job.slabDepth = static_cast<float>(slabs.depth);
        job.sampleDistanceVoxels = static_cast<float>(slabs.longestVoxels);
    }
    job.chunkSamples = chunkSamples(job.sampleDistanceVoxels, reach);
    if (tile.technique == Technique::Isosurface) setSurfaces(job.surfaces, request);
    job.table = sampledTable(tableOf(tile.transfer), *tile.transfer, volume);
    if (preIntegrates(tile))
        job.table.integrals = &cached(integrals_, tile.transfer, integralTable).front().x;
    job.texelSign = volume.valueScale < 0.0 ? -1.0F : 1.0F;
    const float opacity = largestOpacity(*tile.transfer);
    job.opacityScale = opacity > 0.0F ? 1.0F / opacity : 0.0F;
    setLayers(job, stages, request);
    job.pairsShareLight = pairsShareLight(tile);
    const auto strides = stages.skipEmptySpace ? strideSettings(tile, volume) : std::nullopt;
    job.adaptive = strides.has_value();
    if (!stages.skipEmptySpace) return job;
    auto& emptySpace = stages.emptySpace;
    switch (tile.technique) {
    case Technique::Isosurface:
        job.cells = sampledCells(
            emptySpace.crossedOnHost(surfaceTexels(tile.isosurface, volume).values, volume), volume);
        break;
    case Technique::Mip:
        job.cells = sampledCells(emptySpace.largestOnHost(volume), volume);
        break;
    default:
        job.cells = sampledCells(emptySpace.occupiedOnHost(tile.transfer, volume, reach, strides), volume);
    }
    return job;
}

void SimdRays::readSolids(const DrawRequest& request) {
    const auto rows = request.rows.within(request.tile.sizePixels);
    const auto size = request.tile.sizePixels;
    solids_.resize(static_cast<std::size_t>(size.x) * static_cast<std::size_t>(size.y) * 4);
    request.volumes.solids->download(rows.first, rows.end, GL_RGBA, GL_FLOAT,
                                     std::as_writable_bytes(drawnRows(solids_, request)));
}

void SimdRays::draw(SharedStages& stages, const DrawRequest& request) {
    const auto size = request.tile.sizePixels;
    const auto rows = request.rows.within(size);
    drawOnHost(stages, request, pixels_);
    request.target->upload({0, rows.first, 0}, {size.x, rows.end - rows.first, 1}, GL_RGBA, GL_FLOAT,
                           std::as_bytes(drawnRows(pixels_, request)));
}

void SimdRays::drawOnHost(SharedStages& stages, const DrawRequest& request, std::vector<float>& pixels) {
    const auto size = request.tile.sizePixels;
    const auto rows = request.rows.within(size);
    pixels.resize(static_cast<std::size_t>(size.x) * static_cast<std::size_t>(size.y) * 4);
    if (request.volumes.solids != nullptr) readSolids(request);
    const auto job = jobFor(stages, request, pixels);
    const auto kernel = kernelOf(request.tile.technique);
    team_.run((rows.end - rows.first + kRowsPerTask - 1) / kRowsPerTask, 1, [&](long begin, long end) {
        const auto rowOf = [&](long task) { return rows.first + static_cast<int>(task) * kRowsPerTask; };
        kernel(job, rowOf(begin), std::min(rowOf(end), rows.end));
    });
}

} // namespace voxsheet
#endif
