// Which way a finished picture looks: letters of the patient's sides, or the world's axes.
#pragma once

#include "engine/canvas.h"

#include <glm/glm.hpp>

#include <string>

namespace voxsheet::engine {

/// Letters of the patient's sides (R L A P S I; the world is RAS+) that lie towards a direction of the
/// picture, the nearest first; a second one where the view is oblique. \param rightUp  unit, x to the right,
/// y up
[[nodiscard]] std::string edgeLetters(const glm::dmat3& viewFromWorld, const glm::dvec2& rightUp);

struct OrientationMarks {
    glm::dmat3 viewFromWorld{1.0};
    bool anatomical = false; ///< the world is a patient's, RAS+
    int fontPixels = 12;
    glm::vec4 text{1.0F};       ///< not premultiplied
    glm::vec4 background{0.0F}; ///< gives the letters an outline, to be legible on any picture
};

/// Patients' data: letters above, below, and below at the sides, where they leave the colour bar free. Other
/// data: a cross of the axes x, y, z below on the left. Nothing where there is no room.
void paintOrientation(Canvas& canvas, const OrientationMarks& marks, const PixelRect& area);

} // namespace voxsheet::engine
