// The march of direct volume rendering along the rays of a packet, which the kernels of ray casting and of
// slices share: what a stretch of a ray is and shows is told by Stretches.
#if defined(VOXSHEET_SIMD_CASTER_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef VOXSHEET_SIMD_CASTER_INL_H
#undef VOXSHEET_SIMD_CASTER_INL_H
#else
#define VOXSHEET_SIMD_CASTER_INL_H
#endif

#include "simd/layers-inl.h"
#include "simd/rays-inl.h"

HWY_BEFORE_NAMESPACE();
namespace voxsheet::simd::HWY_NAMESPACE {

enum class Stretches {
    Sampled,       ///< of the ray's own, from where it enters; a shorter rest is left
                   ///< (techniques/raycast/raycast.h)
    PreIntegrated, ///< the same, which show means
    Slabs,         ///< between planes that all rays share; cut off where a ray enters and leaves
                   ///< (techniques/slicing/slicing.h)
};

// Stretches that have one sample together where an object clips: a crossing is sought within them.
constexpr float kClippedStride = 2.0F;

template <TexelFormat format, Stretches kind>
struct Caster {
    const PictureJob& job;
    Path path;
    Float unitsPerDepth;
    Light light;
    Float firstDepth;         ///< of the first stretch
    Float stride = num(1.0F); ///< stretches that have one sample together in the lanes' chunks

    Float chunkBegin(Float chunk) const {
        return hn::MulAdd(chunk * num(static_cast<float>(job.chunkSamples)), path.spacing, firstDepth);
    }

    // What the ray has of a depth: slabs go on beyond its ends.
    HWY_INLINE Float within(Float depth) const {
        if constexpr (kind != Stretches::Slabs) return depth;
        return hn::Min(hn::Max(depth, path.span.begin), path.span.end);
    }

    // The samples at `depth` that stand for `length` of depth each.
    HWY_INLINE void takeSample(Float depth, Float length, Mask near) {
        const Vec3 at = indexAt(path.ray, depth);
        const Float texel = trilinear<format>(job.volume, at);
        const Float place = tablePlace(job.table, texel);
        if (job.layerCount == 0 && !any(both(length > zero(), mayShow(job.table, place)))) return;
        Entry entry = entryOf(job.table, texel, place);
        if (job.layerCount > 0)
            entry = blended(entry, depth, at, length, near);
        else if (job.light.enabled) {
            const Mask seen = both(entry.a > zero(), length > zero());
            if (any(seen))
                entry.rgb =
                    pick(seen, lit(job.light, entry.rgb, normalAt(depth, at, seen, near), path.ray.toEye),
                         entry.rgb);
        }
        add(entry.rgb, throughOf(entry, length));
    }

    // The part of light that passes `length` of depth.
    HWY_INLINE Float throughOf(const Entry& entry, Float length) const {
        return exp2OfNegative(zero() - entry.a * (length * unitsPerDepth));
    }

    HWY_INLINE void add(const Vec3& rgb, Float through) {
        const Float weight = light.transmittance * (num(1.0F) - through);
        light.colour = light.colour + weight * rgb;
        light.transmittance = light.transmittance * through;
    }

    Vec3 normalAt(Float depth, const Vec3& at, Mask seen, Mask near) {
        Vec3 normal{zero(), zero(), zero()};
        const Mask behindCut = cutNormalAt(job, path, depth, near, normal);
        return ownNormal(at, seen, behindCut, normal);
    }

    Vec3 ownNormal(const Vec3& at, Mask seen, Mask behindCut, const Vec3& cutNormal) const {
        const Mask inside = butNot(seen, behindCut);
        if (!any(inside)) return cutNormal;
        return pick(
            behindCut, cutNormal,
            times(job.light.viewFromGradient, gradientAt(job.volume, at, inside, job.light.betweenSamples)));
    }

