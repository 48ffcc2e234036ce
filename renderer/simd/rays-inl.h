// Rays of a packet, what box, planes and clip object leave of them, and light.
#if defined(VOXSHEET_SIMD_RAYS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef VOXSHEET_SIMD_RAYS_INL_H
#undef VOXSHEET_SIMD_RAYS_INL_H
#else
#define VOXSHEET_SIMD_RAYS_INL_H
#endif

#include "simd/picture_job.h"
#include "simd/sampling-inl.h"

HWY_BEFORE_NAMESPACE();
namespace voxsheet::simd::HWY_NAMESPACE {

struct Ray {
    Vec3 origin, direction;           ///< texture frame
    Vec3 indexOrigin, indexDirection; ///< the same in index positions of the volume
    Float radiiPerDepth;
    Vec3 toEye;
};

// Packets are 4x2 pixels of eight lanes, 4x1 of four, one of one.
HWY_INLINE int packetWidth() { return hn::Lanes(kF) < 4 ? 1 : 4; }
HWY_INLINE int packetHeight() { return static_cast<int>(hn::Lanes(kF)) / packetWidth(); }

// Pixel centres of the packet whose lower left pixel is (x, y).
HWY_INLINE Ray cameraRay(const PictureJob& job, int x, int y) {
    const RayNumbers& rays = job.rays;
    HWY_ALIGN float offsetX[8], offsetY[8];
    for (std::size_t lane = 0; lane < hn::Lanes(kF); ++lane) {
        offsetX[lane] =
            static_cast<float>(x) + static_cast<float>(static_cast<int>(lane) % packetWidth()) + 0.5F;
        offsetY[lane] =
            static_cast<float>(y) + static_cast<float>(static_cast<int>(lane) / packetWidth()) + 0.5F;
    }
    const Float qx =
        hn::MulAdd(hn::Load(kF, offsetX), num(rays.pictureOfPixel[0]), num(rays.pictureOfPixel[2]));
    const Float qy =
        hn::MulAdd(hn::Load(kF, offsetY), num(rays.pictureOfPixel[1]), num(rays.pictureOfPixel[3]));
    Ray ray;
    ray.origin = spread(rays.origin) + (qx * spread(rays.originX) + qy * spread(rays.originY));
    ray.direction = spread(rays.direction) + (qx * spread(rays.directionX) + qy * spread(rays.directionY));
    const Float perspective = num(rays.lengthPerspective);
    ray.radiiPerDepth = hn::Sqrt(num(1.0F) + perspective * (qx * qx + qy * qy));
    const Float inverse = num(1.0F) / ray.radiiPerDepth;
    ray.toEye = {zero() - perspective * qx * inverse, zero() - perspective * qy * inverse, inverse};
    const Vec3 samples = spread(job.volume.samples);
    ray.indexOrigin = {ray.origin.x * samples.x - num(0.5F), ray.origin.y * samples.y - num(0.5F),
                       ray.origin.z * samples.z - num(0.5F)};
    ray.indexDirection = {ray.direction.x * samples.x, ray.direction.y * samples.y,
                          ray.direction.z * samples.z};
    return ray;
}

HWY_INLINE Vec3 indexAt(const Ray& ray, Float depth) {
    return along(ray.indexOrigin, depth, ray.indexDirection);
}
HWY_INLINE Vec3 textureAt(const Ray& ray, Float depth) { return along(ray.origin, depth, ray.direction); }

struct Span {
    Float begin, end; ///< end <= begin: nothing is left
    Float cutPlane;   ///< the plane that the ray enters through, or -1
};

HWY_INLINE Float awayFromZero(Float value) { return pick(hn::Abs(value) < num(1e-12F), num(1e-12F), value); }

// Depths between which a ray is inside a box of its own frame.
HWY_INLINE void boxDepths(const float* low, const float* high, const Vec3& origin, const Vec3& direction,
                          Float& begin, Float& end) {
    const auto axis = [&](float boxLow, float boxHigh, Float from, Float advance) {
        const Float inverse = awayFromZero(advance);
        const Float toLow = (num(boxLow) - from) / inverse;
        const Float toHigh = (num(boxHigh) - from) / inverse;
        begin = hn::Max(begin, hn::Min(toLow, toHigh));
        end = hn::Min(end, hn::Max(toLow, toHigh));
    };
    axis(low[0], high[0], origin.x, direction.x);
    axis(low[1], high[1], origin.y, direction.y);
    axis(low[2], high[2], origin.z, direction.z);
}

HWY_INLINE Span keptSpan(const PictureJob& job, const Ray& ray) {
    Span span{num(job.rays.nearest), num(3.0e38F), num(-1.0F)};
    boxDepths(job.rays.boxLow, job.rays.boxHigh, ray.origin, ray.direction, span.begin, span.end);
    for (int i = 0; i < job.clip.planeCount; ++i) {
        const float* plane = job.clip.planes[i];
        const Vec3 normal = spread(plane);
        const Float advance = dot(normal, ray.direction);
        const Float beyond = dot(normal, ray.origin) + num(plane[3]);
        const Float crossing = (zero() - beyond) / pick(hn::Abs(advance) < num(1e-20F), num(1e-20F), advance);
        const Mask enters = both(advance > zero(), crossing > span.begin);
        const Mask parallelOutside = both(advance == zero(), beyond < zero());
        assign(enters, span.begin, crossing);
        assign(enters, span.cutPlane, num(static_cast<float>(i)));
        assign(advance < zero(), span.end, hn::Min(span.end, crossing));
        assign(parallelOutside, span.end, span.begin);
    }
    return span;
}

// --- clip object ---

// The ray in index positions of the distances.
struct ClipRay {
    Vec3 origin, direction;               ///< index positions
    Vec3 textureOrigin, textureDirection; ///< texture frame of the distances
    Float lengthPerDepth;
};

HWY_INLINE ClipRay clipRayOf(const ClipNumbers& clip, const Ray& ray) {
    ClipRay result;
    result.textureOrigin = placed(clip.clipFromTexture, ray.origin);
    result.textureDirection = times(clip.clipFromTexture, ray.direction);
    const Vec3 samples = spread(clip.distances.samples);
    const auto index = [](Float at, Float count) { return at * count - num(0.5F); };
    result.origin = {index(result.textureOrigin.x, samples.x), index(result.textureOrigin.y, samples.y),
                     index(result.textureOrigin.z, samples.z)};
    result.direction = {result.textureDirection.x * samples.x, result.textureDirection.y * samples.y,
                        result.textureDirection.z * samples.z};
    const Vec3 inObject = times(clip.objectFromTexture, ray.direction);
    result.lengthPerDepth = hn::Sqrt(dot(inObject, inObject));
    return result;
}

HWY_INLINE Float keptMeasure(const ClipNumbers& clip, const ClipRay& ray, Float depth) {
    const Vec3 at = along(ray.origin, depth, ray.direction);
    const Float texel = clip.binary ? nearestTexelAt(clip.distances, at) : texelAt(clip.distances, at);
    return hn::MulAdd(texel, num(clip.measureFromTexel[0]), num(clip.measureFromTexel[1]));
}

HWY_INLINE Float largestChange(const ClipNumbers& clip, Float length) {
    return hn::Min(num(1.1F) * length + num(clip.nearestSampleSlack), num(1.7321F) * length);
}

struct ClipVerdict {
    Mask kept, removed; ///< all of the stretch; in neither: not known
    Float removedUntil;
};

HWY_INLINE ClipVerdict clipVerdict(const ClipNumbers& clip, const ClipRay& ray, Float begin, Float end) {
    const Float middle = num(0.5F) * (begin + end);
    const Float measure = keptMeasure(clip, ray, middle);
    const Float reach = largestChange(clip, (end - middle) * ray.lengthPerDepth);
    const Float less = zero() - measure;
    const Float free =
        hn::Max((less - num(clip.nearestSampleSlack)) * num(1.0F / 1.1F), less * num(1.0F / 1.7321F));
    return {measure > reach, less > reach, middle + free / ray.lengthPerDepth};
}

HWY_INLINE Float clipCrossing(Float begin, Float end, Float measureBegin, Float measureEnd) {
    return hn::MulAdd(end - begin, clampTo(measureBegin / (measureBegin - measureEnd), 0.0F, 1.0F), begin);
}

// Normal of the object's surface at a depth, in the view frame, of any length.
HWY_INLINE Vec3 clipSurfaceNormal(const ClipNumbers& clip, const ClipRay& ray, Float depth) {
    const Vec3 at = along(ray.origin, depth, ray.direction);
    const Float one = num(1.0F);
    const auto difference = [&](const Vec3& after, const Vec3& before) {
        return texelAt(clip.distances, after) - texelAt(clip.distances, before);
    };
    const Vec3 gradient{difference({at.x + one, at.y, at.z}, {at.x - one, at.y, at.z}),
                        difference({at.x, at.y + one, at.z}, {at.x, at.y - one, at.z}),
                        difference({at.x, at.y, at.z + one}, {at.x, at.y, at.z - one})};
    return times(clip.viewFromClipGradient, gradient);
}

// --- light ---

// Of bases up to 1; below 0 they count as 0.
HWY_INLINE Float power(Float base, float exponent) {
    base = hn::Max(base, zero());
    const auto whole = static_cast<int>(exponent);
    if (static_cast<float>(whole) != exponent) {
        const Float logarithm = hn::Log2(kF, hn::Max(base, num(1e-30F)));
        return exp2OfNegative(hn::Min(num(exponent) * logarithm, zero()));
    }
    Float result = num(1.0F);
    for (int bits = whole; bits > 0;
         bits >>= 1) { // 24 takes six products, a logarithm and an exponential thirty
        if ((bits & 1) != 0) result = result * base;
        base = base * base;
    }
    return result;
}

/// What light makes of a colour: min(matte rgb + shine, 1).
struct Reflection {
    Float matte, shine;
};

HWY_INLINE Reflection pick(Mask mask, const Reflection& yes, const Reflection& no) {
    return {pick(mask, yes.matte, no.matte), pick(mask, yes.shine, no.shine)};
}

HWY_INLINE Vec3 reflected(const Reflection& reflection, const Vec3& rgb) {
    const auto channel = [&](Float value) {
        return hn::Min(hn::MulAdd(reflection.matte, value, reflection.shine), num(1.0F));
    };
    return {channel(rgb.x), channel(rgb.y), channel(rgb.z)};
}

// Of numbers above 1e-37; one step of Newton's method after the processor's estimate of 12 bits.
HWY_INLINE Float inverseRoot(Float square) {
    const Float estimate = hn::ApproximateReciprocalSqrt(square);
    return estimate * hn::NegMulAdd(num(0.5F) * square * estimate, estimate, num(1.5F));
}

/// By a normal of any length and sign in the view frame; where it has none, colours stay.
HWY_INLINE Reflection reflectionOf(const LightNumbers& light, const Vec3& normal, const Vec3& toEye) {
    const Float square = dot(normal, normal);
    const Float length = inverseRoot(hn::Max(square, num(1e-37F)));
    const Float towardsEye = dot(normal, toEye);
    const Float facing = hn::Abs(towardsEye) * length;
    const Float diffuse = num(light.material[1]), specular = num(light.material[2]);
    Reflection sum{num(light.material[0]), zero()};
    const auto add = [&](Mask counts, Float intensity, Float cosine, Float mirrored) HWY_ATTR {
        const Float shine = intensity * specular * power(mirrored, light.material[3]);
        sum.matte = sum.matte + hn::IfThenElseZero(counts, intensity * diffuse * cosine);
        sum.shine = sum.shine + hn::IfThenElseZero(counts, shine);
    };
    add(whole(true), num(light.headLight), facing, num(2.0F) * facing * facing - num(1.0F));
    const Float turned = pick(towardsEye < zero(), zero() - length, length);
    for (int i = 0; i < light.lightCount; ++i) {
        const Vec3 direction = spread(light.lights[i]);
        const Float towards = turned * dot(normal, direction);
        add(towards > zero(), num(light.lights[i][3]), towards,
            num(2.0F) * towards * facing - dot(direction, toEye));
    }
    const Mask known = square > zero();
    return {pick(known, sum.matte, num(1.0F)), hn::IfThenElseZero(known, sum.shine)};
}

HWY_INLINE Vec3 lit(const LightNumbers& light, const Vec3& rgb, const Vec3& normal, const Vec3& toEye) {
    return reflected(reflectionOf(light, normal, toEye), rgb);
}

// Normals of the planes through which lanes entered; any for lanes that entered through none.
HWY_INLINE Vec3 planeNormals(const ClipNumbers& clip, Float cutPlane) {
    Vec3 normal{zero(), zero(), zero()};
    for (int i = 0; i < clip.planeCount; ++i)
        normal = pick(cutPlane == num(static_cast<float>(i)), spread(clip.cutNormals[i]), normal);
    return normal;
}

// Depths of the solids in a packet's pixels.
HWY_INLINE Float solidDepth(const PictureJob& job, int x, int y) {
    HWY_ALIGN float depths[8];
    for (std::size_t lane = 0; lane < hn::Lanes(kF); ++lane) {
        const int px = std::min(x + static_cast<int>(lane) % packetWidth(), job.width - 1);
        const int py = std::min(y + static_cast<int>(lane) / packetWidth(), job.height - 1);
        depths[lane] = job.solids[(static_cast<std::ptrdiff_t>(py) * job.width + px) * 4 + 3];
    }
    return hn::Load(kF, depths);
}

/// What stays the same along the rays of a packet.
struct Path {
    Ray ray;
    Span span;
    Float spacing; ///< depth of a whole stretch
    Float depthPerVoxel;
    ClipRay clip;
};

HWY_INLINE Path pathOf(const PictureJob& job, int x, int y) {
    Path path;
    path.ray = cameraRay(job, x, y);
    path.span = keptSpan(job, path.ray);
    if (job.solids != nullptr) path.span.end = hn::Min(path.span.end, solidDepth(job, x, y));
    path.depthPerVoxel = num(1.0F) / hn::Sqrt(dot(path.ray.indexDirection, path.ray.indexDirection));
    path.spacing = num(job.sampleDistanceVoxels) * path.depthPerVoxel;
    if (job.clip.hasObject) path.clip = clipRayOf(job.clip, path.ray);
    return path;
}

/// Lanes whose samples at `depth` lie within one voxel behind a cut, and the cuts' normals there. `near`:
/// lanes that may lie behind the clip object's surface.
HWY_INLINE Mask cutNormalAt(const PictureJob& job, const Path& path, Float depth, Mask near, Vec3& normal) {
    Mask behind = none();
    if (job.clip.planeCount > 0) {
        behind = both(path.span.cutPlane >= zero(), depth - path.span.begin <= path.depthPerVoxel);
        if (any(behind)) normal = planeNormals(job.clip, path.span.cutPlane);
    }
    if (!job.clip.hasObject || !any(near)) return behind;
    const Float before = hn::Max(depth - path.depthPerVoxel, path.span.begin);
    const Float measureBefore = keptMeasure(job.clip, path.clip, before);
    const Mask cut = both(near, measureBefore < zero());
    if (!any(cut)) return behind;
    const Float measure = hn::Max(keptMeasure(job.clip, path.clip, depth), zero());
    const Float crossing = clipCrossing(before, depth, measureBefore, measure);
    normal = pick(cut, clipSurfaceNormal(job.clip, path.clip, crossing), normal);
    return either(behind, cut);
}

/// Colour so far, premultiplied, and what still shines through.
struct Light {
    Vec3 colour{zero(), zero(), zero()};
    Float transmittance = num(1.0F);
};

constexpr float kOpaque = 1.0F / 1024.0F;

/// Writes what a packet drew; pixels beyond the picture are left out.
HWY_INLINE void storePacket(const PictureJob& job, int x, int y, const Vec3& rgb, Float alpha) {
    HWY_ALIGN float channel[4][8];
    hn::Store(rgb.x, kF, channel[0]);
    hn::Store(rgb.y, kF, channel[1]);
    hn::Store(rgb.z, kF, channel[2]);
    hn::Store(alpha, kF, channel[3]);
    for (std::size_t lane = 0; lane < hn::Lanes(kF); ++lane) {
        const int px = x + static_cast<int>(lane) % packetWidth();
        const int py = y + static_cast<int>(lane) / packetWidth();
        if (px >= job.width || py >= job.height) continue;
        float* pixel = job.pixels + (static_cast<std::ptrdiff_t>(py) * job.width + px) * 4;
        for (int i = 0; i < 4; ++i)
            pixel[i] = channel[i][lane];
    }
}

/// Draws rows [firstRow, endRow) packet by packet; `draw` gives rgba of the packet at (x, y).
template <typename Draw>
HWY_INLINE void drawRows(const PictureJob& job, int firstRow, int endRow, Draw draw) {
    for (int y = firstRow; y < endRow; y += packetHeight())
        for (int x = 0; x < job.width; x += packetWidth())
            draw(x, y);
}

} // namespace voxsheet::simd::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
