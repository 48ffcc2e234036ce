// Volumes blended with the drawn one: stages/layers.glsl for all lanes of a packet at once.
#if defined(VOXSHEET_SIMD_LAYERS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef VOXSHEET_SIMD_LAYERS_INL_H
#undef VOXSHEET_SIMD_LAYERS_INL_H
#else
#define VOXSHEET_SIMD_LAYERS_INL_H
#endif

#include "simd/rays-inl.h"

HWY_BEFORE_NAMESPACE();
namespace voxsheet::simd::HWY_NAMESPACE {

/// What lights all volumes of a sample alike.
struct LayerLight {
    Vec3 toEye;
    Mask behindCut; ///< there all have the cut's normal
    Vec3 cutNormal; ///< view frame
};

/// Adds what a layer shows at points of the drawn volume's texture frame to chromaticity and extinction
/// there.
HWY_INLINE void blendLayer(Entry& entry, const PictureJob& job, const LayerNumbers& layer,
                           const Vec3& position, Mask counts, const LayerLight& light) {
    const Vec3 at = placed(layer.fromTexture, position);
    const auto inside = [&](int axis, Float coordinate) {
        return both(coordinate >= num(layer.boxLow[axis]), coordinate <= num(layer.boxHigh[axis]));
    };
    counts = both(counts, both(both(inside(0, at.x), inside(1, at.y)), inside(2, at.z)));
    if (!any(counts)) return;
    const float* samples = layer.volume.samples;
    const Float half = num(0.5F);
    const Vec3 index{at.x * num(samples[0]) - half, at.y * num(samples[1]) - half,
                     at.z * num(samples[2]) - half};
    Entry more = classify(layer.table, texelAt(layer.volume, index));
    more.a = hn::IfThenElseZero(counts, more.a * num(layer.density));
    const Mask seen = more.a > zero();
    if (!any(seen)) return;
    if (job.light.enabled) {
        Vec3 normal = light.cutNormal;
        const Mask uncut = butNot(seen, light.behindCut);
        if (any(uncut))
            normal = pick(light.behindCut, normal,
                          times(layer.viewFromGradient, gradientAt(layer.volume, index, uncut, false)));
        more.rgb = lit(job.light, more.rgb, normal, light.toEye);
    }
    const Float sum = entry.a + more.a;
    const Float part = more.a / sum;
    entry.a = pick(seen, sum, entry.a);
    entry.rgb = pick(seen,
                     {mix(entry.rgb.x, more.rgb.x, part), mix(entry.rgb.y, more.rgb.y, part),
                      mix(entry.rgb.z, more.rgb.z, part)},
                     entry.rgb);
}

/// As stretchesAhead, in one layer, of stretches that cover `stretch` of the drawn volume's texture frame. A
/// middle outside of it looks up its nearest cell: what of the stretch is inside lies within that one's
/// reach.
HWY_INLINE Float layerStretchesAhead(const LayerNumbers& layer, const Vec3& middle, const Vec3& stretch) {
    const Vec3 turned = times(layer.fromTexture, stretch);
    const Vec3 voxels{turned.x * num(layer.volume.samples[0]), turned.y * num(layer.volume.samples[1]),
                      turned.z * num(layer.volume.samples[2])};
    return stretchesAhead(layer.cells, placed(layer.fromTexture, middle),
                          num(layer.cells.cellSamples) / hn::Sqrt(dot(voxels, voxels)));
}

} // namespace voxsheet::simd::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