    // Behind a cut all volumes have its normal.
    HWY_NOINLINE Entry blended(Entry entry, Float depth, const Vec3& at, Float length, Mask near) {
        const Mask counts = length > zero();
        LayerLight layerLight{path.ray.toEye, none(), {zero(), zero(), zero()}};
        if (job.light.enabled && any(counts)) {
            layerLight.behindCut = cutNormalAt(job, path, depth, near, layerLight.cutNormal);
            const Mask seen = both(entry.a > zero(), counts);
            if (any(seen))
                entry.rgb =
                    pick(seen,
                         lit(job.light, entry.rgb,
                             ownNormal(at, seen, layerLight.behindCut, layerLight.cutNormal), path.ray.toEye),
                         entry.rgb);
        }
        entry.a = entry.a * num(job.ownDensity);
        const Vec3 position = textureAt(path.ray, depth);
        for (int i = 0; i < job.layerCount; ++i)
            blendLayer(entry, job, job.layers[i], position, counts, layerLight);
        return entry;
    }

    // From chunks with their middles there to the next that may show something, in chunks; 0: they may
    // themselves.
    HWY_INLINE Float chunksAhead(const Vec3& middle) {
        const float voxels = static_cast<float>(job.chunkSamples) * job.sampleDistanceVoxels;
        if (job.adaptive) return chunksAheadAndStride(middle, voxels);
        Float ahead = stretchesAhead(job.cells, middle, voxels);
        if (job.layerCount == 0) return ahead;
        const Vec3 chunk = num(static_cast<float>(job.chunkSamples)) * path.spacing * path.ray.direction;
        for (int i = 0; i < job.layerCount && any(ahead > zero()); ++i)
            ahead = hn::Min(ahead, layerStretchesAhead(job.layers[i], middle, chunk));
        return ahead;
    }

    HWY_INLINE Float chunksAheadAndStride(const Vec3& middle, float voxels) {
        const Int marks = marksAt(job.cells, middle);
        const Float ahead = stretchesAhead(marks, num(job.cells.cellSamples / voxels));
        stride = pick(ahead == zero(), strideOf(marks), stride);
        return ahead;
    }

    // Where a stretch begins: its position over the table's entries, and the integrals up to there.
    struct Boundary {
        Float position;
        Entry integrals;
    };

    HWY_INLINE Boundary boundaryAt(Float depth) const {
        Boundary boundary;
        boundary.position = entryPosition(job.table, trilinear<format>(job.volume, indexAt(path.ray, depth)));
        boundary.integrals = integralAt(job.table, pick(isNan(boundary.position), zero(), boundary.position));
        return boundary;
    }

    HWY_INLINE Boundary firstBoundary(Float depth) const {
        if constexpr (kind == Stretches::PreIntegrated) return boundaryAt(depth);
        return Boundary{};
    }

    // What the `length` from `depth` on shows, a whole stretch or several; `begin` becomes its end.
    HWY_INLINE Entry stretchEntry(Float depth, Float length, Boundary& begin) const {
        if constexpr (kind == Stretches::PreIntegrated) {
            const Boundary end = boundaryAt(depth + path.spacing);
            const Entry mean =
                meanEntry(job.table, begin.position, begin.integrals, end.position, end.integrals);
            begin = end;
            return mean;
        } else {
            const Float middle = hn::MulAdd(num(0.5F), length, depth);
            return classify(job.table, trilinear<format>(job.volume, indexAt(path.ray, middle)));
        }
    }

    // Two samples that share the normal between them: of `first` and `second` of depth, which may be nothing.
    HWY_INLINE void takeLitPair(Float depth, Float first, Float second, Boundary& begin) {
        const Entry entry = stretchEntry(depth, first, begin);
        const Entry other = stretchEntry(depth + first, second, begin);
        const Float through = throughOf(entry, first);
        const Float otherThrough = throughOf(other, second);
        const Mask seen = through * otherThrough < num(1.0F);
        Reflection reflection{num(1.0F), zero()};
        if (any(seen)) {
            const Float between = hn::MulAdd(pick(second > zero(), num(1.0F), num(0.5F)), first, depth);
            const Vec3 normal = normalAt(between, indexAt(path.ray, between), seen, none());
            reflection = pick(seen, reflectionOf(job.light, normal, path.ray.toEye), reflection);
        }
        add(reflected(reflection, entry.rgb), through);
        add(reflected(reflection, other.rgb), otherThrough);
    }

