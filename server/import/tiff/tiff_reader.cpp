#include "import/tiff/tiff_reader.h"

#include "base/errors.h"
#include "import/formats/byte_stream.h"
#include "import/formats/field_names.h"
#include "import/formats/geometry.h"
#include "import/formats/voxel_plan.h"
#include "import/tiff/stack_description.h"
#include "import/tiff/tiff_file.h"

#include <algorithm>
#include <array>
#include <sstream>

namespace voxsheet::import {

namespace {

constexpr std::size_t kMostPages = 65'535; // libtiff looks for loops with a search that grows with each page

struct TiffPlan {
    std::vector<std::uint64_t> pageOffsets; ///< of the pages that are slices
    std::uint64_t storedBytes = 0;          ///< of all of them, decompressed
    PageFormat format;
    bool paletteAsRgb = false;
    int channels = 1; ///< of whole pages
    int slices = 1;
    int frames = 1;
    std::string pageOrder;

    [[nodiscard]] int planesPerPage() const { return paletteAsRgb ? 3 : format.samples; }
    [[nodiscard]] std::size_t pageOf(int channel, int slice, int frame) const {
        std::size_t page = 0;
        for (auto axis = pageOrder.rbegin(); axis != pageOrder.rend(); ++axis) {
            const auto [index, count] = *axis == 'C'   ? std::pair(channel, channels)
                                        : *axis == 'Z' ? std::pair(slice, slices)
                                                       : std::pair(frame, frames);
            page = page * static_cast<std::size_t>(count) + static_cast<std::size_t>(index);
        }
        return page;
    }
};

/// Goes over all pages once. Returns the tags of the first slice.
PageTags collectPages(const InputFile& file, TiffFile& tiff, TiffPlan& plan,
                      std::vector<std::string>& notes) {
    PageTags first;
    std::uint64_t bytesPerFileByte = 1;
    std::size_t leftOut = 0;
    int number = 0;
    do {
        ++number;
        if (static_cast<std::size_t>(number) > kMostPages)
            throw LimitExceeded(file.name(), "it has more than " + std::to_string(kMostPages) + " pages",
                                "split it");
        const auto tags = tiff.tags();
        if (tags.reducedOrMask) {
            ++leftOut;
            continue;
        }
        const auto format = tiff.format(number);
        if (plan.pageOffsets.empty()) {
            plan.format = format;
            first = tags;
        } else if (format != plan.format) {
            throw InvalidInput(file.name(),
                               "page " + std::to_string(number) + " is " + format.text() +
                                   (format.text() == plan.format.text() ? " of other colours" : "") +
                                   ", the pages before it are " + plan.format.text(),
                               "the pages of a volume must be equal: split the file");
        }
        bytesPerFileByte = tags.mostBytesPerFileByte == 0 || bytesPerFileByte == 0
                               ? 0
                               : std::max(bytesPerFileByte, tags.mostBytesPerFileByte);
        plan.pageOffsets.push_back(tiff.pageOffset());
    } while (tiff.nextPage());
    if (plan.pageOffsets.empty()) throw Unsupported(file.name(), "all of its pages are thumbnails or masks");
    if (leftOut != 0)
        notes.push_back("Pages that are thumbnails or masks were left out: " + std::to_string(leftOut) + ".");
    first.mostBytesPerFileByte = bytesPerFileByte;
    return first;
}

void checkBytes(const InputFile& file, TiffPlan& plan, std::uint64_t bytesPerFileByte,
                const ImportLimits& limits) {
    const auto pages = static_cast<std::int64_t>(plan.pageOffsets.size());
    (void)checkedBytes(file.name(), {plan.format.width, plan.format.height, pages, plan.planesPerPage()},
                       scalarBytes(plan.format.type()), limits);
    const auto row = rowBytes(plan.format.sample,
                              std::size_t{plan.format.width} * static_cast<std::size_t>(plan.format.samples));
    const auto stored =
        checkedBytes(file.name(), {static_cast<std::int64_t>(row), plan.format.height, pages}, 1, limits);
    plan.storedBytes = stored;
    if (bytesPerFileByte == 0 || stored / bytesPerFileByte <= file.bytes()) return;
    throw InvalidInput(file.name(),
                       "its pages need " + std::to_string(stored) +
                           " bytes, which cannot come from a file of " + std::to_string(file.bytes()) +
                           " bytes",
                       "copy or write the file again");
}

/// Channels, slices and frames, from the description and the number of pages.
void arrangePages(const InputFile& file, const StackDescription& stack, TiffPlan& plan) {
    const auto pages = static_cast<std::int64_t>(plan.pageOffsets.size());
    const bool isOme = stack.writer == StackDescription::Writer::Ome;
    auto channels = stack.channels.value_or(1);
    // OME counts the samples of a pixel as channels.
    if (isOme && plan.format.samples > 1 && channels % plan.format.samples == 0)
        channels /= plan.format.samples;
    const auto frames = stack.frames.value_or(1);
    const auto fits = [&](std::int64_t a, std::int64_t b) {
        return a <= pages && b <= pages / a && pages % (a * b) == 0;
    };
    const auto slices = stack.slices.value_or(fits(channels, frames) ? pages / (channels * frames) : 1);
    const bool complete = fits(channels, frames) && slices == pages / (channels * frames);
    if (complete && stack.images.value_or(pages) == pages) {
        plan.channels = static_cast<int>(channels);
        plan.slices = static_cast<int>(slices);
        plan.frames = static_cast<int>(frames);
        plan.pageOrder = stack.pageOrder;
        return;
    }
    const auto said = stack.images && *stack.images != pages
                          ? std::to_string(*stack.images) + " images"
                          : std::to_string(channels) + " channels x " + std::to_string(slices) +
                                " slices x " + std::to_string(frames) + " frames";
    throw InvalidInput(file.name(),
                       "its description says " + said + ", and it has " + std::to_string(pages) +
                           (pages == 1 ? " page" : " pages"),
                       isOme ? "save the whole series in one file"
                             : "save it again in ImageJ, stacks above 4 GB as NRRD");
}

std::string shortNumber(double value) {
    std::ostringstream text;
    text << value;
    return text.str();
}

/// Lengths of the voxel edges, and their unit.
glm::dvec3 spacingOf(const PageTags& tags, const StackDescription& stack, int slices, DatasetMeta& meta) {
    glm::dvec3 spacing(1.0);
    const bool isImageJ = stack.writer == StackDescription::Writer::ImageJ;
    const bool hasResolution = tags.xResolution && tags.yResolution;
    double scaleZ = stack.lengthScale;
    if (stack.spacingX && stack.spacingY) {
        spacing = glm::dvec3(*stack.spacingX, *stack.spacingY, 1.0) * stack.lengthScale;
        meta.lengthUnit = stack.lengthUnit;
    } else if (hasResolution && isImageJ) {
        spacing = glm::dvec3(1.0 / *tags.xResolution, 1.0 / *tags.yResolution, 1.0) * stack.lengthScale;
        meta.lengthUnit = stack.lengthUnit;
    } else if (hasResolution && tags.resolutionUnit != 1) {
        const bool centimetres = tags.resolutionUnit == 3;
        const double unit = centimetres ? 10.0 : 25.4;
        spacing = glm::dvec3(unit / *tags.xResolution, unit / *tags.yResolution, 1.0);
        meta.lengthUnit = "mm";
        scaleZ = 1.0;
        meta.notes.push_back("The size of its pixels comes from its resolution tags, " +
                             shortNumber(*tags.xResolution) + " x " + shortNumber(*tags.yResolution) +
                             " pixels per " + (centimetres ? "cm" : "inch") +
                             "; some programs write a number for printing there.");
    } else if (isImageJ) {
        meta.lengthUnit = stack.lengthUnit;
    }
    if (stack.spacingZ) {
        spacing.z = *stack.spacingZ * scaleZ;
    } else {
        spacing.z = 0.5 * (spacing.x + spacing.y);
        if (slices > 1)
            meta.notes.emplace_back(
                "The distance of its slices is not in the file: it is taken as that of its pixels.");
    }
    return spacing;
}

std::string sampleName(const PageFormat& format, int sample) {
    constexpr std::array<const char*, 3> rgb{"r", "g", "b"};
    constexpr std::array<const char*, 4> cmyk{"c", "m", "y", "k"};
    const auto index = static_cast<std::size_t>(sample);
    if (sample == format.alphaSample) return "a";
    if ((format.colours == PageColours::Rgb || format.colours == PageColours::Palette) && index < rgb.size())
        return rgb[index];
    if (format.colours == PageColours::Cmyk && index < cmyk.size()) return cmyk[index];
    return "sample " + std::to_string(sample + 1);
}

void describeFields(const TiffPlan& plan, const StackDescription& stack, DatasetMeta& meta) {
    std::vector<std::string> names;
    for (int channel = 0; channel < plan.channels; ++channel)
        for (int plane = 0; plane < plan.planesPerPage(); ++plane) {
            std::string name = plan.channels > 1 ? "channel " + std::to_string(channel + 1) : "";
            if (plan.planesPerPage() > 1) name += (name.empty() ? "" : " ") + sampleName(plan.format, plane);
            names.push_back(name);
        }
    if (names.size() == 1) names.clear(); // the name of a single field is makeFields's
    const auto count = plan.channels * plan.planesPerPage();
    meta.sourceType = plan.format.type();
    meta.fields = makeFields(count, plan.format.type(), names);
    for (auto& field : meta.fields) {
        field.valueScale = stack.valueScale;
        field.valueOffset = stack.valueOffset;
        field.unit = stack.valueUnit;
    }
}

void addNotes(const TiffPlan& plan, const PageTags& tags, std::vector<std::string>& notes) {
    notes.emplace_back("Rows go along y: seen along +z with y down, a slice looks as in a picture viewer.");
    if (plan.format.colours == PageColours::Inverted)
        notes.emplace_back("The file asks for small numbers to be shown bright; the numbers are as stored.");
    if (plan.format.colours == PageColours::Palette && !plan.paletteAsRgb)
        notes.emplace_back(
            "Its palette, which ImageJ uses for display, was left out; the numbers are as stored.");
    if (tags.orientation > 1)
        notes.push_back("Its pictures are turned or mirrored, as the file asks (orientation " +
                        std::to_string(tags.orientation) + ").");
    if (plan.format.sample.isPacked() && isFloat(plan.format.type()))
        notes.emplace_back("Its floats of 16 bits became floats of 32 bits, which hold them exactly.");
}

/// Rows and columns as the orientation says, within the box that begins at the origin; the numbers stay in
/// their order. Source: TIFF 6.0, tag Orientation (274), here with y down.
glm::dmat4 placedPages(int orientation, const glm::ivec3& dims, const glm::dvec3& spacing) {
    const bool transposed = orientation >= 5;
    const bool right = orientation == 2 || orientation == 3 || orientation == 6 || orientation == 7;
    const bool bottom = orientation == 3 || orientation == 4 || orientation == 7 || orientation == 8;
    glm::dvec3 column(0.0); // from pixel to pixel
    glm::dvec3 row(0.0);
    (transposed ? column.y : column.x) = spacing.x;
    (transposed ? row.x : row.y) = spacing.y;
    glm::dvec3 origin(0.0);
    const auto mirror = [&](glm::length_t axis) {
        origin[axis] = column[axis] * (dims.x - 1) + row[axis] * (dims.y - 1);
        column[axis] = -column[axis];
        row[axis] = -row[axis];
    };
    if (right) mirror(0);
    if (bottom) mirror(1);
    return affine({column, row, glm::dvec3(0, 0, spacing.z)}, origin);
}

class TiffReader : public SourceReader {
public:
    [[nodiscard]] const char* format() const override { return "tiff"; }
    [[nodiscard]] const char* description() const override { return "TIFF stacks (.tif)"; }

