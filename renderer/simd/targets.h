// Which instruction sets the kernels are compiled for: AVX2, SSE4 and the plain fallback. Packets are eight
// rays wide, so that wider sets would add nothing but build time.
#pragma once

#ifndef HWY_DISABLED_TARGETS
#define HWY_DISABLED_TARGETS (HWY_AVX3 | HWY_AVX3_DL | HWY_SSSE3)
#endif