    // The stretches of the chunk that begins with the `first`.
    HWY_INLINE Float countIn(Mask active, Float first, Float stretches) const {
        return pick(active, hn::Min(stretches - first, num(static_cast<float>(job.chunkSamples))), zero());
    }

    // Of a stride where so many stretches are left.
    HWY_INLINE Float depthOf(Float left) const {
        return hn::Min(hn::Max(left, zero()), stride) * path.spacing;
    }

    HWY_INLINE void takeWholeLit(Mask active, Float chunk, Float stretches) {
        const Float first = chunk * num(static_cast<float>(job.chunkSamples));
        const Float count = countIn(active, first, stretches);
        Boundary begin = firstBoundary(chunkBegin(chunk));
        for (Float step = zero(); any(step < count); step = hn::MulAdd(num(2.0F), stride, step)) {
            const Float depth = hn::MulAdd(first + step, path.spacing, firstDepth);
            takeLitPair(depth, depthOf(count - step), depthOf(count - step - stride), begin);
        }
    }

    HWY_INLINE void takeMeans(Mask active, Float chunk, Float stretches) {
        const Float first = chunk * num(static_cast<float>(job.chunkSamples));
        const Float count = pick(active, stretches - first, zero());
        Boundary begin = firstBoundary(chunkBegin(chunk));
        for (int k = 0; k < job.chunkSamples; ++k) {
            const Float step = num(static_cast<float>(k));
            const Mask counts = step < count;
            if (!any(counts)) break;
            const Float depth = hn::MulAdd(first + step, path.spacing, firstDepth);
            Entry entry = stretchEntry(depth, path.spacing, begin);
            const Mask seen = both(entry.a > zero(), counts);
            if (job.light.enabled && any(seen)) {
                const Float middle = hn::MulAdd(num(0.5F), path.spacing, depth);
                const Vec3 normal = normalAt(middle, indexAt(path.ray, middle), seen, none());
                entry.rgb = pick(seen, lit(job.light, entry.rgb, normal, path.ray.toEye), entry.rgb);
            }
            add(entry.rgb, throughOf(entry, hn::IfThenElseZero(counts, path.spacing)));
        }
    }

    HWY_INLINE void takeStrides(Mask active, Float chunk, Float stretches) {
        const Float first = chunk * num(static_cast<float>(job.chunkSamples));
        const Float count = countIn(active, first, stretches);
        for (Float step = zero(); any(step < count); step = step + stride) {
            const Float length = depthOf(count - step);
            const Float begin = hn::MulAdd(first + step, path.spacing, firstDepth);
            takeSample(hn::MulAdd(num(0.5F), length, begin), length, none());
        }
    }

    HWY_INLINE void takeWhole(Mask active, Float chunk, Float stretches) {
        if constexpr (kind != Stretches::Slabs) {
            if (job.pairsShareLight) return takeWholeLit(active, chunk, stretches);
            if (job.adaptive) return takeStrides(active, chunk, stretches);
        }
        if constexpr (kind == Stretches::PreIntegrated) return takeMeans(active, chunk, stretches);
        const Float first = chunk * num(static_cast<float>(job.chunkSamples));
        const Float count = pick(active, stretches - first, zero());
        for (int k = 0; k < job.chunkSamples; ++k) {
            const Float step = num(static_cast<float>(k));
            const Mask counts = step < count;
            if (!any(counts)) break;
            takeEven(counts, first + step);
        }
    }

    HWY_INLINE void takeEven(Mask counts, Float stretch) {
        if constexpr (kind == Stretches::Slabs) {
            const Float begin = hn::MulAdd(stretch, path.spacing, firstDepth);
            const Float from = within(begin), to = within(begin + path.spacing);
            takeSample(num(0.5F) * (from + to), hn::IfThenElseZero(counts, to - from), none());
        } else {
            const Float depth = hn::MulAdd(stretch + num(0.5F), path.spacing, firstDepth);
            takeSample(depth, hn::IfThenElseZero(counts, path.spacing), none());
        }
    }