    [[nodiscard]] bool recognises(const FileHead& head, const ImportOptions&) const override {
        using namespace std::string_view_literals;
        constexpr std::array<std::string_view, 4> magic{"II*\0"sv, "MM\0*"sv, "II+\0"sv, "MM\0+"sv};
        return std::any_of(magic.begin(), magic.end(),
                           [&](std::string_view bytes) { return head.bytes.starts_with(bytes); });
    }

    [[nodiscard]] SourceHeader readHeader(const std::filesystem::path& path, const ImportOptions&,
                                          const ImportLimits& limits) const override {
        const InputFile file(path);
        TiffFile tiff(file);
        SourceHeader source;
        source.files.push_back(canonicalPath(path));
        auto& meta = source.meta;
        meta.format = format();
        auto plan = std::make_shared<TiffPlan>();
        const auto tags = collectPages(file, tiff, *plan, meta.notes);
        const auto stack = parseStackDescription(file.name(), tags.description);
        plan->paletteAsRgb =
            plan->format.colours == PageColours::Palette && stack.writer != StackDescription::Writer::ImageJ;
        checkBytes(file, *plan, tags.mostBytesPerFileByte, limits);
        arrangePages(file, stack, *plan);
        checkFieldsAndSteps(file.name(), std::int64_t{plan->channels} * plan->planesPerPage(), plan->frames);

        meta.grid.dims = {static_cast<int>(plan->format.width), static_cast<int>(plan->format.height),
                          plan->slices};
        const auto spacing = spacingOf(tags, stack, plan->slices, meta);
        meta.grid.worldFromIndex = placedPages(tags.orientation, meta.grid.dims, spacing);
        validateGrid(meta.grid);
        describeFields(*plan, stack, meta);
        meta.times.clear();
        for (int frame = 0; frame < plan->frames; ++frame)
            meta.times.push_back(frame * stack.frameInterval.value_or(1.0));
        addNotes(*plan, tags, meta.notes);
        source.plan = std::move(plan);
        return source;
    }

