#include "simd/targets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "simd/mip_kernel.cpp"
#include <hwy/foreach_target.h>

#include "simd/kernels.h"
#include "simd/rays-inl.h"

HWY_BEFORE_NAMESPACE();
namespace voxsheet::simd::HWY_NAMESPACE {
namespace {

constexpr float kNothing = -3.0e38F;

struct Projector {
    const PictureJob& job;
    Path path;
    Float stretches = zero(); // whole ones
    Float chunks = zero();
    Float largest = num(kNothing);

    Float samples() const { return num(static_cast<float>(job.chunkSamples)); }
    Float depthOf(Float sample) const {
        return hn::MulAdd(sample + num(0.5F), path.spacing, path.span.begin);
    }

    void take(Mask counts, Float depth) {
        const Float texel = num(job.texelSign) * texelAt(job.volume, indexAt(path.ray, depth));
        Mask larger = both(counts, texel > largest); // false for NaN
        if (job.clip.hasObject && any(larger))
            larger = both(larger, keptMeasure(job.clip, path.clip, depth) >= zero());
        assign(larger, largest, texel);
    }

    void takeChunk(Mask lanes, Float chunk) {
        const Float first = chunk * samples();
        if (job.clip.hasObject) {
            const Float begin = depthOf(first);
            lanes = butNot(lanes,
                           clipVerdict(job.clip, path.clip, begin, begin + samples() * path.spacing).removed);
        }
        for (int k = 0; k < job.chunkSamples; ++k) {
            const Float sample = first + num(static_cast<float>(k));
            const Mask counts = both(lanes, sample < stretches);
            if (!any(counts)) return;
            take(counts, depthOf(sample));
        }
    }

    Float boundOf(Float chunk) const {
        const Float middle =
            hn::MulAdd(chunk, samples(), num(0.5F * static_cast<float>(job.chunkSamples - 1)));
        return largestInCell(job.cells, textureAt(path.ray, depthOf(middle)));
    }

    // The chunk of each lane with the largest bound.
    Float promisingChunk(Mask hits) const {
        Float promising = zero(), promise = num(kNothing);
        Float chunk = zero();
        for (Mask lanes = both(hits, chunk < chunks); any(lanes); lanes = both(hits, chunk < chunks)) {
            const Float bound = boundOf(chunk);
            const Mask better = both(lanes, bound > promise);
            assign(better, promise, bound);
            assign(better, promising, chunk);
            chunk = chunk + num(1.0F);
        }
        return promising;
    }

    void project() {
        const Mask hits = path.span.begin < path.span.end;
        if (!any(hits)) return;
        const Float all = (path.span.end - path.span.begin) / path.spacing;
        stretches = pick(hits, hn::Floor(all), zero());
        chunks = hn::Ceil(stretches * num(1.0F / static_cast<float>(job.chunkSamples)));
        take(hits,
             num(0.5F) * (hn::MulAdd(stretches, path.spacing, path.span.begin) + path.span.end)); // the rest
        // The most promising chunk first: most others then cannot exceed what it holds.
        Float promising = num(-1.0F);
        if (job.cells.largest != nullptr) {
            promising = promisingChunk(hits);
            takeChunk(both(hits, chunks > zero()), promising);
        }
        Float chunk = zero();
        Mask lanes = both(hits, chunk < chunks);
        while (any(lanes)) {
            if (job.cells.largest != nullptr) {
                Mask seeking = lanes;
                while (any(seeking)) {
                    const Mask worth = butNot(boundOf(chunk) > largest, chunk == promising);
                    seeking = butNot(seeking, worth);
                    assign(seeking, chunk, chunk + num(1.0F));
                    seeking = both(seeking, chunk < chunks);
                }
                lanes = both(lanes, chunk < chunks);
            }
            takeChunk(lanes, chunk);
            chunk = chunk + num(1.0F);
            lanes = both(lanes, chunk < chunks);
        }
    }

    void store(int x, int y) const {
        const Entry entry = classify(job.table, num(job.texelSign) * largest);
        const Float alpha =
            hn::IfThenElseZero(largest > num(kNothing), num(1.0F) - hn::Exp(kF, entry.a * num(-0.69314718F)));
        const Float scaled = num(job.opacityScale) * alpha;
        storePacket(job, x, y, scaled * entry.rgb, scaled);
    }
};

} // namespace

void mipRowsHere(const PictureJob& job, int firstRow, int endRow) {
    drawRows(job, firstRow, endRow, [&](int x, int y) HWY_ATTR {
        Projector projector{.job = job, .path = pathOf(job, x, y)};
        projector.project();
        projector.store(x, y);
    });
}

} // namespace voxsheet::simd::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace voxsheet::simd {

HWY_EXPORT(mipRowsHere);

void mipRows(const PictureJob& job, int firstRow, int endRow) {
    HWY_DYNAMIC_DISPATCH(mipRowsHere)(job, firstRow, endRow);
}

} // namespace voxsheet::simd
#endif