    // The stretches [begin, end], as far as the object keeps them; gives the measures at their ends.
    HWY_INLINE Float takeClipped(Mask active, Float begin, Float end, Float measureBegin) {
        if (job.clip.binary) {
            const Float middle = num(0.5F) * (begin + end);
            const Mask kept = both(active, keptMeasure(job.clip, path.clip, middle) >= zero());
            takeSample(middle, hn::IfThenElseZero(kept, end - begin), active);
            return zero();
        }
        const Float measureEnd = keptMeasure(job.clip, path.clip, end);
        const Mask first = measureBegin >= zero();
        const Mask last = measureEnd >= zero();
        const Float crossing = clipCrossing(begin, end, measureBegin, measureEnd);
        const Float from = pick(first, begin, crossing);
        const Float to = pick(last, end, crossing);
        const Mask kept = both(active, either(first, last));
        if (any(kept)) takeSample(num(0.5F) * (from + to), hn::IfThenElseZero(kept, to - from), active);
        return measureEnd;
    }

    HWY_INLINE void takeClippedChunk(Mask active, Mask partly, Float chunk, Float stretches) {
        const Float first = chunk * num(static_cast<float>(job.chunkSamples));
        const Float count = countIn(active, first, stretches);
        const Float most = pick(partly, hn::Min(stride, num(kClippedStride)), stride);
        Float measure = keptMeasure(job.clip, path.clip, within(chunkBegin(chunk)));
        for (Float step = zero(); any(step < count); step = step + most) {
            const Float from = hn::MulAdd(first + step, path.spacing, firstDepth);
            const Float length = hn::Min(count - step, most) * path.spacing;
            measure = takeClipped(step < count, within(from), within(from + length), measure);
        }
    }

    // Moves lanes on to their next chunk that may show something.
    HWY_INLINE void seek(Mask seeking, Float& chunk, Float chunks) {
        const Float samples = num(static_cast<float>(job.chunkSamples));
        while (any(seeking)) {
            const Float middle = hn::MulAdd(num(0.5F) * samples, path.spacing, chunkBegin(chunk));
            const Float ahead = hn::IfThenElseZero(seeking, chunksAhead(textureAt(path.ray, middle)));
            chunk = chunk + ahead;
            seeking = both(seeking, both(ahead > zero(), chunk < chunks));
        }
    }

    void takeWholeStretches(Mask active, Float stretches, Float chunks) {
        Float chunk = zero();
        active = both(active, chunks > zero());
        while (any(active)) {
            if (job.cells.marks != nullptr) {
                seek(active, chunk, chunks);
                active = both(active, chunk < chunks);
                if (!any(active)) return;
            }
            takeWhole(active, chunk, stretches);
            chunk = chunk + num(1.0F);
            active = both(active, both(chunk<chunks, light.transmittance> num(kOpaque)));
        }
    }

    // Moves lanes on to their next chunk of which the object keeps something; `partly`: maybe not all of it.
    HWY_INLINE Mask seekKept(Mask seeking, Float& chunk, Float chunks) {
        const Float length = num(static_cast<float>(job.chunkSamples)) * path.spacing;
        Mask partly = none();
        while (any(seeking)) {
            const Float begin = chunkBegin(chunk);
            const Float before = job.light.enabled ? path.depthPerVoxel : zero();
            const auto verdict = clipVerdict(job.clip, path.clip, begin - before, begin + length);
            const Float middle = hn::MulAdd(num(0.5F), length, begin);
            const Float empty = chunksAhead(textureAt(path.ray, middle));
            const Float free =
                hn::Max(chunk + num(1.0F), hn::Floor((verdict.removedUntil - firstDepth) / length));
            const Float next = pick(verdict.removed, free, chunk + empty);
            const Mask moves = both(seeking, next > chunk);
            partly = either(partly, butNot(butNot(seeking, moves), verdict.kept));
            chunk = pick(moves, next, chunk);
            seeking = both(moves, chunk < chunks);
        }
        return partly;
    }

