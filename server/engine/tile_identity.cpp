#include "engine/tile_identity.h"

#include "base/errors.h"
#include "base/program_file.h"

#include <bit>
#include <cstdint>
#include <fstream>
#include <vector>

#define XXH_INLINE_ALL
#include <xxhash.h>

namespace voxsheet::engine {

namespace {

std::string hex(const XXH128_hash_t& hash) {
    static constexpr char digits[] = "0123456789abcdef";
    std::string text(32, '0');
    for (std::size_t i = 0; i < 16; ++i) {
        text[15 - i] = digits[(hash.high64 >> (4 * i)) & 15U];
        text[31 - i] = digits[(hash.low64 >> (4 * i)) & 15U];
    }
    return text;
}

/// Numbers by value, so that padding never counts and -0 equals 0.
class Collector {
public:
    void add(double value) {
        const auto bits = std::bit_cast<std::uint64_t>(value == 0.0 ? 0.0 : value);
        append(&bits, sizeof(bits));
    }
    void add(std::string_view text) {
        add(static_cast<double>(text.size()));
        append(text.data(), text.size());
    }
    template <glm::length_t N, typename T>
    void add(const glm::vec<N, T>& v) {
        for (glm::length_t i = 0; i < N; ++i)
            add(static_cast<double>(v[i]));
    }
    void add(const glm::dmat4& matrix) {
        for (int column = 0; column < 4; ++column)
            add(matrix[column]);
    }
    void append(const void* data, std::size_t bytes) {
        const auto* begin = static_cast<const char*>(data);
        bytes_.insert(bytes_.end(), begin, begin + bytes);
    }
    [[nodiscard]] std::string digest() const { return hex(XXH3_128bits(bytes_.data(), bytes_.size())); }

private:
    std::vector<char> bytes_;
};

enum class TableUse { ColoursAndOpacities, Colours };

void addTable(Collector& collector, const TransferTable& table, TableUse use) {
    collector.add(table.low);
    collector.add(table.high);
    collector.add(static_cast<double>(table.scale));
    collector.add(table.symLogThreshold);
    collector.add(table.nan);
    if (use == TableUse::ColoursAndOpacities) {
        collector.add(table.below);
        collector.add(table.above);
        const XXH128_hash_t entries =
            XXH3_128bits(table.entries.data(), table.entries.size() * sizeof(glm::vec4));
        collector.add(hex(entries));
        return;
    }
    collector.add(glm::vec3(table.below));
    collector.add(glm::vec3(table.above));
    std::vector<glm::vec3> colours(table.entries.begin(), table.entries.end());
    collector.add(hex(XXH3_128bits(colours.data(), colours.size() * sizeof(glm::vec3))));
}

void addCamera(Collector& collector, const CameraSpec& camera) {
    collector.add(camera.viewFromWorld);
    collector.add(static_cast<double>(camera.projection));
    // The member that the projection does not use decides nothing.
    const bool perspective = camera.projection == Projection::Perspective;
    collector.add(perspective ? camera.fovYDegrees : camera.heightWorld);
}

void addClip(Collector& collector, const ClipSpec& clip) {
    collector.add(static_cast<double>(clip.planes.size()));
    for (const ClipPlane& plane : clip.planes) {
        collector.add(plane.normal);
        collector.add(plane.offset);
    }
    collector.add(clip.object ? 1.0 : 0.0);
    if (!clip.object) return;
    collector.add(clip.object->dataset);
    collector.add(clip.object->objectFromWorld);
    collector.add(static_cast<double>(clip.object->mode));
    collector.add(clip.object->binary ? 1.0 : 0.0);
}

bool showsSites(const CrystalSpec& crystal) { return crystal.atoms || crystal.bonds != BondReach::None; }

void addCrystal(Collector& collector, const CrystalSpec& crystal) {
    collector.add(crystal.cell ? 1.0 : 0.0);
    collector.add(crystal.atoms ? 1.0 : 0.0);
    collector.add(static_cast<double>(crystal.bonds));
    collector.add(showsSites(crystal) ? crystal.radiusScale : 0.0);
}

void addShading(Collector& collector, const TileSpec& tile) {
    const ShadingSpec& shading = tile.shading;
    const bool shaded =
        shading.enabled && tile.technique != Technique::Mip && tile.technique != Technique::Plane;
    // Solids are lit in any case, but where a plane cuts them.
    const bool solids = showsSites(tile.crystal) && tile.technique != Technique::Plane;
    collector.add(shaded ? 1.0 : solids ? 2.0 : 0.0);
    if (!shaded && !solids) return;
    // Faces have normals of their own.
    const bool gradients = shaded && tile.technique != Technique::Surface;
    collector.add(gradients ? static_cast<double>(shading.gradient) : -1.0);
    for (const double number : {shading.ambient, shading.diffuse, shading.specular, shading.headLight})
        collector.add(number);
    collector.add(shading.specular > 0.0 ? shading.shininess : 0.0);
    collector.add(static_cast<double>(shading.lightsView.size()));
    for (const glm::dvec3& light : shading.lightsView)
        collector.add(light);
    collector.add(shading.lightsView.empty() ? 0.0 : shading.lightIntensity);
}

void addIsosurface(Collector& collector, const IsosurfaceSpec& isosurface) {
    collector.add(static_cast<double>(isosurface.surfaces.size()));
    for (const Isosurface& surface : isosurface.surfaces) {
        collector.add(surface.value);
        collector.add(surface.colour);
    }
    collector.add(isosurface.colouredBy ? 1.0 : 0.0);
    if (const auto& colours = isosurface.colouredBy) {
        collector.add(colours->dataset);
        collector.add(colours->field);
        collector.add(colours->step);
        collector.add(colours->level);
        addTable(collector, *colours->transfer, TableUse::Colours);
    }
    collector.add(isosurface.caps ? 1.0 : 0.0);
    collector.add(static_cast<double>(isosurface.method));
}

void addLayers(Collector& collector, const LayersSpec& layers) {
    collector.add(static_cast<double>(layers.volumes.size()));
    if (layers.volumes.empty()) return;
    collector.add(layers.ownWeight);
    for (const VolumeLayer& layer : layers.volumes) {
        collector.add(layer.dataset);
        collector.add(layer.field);
        collector.add(layer.step);
        collector.add(layer.level);
        collector.add(layer.unitLengthWorld);
        collector.add(layer.weight);
        collector.add(static_cast<double>(layer.floatTexels));
        collector.add(layer.categories ? 1.0 : 0.0);
        collector.add(layer.threshold);
        addTable(collector, *layer.transfer, TableUse::ColoursAndOpacities);
    }
}

void addPlane(Collector& collector, const PlaneSpec& plane) {
    collector.add(plane.normal);
    collector.add(plane.offset);
    collector.add(static_cast<double>(plane.interpolation));
}

/// What the technique makes of the transfer table.
void addColours(Collector& collector, const TileSpec& tile) {
    switch (tile.technique) {
    case Technique::Slices:
    case Technique::Raycast:
        collector.add(tile.unitLengthWorld);
        addTable(collector, *tile.transfer, TableUse::ColoursAndOpacities);
        addLayers(collector, tile.layers);
        break;
    case Technique::Mip: // Opacity as it is, whatever the length.
        addTable(collector, *tile.transfer, TableUse::ColoursAndOpacities);
        break;
    case Technique::Surface:
        addTable(collector, *tile.transfer, TableUse::Colours);
        break;
    case Technique::Isosurface: // Colours of surfaces are their own; only caps show the table's.
        if (tile.isosurface.caps) addTable(collector, *tile.transfer, TableUse::Colours);
        addIsosurface(collector, tile.isosurface);
        break;
    case Technique::Plane:
        addTable(collector, *tile.transfer,
                 tile.categories ? TableUse::ColoursAndOpacities : TableUse::Colours);
        addPlane(collector, tile.plane);
        addLayers(collector, tile.layers);
        break;
    }
}

} // namespace

std::string tileIdentity(const TileSpec& tile, RenderPath path, std::string_view environment) {
    Collector collector;
    collector.add(environment);
    collector.add(std::string_view(pathName(path)));
    collector.add(tile.dataset);
    collector.add(tile.field);
    collector.add(tile.step);
    collector.add(tile.level);
    collector.add(static_cast<double>(tile.technique));
    addCamera(collector, tile.camera);
    addColours(collector, tile);
    collector.add(wrappedShift(tile.periodic));
    collector.add(tile.periodic.replicate);
    if (tile.technique != Technique::Plane) { // Nothing clips a plane, and each ray meets it once.
        addClip(collector, tile.clip);
        collector.add(tile.sampleDistanceVoxels);
    }
    addCrystal(collector, tile.crystal);
    const bool crosshair = tile.crosshairWorld.has_value() && tile.technique != Technique::Plane;
    collector.add(crosshair ? 1.0 : 0.0);
    if (crosshair)
        for (int axis = 0; axis < 3; ++axis)
            collector.add((*tile.crosshairWorld)[axis]);
    addShading(collector, tile);
    collector.add(tile.categories ? 1.0 : 0.0);
    collector.add(preIntegrates(tile) ? 1.0 : 0.0);
    collector.add(adaptsSampling(tile) ? 1.0 : 0.0);
    collector.add(static_cast<double>(tile.floatTexels));
    collector.add(tile.background);
    collector.add(tile.sizePixels.x);
    collector.add(tile.sizePixels.y);
    return collector.digest();
}

std::string textIdentity(std::string_view text) { return hex(XXH3_128bits(text.data(), text.size())); }

const std::string& buildIdentity() {
    static const std::string identity = [] {
        std::ifstream self(programBytes(), std::ios::binary);
        if (!self) throw IoError("the program", "its own file cannot be read", "check its permissions");
        XXH3_state_t* state = XXH3_createState();
        XXH3_128bits_reset(state);
        std::vector<char> block(1U << 20U);
        while (self.read(block.data(), static_cast<std::streamsize>(block.size())) || self.gcount() > 0) {
            XXH3_128bits_update(state, block.data(), static_cast<std::size_t>(self.gcount()));
        }
        const std::string text = hex(XXH3_128bits_digest(state));
        XXH3_freeState(state);
        return text;
    }();
    return identity;
}

} // namespace voxsheet::engine
