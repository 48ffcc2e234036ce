#include "bench/time_n/bench_datasets.h"

#include "base/byte_size.h"
#include "base/errors.h"
#include "fields/scenes.h"
#include "store/entry_layout.h"
#include "store/store_writer.h"
#include "volume/parallel_for.h"

#include <array>
#include <cmath>
#include <linux/magic.h>
#include <numbers>
#include <sys/vfs.h>

namespace voxsheet::bench {

namespace {

constexpr double kCells = 2.0;
constexpr double kPhaseAmplitude = 0.35; ///< radians

/// 42 (1 + cos) per axis: the sum of three fits a byte.
std::vector<unsigned char> axisWave(int dim, double phase) {
    std::vector<unsigned char> wave(static_cast<std::size_t>(dim));
    for (int i = 0; i < dim; ++i) {
        const double turn = 2.0 * std::numbers::pi * kCells * (i + 0.5) / dim;
        wave[static_cast<std::size_t>(i)] =
            static_cast<unsigned char>(std::lround(42.0 * (1.0 + std::cos(turn + phase))));
    }
    return wave;
}

/// In [-1, 1], another for each dataset and axis.
double spread(int index, int axis) {
    static constexpr std::array<double, 3> steps{0.7548776662466927, 0.5698402909980532, 0.8191725133961645};
    const double turn = 0.5 + (index + 1) * steps[static_cast<std::size_t>(axis)];
    return 2.0 * (turn - std::floor(turn)) - 1.0;
}

std::vector<std::byte> samplesOf(int index, int dim) {
    std::array<std::vector<unsigned char>, 3> waves;
    for (int axis = 0; axis < 3; ++axis)
        waves[static_cast<std::size_t>(axis)] = axisWave(dim, kPhaseAmplitude * spread(index, axis));
    const auto n = static_cast<std::size_t>(dim);
    std::vector<std::byte> samples(n * n * n);
    // The dataset's number in its first samples: no two files are equal, whatever rounding does.
    parallelFor(dim, 8, [&](long begin, long end) {
        for (auto z = static_cast<std::size_t>(begin); z < static_cast<std::size_t>(end); ++z)
            for (std::size_t y = 0; y < n; ++y) {
                const int plane = waves[1][y] + waves[2][z];
                auto* row = samples.data() + (z * n + y) * n;
                for (std::size_t x = 0; x < n; ++x)
                    row[x] = static_cast<std::byte>(plane + waves[0][x]);
            }
    });
    for (std::size_t digit = 0; digit < 2; ++digit)
        samples[digit] = static_cast<std::byte>((index >> (8 * digit)) & 0xFF);
    return samples;
}

DatasetMeta metaOf(const std::string& key, const Grid& grid) {
    DatasetMeta meta;
    meta.key = key;
    meta.sourcePath = key;
    meta.format = "bench";
    meta.grid = grid;
    meta.sourceType = ScalarType::U8;
    FieldMeta field;
    field.name = "lattice";
    field.storedType = ScalarType::U8;
    field.valueScale = 1.0 / 252.0;
    meta.fields.push_back(field);
    return meta;
}

} // namespace

BenchDatasets::BenchDatasets(int count, int dim, const std::function<void(int)>& wrote)
    : grid_(fields::gridOf(fields::Geometry::Isotropic, dim)) {
    const auto needed = static_cast<std::uint64_t>(count) * store::entryBytes(metaOf("bench", grid_));
    const auto available = std::filesystem::space(folder_.path()).available;
    if (available < needed)
        throw IoError(folder_.path().string(),
                      std::to_string(count) + " datasets need " + byteText(needed) + ", and " +
                          byteText(available) + " are free",
                      "set TMPDIR to a folder on a larger disk, or ask for a smaller --dim or --max-n");
    store_ = std::make_shared<const store::VolumeStore>(folder_.path() / "store");
    for (int index = 0; index < count; ++index) {
        keys_.push_back("bench_" + std::to_string(index));
        store::StoreWriter writer(*store_, metaOf(keys_.back(), grid_));
        writer.addArray(0, 0, samplesOf(index, dim));
        writer.commit();
        wrote(index + 1);
    }
}

bool BenchDatasets::onDisk() const {
    struct statfs system {};
    return statfs(folder_.path().c_str(), &system) != 0 || system.f_type != TMPFS_MAGIC;
}

} // namespace voxsheet::bench
