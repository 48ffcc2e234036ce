#include "simd/targets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "simd/isosurface_kernel.cpp"
#include <hwy/foreach_target.h>

#include "simd/kernels.h"
#include "simd/rays-inl.h"

HWY_BEFORE_NAMESPACE();
namespace voxsheet::simd::HWY_NAMESPACE {
namespace {

constexpr float kRefinedVoxels = 0.008F; // width within which a crossing is enclosed

// The search of techniques/isosurface/isosurface.glsl, for all lanes at once: a lane that has found something
// waits for the others.
struct Tracer {
    const PictureJob& job;
    Path path;
    Light light;
    // Where each lane has got to: the step from `begin` on is looked at next.
    Float steps = zero(), chunks = zero(); // along the whole ray
    Float chunk = zero(), step = zero();   // `step` counts within the chunk
    Mask entered = none();                 // what follows holds for this chunk
    Float begin = zero(), atBegin = zero(), rankBegin = zero();
    Float end = zero(), atEnd = zero(), rankEnd = zero();
    Float atStep = zero(), atBefore = zero(); // where the whole step begins, and a step before that
    Mask mayTurn = none(), isSplit = none();
    Float wholeEnd = zero(), atWholeEnd = zero();
    Float measureBegin = zero(), measureEnd = zero();

    const SurfaceNumbers& surfaces() const { return job.surfaces; }
    bool cutsMatter() const { return surfaces().caps && job.clip.hasObject; }

    Float texelAtDepth(Float depth) const { return texelAt(job.volume, indexAt(path.ray, depth)); }
    Float chunkBegin(Float at) const {
        return hn::MulAdd(at * num(static_cast<float>(job.chunkSamples)), path.spacing, path.span.begin);
    }

    // How many surfaces lie at or below texels, in their order; -1: no value.
    Float rankOf(Float texel) const {
        Float rank = zero();
        for (int i = 0; i < surfaces().count; ++i)
            rank = rank + hn::IfThenElseZero(texel >= num(surfaces().texels[i]), num(1.0F));
        return pick(isNan(texel), num(-1.0F), rank);
    }

    // --- what is shown ---

    void addSurface(Mask shown, const Vec3& rgb, Float alpha) {
        const Float weight = hn::IfThenElseZero(shown, light.transmittance * alpha);
        light.colour = light.colour + weight * rgb;
        light.transmittance = light.transmittance - weight;
    }

    Vec3 colouredByOther(Float depth, const Vec3& own) const {
        const Vec3 at = placed(surfaces().colourFromTexture, textureAt(path.ray, depth));
        const auto inside = [&](int axis, Float position) {
            return both(position >= num(surfaces().colourBoxLow[axis]),
                        position <= num(surfaces().colourBoxHigh[axis]));
        };
        const Vec3 samples = spread(surfaces().colours3d.samples);
        const Float half = num(0.5F);
        const Float texel = texelAt(surfaces().colours3d, {at.x * samples.x - half, at.y * samples.y - half,
                                                           at.z * samples.z - half});
        const Mask known =
            butNot(both(both(inside(0, at.x), inside(1, at.y)), inside(2, at.z)), isNan(texel));
        return pick(known, classify(surfaces().colourTable, texel).rgb, own);
    }

    void showCrossing(Mask shown, Float surface, Float depth) {
        if (job.clip.hasObject) shown = both(shown, keptMeasure(job.clip, path.clip, depth) >= zero());
        if (!any(shown)) return;
        Vec3 rgb{zero(), zero(), zero()};
        Float alpha = zero();
        for (int i = 0; i < surfaces().count; ++i) {
            const Mask mine = surface == num(static_cast<float>(i));
            rgb = pick(mine, spread(surfaces().colours[i]), rgb);
            assign(mine, alpha, num(surfaces().colours[i][3]));
        }
        if (surfaces().hasColours) rgb = colouredByOther(depth, rgb);
        if (job.light.enabled) {
            const Vec3 gradient =
                gradientAt(job.volume, indexAt(path.ray, depth), shown, job.light.betweenSamples);
            rgb = lit(job.light, rgb, times(job.light.viewFromGradient, gradient), path.ray.toEye);
        }
        addSurface(shown, rgb, alpha);
    }

