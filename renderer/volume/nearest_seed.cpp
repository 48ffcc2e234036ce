#include "volume/nearest_seed.h"

#include "volume/parallel_for.h"

#include <array>

namespace voxsheet {

namespace {

struct GridLines {
    glm::ivec3 dims;

    [[nodiscard]] std::array<long, 3> coordinates(std::uint32_t sample) const {
        const long s = sample;
        return {s % dims.x, s / dims.x % dims.y, s / dims.x / dims.y};
    }
};

/// Lower envelope of the parabolas of one line; its buffers serve line after line.
class Line {
public:
    explicit Line(int length)
        : length_(length), heights_(static_cast<std::size_t>(length)), seeds_(heights_.size()),
          apexes_(heights_.size()), starts_(heights_.size() + 1) {}

    void set(int at, std::uint32_t seed, double height) {
        seeds_[static_cast<std::size_t>(at)] = seed;
        heights_[static_cast<std::size_t>(at)] = height;
    }

    /// Returns false if the line has no seed; then write must not be called.
    bool buildEnvelope() {
        count_ = 0;
        for (int q = 0; q < length_; ++q) {
            if (seeds_[static_cast<std::size_t>(q)] == kNoSeed) continue;
            double start = -std::numeric_limits<double>::infinity();
            for (; count_ > 0; --count_) {
                start = intersection(apexes_[count_ - 1], q);
                if (start > starts_[count_ - 1]) break;
                start = -std::numeric_limits<double>::infinity();
            }
            apexes_[count_] = q;
            starts_[count_] = start;
            ++count_;
        }
        return count_ > 0;
    }

    template <typename Write>
    void write(const Write& out) const {
        std::size_t parabola = 0;
        for (int p = 0; p < length_; ++p) {
            while (parabola + 1 < count_ && starts_[parabola + 1] < p)
                ++parabola;
            out(p, seeds_[static_cast<std::size_t>(apexes_[parabola])]);
        }
    }

private:
    [[nodiscard]] double intersection(int left, int right) const {
        const double l = left;
        const double r = right;
        return (heights_[static_cast<std::size_t>(right)] + r * r - heights_[static_cast<std::size_t>(left)] -
                l * l) /
               (2.0 * (r - l));
    }

    int length_;
    std::vector<double> heights_;
    std::vector<std::uint32_t> seeds_;
    std::vector<int> apexes_;
    std::vector<double> starts_; ///< of the stretch on which a parabola is the lowest
    std::size_t count_ = 0;
};

/// Axes below `axis` are done: each sample knows its nearest seed among those that differ only on them.
void sweep(const glm::ivec3& dims, int axis, std::vector<std::uint32_t>& seeds) {
    const GridLines grid{dims};
    const std::array<long, 3> strides{1, dims.x, static_cast<long>(dims.x) * dims.y};
    const long stride = strides[static_cast<std::size_t>(axis)];
    const int length = dims[axis];
    const long lines = static_cast<long>(seeds.size()) / length;
    parallelFor(lines, 256, [&](long begin, long end) {
        Line line(length);
        for (long l = begin; l < end; ++l) {
            const long first = l / stride * stride * length + l % stride;
            const auto here = grid.coordinates(static_cast<std::uint32_t>(first));
            for (int at = 0; at < length; ++at) {
                const auto seed = seeds[static_cast<std::size_t>(first + at * stride)];
                double height = 0.0;
                if (seed != kNoSeed) {
                    const auto there = grid.coordinates(seed);
                    for (std::size_t done = 0; done < static_cast<std::size_t>(axis); ++done) {
                        const auto offset = static_cast<double>(there[done] - here[done]);
                        height += offset * offset;
                    }
                }
                line.set(at, seed, height);
            }
            if (!line.buildEnvelope()) continue;
            line.write([&](int at, std::uint32_t seed) {
                seeds[static_cast<std::size_t>(first + at * stride)] = seed;
            });
        }
    });
}

} // namespace

void findNearestSeeds(const glm::ivec3& dims, std::vector<std::uint32_t>& seeds) {
    for (int axis = 0; axis < 3; ++axis)
        sweep(dims, axis, seeds);
}

} // namespace voxsheet
