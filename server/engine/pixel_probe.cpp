#include "engine/pixel_probe.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace voxsheet::engine {

namespace {

constexpr int kBisections = 20; ///< 1e-6 of a step
constexpr int kMaxSteps = 100'000;

double opacityOf(const TransferTable& table, double value) {
    return std::isnan(value) ? 0.0 : classify(table, value).w;
}

/// Where a value makes a cut show a cap: renderer/stages/isosurface_spec.h.
class CapTest {
public:
    explicit CapTest(const IsosurfaceSpec& isosurface) {
        for (const Isosurface& surface : isosurface.surfaces) {
            if (surface.value > 0.0) above_ = std::min(above_, surface.value);
            if (surface.value < 0.0) below_ = std::max(below_, surface.value);
            smallest_ = std::min(smallest_, surface.value);
        }
        const bool neither = std::isinf(above_) && std::isinf(below_);
        if (neither) above_ = smallest_;
        enabled_ = isosurface.caps;
    }
    /// False for NaN.
    [[nodiscard]] bool shows(double value) const { return enabled_ && (value >= above_ || value <= below_); }

private:
    static constexpr double kInfinity = std::numeric_limits<double>::infinity();
    double above_ = kInfinity;
    double below_ = -kInfinity;
    double smallest_ = kInfinity;
    bool enabled_ = false;
};

/// One ray through one picture.
class RayProbe {
public:
    RayProbe(const TileSpec& tile, const ProbedVolumes& volumes, glm::dvec2 pixel)
        : tile_(tile), volumes_(volumes), ray_(pixelRay(tile.camera, pixel, tile.sizePixels)),
          textureFromWorld_(glm::inverse(worldFromTexture(placedGrid(volumes.grid, tile.periodic)))),
          box_(drawnGrid(volumes.grid, tile.periodic)), kept_(keptSpan(ray_, box_, tile.clip.planes)) {
        if (tile.clip.object) object_.emplace(ray_, *tile.clip.object, *volumes.object);
        const glm::dvec3 texelsPerLength =
            glm::dvec3(textureFromWorld_ * glm::dvec4(ray_.direction, 0.0)) * glm::dvec3(volumes.level.dims);
        const double step = 0.5 / std::max(glm::length(texelsPerLength), 1e-300);
        if (!kept_) return;
        steps_ = static_cast<int>(std::clamp(std::ceil(span().length() / step), 1.0, double{kMaxSteps}));
        step_ = span().length() / steps_;
    }

    [[nodiscard]] std::optional<PixelHit> hit(std::optional<double> opacity) const {
        if (!kept_) return std::nullopt;
        switch (tile_.technique) {
        case Technique::Isosurface:
            return crossingOrMiddle();
        case Technique::Surface:
            return face();
        case Technique::Mip:
            return largest();
        case Technique::Plane: // planeHit(), which asks nothing of what clipping keeps
        case Technique::Slices:
        case Technique::Raycast:
            break;
        }
        return opacity ? firstOpaque(*opacity) : halfOpaque();
    }

private:
    [[nodiscard]] const RaySpan& span() const { return kept_->span; }
    [[nodiscard]] RaySpan stretch(int i) const {
        return {span().begin + i * step_, i + 1 == steps_ ? span().end : span().begin + (i + 1) * step_};
    }
    [[nodiscard]] std::optional<RaySpan> keptPart(const RaySpan& stretch) const {
        return object_ ? object_->keptPart(stretch) : stretch;
    }
    [[nodiscard]] bool keeps(double depth) const { return !object_ || object_->keeps(depth); }
    [[nodiscard]] double value(double depth) const {
        return static_cast<double>(
            volumes_.level.at(glm::dvec3(textureFromWorld_ * glm::dvec4(ray_.at(depth), 1.0))));
    }
    [[nodiscard]] PixelHit at(double depth, HitKind kind) const { return {ray_.at(depth), kind, {}, depth}; }

    /// Front to back over the middles of the kept stretches, until `seen(depth, length)` says enough.
    template <typename Seen>
    [[nodiscard]] std::optional<double> firstSample(const Seen& seen) const {
        for (int i = 0; i < steps_; ++i) {
            const auto part = keptPart(stretch(i));
            if (!part) continue;
            const double middle = part->begin + 0.5 * part->length();
            if (seen(middle, part->length())) return middle;
        }
        return std::nullopt;
    }

    /// The kept sample nearest to the middle of the box.
    [[nodiscard]] std::optional<PixelHit> middle() const {
        const double wanted = glm::dot(centreWorld(box_) - ray_.origin, ray_.direction);
        if (wanted >= span().begin && wanted <= span().end && keeps(wanted))
            return at(wanted, HitKind::Middle);
        std::optional<double> nearest;
        static_cast<void>(firstSample([&](double depth, double) {
            if (!nearest || std::abs(depth - wanted) < std::abs(*nearest - wanted)) nearest = depth;
            return false;
        }));
        return nearest ? std::optional(at(*nearest, HitKind::Middle)) : std::nullopt;
    }

    [[nodiscard]] std::optional<PixelHit> halfOpaque() const {
        double transmittance = 1.0;
        const auto depth = firstSample([&](double middle, double length) {
            const double opacity = opacityOf(*tile_.transfer, value(middle));
            transmittance *= std::pow(1.0 - opacity, length / tile_.unitLengthWorld);
            return transmittance < 0.5;
        });
        return depth ? at(*depth, HitKind::Sample) : middle();
    }

