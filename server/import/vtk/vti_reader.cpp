#include "import/vtk/vti_reader.h"

#include "base/errors.h"
#include "import/formats/field_names.h"
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
#include <vtkSmartPointer.h>
#include <vtkXMLImageDataReader.h>

#include <algorithm>
#include <cstring>

namespace voxsheet::import {

namespace {

struct ArrayPlan {
    VtiArray array;
    int firstField = 0;
};

struct VtiPlan {
    bool ofCells = false;
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
    explicit VtkImageFile(const std::string& path) : path_(path) {
        ensureController();
        reader_->SetFileName(path.c_str());
        reader_->UpdateInformation();
        check("opening");
    }

    vtkDataArray* read(const VtiArray& wanted, bool ofCells) {
        reader_->GetPointDataArraySelection()->DisableAllArrays();
        reader_->GetCellDataArraySelection()->DisableAllArrays();
        auto* const selection =
            ofCells ? reader_->GetCellDataArraySelection() : reader_->GetPointDataArraySelection();
        selection->EnableArray(wanted.name.c_str());
        reader_->Update();
        check("reading");
        auto* const image = reader_->GetOutput();
        vtkDataSetAttributes* const data =
            ofCells ? static_cast<vtkDataSetAttributes*>(image->GetCellData()) : image->GetPointData();
        return data->GetArray(wanted.name.c_str());
    }

private:
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
    vtkNew<vtkXMLImageDataReader> reader_;
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
    [[nodiscard]] const char* description() const override { return "VTK XML image data (.vti)"; }

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
        source.meta.grid = plan->ofCells ? cellGrid(vti.points) : vti.points;
        if (!plan->ofCells &&
            std::any_of(vti.arrays.begin(), vti.arrays.end(), [](auto& a) { return a.ofCells; }))
            source.meta.notes.emplace_back(
                "The arrays of its cells were left out, because it has arrays of points.");

        const auto& dims = source.meta.grid.dims;
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
        checkFieldsAndSteps(file.name(), static_cast<std::int64_t>(source.meta.fields.size()), 1);
        source.meta.sourceType = source.meta.fields.front().storedType;
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
        const auto tuples = static_cast<std::size_t>(sampleCount(header.meta.grid.dims));
        VtkImageFile file(path);
        for (std::size_t i = 0; i < plan.arrays.size(); ++i) {
            const auto& wanted = plan.arrays[i].array;
            auto* const array = file.read(wanted, plan.ofCells);
            if (!array || static_cast<std::size_t>(array->GetNumberOfTuples()) != tuples ||
                array->GetNumberOfComponents() != wanted.components || !isOfType(*array, wanted.type))
                throw InvalidInput(path,
                                   "VTK could not read all of the array '" + printable(wanted.name) + "'",
                                   "the file is damaged: copy or write it again");
            for (int c = 0; c < wanted.components; ++c)
                sink(plan.arrays[i].firstField + c, 0,
                     component(*array, c, tuples, scalarBytes(wanted.type)));
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
