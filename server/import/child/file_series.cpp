#include "import/child/file_series.h"

#include "base/errors.h"

#include <algorithm>
#include <cstring>

namespace voxsheet::import {

namespace {

bool isSlice(const SeriesPart& part) {
    return part.header.meta.grid.dims.z == 1 && part.header.meta.stepCount() == 1;
}

bool isStack(const std::vector<SeriesPart>& parts, std::optional<SeriesKind> kind) {
    return kind ? *kind == SeriesKind::Stack : std::all_of(parts.begin(), parts.end(), isSlice);
}

std::string fileOf(const SeriesPart& part) { return part.header.files.front().string(); }

std::string sizeText(const DatasetMeta& meta) {
    const auto& dims = meta.grid.dims;
    return std::to_string(dims.x) + " x " + std::to_string(dims.y) + " x " + std::to_string(dims.z) +
           " samples of " + scalarName(meta.sourceType);
}

[[noreturn]] void refuse(const SeriesPart& part, const std::string& why) {
    throw InvalidInput(fileOf(part), why, "leave it out of the series, or open it on its own");
}

bool nearlyEqual(const glm::dmat4& a, const glm::dmat4& b) {
    double largest = 0.0;
    double difference = 0.0;
    for (glm::length_t column = 0; column < 4; ++column)
        for (glm::length_t row = 0; row < 3; ++row) {
            largest = std::max(largest, std::abs(a[column][row]));
            difference = std::max(difference, std::abs(a[column][row] - b[column][row]));
        }
    return difference <= 1e-5 * largest; // as exact as headers with floats are
}

void requireEqual(const SeriesPart& first, const SeriesPart& part, bool slices) {
    const auto& a = first.header.meta;
    const auto& b = part.header.meta;
    if (a.grid.dims != b.grid.dims || a.sourceType != b.sourceType)
        refuse(part, "it has " + sizeText(b) + ", and the first file of the series has " + sizeText(a));
    if (a.fields.size() != b.fields.size())
        refuse(part, "it has " + std::to_string(b.fields.size()) +
                         " fields, and the first file of the series has " + std::to_string(a.fields.size()));
    for (std::size_t i = 0; i < a.fields.size(); ++i) {
        const auto& x = a.fields[i];
        const auto& y = b.fields[i];
        if (x.name != y.name || x.storedType != y.storedType)
            refuse(part,
                   "its field '" + y.name + "' is not the '" + x.name + "' of the first file of the series");
        if (x.valueScale != y.valueScale || x.valueOffset != y.valueOffset)
            refuse(part, "its values are scaled in another way than those of the first file of the series");
    }
    if (!slices && !nearlyEqual(a.grid.worldFromIndex, b.grid.worldFromIndex))
        refuse(part, "it lies in another place, or has another spacing, than the first file of the series");
}

glm::dvec3 originOf(const SeriesPart& part) { return part.header.meta.grid.worldFromIndex[3]; }

void stackSlices(const std::vector<SeriesPart>& parts, DatasetMeta& meta) {
    const auto count = parts.size();
    const int thickness = meta.grid.dims.z;
    const auto slices = static_cast<std::int64_t>(count) * thickness;
    if (slices > INT32_MAX) throw LimitExceeded(fileOf(parts.front()), "the stack has too many slices");
    for (const auto& part : parts)
        if (part.header.meta.stepCount() != 1)
            refuse(part, "it has several time steps, so it is no slice of a stack");
    meta.grid.dims.z = static_cast<int>(slices);
    if (count == 1) return;
    const auto first = originOf(parts.front());
    const auto step = (originOf(parts.back()) - first) / static_cast<double>(count - 1);
    const double length = glm::length(step);
    double farthest = 0.0;
    for (const auto& part : parts)
        farthest = std::max(farthest, glm::length(originOf(part) - first));
    if (farthest == 0.0) {
        meta.notes.emplace_back(
            "The files do not say where their slices lie: they follow on each other, in the order "
            "of the files, at the distance of the first one's.");
        return;
    }
    for (std::size_t i = 0; i < count; ++i)
        if (glm::length(originOf(parts[i]) - first - static_cast<double>(i) * step) > 1e-2 * length)
            refuse(parts[i], "its slice is not as far from the one before as the others of the series are");
    const auto along = step / static_cast<double>(thickness);
    const glm::dvec3 own = meta.grid.worldFromIndex[2];
    if (thickness > 1 && glm::length(own - along) > 1e-2 * glm::length(own))
        refuse(parts[1], "its slab does not begin where the one before ends");
    meta.grid.worldFromIndex[2] = glm::dvec4(along, 0.0);
}

void appendSteps(const std::vector<SeriesPart>& parts, DatasetMeta& meta) {
    std::vector<double> times;
    for (const auto& part : parts)
        times.insert(times.end(), part.header.meta.times.begin(), part.header.meta.times.end());
    const bool rising = std::adjacent_find(times.begin(), times.end(),
                                           [](double a, double b) { return !(a < b); }) == times.end();
    if (!rising)
        for (std::size_t step = 0; step < times.size(); ++step)
            times[step] = static_cast<double>(step);
    meta.times = std::move(times);
    if (meta.crystal) meta.notes.emplace_back("The atoms are those of the first file of the series.");
}

/// The slices of one field, until all have come.
class SliceStack {
public:
    SliceStack(const SourceHeader& header) : volumes_(header.meta.fields.size()) {
        for (std::size_t field = 0; field < volumes_.size(); ++field)
            volumes_[field].resize(header.arrayBytes(static_cast<int>(field)));
    }

