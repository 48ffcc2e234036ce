#include "import/vtk/vti_reader.h"

#include "base/errors.h"
#include "import/formats/byte_stream.h"
#include "import/formats/field_names.h"
#include "import/formats/rectilinear_axes.h"
#include "import/formats/voxel_plan.h"
#include "import/vtk/vtk_errors.h"
#include "import/vtk_legacy/image_fields.h"
#include "import/vtk_xml/vti_header.h"

#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkDataArraySelection.h>
#include <vtkDummyController.h>
#include <vtkImageData.h>
#include <vtkInformation.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkRectilinearGrid.h>
#include <vtkSmartPointer.h>
#include <vtkStreamingDemandDrivenPipeline.h>
#include <vtkXMLImageDataReader.h>
#include <vtkXMLRectilinearGridReader.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <optional>

namespace voxsheet::import {

namespace {

constexpr const char* kFormat = "vti";
constexpr double kSlabBytes = 4U << 20;

struct ArrayPlan {
    VtiArray array;
    int firstField = 0;
};

struct VtiPlan {
    bool ofCells = false;
    bool rectilinear = false;
    glm::ivec3 points{1};
    glm::ivec3 dims{1}; ///< of the arrays in the file
    std::optional<UniformResampling> resampling;
    std::vector<ArrayPlan> arrays;
};

/// Debian's VTK replaces some readers by parallel twins, which need a controller (the one for MPI aborts
/// without MPI).
void ensureController() {
    static const auto controller = [] {
        auto dummy = vtkSmartPointer<vtkDummyController>::New();
        vtkMultiProcessController::SetGlobalController(dummy);
        return dummy;
    }();
    (void)controller;
}

/// Reads one array; the others are not decoded, so that memory holds one at a time.
class VtkImageFile {
public:
    VtkImageFile(const std::string& path, bool rectilinear) : path_(path) {
        ensureController();
        if (rectilinear)
            reader_ = vtkSmartPointer<vtkXMLRectilinearGridReader>::New();
        else
            reader_ = vtkSmartPointer<vtkXMLImageDataReader>::New();
        reader_->SetFileName(path.c_str());
        reader_->UpdateInformation();
        check("opening");
    }

    vtkDataArray* read(const VtiArray& wanted, bool ofCells) {
        selectNothing();
        auto* const selection =
            ofCells ? reader_->GetCellDataArraySelection() : reader_->GetPointDataArraySelection();
        selection->EnableArray(wanted.name.c_str());
        reader_->Update();
        check("reading");
        auto* const set = reader_->GetOutputAsDataSet();
        vtkDataSetAttributes* const data =
            ofCells ? static_cast<vtkDataSetAttributes*>(set->GetCellData()) : set->GetPointData();
        return data->GetArray(wanted.name.c_str());
    }

    /// Decodes an array slab by slab and keeps nothing.
    void prove(const VtiArray& wanted, bool ofCells) {
        selectNothing();
        auto* const selection =
            ofCells ? reader_->GetCellDataArraySelection() : reader_->GetPointDataArraySelection();
        selection->EnableArray(wanted.name.c_str());
        std::array<int, 6> whole{};
        reader_->GetOutputInformation(0)->Get(vtkStreamingDemandDrivenPipeline::WHOLE_EXTENT(), whole.data());
        const std::size_t axis = whole[5] > whole[4] ? 2 : 1; // the slowest that has an extent
        const int last = whole[2 * axis + 1];
        double bytesPerSlice = static_cast<double>(scalarBytes(wanted.type)) * wanted.components;
        for (std::size_t other = 0; other < axis; ++other)
            bytesPerSlice *= whole[2 * other + 1] - whole[2 * other] + 1;
        const int slices = std::max(1, static_cast<int>(kSlabBytes / std::max(1.0, bytesPerSlice)));
        for (int first = whole[2 * axis];; first += slices) {
            auto slab = whole;
            slab[2 * axis] = first;
            slab[2 * axis + 1] = std::min(first + slices, last);
            reader_->UpdateExtent(slab.data());
            check("reading");
            auto* const set = reader_->GetOutputAsDataSet();
            vtkDataSetAttributes* const data =
                ofCells ? static_cast<vtkDataSetAttributes*>(set->GetCellData()) : set->GetPointData();
            const auto* const array = data->GetArray(wanted.name.c_str());
            const auto expected = ofCells ? set->GetNumberOfCells() : set->GetNumberOfPoints();
            if (!array || array->GetNumberOfTuples() != expected) damaged(wanted);
            if (slab[2 * axis + 1] >= last) return;
        }
    }

    [[nodiscard]] std::uint64_t bytes() const { return InputFile(path_).bytes(); }

    [[noreturn]] void damaged(const VtiArray& array) const {
        throw InvalidInput(path_, "VTK could not read all of the array '" + printable(array.name) + "'",
                           "the file is damaged: copy or write it again");
    }

