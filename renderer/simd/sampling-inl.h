// Trilinear samples, gradients, table entries and cells' marks of one packet.
#if defined(VOXSHEET_SIMD_SAMPLING_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef VOXSHEET_SIMD_SAMPLING_INL_H
#undef VOXSHEET_SIMD_SAMPLING_INL_H
#else
#define VOXSHEET_SIMD_SAMPLING_INL_H
#endif

#include "simd/lanes-inl.h"
#include "simd/sampled_volume.h"

HWY_BEFORE_NAMESPACE();
namespace voxsheet::simd::HWY_NAMESPACE {

// Two texels that lie side by side, as floats; unscaled where texels are integers.
struct Pair {
    Float low, high;
};

template <TexelFormat format>
constexpr int kShift = format == TexelFormat::R8     ? 0
                       : format == TexelFormat::R32F ? 2
                                                     : 1;

template <TexelFormat format>
constexpr float kTexelScale = format == TexelFormat::R8    ? 1.0F / 255.0F
                              : format == TexelFormat::R16 ? 1.0F / 65535.0F
                                                           : 1.0F;

HWY_INLINE Float halfFloats(Int bits) {
    const hn::Rebind<std::uint16_t, FloatTag> u16;
    const hn::Rebind<hwy::float16_t, FloatTag> f16;
    return hn::PromoteTo(kF, hn::BitCast(f16, hn::DemoteTo(u16, bits)));
}

template <TexelFormat format>
HWY_INLINE Pair pairAt(const std::byte* base, const std::int32_t* offsets) {
    if constexpr (format == TexelFormat::R32F) {
        return {hn::BitCast(kF, loadWords<kShift<format>>(base, offsets)),
                hn::BitCast(kF, loadWords<kShift<format>>(base + 4, offsets))};
    } else if constexpr (format == TexelFormat::R8) {
        const Int words = loadWords<kShift<format>>(base, offsets);
        const Int mask = hn::Set(kI, 0xFF);
        return {hn::ConvertTo(kF, hn::And(words, mask)),
                hn::ConvertTo(kF, hn::And(hn::ShiftRight<8>(words), mask))};
    } else {
        const Int words = loadWords<kShift<format>>(base, offsets);
        const Int mask = hn::Set(kI, 0xFFFF);
        const Int low = hn::And(words, mask);
        const Int high = hn::And(hn::ShiftRight<16>(words), mask);
        if constexpr (format == TexelFormat::R16F)
            return {halfFloats(low), halfFloats(high)};
        else
            return {hn::ConvertTo(kF, low), hn::ConvertTo(kF, high)};
    }
}

// Where a packet samples: its lower corners, counted in texels, and the weights of the upper ones.
struct Place {
    HWY_ALIGN std::int32_t offsets[8];
    Float x, y, z;
};

// On an axis that wraps, into [-1/2, n - 1/2); else the nearest place there.
HWY_INLINE Float insideAxis(const SampledVolume& volume, int axis, Float at) {
    const float n = volume.samples[axis];
    if (volume.periodic[axis]) at = at - num(n) * hn::Floor((at + num(0.5F)) * num(1.0F / n));
    return clampTo(at, -0.5F, n - 0.5F); // also NaN goes somewhere
}

HWY_INLINE Place placeOf(const SampledVolume& volume, const Vec3& at) {
    const Float x = insideAxis(volume, 0, at.x) + num(1.0F);
    const Float y = insideAxis(volume, 1, at.y) + num(1.0F);
    const Float z = insideAxis(volume, 2, at.z) + num(1.0F);
    const Int ix = truncated(x);
    const Int iy = truncated(y);
    const Int iz = truncated(z);
    Place place;
    const Int texel = ix + iy * hn::Set(kI, volume.rowTexels) + iz * hn::Set(kI, volume.sliceTexels);
    hn::Store(texel, kI, place.offsets);
    place.x = x - hn::ConvertTo(kF, ix);
    place.y = y - hn::ConvertTo(kF, iy);
    place.z = z - hn::ConvertTo(kF, iz);
    return place;
}

// In a row of the lower corner moved by `texels`.
template <TexelFormat format>
HWY_INLINE Float rowAt(const SampledVolume& volume, const Place& place, std::ptrdiff_t texels) {
    const Pair pair = pairAt<format>(volume.first + (texels << kShift<format>), place.offsets);
    return mix(pair.low, pair.high, place.x);
}

template <TexelFormat format>
HWY_INLINE Float trilinear(const SampledVolume& volume, const Vec3& at) {
    const Place place = placeOf(volume, at);
    const Float near =
        mix(rowAt<format>(volume, place, 0), rowAt<format>(volume, place, volume.rowTexels), place.y);
    const Float far = mix(rowAt<format>(volume, place, volume.sliceTexels),
                          rowAt<format>(volume, place, volume.sliceTexels + volume.rowTexels), place.y);
    return mix(near, far, place.z) * num(kTexelScale<format>);
}

/// The texel at index positions, as a texture with a linear filter gives it.
HWY_INLINE Float texelAt(const SampledVolume& volume, const Vec3& at) {
    switch (volume.format) {
    case TexelFormat::R8:
        return trilinear<TexelFormat::R8>(volume, at);
    case TexelFormat::R16:
        return trilinear<TexelFormat::R16>(volume, at);
    case TexelFormat::R16F:
        return trilinear<TexelFormat::R16F>(volume, at);
    case TexelFormat::R32F:
        break;
    }
    return trilinear<TexelFormat::R32F>(volume, at);
}

/// The texel of the nearest sample.
HWY_INLINE Float nearestTexelAt(const SampledVolume& volume, const Vec3& at) {
    const auto nearest = [&](int axis, Float position) {
        return clampTo(hn::Floor(position + num(0.5F)), 0.0F, volume.samples[axis] - 1.0F);
    };
    return texelAt(volume, {nearest(0, at.x), nearest(1, at.y), nearest(2, at.z)});
}

// Of the row of the lower corner moved by `texels`: four texels from x - 1 on, and the value at x.
struct Triple {
    Pair before, after; ///< the outer two are before.low and after.high
    Float middle;
};

template <TexelFormat format>
HWY_INLINE Triple tripleAt(const SampledVolume& volume, const Place& place, std::ptrdiff_t texels) {
    Float a, b, c, d;
    if constexpr (format == TexelFormat::R8) {
        const Int words = loadWords<0>(volume.first + texels - 1, place.offsets);
        const Int mask = hn::Set(kI, 0xFF);
        a = hn::ConvertTo(kF, hn::And(words, mask));
        b = hn::ConvertTo(kF, hn::And(hn::ShiftRight<8>(words), mask));
        c = hn::ConvertTo(kF, hn::And(hn::ShiftRight<16>(words), mask));
        d = hn::ConvertTo(kF, hn::And(hn::ShiftRight<24>(words), mask));
    } else {
        const Pair low = pairAt<format>(volume.first + ((texels - 1) << kShift<format>), place.offsets);
        const Pair high = pairAt<format>(volume.first + ((texels + 1) << kShift<format>), place.offsets);
        a = low.low;
        b = low.high;
        c = high.low;
        d = high.high;
    }
    return {{a, b}, {c, d}, mix(b, c, place.x)};
}

// On axes that do not wrap, what the ends change of differences: taps do not leave the samples.
struct AxisEnds {
    Float low, high; ///< factors of the differences at the lower and the upper corner
    Float all;       ///< of both
};

// Twice the central differences of six taps, from the 32 samples that all six touch. The border repeats the
// samples at the ends, so that differences there only have to be divided by their shorter distance.
template <TexelFormat format, bool atEnds>
HWY_INLINE Vec3 gradientFrom32(const SampledVolume& volume, const Place& place, const AxisEnds* ends) {
    const std::ptrdiff_t row = volume.rowTexels;
    const std::ptrdiff_t slice = volume.sliceTexels;
    const Triple r00 = tripleAt<format>(volume, place, 0);
    const Triple r10 = tripleAt<format>(volume, place, row);
    const Triple r01 = tripleAt<format>(volume, place, slice);
    const Triple r11 = tripleAt<format>(volume, place, slice + row);
    const auto bilinear = [&](Float v00, Float v10, Float v01, Float v11) HWY_ATTR {
        return mix(mix(v00, v10, place.y), mix(v01, v11, place.y), place.z);
    };
    const auto low = [&](int axis, Float value) HWY_ATTR { return atEnds ? ends[axis].low * value : value; };
    const auto high = [&](int axis, Float value)
                          HWY_ATTR { return atEnds ? ends[axis].high * value : value; };
    const auto alongX = [&](const Triple& at) HWY_ATTR {
        return mix(low(0, at.after.low - at.before.low), high(0, at.after.high - at.before.high), place.x);
    };
    Vec3 twice;
    twice.x = bilinear(alongX(r00), alongX(r10), alongX(r01), alongX(r11));
    const Float below0 = rowAt<format>(volume, place, -row);
    const Float below1 = rowAt<format>(volume, place, slice - row);
    const Float above0 = rowAt<format>(volume, place, 2 * row);
    const Float above1 = rowAt<format>(volume, place, slice + 2 * row);
    twice.y = bilinear(low(1, r10.middle - below0), high(1, above0 - r00.middle), low(1, r11.middle - below1),
                       high(1, above1 - r01.middle));
    const Float before0 = rowAt<format>(volume, place, -slice);
    const Float before1 = rowAt<format>(volume, place, row - slice);
    const Float after0 = rowAt<format>(volume, place, 2 * slice);
    const Float after1 = rowAt<format>(volume, place, row + 2 * slice);
    twice.z = bilinear(low(2, r01.middle - before0), low(2, r11.middle - before1),
                       high(2, after0 - r00.middle), high(2, after1 - r10.middle));
    if (atEnds) twice = {ends[0].all * twice.x, ends[1].all * twice.y, ends[2].all * twice.z};
    return twice;
}

HWY_INLINE Float component(const Vec3& v, int axis) { return axis == 0 ? v.x : axis == 1 ? v.y : v.z; }

HWY_INLINE Vec3 movedTo(Vec3 v, int axis, Float value) {
    (axis == 0 ? v.x : axis == 1 ? v.y : v.z) = value;
    return v;
}

// Difference per voxel along one axis, by two taps a voxel to both sides, which do not leave the samples
// unless the axis wraps.
HWY_INLINE Float slopeAt(const SampledVolume& volume, const Vec3& at, int axis) {
    const Float here = component(at, axis);
    Float low = here - num(1.0F);
    Float high = here + num(1.0F);
    if (!volume.periodic[axis]) {
        low = hn::Max(low, zero());
        high = hn::Min(high, num(volume.samples[axis] - 1.0F));
    }
    const Float distance = high - low;
    const Float difference =
        texelAt(volume, movedTo(at, axis, high)) - texelAt(volume, movedTo(at, axis, low));
    return pick(distance > zero(), difference / distance, zero());
}

// The same, interpolated between its values at the two samples beside each point: what a gradient texture
// holds.
HWY_INLINE Float slopeBetweenSamples(const SampledVolume& volume, const Vec3& at, int axis) {
    const Float last = num(volume.samples[axis] - 1.0F);
    Float here = component(at, axis);
    if (!volume.periodic[axis]) here = hn::Min(hn::Max(here, zero()), last);
    const Float before = hn::Floor(here);
    const Float after = volume.periodic[axis] ? before + num(1.0F) : hn::Min(before + num(1.0F), last);
    return mix(slopeAt(volume, movedTo(at, axis, before), axis),
               slopeAt(volume, movedTo(at, axis, after), axis), here - before);
}

inline HWY_NOINLINE Vec3 outerGradient(const SampledVolume& volume, const Vec3& at, bool betweenSamples) {
    const auto slope = [&](int axis) {
        return betweenSamples ? slopeBetweenSamples(volume, at, axis) : slopeAt(volume, at, axis);
    };
    return {slope(0), slope(1), slope(2)};
}

// Where differences are taken: between the samples on axes that do not wrap, wrapped on others.
HWY_INLINE Float slopeAxis(const SampledVolume& volume, int axis, Float at) {
    const float n = volume.samples[axis];
    if (volume.periodic[axis]) return at - num(n) * hn::Floor(at * num(1.0F / n));
    return clampTo(at, 0.0F, (n - 1.0F) * (1.0F - 1e-7F)); // never the last sample as a lower corner
}

HWY_INLINE Place slopePlace(const SampledVolume& volume, const Vec3& at) {
    const Int x = truncated(at.x), y = truncated(at.y), z = truncated(at.z);
    const Int border = hn::Set(kI, 1 + volume.rowTexels + volume.sliceTexels);
    Place place;
    hn::Store(border + x + y * hn::Set(kI, volume.rowTexels) + z * hn::Set(kI, volume.sliceTexels), kI,
              place.offsets);
    place.x = at.x - hn::ConvertTo(kF, x);
    place.y = at.y - hn::ConvertTo(kF, y);
    place.z = at.z - hn::ConvertTo(kF, z);
    return place;
}

HWY_INLINE AxisEnds axisEnds(const SampledVolume& volume, int axis, Float at, bool betweenSamples) {
    const Float one = num(1.0F), two = num(2.0F);
    AxisEnds ends{one, one, one};
    if (volume.periodic[axis]) return ends;
    const Mask first = at < one;
    const Mask last = at >= num(volume.samples[axis] - 2.0F);
    if (betweenSamples) {
        ends.low = pick(first, two, one);
        ends.high = pick(last, two, one);
    } else {
        const Float weight = at - hn::Floor(at);
        ends.all = two / (pick(first, weight, one) + pick(last, one - weight, one));
    }
    return ends;
}

template <TexelFormat format>
HWY_INLINE Vec3 gradientIn(const SampledVolume& volume, const Vec3& at, Mask wanted, bool betweenSamples) {
    Mask ends = none(), wraps = none();
    const auto place = [&](int axis, Float position) HWY_ATTR {
        const Float inside = slopeAxis(volume, axis, position);
        const Mask last = inside >= num(volume.samples[axis] - (volume.periodic[axis] ? 1.0F : 2.0F));
        if (volume.periodic[axis])
            wraps = either(wraps, last);
        else
            ends = either(ends, either(last, inside < num(1.0F)));
        return inside;
    };
    Vec3 inside{place(0, at.x), place(1, at.y), place(2, at.z)};
    const bool thin = volume.samples[0] < 2.0F || volume.samples[1] < 2.0F || volume.samples[2] < 2.0F;
    if (thin || any(both(wanted, wraps))) return outerGradient(volume, at, betweenSamples);
    inside = pick(wraps, {zero(), zero(), zero()}, inside);
    if (!any(both(wanted, ends)))
        return gradientFrom32<format, false>(volume, slopePlace(volume, inside), nullptr);
    const AxisEnds axes[3] = {axisEnds(volume, 0, inside.x, betweenSamples),
                              axisEnds(volume, 1, inside.y, betweenSamples),
                              axisEnds(volume, 2, inside.z, betweenSamples)};
    return gradientFrom32<format, true>(volume, slopePlace(volume, inside), axes);
}

/// Differences per voxel, up to a common positive factor, of the lanes of the mask. Within a voxel of the
/// ends it matters whether they are taken at samples and interpolated between them, or about the points
/// themselves.
HWY_INLINE Vec3 gradientAt(const SampledVolume& volume, const Vec3& at, Mask wanted, bool betweenSamples) {
    switch (volume.format) {
    case TexelFormat::R8:
        return gradientIn<TexelFormat::R8>(volume, at, wanted, betweenSamples);
    case TexelFormat::R16:
        return gradientIn<TexelFormat::R16>(volume, at, wanted, betweenSamples);
    case TexelFormat::R16F:
        return gradientIn<TexelFormat::R16F>(volume, at, wanted, betweenSamples);
    case TexelFormat::R32F:
        break;
    }
    return gradientIn<TexelFormat::R32F>(volume, at, wanted, betweenSamples);
}

struct Entry {
    Vec3 rgb;
    Float a; ///< extinction
};

HWY_INLINE Entry entryAt(const float* entries, Int index) {
    HWY_ALIGN std::int32_t offsets[8];
    hn::Store(index, kI, offsets);
#if HWY_TARGET <= HWY_AVX2 && HWY_ARCH_X86
    const auto two = [&](int a, int b) {
        const __m128 low = _mm_loadu_ps(entries + 4 * static_cast<std::ptrdiff_t>(offsets[a]));
        const __m128 high = _mm_loadu_ps(entries + 4 * static_cast<std::ptrdiff_t>(offsets[b]));
        return _mm256_insertf128_ps(_mm256_castps128_ps256(low), high, 1);
    };
    const __m256 r0 = two(0, 4), r1 = two(1, 5), r2 = two(2, 6), r3 = two(3, 7);
    const __m256 t0 = _mm256_unpacklo_ps(r0, r1), t1 = _mm256_unpackhi_ps(r0, r1);
    const __m256 t2 = _mm256_unpacklo_ps(r2, r3), t3 = _mm256_unpackhi_ps(r2, r3);
    return {{Float{_mm256_shuffle_ps(t0, t2, 0x44)}, Float{_mm256_shuffle_ps(t0, t2, 0xEE)},
             Float{_mm256_shuffle_ps(t1, t3, 0x44)}},
            Float{_mm256_shuffle_ps(t1, t3, 0xEE)}};
#else
    const auto* base = reinterpret_cast<const std::byte*>(entries);
    const auto channel = [&](int i) { return hn::BitCast(kF, loadWords<4>(base + 4 * i, offsets)); };
    return {{channel(0), channel(1), channel(2)}, channel(3)};
#endif
}

HWY_INLINE Float scaledValue(int scale, Float value) {
    if (scale == 1) return hn::Log2(kF, hn::Max(value, num(1e-37F)));
    if (scale == 2) {
        const Float magnitude = hn::Abs(value);
        const Float beyond = hn::CopySign(num(1.0F) + hn::Log(kF, hn::Max(magnitude, num(1.0F))), value);
        return pick(magnitude <= num(1.0F), value, beyond);
    }
    return value;
}

/// Where texels stand in the table: its entry is the whole part.
HWY_INLINE Float tablePlace(const SampledTable& table, Float texel) {
    const Float known = pick(isNan(texel), zero(), texel);
    const Float mapped = scaledValue(
        table.scale, hn::MulAdd(known, num(table.mappedFromTexel[0]), num(table.mappedFromTexel[1])));
    return clampTo(hn::MulAdd(mapped, num(table.entryFromMapped[0]), num(table.entryFromMapped[1])), 0.0F,
                   table.lastEntry);
}

/// Places where the table may show something.
HWY_INLINE Mask mayShow(const SampledTable& table, Float place) {
    return both(place >= num(table.shownBegin), place < num(table.shownEnd));
}

/// Chromaticity and extinction of texels with these places; nothing where they are NaN.
HWY_INLINE Entry entryOf(const SampledTable& table, Float texel, Float place) {
    Entry result = entryAt(table.entries, truncated(place));
    result.a = hn::IfThenZeroElse(isNan(texel), result.a);
    return result;
}

HWY_INLINE Entry classify(const SampledTable& table, Float texel) {
    return entryOf(table, texel, tablePlace(table, texel));
}

// --- pre-integration: stages/preintegration.glsl ---

/// Position over the entries; beyond the ends, too. NaN stays.
HWY_INLINE Float entryPosition(const SampledTable& table, Float texel) {
    const Mask absent = isNan(texel);
    const Float mapped =
        scaledValue(table.scale, hn::MulAdd(pick(absent, zero(), texel), num(table.mappedFromTexel[0]),
                                            num(table.mappedFromTexel[1])));
    const float farBeyond = 65536.0F;
    const Float position =
        clampTo(hn::MulAdd(mapped, num(table.entryFromMapped[0]), num(table.entryFromMapped[1])), -farBeyond,
                farBeyond);
    return pick(absent, texel, position);
}

HWY_INLINE Entry integralAt(const SampledTable& table, Float position) {
    const Float first = hn::Floor(clampTo(position, 0.0F, table.lastEntry));
    const Int index = truncated(first);
    const Entry before = entryAt(table.integrals, index);
    const Entry after = entryAt(table.integrals + 4, index);
    const Float beyond = position - first;
    return {{mix(before.rgb.x, after.rgb.x, beyond), mix(before.rgb.y, after.rgb.y, beyond),
             mix(before.rgb.z, after.rgb.z, beyond)},
            mix(before.a, after.a, beyond)};
}

/// Mean of the table between two positions with integrals there.
HWY_INLINE Entry meanEntry(const SampledTable& table, Float begin, const Entry& upToBegin, Float end,
                           const Entry& upToEnd) {
    const Float width = end - begin;
    const Float sum = upToEnd.a - upToBegin.a;
    const Float extinction = hn::Max(sum / width, zero());
    const Mask seen = extinction > zero(); // not if NaN
    const Float inverse = num(1.0F) / sum;
    const auto channel = [&](Float to, Float from) HWY_ATTR {
        return hn::IfThenElseZero(seen, clampTo((to - from) * inverse, 0.0F, 1.0F));
    };
    Entry mean{{channel(upToEnd.rgb.x, upToBegin.rgb.x), channel(upToEnd.rgb.y, upToBegin.rgb.y),
                channel(upToEnd.rgb.z, upToBegin.rgb.z)},
               hn::IfThenElseZero(seen, extinction)};
    // Values that stay within two entries need no mean, and sums in 32 bits would not give it.
    const Mask narrow = hn::Abs(width) < num(2.0F);
    if (!any(narrow)) return mean;
    const Float middle = pick(narrow, num(0.5F) * (begin + end), zero());
    const Entry entry = entryAt(table.entries, truncated(clampTo(middle, 0.0F, table.lastEntry)));
    return {pick(narrow, entry.rgb, mean.rgb), pick(narrow, entry.a, mean.a)};
}

// The cell of a point of the texture frame.
HWY_INLINE Int cellAt(const SampledCells& cells, const Vec3& position) {
    const auto onAxis = [&](int axis, Float at) {
        if (cells.periodic[axis]) at = at - hn::Floor(at);
        const Float cell =
            clampTo(at * num(cells.cellsPerTexture[axis]), 0.0F, static_cast<float>(cells.cells[axis] - 1));
        return truncated(cell);
    };
    const Int x = onAxis(0, position.x);
    const Int y = onAxis(1, position.y);
    const Int z = onAxis(2, position.z);
    return x + (y + z * hn::Set(kI, cells.cells[1])) * hn::Set(kI, cells.cells[0]);
}

/// Marks of the cells at points, in the lowest byte.
HWY_INLINE Int marksAt(const SampledCells& cells, const Vec3& position) {
    HWY_ALIGN std::int32_t offsets[8];
    hn::Store(cellAt(cells, position), kI, offsets);
    return loadWords<0>(reinterpret_cast<const std::byte*>(cells.marks), offsets);
}

HWY_INLINE Float stretchesAhead(Int marks, Float stretchesPerCell) {
    const Float distance = hn::ConvertTo(kF, hn::And(marks, hn::Set(kI, 0xF)));
    const Float ahead = num(1.0F) + hn::Floor((distance - num(1.0F)) * stretchesPerCell);
    return pick(distance == zero(), zero(), ahead);
}

/// How many samples one stands for.
HWY_INLINE Float strideOf(Int marks) {
    const Int exponent = hn::And(hn::ShiftRight<4>(marks), hn::Set(kI, 0xF));
    return hn::BitCast(kF, hn::ShiftLeft<23>(exponent + hn::Set(kI, 127)));
}

/// From stretches with their middles there to the next that may show something, in stretches; 0: they may
/// themselves.
/// \param stretchesPerCell  width of a cell in stretches
HWY_INLINE Float stretchesAhead(const SampledCells& cells, const Vec3& middle, Float stretchesPerCell) {
    if (cells.marks == nullptr) return zero();
    return stretchesAhead(marksAt(cells, middle), stretchesPerCell);
}

HWY_INLINE Float stretchesAhead(const SampledCells& cells, const Vec3& middle, float stretchVoxels) {
    return stretchesAhead(cells, middle, num(cells.cellSamples / stretchVoxels));
}

/// Bound of the texels (of MIP) in the cell of a point.
HWY_INLINE Float largestInCell(const SampledCells& cells, const Vec3& position) {
    HWY_ALIGN std::int32_t offsets[8];
    hn::Store(cellAt(cells, position), kI, offsets);
    return hn::BitCast(kF, loadWords<2>(reinterpret_cast<const std::byte*>(cells.largest), offsets));
}

} // namespace voxsheet::simd::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