    void put(std::size_t slice, int field, const std::vector<std::byte>& voxels) {
        auto& volume = volumes_.at(static_cast<std::size_t>(field));
        if (voxels.size() > volume.size() || slice * voxels.size() > volume.size() - voxels.size())
            throw InternalError("file series", "a slice is larger than its header said");
        std::memcpy(volume.data() + slice * voxels.size(), voxels.data(), voxels.size());
    }
    void handOver(const ArraySink& sink) {
        for (std::size_t field = 0; field < volumes_.size(); ++field)
            sink(static_cast<int>(field), 0, std::move(volumes_[field]));
    }

private:
    std::vector<std::vector<std::byte>> volumes_;
};

} // namespace

SourceHeader combinedHeader(const std::vector<SeriesPart>& parts, const ImportLimits& limits,
                            std::optional<SeriesKind> kind) {
    if (parts.empty()) throw InternalError("file series", "it is empty");
    const bool slices = isStack(parts, kind);
    SourceHeader header;
    header.meta = parts.front().header.meta;
    for (const auto& part : parts) {
        requireEqual(parts.front(), part, slices);
        header.files.insert(header.files.end(), part.header.files.begin(), part.header.files.end());
    }
    header.meta.notes.push_back(
        std::to_string(parts.size()) +
        (slices ? " files are the slices of this volume." : " files are the steps of this series."));
    if (slices)
        stackSlices(parts, header.meta);
    else
        appendSteps(parts, header.meta);
    validateGrid(header.meta.grid);
    if (header.totalBytes() > limits.maxBytes)
        throw LimitExceeded(fileOf(parts.front()),
                            "the series that begins with it needs " + std::to_string(header.totalBytes()) +
                                " bytes, more than the limit of " + std::to_string(limits.maxBytes));
    return header;
}

std::vector<std::string> readSeries(const std::vector<SeriesPart>& parts, const SourceHeader& header,
                                    const ArraySink& sink, const ReadProgress& progress,
                                    std::optional<SeriesKind> kind) {
    const bool slices = isStack(parts, kind);
    SliceStack stack(slices ? header : SourceHeader{});
    int firstStep = 0;
    std::vector<std::string> notes;
    for (std::size_t i = 0; i < parts.size(); ++i) {
        const auto collect = [&](int field, int step, std::vector<std::byte>&& voxels) {
            if (slices)
                stack.put(i, field, voxels);
            else
                sink(field, firstStep + step, std::move(voxels));
        };
        const auto partProgress = [&](double fraction) {
            if (progress) progress((static_cast<double>(i) + fraction) / static_cast<double>(parts.size()));
        };
        for (auto& note : parts[i].reader->readData(parts[i].header, collect, partProgress))
            if (std::find(notes.begin(), notes.end(), note) == notes.end()) notes.push_back(std::move(note));
        firstStep += parts[i].header.meta.stepCount();
    }
    if (slices) stack.handOver(sink);
    return notes;
}

} // namespace voxsheet::import