    // Cuts at `depth`; shown where they lie inside a surface.
    void showCap(Mask shown, Float depth, const Vec3& normal) {
        const Float texel = texelAtDepth(depth);
        const auto inside = [&](const float* test) {
            return texel * num(test[0]) >= num(test[1]);
        }; // false for NaN
        shown = both(shown, either(inside(surfaces().capTexels), inside(surfaces().mirroredCapTexels)));
        if (!any(shown)) return;
        Vec3 rgb = classify(job.table, texel).rgb;
        if (job.light.enabled) rgb = lit(job.light, rgb, normal, path.ray.toEye);
        addSurface(shown, rgb, num(1.0F));
    }

    void showEntryCap(Mask hits) {
        Mask shown = both(hits, path.span.cutPlane >= zero());
        if (!any(shown)) return;
        if (job.clip.hasObject)
            shown = both(shown, keptMeasure(job.clip, path.clip, path.span.begin) >= zero());
        showCap(shown, path.span.begin, planeNormals(job.clip, path.span.cutPlane));
    }

    // --- the search ---

    // To the next chunks that can hold anything to show, in chunks; 0: these can.
    Float worthEnteringAhead() const {
        const Float first = chunkBegin(chunk);
        const Float length = num(static_cast<float>(job.chunkSamples)) * path.spacing;
        const float stretchVoxels = static_cast<float>(job.chunkSamples) * job.sampleDistanceVoxels;
        const Float middle = hn::MulAdd(num(0.5F), length, first);
        const Float ahead = stretchesAhead(job.cells, textureAt(path.ray, middle), stretchVoxels);
        if (!job.clip.hasObject) return ahead;
        const auto verdict = clipVerdict(job.clip, path.clip, first, hn::Min(first + length, path.span.end));
        const Float removedAhead =
            hn::Max(num(1.0F), hn::Floor((verdict.removedUntil - path.span.begin) / length) - chunk);
        if (!surfaces().caps) return pick(verdict.removed, hn::Max(ahead, removedAhead), ahead);
        // A cut may stand anywhere.
        return pick(verdict.kept, hn::Min(ahead, num(1.0F)), pick(verdict.removed, removedAhead, zero()));
    }

    Mask cutsHere() const { return both(measureBegin < zero(), measureEnd >= zero()); }

    Mask hasEvent() const {
        const Mask crossed = both(butNot(rankBegin >= zero(), rankBegin == rankEnd), rankEnd >= zero());
        return cutsMatter() ? either(crossed, cutsHere()) : crossed;
    }

    void toNextStep(Mask lanes) {
        assign(lanes, step, step + num(1.0F));
        assign(lanes, begin, end);
        assign(lanes, atBegin, atEnd);
        assign(lanes, rankBegin, rankEnd);
        assign(lanes, atBefore, atStep);
        assign(lanes, atStep, atEnd);
        if (cutsMatter()) assign(lanes, measureBegin, measureEnd);
    }

    void enter(Mask lanes) {
        if (!any(lanes)) return;
        entered = either(entered, lanes);
        isSplit = butNot(isSplit, lanes);
        assign(lanes, step, zero());
        assign(lanes, begin, chunkBegin(chunk));
        assign(lanes, atBegin, texelAtDepth(begin));
        assign(lanes, rankBegin, rankOf(atBegin));
        assign(lanes, atStep, atBegin);
        assign(lanes, atBefore, texelAtDepth(begin - path.spacing));
        if (cutsMatter()) assign(lanes, measureBegin, keptMeasure(job.clip, path.clip, begin));
    }

    // Whether values may pass a surface and come back within the step: they had been heading for one.
    Mask isHeadingForSurface() const {
        const Float ahead = rankOf(num(2.0F) * atStep - atBefore);
        const Mask same = both(rankBegin >= zero(), rankEnd == rankBegin);
        return both(same, butNot(ahead >= zero(), ahead == rankBegin));
    }

    // Splits steps in which the value passes a surface and turns back at a point beyond the surface, found by
    // golden section.
    void splitAtTurn(Mask lanes) {
        const Float side = pick(atStep > atBefore, num(1.0F), num(-1.0F));
        Float a = begin, b = end, turn = begin, atTurn = atBegin;
        for (int i = 0; i < 8 && any(lanes); ++i) {
            const Float guess =
                pick(b - turn > turn - a, mix(turn, b, num(0.382F)), mix(turn, a, num(0.382F)));
            const Float texel = texelAtDepth(guess);
            const Mask better = side * texel > side * atTurn;
            const Mask right = guess > turn;
            const Mask towardsA = either(both(right, better), hn::Not(either(right, better)));
            const Float bound = pick(better, turn, guess);
            assign(towardsA, a, bound);
            assign(hn::Not(towardsA), b, bound);
            assign(better, turn, guess);
            assign(better, atTurn, texel);
            const Float rank = rankOf(atTurn);
            const Mask split = both(lanes, butNot(rank >= zero(), rank == rankBegin));
            isSplit = either(isSplit, split);
            assign(split, wholeEnd, end);
            assign(split, atWholeEnd, atEnd);
            assign(split, end, turn);
            assign(split, atEnd, atTurn);
            assign(split, rankEnd, rank);
            lanes = butNot(lanes, split);
        }
    }

