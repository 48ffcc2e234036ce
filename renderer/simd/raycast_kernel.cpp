#include "simd/targets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "simd/raycast_kernel.cpp"
#include <hwy/foreach_target.h>

#include "simd/caster-inl.h"
#include "simd/kernels.h"

HWY_BEFORE_NAMESPACE();
namespace voxsheet::simd::HWY_NAMESPACE {

void raycastRowsHere(const PictureJob& job, int firstRow, int endRow) {
    if (job.table.integrals != nullptr) return castRowsOf<Stretches::PreIntegrated>(job, firstRow, endRow);
    castRowsOf<Stretches::Sampled>(job, firstRow, endRow);
}

const char* instructionSetHere() { return hwy::TargetName(HWY_TARGET); }

} // namespace voxsheet::simd::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace voxsheet::simd {

HWY_EXPORT(raycastRowsHere);
HWY_EXPORT(instructionSetHere);

void raycastRows(const PictureJob& job, int firstRow, int endRow) {
    HWY_DYNAMIC_DISPATCH(raycastRowsHere)(job, firstRow, endRow);
}

const char* instructionSet() { return HWY_DYNAMIC_DISPATCH(instructionSetHere)(); }

} // namespace voxsheet::simd
#endif
