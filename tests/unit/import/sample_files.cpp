#include "sample_files.h"

#include "mesh_bytes.h"
#include "nifti_bytes.h"
#include "packed_bytes.h"
#include "tiff_bytes.h"

#include <unistd.h>

#include <cstdio>
#include <fstream>
#include <iterator>

namespace voxsheet::import::testing {

namespace {

using namespace std::string_literals;

const std::vector<short>& values() {
    static const auto samples = ramp<short>(5 * 6 * 7);
    return samples;
}

std::string decimals(const std::string& before, const std::string& after) {
    std::string text;
    for (const auto value : values())
        text += before + std::to_string(value) + after;
    return text;
}

template <typename... Arguments>
std::string printed(const char* format, Arguments... arguments) {
    char word[64];
    std::snprintf(word, sizeof word, format, arguments...);
    return word;
}

std::string hexDigits(const std::string& bytes) {
    std::string hex;
    for (const char byte : bytes)
        hex += printed("%02x", static_cast<unsigned>(static_cast<unsigned char>(byte)));
    return hex;
}

void addNrrd(std::vector<SampleFile>& samples) {
    const auto raw = bytesOf(values());
    const std::string head =
        "NRRD0005\ntype: short\ndimension: 3\nspace: left-posterior-superior\nsizes: 5 6 7\n"
        "space directions: (1,0,0) (0,2,0) (0,0.5,3)\nkinds: domain domain domain\nendian: little\n"
        "space origin: (1,2,3)\nencoding: ";
    samples.push_back({"raw.nrrd", head + "raw\n\n" + raw});
    samples.push_back({"gzip.nrrd", head + "gzip\n\n" + gzipped(raw)});
    samples.push_back({"bzip2.nrrd", head + "bzip2\n\n" + bzipped(raw)});
    // A shortened last number is still a number.
    samples.push_back({"ascii.nrrd", head + "ascii\n\n" + decimals("", "\n"), 6});
    samples.push_back({"hex.nrrd", head + "hex\n\n" + hexDigits(raw)});
}

void addMetaImage(std::vector<SampleFile>& samples) {
    const auto raw = bytesOf(values());
    const std::string head =
        "ObjectType = Image\nNDims = 3\nDimSize = 5 6 7\nElementSpacing = 1 2 3\nOffset = 4 5 6\n"
        "TransformMatrix = 1 0 0 0 1 0 0 0 1\nElementType = MET_SHORT\n";
    samples.push_back({"raw.mha", head + "ElementDataFile = LOCAL\n" + raw});
    samples.push_back({"zlib.mha", head + "CompressedData = True\nElementDataFile = LOCAL\n" + zlibbed(raw)});
}

std::string niftiBytes(int version, bool single) {
    NiftiBytes header(version, version == 2, {5, 6, 7}, 4, single);
    header.setSform({1, 0, 0, 4, 0, 2, 0, 5, 0, 0, 3, 6});
    return single ? header.with(bytesOf(values(), version == 2)) : header.header();
}

/// With a table of labels in an extension of the header.
std::string niftiWithLabels() {
    auto xml =
        "<CaretExtension><VolumeInformation Index=\"0\"><LabelTable><Label Key=\"1\" Red=\"1\" Green=\"0\" "
        "Blue=\"0.5\">spleen</Label></LabelTable></VolumeInformation></CaretExtension>"s;
    xml.resize((xml.size() + 8 + 15) / 16 * 16 - 8);
    NiftiBytes header(1, false, {5, 6, 7}, 4);
    header.setSform({1, 0, 0, 4, 0, 2, 0, 5, 0, 0, 3, 6});
    header.set<float>(108, static_cast<float>(352 + 8 + xml.size()));
    const std::vector<std::int32_t> head{static_cast<std::int32_t>(xml.size()) + 8, 30};
    return header.header() + "\1\0\0\0"s + bytesOf(head) + xml + bytesOf(values());
}

void addNifti(std::vector<SampleFile>& samples) {
    for (const int version : {1, 2}) {
        const auto file = niftiBytes(version, true);
        samples.push_back({"v" + std::to_string(version) + ".nii", file});
        samples.push_back({"v" + std::to_string(version) + ".nii.gz", gzipped(file)});
    }
    samples.push_back({"labels.nii", niftiWithLabels()});
}

void addCrystals(std::vector<SampleFile>& samples) {
    std::string chgcar =
        "NaCl\n 1.0\n 2 0 0\n 0 3 0\n 1 0 4\n Na Cl\n 1 1\nDirect\n 0 0 0\n 0.5 0.5 0.5\n\n 5 6 7\n";
    for (std::size_t i = 0; i < values().size(); ++i)
        chgcar += printed(" %18.11E%s", static_cast<double>(values()[i]) / 7.0, i % 5 == 4 ? "\n" : "");
    samples.push_back({"CHGCAR", chgcar, 1});
    samples.push_back({"LOCPOT.gz", gzipped(chgcar)});

    const auto xsf =
        "CRYSTAL\nPRIMVEC\n 2 0 0\n 0 3 0\n 1 0 4\nPRIMCOORD\n 2 1\n 11 0 0 0\n Cl 1 1 1\n"
        "BEGIN_BLOCK_DATAGRID_3D\nrho\nBEGIN_DATAGRID_3D_rho\n 5 6 7\n 0 0 0\n 2 0 0\n 0 3 0\n 1 0 4\n" +
        decimals(" ", "\n") + "END_DATAGRID_3D\nEND_BLOCK_DATAGRID_3D\n";
    samples.push_back({"salt.xsf", xsf, 4}); // "_3D" and a line end
    samples.push_back({"salt.xsf.gz", gzipped(xsf)});

    std::string cube =
        "salt\ndensity\n   -2 0 0 0\n 5 1 0 0\n 6 0 1 0\n -7 0.1 0 1\n 11 11 0 0 0\n 17 17 1 1 1\n"
        "   2   4   5\n";
    for (const auto value : values())
        cube += printed(" %13.5E %13.5E\n", static_cast<double>(value), 0.5 * value);
    samples.push_back({"salt.cube", cube, 1});
    samples.push_back({"salt.cube.gz", gzipped(cube)});
}

std::string slcHeader(int compression) {
    return "11111\n3 2 2 8\n1.0 0.5 2.000000\n1 6 0 " + std::to_string(compression) +
           "\n2 1 X5 X\x82\x01\x01";
}

std::string contentsOf(const std::filesystem::path& path) {
    std::ifstream in(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}

} // namespace

std::vector<SampleFile> volumeSamples() {
    std::vector<SampleFile> samples;
    addNrrd(samples);
    addMetaImage(samples);
    addNifti(samples);
    addCrystals(samples);
    return samples;
}

std::vector<SampleFile> detachedSamples() {
    const auto raw = bytesOf(values());
    std::vector<SampleFile> samples;
    samples.push_back({"one.nhdr",
                       "NRRD0005\ntype: short\ndimension: 3\nsizes: 5 6 7\nspacings: 1 2 3\nendian: little\n"
                       "encoding: raw\nbyte skip: 4\ndata file: one.raw\n",
                       1,
                       {{"one.raw", "SKIP" + raw}}});
    samples.push_back({"list.nhdr",
                       "NRRD0005\ntype: short\ndimension: 3\nsizes: 5 6 7\nendian: little\n"
                       "encoding: gzip\ndata file: LIST\na.gz\nb.gz\nc.gz\nd.gz\ne.gz\nf.gz\ng.gz\n",
                       1,
                       {}});
    for (int slice = 0; slice < 7; ++slice)
        samples.back().beside.emplace_back("abcdefg"s.substr(static_cast<std::size_t>(slice), 1) + ".gz",
                                           gzipped(raw.substr(static_cast<std::size_t>(slice) * 60, 60)));
    samples.push_back({"one.mhd",
                       "ObjectType = Image\nNDims = 3\nDimSize = 5 6 7\nElementSpacing = 1 2 3\n"
                       "ElementType = MET_SHORT\nElementDataFile = voxels.raw\n",
                       1,
                       {{"voxels.raw", raw}}});
    samples.push_back({"pair.hdr", niftiBytes(1, false), 0, {{"pair.img", raw}}});
    samples.push_back({"side.json",
                       R"({"dims": [5, 6, 7], "type": "i16", "spacing": [1, 2, 3], "origin": [4, 5, 6],)"
                       R"( "direction": [1, 0, 0, 0, 1, 0, 0, 0, 1], "file": "side.raw", "skip": 0})",
                       0,
                       {{"side.raw", raw}}});
    return samples;
}

std::vector<SampleFile> furtherSamples() {
    std::vector<SampleFile> samples;
    const std::vector<unsigned char> voxels{7, 7, 7, 7, 1, 2, 3, 4, 5, 6, 7, 7};
    const std::string runs = "6 X\x04\x07\x82\x01\x02\x00"s + "8 X\x84\x03\x04\x05\x06\x02\x07\x00"s;
    samples.push_back({"plain.slc", slcHeader(0) + bytesOf(voxels)});
    samples.push_back({"runs.slc", slcHeader(1) + runs, 1}); // a slice may end without its zero

    const std::string vtk = "# vtk DataFile Version 3.0\na title\n";
    const std::string image = "DATASET STRUCTURED_POINTS\nDIMENSIONS 5 6 7\nSPACING 1 0.5 2\nORIGIN -1 0 4\n"
                              "POINT_DATA 210\nSCALARS density short 1\nLOOKUP_TABLE default\n";
    samples.push_back({"ascii.vtk", vtk + "ASCII\n" + image + decimals("", "\n"), 6});
    samples.push_back({"binary.vtk", vtk + "BINARY\n" + image + bytesOf(values(), true) + "\n", 1});

    const auto cube = cubeMesh(1.0);
    samples.push_back({"text.ply", textPly(cube), 1});
    samples.push_back({"little.ply", binaryPly(cube, false)});
    samples.push_back({"big.ply", binaryPly(cube, true)});
    samples.push_back({"text.stl", textStl(cube), 14});
    samples.push_back({"binary.stl", binaryStl(cube)});
    samples.push_back({"cube.obj", obj(cube), 4});
    return samples;
}

std::vector<SampleFile> tiffSamples(const std::filesystem::path& scratch) {
    std::vector<SampleFile> samples;
    // Every process that lists these tests writes it.
    const auto path = scratch / ("voxsheet_sample_" + std::to_string(getpid()) + ".tif");
    for (const auto& [name, compression] :
         {std::pair{"plain.tif", COMPRESSION_NONE}, std::pair{"deflate.tif", COMPRESSION_ADOBE_DEFLATE}}) {
        TiffPageOptions page;
        page.width = 5;
        page.height = 6;
        page.compression = compression;
        writeTiff(path, page, 7, values());
        samples.push_back({name, contentsOf(path)});
    }
    std::filesystem::remove(path);
    return samples;
}

std::vector<SampleFile> allSamples(const std::filesystem::path& scratch) {
    auto samples = volumeSamples();
    for (auto&& more : {detachedSamples(), furtherSamples(), tiffSamples(scratch)})
        samples.insert(samples.end(), more.begin(), more.end());
    return samples;
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
    const auto at = text.find(from);
    if (at == std::string::npos) throw std::logic_error("the sample does not hold '" + from + "'");
    return text.replace(at, from.size(), to);
}

} // namespace voxsheet::import::testing
