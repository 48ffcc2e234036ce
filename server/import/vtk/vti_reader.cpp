#include "import/vtk/vti_reader.h"

#include "base/errors.h"
#include "import/formats/field_names.h"
#include "import/formats/rectilinear_axes.h"
#include "import/formats/voxel_plan.h"
#include "import/vtk/vti_header.h"
#include "import/vtk/vtk_errors.h"
#include "import/vtk_legacy/image_fields.h"

#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkDataArraySelection.h>
#include <vtkDummyController.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkRectilinearGrid.h>
#include <vtkSmartPointer.h>
#include <vtkXMLImageDataReader.h>
#include <vtkXMLRectilinearGridReader.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <optional>

namespace voxsheet::import {

namespace {

struct ArrayPlan {
    VtiArray array;
    int firstField = 0;
};

struct VtiPlan {
    bool ofCells = false;
    bool rectilinear = false;
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

class VtiReader : public SourceReader {
public:
    [[nodiscard]] const char* format() const override { return "vti"; }
    [[nodiscard]] const char* description() const override {
        return "VTK XML images and rectilinear grids (.vti, .vtr)";
    }

    [[nodiscard]] bool recognises(const FileHead& head, const ImportOptions&) const override {
        return head.bytes.substr(0, 4096).find("<VTKFile") != std::string::npos;
    }

    [[nodiscard]] SourceHeader readHeader(const std::filesystem::path& path, const ImportOptions&,
                                          const ImportLimits& limits) const override {
        const InputFile file(path);
        const auto vti = parseVtiHeader(file);
        SourceHeader source;
        source.files.push_back(canonicalPath(path));
        source.meta.format = format();
        source.meta.notes = vti.notes;
        auto plan = std::make_shared<VtiPlan>();
        plan->ofCells = chooseCells(file, vti);
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
        if (plan->resampling)
            for (auto& field : source.meta.fields)
                field.storedType = plan->resampling->resultType(field.storedType);
        checkFieldsAndSteps(file.name(), static_cast<std::int64_t>(source.meta.fields.size()), 1);
        source.meta.sourceType = plan->arrays.front().array.type;
        if (source.totalBytes() > limits.maxBytes)
            throw LimitExceeded(file.name(), "its arrays need " + std::to_string(source.totalBytes()) +
                                                 " bytes, more than the limit of " +
                                                 std::to_string(limits.maxBytes));
        source.plan = plan;
        return source;
    }

    [[nodiscard]] std::vector<std::string> readData(const SourceHeader& header, const ArraySink& sink,
                                                    const ReadProgress& progress) const override {
        const auto& plan = *static_cast<const VtiPlan*>(header.plan.get());
        const auto path = header.files.front().string();
        const auto tuples = static_cast<std::size_t>(sampleCount(plan.dims));
        VtkImageFile file(path, plan.rectilinear);
        for (std::size_t i = 0; i < plan.arrays.size(); ++i) {
            const auto& wanted = plan.arrays[i].array;
            auto* const array = file.read(wanted, plan.ofCells);
            if (!array || static_cast<std::size_t>(array->GetNumberOfTuples()) != tuples ||
                array->GetNumberOfComponents() != wanted.components || !isOfType(*array, wanted.type))
                throw InvalidInput(path,
                                   "VTK could not read all of the array '" + printable(wanted.name) + "'",
                                   "the file is damaged: copy or write it again");
            for (int c = 0; c < wanted.components; ++c) {
                auto values = component(*array, c, tuples, scalarBytes(wanted.type));
                if (plan.resampling) values = plan.resampling->apply(values, wanted.type);
                sink(plan.arrays[i].firstField + c, 0, std::move(values));
            }
            if (progress) progress(static_cast<double>(i + 1) / static_cast<double>(plan.arrays.size()));
        }
        return {};
    }

private:
    [[nodiscard]] static bool chooseCells(const InputFile& file, const VtiHeader& vti) {
        if (vti.arrays.empty())
            throw InvalidInput(file.name(), "it has no array of numbers for its points or cells");
        return std::none_of(vti.arrays.begin(), vti.arrays.end(), [](auto& a) { return !a.ofCells; });
    }

    static void placeRectilinear(const InputFile& file, const VtiHeader& vti, const ImportLimits& limits,
                                 SourceHeader& source, VtiPlan& plan) {
        plan.rectilinear = true;
        for (int axis = 0; axis < 3; ++axis) {
            const auto& array = vti.coordinates[static_cast<std::size_t>(axis)];
            checkVtiArray(
                file, vti, array,
                checkedBytes(file.name(), {vti.points.dims[axis]}, scalarBytes(array.type), limits));
        }
        const auto points = VtkImageFile(source.files.front().string(), true).coordinates();
        for (int axis = 0; axis < 3; ++axis)
            if (points[static_cast<std::size_t>(axis)].size() !=
                static_cast<std::size_t>(vti.points.dims[axis]))
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
    static void refuseSameName(const InputFile& file, const VtiPlan& plan, const VtiArray& array) {
        for (const auto& other : plan.arrays)
            if (other.array.name == array.name)
                throw Unsupported(file.name(),
                                  "two of its arrays have the name '" + printable(array.name) + "'",
                                  "give each array a name of its own");
        if (array.name.empty())
            throw Unsupported(file.name(), "one of its arrays has no name", "give each array a name");
    }
};

} // namespace

std::unique_ptr<SourceReader> makeVtiReader() { return std::make_unique<VtiReader>(); }

} // namespace voxsheet::import
