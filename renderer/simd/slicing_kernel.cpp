#include "simd/targets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "simd/slicing_kernel.cpp"
#include <hwy/foreach_target.h>

#include "simd/caster-inl.h"
#include "simd/kernels.h"

HWY_BEFORE_NAMESPACE();
namespace voxsheet::simd::HWY_NAMESPACE {

void slicingRowsHere(const PictureJob& job, int firstRow, int endRow) {
    castRowsOf<Stretches::Slabs>(job, firstRow, endRow);
}

} // namespace voxsheet::simd::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace voxsheet::simd {

HWY_EXPORT(slicingRowsHere);

void slicingRows(const PictureJob& job, int firstRow, int endRow) {
    HWY_DYNAMIC_DISPATCH(slicingRowsHere)(job, firstRow, endRow);
}

} // namespace voxsheet::simd
#endif