    // To the second parts of split steps.
    void toRestOfStep(Mask lanes) {
        isSplit = butNot(isSplit, lanes);
        assign(lanes, begin, end);
        assign(lanes, atBegin, atEnd);
        assign(lanes, rankBegin, rankEnd);
        assign(lanes, end, wholeEnd);
        assign(lanes, atEnd, atWholeEnd);
        assign(lanes, rankEnd, rankOf(atEnd));
    }

    void seekChunk(Mask lanes) {
        while (any(lanes)) {
            const Float ahead = hn::IfThenElseZero(lanes, worthEnteringAhead());
            chunk = chunk + ahead;
            lanes = both(lanes, both(ahead > zero(), chunk < chunks));
        }
    }

    // Through the steps of the lanes' chunks, up to the first in which something happens or may happen: those
    // lanes.
    Mask seekInChunk(Mask lanes) {
        const Float samples = num(static_cast<float>(job.chunkSamples));
        const Float count = hn::Min(samples, steps - chunk * samples);
        const Float first = chunkBegin(chunk);
        Mask found = none();
        lanes = both(lanes, step < count);
        while (any(lanes)) {
            const Float to = hn::Min(hn::MulAdd(step + num(1.0F), path.spacing, first), path.span.end);
            assign(lanes, end, to);
            assign(lanes, atEnd, texelAtDepth(end));
            assign(lanes, rankEnd, rankOf(atEnd));
            if (cutsMatter()) assign(lanes, measureEnd, keptMeasure(job.clip, path.clip, end));
            const Mask events = both(lanes, hasEvent());
            const Mask turns = butNot(both(lanes, isHeadingForSurface()), events);
            mayTurn = either(mayTurn, turns);
            const Mask stops = either(events, turns);
            found = either(found, stops);
            lanes = butNot(lanes, stops);
            toNextStep(lanes);
            lanes = both(lanes, step < count);
        }
        return found;
    }

    // Moves lanes on to their next steps in which something happens or may happen: those lanes.
    Mask seekStep(Mask lanes) {
        mayTurn = butNot(mayTurn, lanes);
        Mask found = both(both(lanes, entered), hasEvent());
        const Mask split = both(butNot(lanes, found), isSplit);
        if (any(split)) {
            toRestOfStep(split);
            found = either(found, both(split, hasEvent()));
        }
        lanes = both(butNot(lanes, found), chunk < chunks);
        while (any(lanes)) {
            toNextStep(both(lanes, entered));
            seekChunk(butNot(lanes, entered));
            lanes = both(lanes, chunk < chunks);
            enter(butNot(lanes, entered));
            found = either(found, seekInChunk(lanes));
            lanes = butNot(lanes, found);
            entered = butNot(entered, lanes);
            assign(lanes, chunk, chunk + num(1.0F));
            lanes = both(lanes, chunk < chunks);
        }
        return found;
    }

    Mask seekEvent(Mask lanes) {
        Mask events = none();
        while (any(lanes)) {
            const Mask found = seekStep(lanes);
            const Mask turns = both(found, mayTurn);
            if (any(turns)) splitAtTurn(turns);
            lanes = butNot(turns, isSplit);
            events = either(events, butNot(found, lanes));
        }
        return events;
    }