    /// Of a rectilinear grid.
    AxisCoordinates coordinates() {
        selectNothing();
        reader_->Update();
        check("reading");
        auto* const grid = vtkRectilinearGrid::SafeDownCast(reader_->GetOutputAsDataSet());
        AxisCoordinates points;
        if (!grid) return points;
        const std::array arrays{grid->GetXCoordinates(), grid->GetYCoordinates(), grid->GetZCoordinates()};
        for (std::size_t axis = 0; axis < 3; ++axis)
            for (vtkIdType i = 0; arrays[axis] && i < arrays[axis]->GetNumberOfTuples(); ++i)
                points[axis].push_back(arrays[axis]->GetTuple1(i));
        return points;
    }

private:
    void selectNothing() {
        reader_->GetPointDataArraySelection()->DisableAllArrays();
        reader_->GetCellDataArraySelection()->DisableAllArrays();
    }

    void check(const char* action) const {
        const auto error = errors_.firstError();
        if (!error.empty() || reader_->GetErrorCode() != 0)
            throw InvalidInput(path_,
                               std::string(action) +
                                   " its data failed: " + (error.empty() ? "VTK says no more" : error),
                               "the file is damaged: copy or write it again");
    }

    std::string path_;
    VtkErrorCollector errors_;
    vtkSmartPointer<vtkXMLReader> reader_;
};

std::vector<std::byte> component(vtkDataArray& array, int index, std::size_t tuples, std::size_t valueBytes) {
    std::vector<std::byte> samples(tuples * valueBytes);
    const auto* from =
        static_cast<const std::byte*>(array.GetVoidPointer(0)) + static_cast<std::size_t>(index) * valueBytes;
    const auto stride = static_cast<std::size_t>(array.GetNumberOfComponents()) * valueBytes;
    if (stride == valueBytes) {
        std::memcpy(samples.data(), from, samples.size());
    } else {
        for (std::size_t i = 0; i < tuples; ++i)
            std::memcpy(samples.data() + i * valueBytes, from + i * stride, valueBytes);
    }
    return samples;
}

bool isOfType(const vtkDataArray& array, ScalarType type) {
    return visitScalar(type, [&]<typename T>() {
        auto& a = const_cast<vtkDataArray&>(array); // VTK's getters are not const
        const bool floating = a.GetDataType() == VTK_FLOAT || a.GetDataType() == VTK_DOUBLE;
        return a.GetDataTypeSize() == static_cast<int>(sizeof(T)) && floating == std::is_floating_point_v<T>;
    });
}

const VtiPlan& planOf(const SourceHeader& header) { return *static_cast<const VtiPlan*>(header.plan.get()); }

bool chooseCells(const InputFile& file, const VtiHeader& vti, VtiData wanted) {
    if (vti.arrays.empty())
        throw InvalidInput(file.name(), "it has no array of numbers for its points or cells");
    const auto has = [&](bool ofCells) {
        return std::any_of(vti.arrays.begin(), vti.arrays.end(), [&](const VtiArray& array) {
            return array.ofCells == ofCells && array.name != kVtkGhosts;
        });
    };
    const bool ofCells = wanted == VtiData::Cells || (wanted == VtiData::CellsFirst && has(true)) ||
                         (wanted != VtiData::Points && !has(false));
    const bool chosen = wanted == VtiData::Cells || wanted == VtiData::Points;
    if (chosen && !has(ofCells))
        throw Unsupported(file.name(),
                          ofCells ? "its values are those of points, and those of the first patch of cells"
                                  : "its values are those of cells, and those of the first patch of points",
                          "write all patches with the same arrays");
    return ofCells;
}

void placeRectilinear(const InputFile& file, const VtiHeader& vti, const ImportLimits& limits,
                      SourceHeader& source, VtiPlan& plan) {
    plan.rectilinear = true;
    for (int axis = 0; axis < 3; ++axis) {
        const auto& array = vti.coordinates[static_cast<std::size_t>(axis)];
        checkVtiArray(file, vti, array,
                      checkedBytes(file.name(), {vti.points.dims[axis]}, scalarBytes(array.type), limits));
    }
    const auto points = VtkImageFile(source.files.front().string(), true).coordinates();
    for (int axis = 0; axis < 3; ++axis)
        if (points[static_cast<std::size_t>(axis)].size() != static_cast<std::size_t>(vti.points.dims[axis]))
            throw InvalidInput(file.name(), "VTK could not read all of its coordinates",
                               "the file is damaged: copy or write it again");
    const UniformResampling resampling(file.name(), points, plan.ofCells);
    source.meta.grid = resampling.grid();
    plan.dims = resampling.sourceDims();
    if (resampling.isIdentity()) return;
    plan.resampling = resampling;
    source.meta.notes.push_back(resampling.note());
}

/// VTK finds arrays by name.
void refuseSameName(const InputFile& file, const VtiPlan& plan, const VtiArray& array) {
    for (const auto& other : plan.arrays)
        if (other.array.name == array.name)
            throw Unsupported(file.name(), "two of its arrays have the name '" + printable(array.name) + "'",
                              "give each array a name of its own");
    if (array.name.empty())
        throw Unsupported(file.name(), "one of its arrays has no name", "give each array a name");
}

/// One array's components as fields.
template <typename Sink>
void readArray(VtkImageFile& file, const VtiPlan& plan, const ArrayPlan& array, const Sink& sink) {
    const auto tuples = static_cast<std::size_t>(sampleCount(plan.dims));
    const auto& wanted = array.array;
    const auto bytes = tuples * static_cast<std::size_t>(wanted.components) * scalarBytes(wanted.type);
    // Before memory is taken for what a small file promises.
    if (promisesMuch(bytes, file.bytes())) file.prove(wanted, plan.ofCells);
    auto* const values = file.read(wanted, plan.ofCells);
    if (!values || static_cast<std::size_t>(values->GetNumberOfTuples()) != tuples ||
        values->GetNumberOfComponents() != wanted.components || !isOfType(*values, wanted.type))
        file.damaged(wanted);
    for (int c = 0; c < wanted.components; ++c)
        sink(array.firstField + c, [&] {
            auto samples = component(*values, c, tuples, scalarBytes(wanted.type));
            return plan.resampling ? plan.resampling->apply(samples, wanted.type) : std::move(samples);
        });
}

class VtiReader : public SourceReader {
public:
    [[nodiscard]] const char* format() const override { return kFormat; }
    [[nodiscard]] const char* description() const override {
        return "VTK XML images and rectilinear grids (.vti, .vtr)";
    }