    [[nodiscard]] std::vector<std::string> readData(const SourceHeader& header, const ArraySink& sink,
                                                    const ReadProgress& progress) const override {
        const auto& plan = *static_cast<const TiffPlan*>(header.plan.get());
        const InputFile file(header.files.front());
        TiffFile tiff(file);
        if (promisesMuch(plan.storedBytes, file.bytes())) provePages(tiff, plan);
        std::size_t pagesRead = 0;
        for (int frame = 0; frame < plan.frames; ++frame)
            for (int channel = 0; channel < plan.channels; ++channel) {
                auto volumes = readChannel(tiff, plan, channel, frame, [&] {
                    ++pagesRead;
                    if (progress)
                        progress(static_cast<double>(pagesRead) /
                                 static_cast<double>(plan.pageOffsets.size()));
                });
                for (std::size_t plane = 0; plane < volumes.size(); ++plane)
                    sink(channel * plan.planesPerPage() + static_cast<int>(plane), frame,
                         std::move(volumes[plane]));
            }
        return {};
    }

private:
    /// Before memory is taken for what a small file promises.
    static void provePages(TiffFile& tiff, const TiffPlan& plan) {
        for (std::size_t page = 0; page < plan.pageOffsets.size(); ++page) {
            tiff.goToPage(plan.pageOffsets[page]);
            tiff.provePage(plan.format, static_cast<int>(page) + 1);
        }
    }

    /// One volume for each plane of a page.
    static std::vector<std::vector<std::byte>> readChannel(TiffFile& tiff, const TiffPlan& plan, int channel,
                                                           int frame, const std::function<void()>& pageDone) {
        const auto pageBytes =
            std::size_t{plan.format.width} * plan.format.height * scalarBytes(plan.format.type());
        std::vector<std::vector<std::byte>> volumes(
            static_cast<std::size_t>(plan.planesPerPage()),
            std::vector<std::byte>(pageBytes * static_cast<std::size_t>(plan.slices)));
        for (int slice = 0; slice < plan.slices; ++slice) {
            std::vector<std::span<std::byte>> planes;
            for (auto& volume : volumes)
                planes.push_back(
                    std::span(volume).subspan(static_cast<std::size_t>(slice) * pageBytes, pageBytes));
            const auto page = plan.pageOf(channel, slice, frame);
            tiff.goToPage(plan.pageOffsets[page]);
            tiff.readPage(plan.format, static_cast<int>(page) + 1, planes);
            pageDone();
        }
        return volumes;
    }
};

} // namespace

std::unique_ptr<SourceReader> makeTiffReader() { return std::make_unique<TiffReader>(); }

} // namespace voxsheet::import