    // Where texels are `wanted` between depths that lie on both sides of it: by false position, with the
    // weight of an end that stays halved (Illinois; Dowell & Jarratt 1971).
    Float refinedDepth(Mask lanes, Float wanted) const {
        const Float width = num(kRefinedVoxels) * path.depthPerVoxel;
        Float a = begin, b = end, fa = atBegin - wanted, fb = atEnd - wanted;
        const auto falsePosition = [&] { return a + (b - a) * clampTo(fa / (fa - fb), 0.0F, 1.0F); };
        Float guess = falsePosition();
        Float moved = b - a;
        Float side = zero(); // of the last guess
        for (int i = 0; i < 12; ++i) {
            lanes = both(lanes, hn::Min(b - a, num(8.0F) * moved) > width);
            if (!any(lanes)) break;
            const Float f = texelAtDepth(guess) - wanted;
            const Mask before = both(lanes, hn::Not(hn::Xor(f < zero(), fa < zero())));
            const Mask behind = butNot(lanes, before);
            const Float now = pick(before, num(1.0F), num(-1.0F));
            const Float kept = pick(side == now, num(0.5F), num(1.0F));
            side = now;
            fb = pick(before, kept * fb, pick(behind, f, fb));
            fa = pick(before, f, pick(behind, kept * fa, fa));
            assign(before, a, guess);
            assign(behind, b, guess);
            const Float next = falsePosition();
            assign(lanes, moved, hn::Abs(next - guess));
            assign(lanes, guess, next);
        }
        return guess;
    }

    // Shows the first thing that happens in the lanes' steps, and takes it off.
    void showEvent(Mask lanes) {
        if (cutsMatter()) {
            const Mask cuts = both(lanes, cutsHere());
            if (any(cuts)) {
                const Float depth = clipCrossing(begin, end, measureBegin, measureEnd);
                showCap(cuts, depth, clipSurfaceNormal(job.clip, path.clip, depth));
                assign(cuts, measureBegin, zero());
                lanes = butNot(lanes, cuts);
            }
        }
        if (!any(lanes)) return;
        const Mask rising = rankEnd > rankBegin;
        const Float surface = pick(rising, rankBegin, rankBegin - num(1.0F));
        Float wanted = zero();
        for (int i = 0; i < surfaces().count; ++i)
            assign(surface == num(static_cast<float>(i)), wanted, num(surfaces().texels[i]));
        showCrossing(lanes, surface, refinedDepth(lanes, wanted));
        assign(lanes, rankBegin, rankBegin + pick(rising, num(1.0F), num(-1.0F)));
    }

    void trace(Mask hits) {
        steps = pick(hits, hn::Ceil((path.span.end - path.span.begin) / path.spacing), zero());
        chunks = hn::Ceil(steps * num(1.0F / static_cast<float>(job.chunkSamples)));
        if (surfaces().caps) showEntryCap(hits);
        Mask active = both(hits, light.transmittance > num(kOpaque));
        while (any(active)) {
            const Mask events = seekEvent(active);
            if (!any(events)) return;
            showEvent(events);
            active = both(events, light.transmittance > num(kOpaque));
        }
    }

    // One sample in the middle of each stretch, and of the shorter rest; hit when it is nearly a surface's
    // value.
    void testSamples(Mask active) {
        for (Float number = zero(); any(active); number = number + num(1.0F)) {
            const Float from = hn::MulAdd(number, path.spacing, path.span.begin);
            active = both(active, both(from<path.span.end, light.transmittance> num(kOpaque)));
            if (!any(active)) return;
            const Float depth = num(0.5F) * (from + hn::Min(from + path.spacing, path.span.end));
            const Float texel = texelAtDepth(depth);
            for (int i = 0; i < surfaces().count; ++i) {
                const Mask hit = hn::Abs(texel - num(surfaces().texels[i])) <= num(surfaces().tolerance);
                showCrossing(both(active, hit), num(static_cast<float>(i)), depth);
            }
        }
    }

    void draw() {
        const Mask hits = path.span.begin < path.span.end;
        if (!any(hits)) return;
        if (surfaces().plainTest)
            testSamples(hits);
        else
            trace(hits);
    }
};

} // namespace

void isosurfaceRowsHere(const PictureJob& job, int firstRow, int endRow) {
    drawRows(job, firstRow, endRow, [&](int x, int y) HWY_ATTR {
        Tracer tracer{.job = job, .path = pathOf(job, x, y), .light = {}};
        tracer.draw();
        storePacket(job, x, y, tracer.light.colour, num(1.0F) - tracer.light.transmittance);
    });
}

} // namespace voxsheet::simd::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace voxsheet::simd {

HWY_EXPORT(isosurfaceRowsHere);

void isosurfaceRows(const PictureJob& job, int firstRow, int endRow) {
    HWY_DYNAMIC_DISPATCH(isosurfaceRowsHere)(job, firstRow, endRow);
}

} // namespace voxsheet::simd
#endif