    [[nodiscard]] bool recognises(const FileHead& head, const ImportOptions&) const override {
        return head.bytes.substr(0, 4096).find("<VTKFile") != std::string::npos;
    }

    [[nodiscard]] SourceHeader readHeader(const std::filesystem::path& path, const ImportOptions&,
                                          const ImportLimits& limits) const override {
        return readVtiHeader(path, limits, VtiData::PointsFirst);
    }

    [[nodiscard]] std::vector<std::string> readData(const SourceHeader& header, const ArraySink& sink,
                                                    const ReadProgress& progress) const override {
        const auto& plan = planOf(header);
        const auto path = header.files.front().string();
        VtkImageFile file(path, plan.rectilinear);
        for (std::size_t i = 0; i < plan.arrays.size(); ++i) {
            readArray(file, plan, plan.arrays[i],
                      [&](int field, const auto& samples) { sink(field, 0, samples()); });
            if (progress) progress(static_cast<double>(i + 1) / static_cast<double>(plan.arrays.size()));
        }
        return {};
    }
};

} // namespace

SourceHeader readVtiHeader(const std::filesystem::path& path, const ImportLimits& limits, VtiData wanted) {
    const InputFile file(path);
    const auto vti = parseVtiHeader(file);
    SourceHeader source;
    source.files.push_back(canonicalPath(path));
    source.meta.format = kFormat;
    source.meta.notes = vti.notes;
    auto plan = std::make_shared<VtiPlan>();
    plan->ofCells = chooseCells(file, vti, wanted);
    plan->points = vti.points.dims;
    if (vti.rectilinear)
        placeRectilinear(file, vti, limits, source, *plan);
    else
        source.meta.grid = plan->ofCells ? cellGrid(vti.points) : vti.points;
    if (!vti.rectilinear) plan->dims = source.meta.grid.dims;
    if (!plan->ofCells &&
        std::any_of(vti.arrays.begin(), vti.arrays.end(), [](auto& a) { return a.ofCells; }))
        source.meta.notes.emplace_back(
            "The arrays of its cells were left out, because it has arrays of points.");

    const auto& dims = plan->dims;
    for (const auto& array : vti.arrays) {
        if (array.ofCells != plan->ofCells) continue;
        refuseSameName(file, *plan, array);
        const auto bytes = checkedBytes(file.name(), {dims.x, dims.y, dims.z, array.components},
                                        scalarBytes(array.type), limits);
        checkVtiArray(file, vti, array, bytes);
        plan->arrays.push_back({array, static_cast<int>(source.meta.fields.size())});
        plan->arrays.back().array.inlineHead.clear();
        appendFields(source.meta.fields, array.name, array.type, array.components, array.isVector);
    }
    source.meta.sourceType = plan->arrays.front().array.type;
    finishFields(file.name(), plan->resampling, limits, source);
    source.plan = plan;
    return source;
}

glm::ivec3 vtiPointDims(const SourceHeader& header) { return planOf(header).points; }

std::vector<std::byte> readVtiField(const SourceHeader& header, int field) {
    const auto& plan = planOf(header);
    const auto path = header.files.front().string();
    VtkImageFile file(path, plan.rectilinear);
    std::vector<std::byte> result;
    for (const auto& array : plan.arrays)
        if (field >= array.firstField && field < array.firstField + array.array.components)
            readArray(file, plan, array, [&](int read, const auto& samples) {
                if (read == field) result = samples();
            });
    return result;
}

std::unique_ptr<SourceReader> makeVtiReader() { return std::make_unique<VtiReader>(); }

} // namespace voxsheet::import
