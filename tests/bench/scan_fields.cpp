#include "bench/scan_fields.h"

#include "base/errors.h"
#include "import/formats/own_readers.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>

namespace voxsheet::bench {

namespace {

namespace fs = std::filesystem;

struct Scan {
    const char* name;
    const char* file;
    std::uint64_t bitMask; ///< 0: all bits are values
};

/// FullHead marks voxels in bit 15.
constexpr Scan kScans[] = {{"FullHead", "vol_FullHead/FullHead.mhd", 0x7fff},
                           {"frog", "vol_frog/frog.mhd", 0},
                           {"headsq quarter", "vol_headsq_quarter/quarter.nhdr", 0},
                           {"neghip", "vol_neghip/neghip.slc", 0}};

struct Read {
    DatasetMeta meta;
    std::vector<double> values; ///< of the first field and step
};

std::vector<double> valuesOf(const FieldMeta& field, const std::vector<std::byte>& bytes) {
    std::vector<double> values(bytes.size() / scalarBytes(field.storedType));
    visitScalar(field.storedType, [&]<typename T>() {
        for (std::size_t i = 0; i < values.size(); ++i) {
            T stored;
            std::memcpy(&stored, bytes.data() + i * sizeof(T), sizeof(T));
            values[i] = field.valueScale * static_cast<double>(stored) + field.valueOffset;
        }
    });
    return values;
}

Read readScan(const fs::path& path, std::uint64_t bitMask) {
    import::ImportOptions options;
    if (bitMask != 0) options.bitMask = bitMask;
    const auto head = import::readFileHead(path);
    for (const auto& reader : import::makeOwnReaders()) {
        if (!reader->recognises(head, options)) continue;
        auto header = reader->readHeader(path, options, {});
        std::vector<std::byte> first;
        const auto sink = import::applyOptions(
            header, options, [&first](int field, int step, std::vector<std::byte>&& voxels) {
                if (field == 0 && step == 0) first = std::move(voxels);
            });
        (void)reader->readData(header, sink, [](double) {});
        return {header.meta, valuesOf(header.meta.fields.at(0), first)};
    }
    throw Unsupported(path.string(), "no reader of the benches knows it");
}

double percentile(std::vector<double> values, double share) {
    const auto nth =
        values.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
    std::nth_element(values.begin(), nth, values.end());
    return *nth;
}

/// Values from the smallest on as whole numbers of 8 bits if they fit, else of 16.
fields::SampledField sampledOf(const Read& read, const std::string& key) {
    const auto [low, high] = std::minmax_element(read.values.begin(), read.values.end());
    const double offset = *low;
    if (*high - offset > std::numeric_limits<std::uint16_t>::max() ||
        std::any_of(read.values.begin(), read.values.end(), [](double v) { return v != std::round(v); }))
        throw Unsupported(read.meta.sourcePath, "its values are no whole numbers of 16 bits");
    const auto type =
        *high - offset <= std::numeric_limits<std::uint8_t>::max() ? ScalarType::U8 : ScalarType::U16;
    fields::SampledField sampled;
    sampled.meta.key = key;
    sampled.meta.format = "scan";
    sampled.meta.sourceType = type;
    sampled.meta.grid.dims = read.meta.grid.dims;
    const auto spacing = spacingWorld(read.meta.grid);
    for (int axis = 0; axis < 3; ++axis)
        sampled.meta.grid.worldFromIndex[axis][axis] = spacing[axis];
    FieldMeta field;
    field.name = key;
    field.storedType = type;
    field.valueOffset = offset;
    sampled.meta.fields.push_back(field);
    std::vector<std::byte> bytes(read.values.size() * scalarBytes(type));
    visitScalar(type, [&]<typename T>() {
        for (std::size_t i = 0; i < read.values.size(); ++i) {
            const auto stored = static_cast<T>(read.values[i] - offset);
            std::memcpy(bytes.data() + i * sizeof(T), &stored, sizeof(T));
        }
    });
    sampled.arrays.push_back(std::move(bytes));
    return sampled;
}

} // namespace

std::vector<ScanField> readScans(const fs::path& folder,
                                 const std::function<void(const std::string&)>& missing) {
    std::vector<ScanField> scans;
    for (const auto& scan : kScans) {
        const auto path = folder / scan.file;
        if (!fs::exists(path)) {
            missing(path.string());
            continue;
        }
        const auto read = readScan(path, scan.bitMask);
        scans.push_back({scan.name, sampledOf(read, scan.name), percentile(read.values, 0.5),
                         percentile(read.values, 0.998)});
    }
    if (scans.empty())
        throw NotFound("--scans " + folder.string(), "it has none of the scans",
                       "name the folder of the test data");
    return scans;
}

} // namespace voxsheet::bench
