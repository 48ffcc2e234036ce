// From a cell's isosurface style to surfaces with values and colours.
#pragma once

#include "engine/default_look.h"
#include "sheet/typed_style.h"
#include "stages/isosurface_spec.h"
#include "volume/transfer_function.h"

#include <string>
#include <vector>

namespace voxsheet::engine {

/// The surfaces of isovalue in their order, each followed by its mirror image where
/// isosurface.mirror asks for it; a value that occurs again is left out. Colours go by surface, opacities by
/// value (a mirror image has its value's). Without values of its own: defaultIsovalues(). Without colours:
/// the transfer function's at the value, at the brightness that shading needs.
/// \param summary  as the cell's transfer function was made from: cells that share a range share isovalues
/// \param paleAtZero  the transfer function's colours are a diverging map's, neutral at the value 0: then
/// surfaces take theirs from further out on their side, so that the signs are told apart
/// Throws InvalidInput (field isovalue or isosurface.mirror) if there are more than kMaxIsosurfaces.
[[nodiscard]] std::vector<Isosurface> resolveSurfaces(const sheet::IsosurfaceStyle& style,
                                                      const TransferFunction& function,
                                                      const ValueSummary& summary, bool paleAtZero = false);

/// All but what they are coloured by.
[[nodiscard]] IsosurfaceSpec resolveIsosurface(const sheet::IsosurfaceStyle& style,
                                               const TransferFunction& function, const ValueSummary& summary,
                                               bool paleAtZero = false);

/// A sentence when every surface lies outside the values that the volume has, so that none can be drawn; else
/// empty. Also empty for a volume without a finite value.
/// \param own  of the cell's own volume, not of those that share a range with it
[[nodiscard]] std::string emptySurfacesNote(const std::vector<Isosurface>& surfaces, const ValueSummary& own);

} // namespace voxsheet::engine