    [[nodiscard]] std::optional<PixelHit> firstOpaque(double opacity) const {
        const auto depth = firstSample([&](double middle, double) {
            const double sample = value(middle);
            return !std::isnan(sample) && opacityOf(*tile_.transfer, sample) >= opacity;
        });
        return depth ? at(*depth, HitKind::Sample) : middle();
    }

    [[nodiscard]] std::optional<PixelHit> largest() const {
        double largest = -std::numeric_limits<double>::infinity();
        std::optional<double> depth;
        for (int i = 0; i < steps_; ++i) {
            const RaySpan whole = stretch(i);
            const double middle = whole.begin + 0.5 * whole.length();
            const double sample = value(middle);
            if (!(sample > largest) || !keeps(middle)) continue;
            largest = sample;
            depth = middle;
        }
        return depth ? std::optional(at(*depth, HitKind::Sample)) : std::nullopt;
    }

    [[nodiscard]] std::optional<PixelHit> face() const {
        if (!kept_->atEye && keeps(span().begin)) return at(span().begin, HitKind::Face);
        for (int i = 0; object_ && i < steps_; ++i) {
            if (const auto entry = object_->entry(stretch(i))) return at(*entry, HitKind::Face);
        }
        if (kept_->atEye && keeps(span().end)) return at(span().end, HitKind::Face);
        return std::nullopt;
    }

    [[nodiscard]] std::optional<PixelHit> crossingOrMiddle() const {
        const CapTest caps(tile_.isosurface);
        const bool openCut = kept_->cut && keeps(span().begin);
        if (openCut && caps.shows(value(span().begin))) return at(span().begin, HitKind::Face);
        for (int i = 0; i < steps_; ++i) {
            auto first = crossingIn(stretch(i));
            const auto entry = object_ ? object_->entry(stretch(i)) : std::nullopt;
            if (entry && caps.shows(value(*entry)) && !(first && first->depth < *entry))
                first = at(*entry, HitKind::Face);
            if (first) return first;
        }
        return middle();
    }

    /// The first kept crossing of any visible surface.
    [[nodiscard]] std::optional<PixelHit> crossingIn(const RaySpan& stretch) const {
        std::optional<PixelHit> first;
        for (const Isosurface& surface : tile_.isosurface.surfaces) {
            if (surface.colour.w <= 0.0F) continue;
            // Finer than the picture's steps: it keeps ridges that are thinner than these.
            const auto depth = firstCrossing([this](double s) { return value(s); }, surface.value, stretch,
                                             0.25 * stretch.length());
            if (!depth || !keeps(*depth) || (first && first->depth <= *depth)) continue;
            first = at(*depth, HitKind::Isosurface);
            first->isovalue = surface.value;
        }
        return first;
    }

    const TileSpec& tile_;
    const ProbedVolumes& volumes_;
    Ray ray_;
    glm::dmat4 textureFromWorld_;
    Grid box_; ///< the drawn one
    std::optional<KeptSpan> kept_;
    std::optional<ObjectCut> object_;
    int steps_ = 0;
    double step_ = 0.0; ///< half a voxel of the level at most
};

/// As renderer/techniques/plane/plane.h, in the drawn grid.
std::optional<PixelHit> planeHit(const PlaneSpec& plane, const Grid& grid, const Ray& ray) {
    constexpr double edgeOn = 1e-9;
    constexpr double faceSlack = 1e-5; // texture frame
    const double advance = glm::dot(plane.normal, ray.direction);
    if (std::abs(advance) < edgeOn) return std::nullopt;
    const double depth = (plane.offset - glm::dot(plane.normal, ray.origin)) / advance;
    glm::dvec3 index(glm::inverse(grid.worldFromIndex) * glm::dvec4(ray.at(depth), 1.0));
    const IndexBox box = boxIndex(grid);
    for (int axis = 0; axis < 3; ++axis) {
        const double slack = faceSlack * grid.dims[axis];
        if (index[axis] < box.low[axis] - slack || index[axis] > box.high[axis] + slack) return std::nullopt;
    }
    // A plane in a face of the box has values: what rounding put beyond it lies on it.
    index = glm::clamp(index, box.low, box.high);
    return PixelHit{glm::dvec3(grid.worldFromIndex * glm::dvec4(index, 1.0)), HitKind::Face, {}, depth};
}

} // namespace

std::optional<PixelHit> pixelHit(const TileSpec& tile, const ProbedVolumes& volumes, glm::dvec2 pixel,
                                 std::optional<double> opacity) {
    if (tile.technique == Technique::Plane)
        return planeHit(tile.plane, drawnGrid(volumes.grid, tile.periodic),
                        pixelRay(tile.camera, pixel, tile.sizePixels));
    return RayProbe(tile, volumes, pixel).hit(opacity);
}

std::optional<double> firstCrossing(const std::function<double(double)>& valueAt, double isovalue,
                                    const RaySpan& span, double step) {
    const int steps = static_cast<int>(std::clamp(std::ceil(span.length() / step), 1.0, double{kMaxSteps}));
    double near = span.begin;
    double atNear = valueAt(near) - isovalue;
    for (int i = 1; i <= steps; ++i) {
        double far = span.begin + span.length() * i / steps;
        const double atFar = valueAt(far) - isovalue;
        const bool crosses = !std::isnan(atNear) && !std::isnan(atFar) && (atNear < 0.0) != (atFar < 0.0);
        if (!crosses) {
            near = far;
            atNear = atFar;
            continue;
        }
        for (int k = 0; k < kBisections; ++k) {
            const double middle = 0.5 * (near + far);
            ((valueAt(middle) - isovalue < 0.0) == (atNear < 0.0) ? near : far) = middle;
        }
        return 0.5 * (near + far);
    }
    return std::nullopt;
}

} // namespace voxsheet::engine
