// One phantom for every format: 2 x 3 x 4 samples, all different, steps of 0.5, 2 and 3 along axes turned by
// 3-4-5 about z and, after that, about x. The same voxels at the same places, whatever the format.
#pragma once

#include "vtk_fixture.h"

#include <sstream>

namespace voxsheet::import::testing {

inline const glm::dvec3 kSteps{0.5, 2.0, 3.0};
inline const glm::dmat3 kAboutZ{0.6, 0.8, 0, -0.8, 0.6, 0, 0, 0, 1}; // columns
inline const glm::dmat3 kAboutX{1, 0, 0, 0, 0.8, 0.6, 0, -0.6, 0.8};
inline const glm::dmat3 kDirection = kAboutX * kAboutZ;
inline const glm::dvec3 kOrigin{-11.0, 7.0, 40.0};
inline const glm::dvec3 kToLps{-1, -1, 1};
inline const glm::ivec3 kDims{2, 3, 4};

inline std::string text(double number) {
    std::ostringstream out;
    out.precision(17);
    out << number;
    return out.str();
}

inline std::string text(const glm::dvec3& v, const std::string& between = " ") {
    return text(v.x) + between + text(v.y) + between + text(v.z);
}

/// Where a file puts the phantom; formats differ in what they can hold.
struct PhantomPlace {
    glm::dmat3 direction = kDirection;
    glm::dvec3 origin = kOrigin;
    bool anatomical = false;
    glm::bvec3 periodic{false};
};

class WorldPhantom : public FormatsTest {
protected:
    /// \param tolerance  of what the header's numbers can hold, in world units
    template <typename T>
    void expectPhantom(const fs::path& file, const std::vector<T>& samples, const PhantomPlace& expected,
                       double tolerance = 1e-12, const ImportOptions& options = {}) const {
        const auto loaded = loadAny(file, options);
        const auto& meta = loaded.meta();
        EXPECT_EQ(meta.grid.dims, kDims) << file;
        EXPECT_EQ(loaded.values<T>(), samples) << file;
        EXPECT_EQ(meta.anatomical, expected.anatomical) << file;
        EXPECT_EQ(meta.grid.periodic, expected.periodic) << file;
        for (const glm::dvec3 index : {glm::dvec3(0, 0, 0), glm::dvec3(1, 0, 0), glm::dvec3(0, 2, 0),
                                       glm::dvec3(0, 0, 3), glm::dvec3(1, 2, 3)}) {
            const glm::dvec3 place(meta.grid.worldFromIndex * glm::dvec4(index, 1.0));
            const glm::dvec3 wanted = expected.origin + expected.direction * (kSteps * index);
            EXPECT_LT(glm::distance(place, wanted), tolerance)
                << file << " at " << text(index) << ": " << text(place) << ", not " << text(wanted);
        }
    }
    /// In RAS.
    void expectPhantom(const fs::path& file, double tolerance = 1e-12) const {
        expectPhantom(file, samples_, {kDirection, kOrigin, true, glm::bvec3(false)}, tolerance);
    }

    std::vector<short> samples_ = ramp<short>(24);
};

} // namespace voxsheet::import::testing