    void takeKeptStretches(Mask active, Float stretches, Float chunks) {
        const Float length = num(static_cast<float>(job.chunkSamples)) * path.spacing;
        Float from = num(-3.0e38F), to = num(3.0e38F);
        boxDepths(job.clip.keptLow, job.clip.keptHigh, path.clip.textureOrigin, path.clip.textureDirection,
                  from, to);
        Float chunk = hn::Min(hn::Max(hn::Floor((from - firstDepth) / length), zero()), chunks);
        chunks = hn::Min(hn::Max(hn::Ceil((to - firstDepth) / length), zero()), chunks);
        active = both(active, chunk < chunks);
        while (any(active)) {
            const Mask partly = seekKept(active, chunk, chunks);
            active = both(active, chunk < chunks);
            if (!any(active)) return;
            if (any(both(active, partly)))
                takeClippedChunk(active, partly, chunk, stretches);
            else
                takeWhole(active, chunk, stretches);
            chunk = chunk + num(1.0F);
            active = both(active, both(chunk<chunks, light.transmittance> num(kOpaque)));
        }
    }

    void cast() {
        const Mask hits = path.span.begin < path.span.end;
        if (!any(hits)) return;
        unitsPerDepth = path.ray.radiiPerDepth * num(job.unitsPerRadius);
        if constexpr (kind == Stretches::Slabs)
            castSlabs(hits);
        else
            castFromEntry(hits);
    }

    HWY_INLINE void takeAll(Mask hits, Float stretches) {
        const Float chunks = hn::Ceil(stretches * num(1.0F / static_cast<float>(job.chunkSamples)));
        if (job.clip.hasObject)
            takeKeptStretches(hits, stretches, chunks);
        else
            takeWholeStretches(hits, stretches, chunks);
    }

    HWY_INLINE void castSlabs(Mask hits) {
        path.spacing = num(job.slabDepth);
        const Float inverse = num(1.0F / job.slabDepth);
        firstDepth = hn::Floor(path.span.begin * inverse) * path.spacing;
        takeAll(hits, pick(hits, hn::Ceil((path.span.end - firstDepth) * inverse), zero()));
    }

    HWY_INLINE void castFromEntry(Mask hits) {
        firstDepth = path.span.begin;
        const Float stretches =
            pick(hits, hn::Floor((path.span.end - path.span.begin) / path.spacing), zero());
        takeAll(hits, stretches);
        // The rest of the path is shorter than a whole stretch: its sample sits in its middle and counts for
        // its length.
        const Float begin = hn::MulAdd(stretches, path.spacing, path.span.begin);
        if (job.clip.hasObject)
            takeClipped(hits, begin, path.span.end, keptMeasure(job.clip, path.clip, begin));
        else
            takeSample(num(0.5F) * (begin + path.span.end), hn::IfThenElseZero(hits, path.span.end - begin),
                       none());
    }
};

template <TexelFormat format, Stretches kind>
void castRows(const PictureJob& job, int firstRow, int endRow) {
    drawRows(job, firstRow, endRow, [&](int x, int y) HWY_ATTR {
        Caster<format, kind> caster{job, pathOf(job, x, y), zero(), {}, zero()};
        caster.cast();
        storePacket(job, x, y, caster.light.colour, num(1.0F) - caster.light.transmittance);
    });
}

/// Draws the rows by the march that reads texels of the volume's format.
template <Stretches kind>
void castRowsOf(const PictureJob& job, int firstRow, int endRow) {
    switch (job.volume.format) {
    case TexelFormat::R8:
        return castRows<TexelFormat::R8, kind>(job, firstRow, endRow);
    case TexelFormat::R16:
        return castRows<TexelFormat::R16, kind>(job, firstRow, endRow);
    case TexelFormat::R16F:
        return castRows<TexelFormat::R16F, kind>(job, firstRow, endRow);
    case TexelFormat::R32F:
        return castRows<TexelFormat::R32F, kind>(job, firstRow, endRow);
    }
}

} // namespace voxsheet::simd::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
