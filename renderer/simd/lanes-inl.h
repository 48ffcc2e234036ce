// Vectors of one packet of rays, for the instruction set that this file is compiled for (foreach_target of
// Highway).
#if defined(VOXSHEET_SIMD_LANES_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef VOXSHEET_SIMD_LANES_INL_H
#undef VOXSHEET_SIMD_LANES_INL_H
#else
#define VOXSHEET_SIMD_LANES_INL_H
#endif

#include <hwy/contrib/math/math-inl.h>
#include <hwy/highway.h>

#include <cstddef>
#include <cstdint>

#if HWY_TARGET <= HWY_AVX2 && HWY_ARCH_X86
#include <immintrin.h>
#endif

HWY_BEFORE_NAMESPACE();
namespace voxsheet::simd::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using FloatTag = hn::CappedTag<float, 8>; // packets of 4x2 pixels: wider ones diverge more than they gain
using IntTag = hn::Rebind<std::int32_t, FloatTag>;
using Float = hn::Vec<FloatTag>;
using Int = hn::Vec<IntTag>;
using Mask = hn::Mask<FloatTag>;

constexpr FloatTag kF{};
constexpr IntTag kI{};

HWY_INLINE Float num(float value) { return hn::Set(kF, value); }
HWY_INLINE Float zero() { return hn::Zero(kF); }
HWY_INLINE Float pick(Mask mask, Float yes, Float no) { return hn::IfThenElse(mask, yes, no); }
HWY_INLINE void assign(Mask mask, Float& to, Float value) { to = hn::IfThenElse(mask, value, to); }
HWY_INLINE bool any(Mask mask) { return !hn::AllFalse(kF, mask); }
HWY_INLINE bool all(Mask mask) { return hn::AllTrue(kF, mask); }
HWY_INLINE Mask both(Mask a, Mask b) { return hn::And(a, b); }
HWY_INLINE Mask either(Mask a, Mask b) { return hn::Or(a, b); }
HWY_INLINE Mask butNot(Mask a, Mask b) { return hn::AndNot(b, a); } // a and not b
HWY_INLINE Mask none() { return hn::FirstN(kF, 0); }
HWY_INLINE Mask whole(bool value) { return value ? hn::Not(none()) : none(); }
HWY_INLINE Mask isNan(Float value) { return hn::IsNaN(value); }
HWY_INLINE Float mix(Float a, Float b, Float weight) { return hn::MulAdd(weight, b - a, a); }
HWY_INLINE Float clampTo(Float value, float low, float high) {
    return hn::Min(hn::Max(value, num(low)), num(high));
}

// Towards zero, of floats within the range of an int: Highway's ConvertTo also bounds others, at the cost of
// five instructions.
HWY_INLINE Int truncated(Float value) {
#if HWY_TARGET <= HWY_AVX2 && HWY_ARCH_X86
    return Int{_mm256_cvttps_epi32(value.raw)};
#else
    return hn::ConvertTo(kI, value);
#endif
}

/// 2^x of x <= 0, to 3e-7; below 2^-126 it stays there.
HWY_INLINE Float exp2OfNegative(Float x) {
    x = hn::Max(x, num(-126.0F));
    const Float whole = hn::Round(x);
    const Float f = x - whole;
    // Taylor's series of 2^f, |f| <= 1/2.
    Float p = num(1.5403530e-4F);
    p = hn::MulAdd(p, f, num(1.3333558e-3F));
    p = hn::MulAdd(p, f, num(9.6181291e-3F));
    p = hn::MulAdd(p, f, num(5.5504109e-2F));
    p = hn::MulAdd(p, f, num(2.4022651e-1F));
    p = hn::MulAdd(p, f, num(6.9314718e-1F));
    p = hn::MulAdd(p, f, num(1.0F));
    return p * hn::BitCast(kF, hn::ShiftLeft<23>(truncated(whole) + hn::Set(kI, 127)));
}

// A 32-bit word per lane, from base + (offset << shift). Loads and inserts beat the gather instructions of
// the processor that this was measured on (Zen 5: 2.7 against 3.6 ns per trilinear sample).
template <int shift>
HWY_INLINE Int loadWords(const std::byte* base, const std::int32_t* offsets) {
#if HWY_TARGET <= HWY_AVX2 && HWY_ARCH_X86
    const auto word = [&](int lane) {
        std::int32_t value;
        __builtin_memcpy(&value, base + (static_cast<std::ptrdiff_t>(offsets[lane]) << shift), sizeof value);
        return value;
    };
    __m128i low = _mm_cvtsi32_si128(word(0));
    low = _mm_insert_epi32(low, word(1), 1);
    low = _mm_insert_epi32(low, word(2), 2);
    low = _mm_insert_epi32(low, word(3), 3);
    __m128i high = _mm_cvtsi32_si128(word(4));
    high = _mm_insert_epi32(high, word(5), 1);
    high = _mm_insert_epi32(high, word(6), 2);
    high = _mm_insert_epi32(high, word(7), 3);
    return Int{_mm256_inserti128_si256(_mm256_castsi128_si256(low), high, 1)};
#else
    HWY_ALIGN std::int32_t words[hn::MaxLanes(kI)];
    for (std::size_t lane = 0; lane < hn::Lanes(kI); ++lane)
        __builtin_memcpy(words + lane, base + (static_cast<std::ptrdiff_t>(offsets[lane]) << shift),
                         sizeof(std::int32_t));
    return hn::Load(kI, words);
#endif
}

struct Vec3 {
    Float x, y, z;
};

HWY_INLINE Vec3 operator+(const Vec3& a, const Vec3& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
HWY_INLINE Vec3 operator*(Float scale, const Vec3& v) { return {scale * v.x, scale * v.y, scale * v.z}; }
HWY_INLINE Float dot(const Vec3& a, const Vec3& b) {
    return hn::MulAdd(a.x, b.x, hn::MulAdd(a.y, b.y, a.z * b.z));
}
HWY_INLINE Vec3 spread(const float* v) { return {num(v[0]), num(v[1]), num(v[2])}; }
HWY_INLINE Vec3 along(const Vec3& origin, Float depth, const Vec3& direction) {
    return {hn::MulAdd(depth, direction.x, origin.x), hn::MulAdd(depth, direction.y, origin.y),
            hn::MulAdd(depth, direction.z, origin.z)};
}
HWY_INLINE Vec3 pick(Mask mask, const Vec3& yes, const Vec3& no) {
    return {pick(mask, yes.x, no.x), pick(mask, yes.y, no.y), pick(mask, yes.z, no.z)};
}
/// Columns of a 3x3 matrix.
HWY_INLINE Vec3 times(const float* matrix, const Vec3& v) {
    const auto row = [&](int i) {
        return hn::MulAdd(num(matrix[i]), v.x, hn::MulAdd(num(matrix[3 + i]), v.y, num(matrix[6 + i]) * v.z));
    };
    return {row(0), row(1), row(2)};
}
/// Columns of a 3x4 matrix: axes and origin.
HWY_INLINE Vec3 placed(const float* matrix, const Vec3& v) { return times(matrix, v) + spread(matrix + 9); }

} // namespace voxsheet::simd::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
