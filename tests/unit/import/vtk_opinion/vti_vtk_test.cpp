// Images by VTK's own writer, with every compressor and way to hold the data.
#include "../vtk_fixture.h"

#include <vtkAOSDataArrayTemplate.h>
#include <vtkCellData.h>
#include <vtkDoubleArray.h>
#include <vtkFieldData.h>
#include <vtkFloatArray.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkXMLImageDataWriter.h>

namespace voxsheet::import::testing {
namespace {

using VtiByVtk = FormatsTest;

TEST_F(VtiByVtk, EveryCompressorAndModeGivesTheSameVolume) {
    const glm::ivec3 dims{17, 9, 33};
    vtkNew<vtkImageData> image;
    image->SetDimensions(dims.x, dims.y, dims.z);
    image->SetSpacing(0.5, 2.0, 3.0);
    image->SetOrigin(-1.0, 4.0, 7.0);
    vtkNew<vtkDoubleArray> array;
    array->SetName("density");
    std::vector<double> values;
    for (int i = 0; i < dims.x * dims.y * dims.z; ++i) {
        values.push_back(std::sin(0.37 * i) + 1e-3 * (i % 7));
        array->InsertNextValue(values.back());
    }
    image->GetPointData()->SetScalars(array);
    // VTK writes the range of lengths into the element of a vector's data.
    vtkNew<vtkFloatArray> vectors;
    vectors->SetName("moved");
    vectors->SetNumberOfComponents(3);
    std::vector<float> along;
    for (int i = 0; i < dims.x * dims.y * dims.z; ++i) {
        along.push_back(0.5F * static_cast<float>(i));
        vectors->InsertNextTuple3(along.back(), -1.5, 1e-3);
    }
    image->GetPointData()->AddArray(vectors);
    vtkNew<vtkDoubleArray> time; // belongs to the whole, as simulations write it
    time->SetName("TimeValue");
    time->InsertNextValue(0.25);
    image->GetFieldData()->AddArray(time);

    vtkNew<vtkXMLImageDataWriter> writer;
    writer->SetInputData(image);
    writer->SetBlockSize(1024); // several blocks
    using Writer = vtkXMLWriter;
    for (const int compressor : {Writer::NONE, Writer::ZLIB, Writer::LZ4, Writer::LZMA})
        for (const int mode : {Writer::Ascii, Writer::Binary, Writer::Appended})
            for (const bool base64 : {false, true})
                for (const bool wide : {false, true}) {
                    const auto file = folder_ / "a.vti";
                    writer->SetFileName(file.c_str());
                    writer->SetCompressorType(compressor);
                    writer->SetDataMode(mode);
                    writer->SetEncodeAppendedData(base64);
                    if (wide)
                        writer->SetHeaderTypeToUInt64();
                    else
                        writer->SetHeaderTypeToUInt32();
                    ASSERT_EQ(writer->Write(), 1);
                    SCOPED_TRACE("compressor " + std::to_string(compressor) + ", mode " +
                                 std::to_string(mode) + (base64 ? ", base64" : "") +
                                 (wide ? ", 64 bit" : ""));
                    const auto loaded = loadAny(file);
                    EXPECT_EQ(loaded.meta().grid.dims, dims);
                    EXPECT_EQ(spacingWorld(loaded.meta().grid), glm::dvec3(0.5, 2.0, 3.0));
                    EXPECT_EQ(loaded.meta().fields[0].name, "density");
                    ASSERT_EQ(loaded.meta().fields.size(), 4U);
                    EXPECT_EQ(loaded.values<float>(1), along);
                    if (mode != Writer::Ascii) {
                        EXPECT_EQ(loaded.values<double>(), values);
                    }
                }
}

template <typename T>
void expectType(const fs::path& file, vtkXMLImageDataWriter& writer, vtkImageData& image) {
    vtkNew<vtkAOSDataArrayTemplate<T>> array;
    array->SetName("v");
    const auto values = ramp<T>(24);
    for (const T value : values)
        array->InsertNextValue(value);
    image.GetCellData()->Initialize();
    image.GetCellData()->SetScalars(array);
    writer.SetInputData(&image);
    writer.SetFileName(file.c_str());
    ASSERT_EQ(writer.Write(), 1);
    const auto loaded = loadAny(file);
    EXPECT_EQ(loaded.meta().grid.dims, glm::ivec3(2, 3, 4));
    EXPECT_EQ(loaded.meta().grid.centring, Centring::Cell);
    EXPECT_EQ(loaded.values<T>(), values) << array->GetDataTypeAsString();
}

TEST_F(VtiByVtk, CellsOfEveryTypeInBothByteOrders) {
    vtkNew<vtkImageData> image;
    image->SetDimensions(3, 4, 5);
    vtkNew<vtkXMLImageDataWriter> writer;
    for (const bool big : {false, true})
        for (const int compressor : {vtkXMLWriter::NONE, vtkXMLWriter::ZLIB})
            for (const bool base64 : {false, true}) {
                SCOPED_TRACE(std::string(big ? "big" : "little") + "-endian, compressor " +
                             std::to_string(compressor));
                if (big)
                    writer->SetByteOrderToBigEndian();
                else
                    writer->SetByteOrderToLittleEndian();
                writer->SetCompressorType(compressor);
                writer->SetEncodeAppendedData(base64);
                const auto file = folder_ / "a.vti";
                expectType<unsigned char>(file, *writer, *image);
                expectType<signed char>(file, *writer, *image);
                expectType<unsigned short>(file, *writer, *image);
                expectType<short>(file, *writer, *image);
                expectType<unsigned int>(file, *writer, *image);
                expectType<int>(file, *writer, *image);
                expectType<unsigned long>(file, *writer, *image);
                expectType<long>(file, *writer, *image);
                expectType<float>(file, *writer, *image);
                expectType<double>(file, *writer, *image);
            }
}

TEST_F(VtiByVtk, WhatCompressesWellIsReadAllTheSame) {
    // Decoded once for nothing, slab by slab, before memory is taken; then as a whole.
    const glm::ivec3 dims{300, 400, 300};
    vtkNew<vtkImageData> image;
    image->SetDimensions(dims.x, dims.y, dims.z);
    image->AllocateScalars(VTK_UNSIGNED_CHAR, 1);
    auto* const voxels = static_cast<unsigned char*>(image->GetScalarPointer());
    const auto count = static_cast<std::size_t>(dims.x) * static_cast<std::size_t>(dims.y * dims.z);
    std::fill_n(voxels, count, static_cast<unsigned char>(7));
    voxels[count - 1] = 9;
    voxels[count / 2] = 11;
    vtkNew<vtkXMLImageDataWriter> writer;
    writer->SetInputData(image);
    for (const int compressor : {vtkXMLWriter::ZLIB, vtkXMLWriter::LZ4}) {
        const auto file = folder_ / "a.vti";
        writer->SetFileName(file.c_str());
        writer->SetCompressorType(compressor);
        ASSERT_EQ(writer->Write(), 1);
        ASSERT_LT(fs::file_size(file), count / 40) << "not small enough for this test";
        EXPECT_EQ(loadAny(file).values<unsigned char>(), std::vector<unsigned char>(voxels, voxels + count));
    }
}

} // namespace
} // namespace voxsheet::import::testing
