#include "mutants.h"

#include "nifti_bytes.h"
#include "packed_bytes.h"
#include "tiff_mutants.h"

#include <cmath>
#include <cstdint>
#include <limits>

namespace voxsheet::import::testing {

namespace {

using namespace std::string_literals;

constexpr std::size_t kCuts = 16;

/// Replaces one piece of the text by each of several.
class TextLies {
public:
    explicit TextLies(const SampleFile& sample) : sample_(sample) {}

    TextLies& in(const std::string& from, const std::vector<std::string>& to) {
        for (const auto& each : to) {
            Mutant mutant{"'" + from + "' became '" + each.substr(0, 60) + "'", sample_, false};
            mutant.file.bytes = replaced(sample_.bytes, from, each);
            mutants_.push_back(std::move(mutant));
        }
        return *this;
    }

    TextLies& bytesAt(std::size_t at, const std::string& what, const std::string& bytes) {
        Mutant mutant{what, sample_, false};
        mutant.file.bytes.replace(at, bytes.size(), bytes);
        mutants_.push_back(std::move(mutant));
        return *this;
    }

    [[nodiscard]] bool canSay(const std::string& text) const {
        return sample_.bytes.find(text) != std::string::npos;
    }
    [[nodiscard]] std::vector<Mutant> all() const { return mutants_; }

private:
    const SampleFile& sample_;
    std::vector<Mutant> mutants_;
};

const std::vector<std::string> kBadCounts{"-5", "0", "99999999999999999999", "18446744073709551615", "nan"};

/// "A 5 B" with each bad count in the 5's place, and sizes that only together are too large.
std::vector<std::string> badSizes(const std::string& before, const std::string& after) {
    std::vector<std::string> all;
    for (const auto& count : kBadCounts)
        all.push_back(before + count + " 6 7" + after);
    for (const auto* sizes :
         {"1000 1000 1000", "2147483647 2147483647 2147483647", "65536 65536 4294967296", "5 6", "5 6 8"})
        all.push_back(before + sizes + after);
    return all;
}

std::vector<Mutant> nrrdLies(const SampleFile& sample) {
    TextLies lies(sample);
    lies.in("sizes: 5 6 7", badSizes("sizes: ", ""))
        .in("dimension: 3",
            {"dimension: -3", "dimension: 0", "dimension: 17", "dimension: 99999999999999999999"})
        .in("type: short", {"type: block", "type: shrt"})
        .in("(1,0,0) (0,2,0) (0,0.5,3)",
            {"(nan,0,0) (0,2,0) (0,0.5,3)", "(1,0,0) (2,0,0) (0,0.5,3)", "(0,0,0) (0,2,0) (0,0.5,3)",
             "(1e308,0,0) (0,1e308,0) (0,0,1e308)", "(1,0,0) (0,2,0)", "(1,0,0"})
        .in("encoding: ", {"encoding: zip", "byte skip: -5\nencoding: ", "byte skip: 99999999999\nencoding: ",
                           "line skip: 99999999\nencoding: ", "data file: ../../secret.raw\nencoding: "});
    if (sample.name != "ascii.nrrd") lies.in("type: short", {"type: double"});
    return lies.all();
}

std::vector<Mutant> detachedNrrdLies(const SampleFile& sample) {
    TextLies lies(sample);
    lies.in("one.raw", {"../secret.raw", "/etc/passwd", "in/../../secret.raw", "nothing.raw", "one.nhdr", ".",
                        "out", "%d 1 99999999 1", "LIST"})
        .in("byte skip: 4", {"byte skip: -5", "byte skip: 5", "byte skip: 18446744073709551615"})
        .in("spacings: 1 2 3",
            {"spacings: 0 2 3", "spacings: 1 2", "spacings: 1e308 1e308 1e308", "spacings: inf 2 3"});
    return lies.all();
}

std::vector<Mutant> metaImageLies(const SampleFile& sample) {
    TextLies lies(sample);
    lies.in("DimSize = 5 6 7", badSizes("DimSize = ", ""))
        .in("NDims = 3", {"NDims = -3", "NDims = 0", "NDims = 99999999999"})
        .in("ElementType = MET_SHORT", {"ElementType = MET_DOUBLE", "ElementType = MET_NONE"})
        .in("ElementSpacing = 1 2 3",
            {"ElementSpacing = nan 2 3", "ElementSpacing = 0 2 3", "ElementSpacing = 1 2 inf"});
    if (lies.canSay("TransformMatrix"))
        lies.in("1 0 0 0 1 0 0 0 1", {"1 0 0 1 0 0 0 0 1", "0 0 0 0 0 0 0 0 0", "nan 0 0 0 1 0 0 0 1"});
    if (lies.canSay("CompressedData"))
        lies.in("CompressedData = True", {"CompressedDataSize = 99999999999999\nCompressedData = True",
                                          "CompressedDataSize = -1\nCompressedData = True"});
    if (!sample.beside.empty())
        lies.in("voxels.raw",
                {"../secret.raw", "/etc/passwd", "LIST", "%d.raw 1 99999999 1", "out", "one.mhd"});
    return lies.all();
}

std::vector<Mutant> niftiLies(const SampleFile& sample) {
    const int version =
        sample.bytes[0] == '\x5c' ? 1 : 2; // 348, little-endian; ours of version 2 are big-endian
    TextLies lies(sample);
    const auto lie = [&](const std::string& what, std::size_t at1, std::size_t at2, auto value1,
                         auto value2) {
        version == 1 ? lies.bytesAt(at1, what, bytesOf(std::vector{value1}))
                     : lies.bytesAt(at2, what, bytesOf(std::vector{value2}, true));
    };
    const auto real = [&](const std::string& what, std::size_t at1, std::size_t at2, double value) {
        lie(what, at1, at2, static_cast<float>(value), value);
    };
    constexpr double nan = std::numeric_limits<double>::quiet_NaN();
    constexpr auto huge = std::numeric_limits<std::int64_t>::max();
    lie("a size below zero", 42, 24, std::int16_t{-5}, std::int64_t{-5});
    lie("a size of zero", 42, 24, std::int16_t{0}, std::int64_t{0});
    lie("the largest size", 42, 24, std::int16_t{32767}, huge);
    lie("no dimensions", 40, 16, std::int16_t{0}, std::int64_t{0});
    lie("nine dimensions", 40, 16, std::int16_t{9}, std::int64_t{9});
    lie("a type that is none", 70, 12, std::int16_t{3}, std::int16_t{3});
    lie("a wider type", 70, 12, std::int16_t{64}, std::int16_t{64});
    lie("a header of another length", 0, 0, std::int32_t{349}, std::int32_t{541});
    lie("voxels before the file", 108, 168, -1.0F, std::int64_t{-1});
    lie("voxels beyond the file", 108, 168, 1e30F, huge);
    lie("voxels nowhere", 108, 168, static_cast<float>(nan), std::numeric_limits<std::int64_t>::min());
    real("an axis that is no number", 280, 400, nan);
    real("an axis of no length", 280, 400, 0.0);
    real("an endless origin", 292, 424, std::numeric_limits<double>::infinity());
    return lies.all();
}

std::vector<Mutant> chgcarLies(const SampleFile& sample) {
    TextLies lies(sample);
    lies.in(" 5 6 7\n", badSizes(" ", "\n"))
        .in(" 1.0\n", {" nan\n", " 0\n", " 1e308\n"})
        .in(" 0 3 0\n", {" 2 0 0\n", " 0 0 0\n", " 0 inf 0\n"})
        .in(" 1 1\nDirect", {" -1 1\nDirect", " 1 99999999999\nDirect", " 4000000 4000000\nDirect"})
        .in("E+03", {"E+03x", "E+999"});
    return lies.all();
}

std::vector<Mutant> cubeLies(const SampleFile& sample) {
    TextLies lies(sample);
    lies.in(" 5 1 0 0\n", {" 0 1 0 0\n", " 99999999999999999999 1 0 0\n", " 1000000 1 0 0\n", " 6 1 0 0\n",
                           " 5 nan 0 0\n", " 5 0 1 0\n", " 5 0 0 0\n", " 2147483647 1 0 0\n"})
        .in("   -2 0 0 0\n", {"   -99999999999 0 0 0\n", "   2 0 0 0\n", "   -3 0 0 0\n", "   -2 inf 0 0\n"})
        .in("   2   4   5\n", {"   3   4   5\n", "   -2   4   5\n", "   99999999   4   5\n"});
    return lies.all();
}

std::vector<Mutant> xsfLies(const SampleFile& sample) {
    TextLies lies(sample);
    lies.in(" 5 6 7\n", badSizes(" ", "\n"))
        .in(" 0 0 0\n 2 0 0\n 0 3 0\n",
            {" 0 0 0\n 2 0 0\n 2 0 0\n", " 0 0 0\n nan 0 0\n 0 3 0\n", " 0 0 0\n 0 0 0\n 0 3 0\n"})
        .in(" 2 1\n", {" -2 1\n", " 99999999999 1\n", " 3 1\n"})
        .in("END_DATAGRID_3D", {"1 2 3\nEND_DATAGRID_3D", "BEGIN_DATAGRID_3D_x\n 9999 9999 9999\n"});
    return lies.all();
}

std::vector<Mutant> slcLies(const SampleFile& sample) {
    TextLies lies(sample);
    lies.in("3 2 2 8", {"-3 2 2 8", "3 2 99999999999 8", "2147483647 2147483647 2147483647 8", "0 2 2 8",
                        "3 2 3 8", "3 2 2 16"})
        .in("1.0 0.5 2.000000", {"nan 0.5 2.000000", "0 0.5 2.000000"})
        .in("2 1 X", {"-2 1 X", "65535 65535 X", "2 1 Y"});
    if (sample.name == "runs.slc")
        lies.in("6 X", {"-6 X", "99999999 X", "7 X", "5 X", "0 X"})
            .in("8 X", {"9 X", "2 X"})
            .in("\x82\x01\x02"s, {"\xff\x01\x02"s, "\x7f\x01\x02"s});
    return lies.all();
}

std::vector<Mutant> vtkLies(const SampleFile& sample) {
    TextLies lies(sample);
    lies.in("DIMENSIONS 5 6 7", badSizes("DIMENSIONS ", ""))
        .in("SPACING 1 0.5 2", {"SPACING nan 0.5 2", "SPACING 0 0.5 2", "SPACING 1 0.5"})
        .in("ORIGIN -1 0 4", {"ORIGIN inf 0 4"})
        .in("POINT_DATA 210", {"POINT_DATA 211", "POINT_DATA -210", "POINT_DATA 99999999999999999999"})
        .in("SCALARS density short 1", {"SCALARS density double 4", "SCALARS density short -1",
                                        "SCALARS density short 99999999", "SCALARS density"});
    return lies.all();
}

std::vector<Mutant> meshLies(const SampleFile& sample) {
    TextLies lies(sample);
    if (lies.canSay("element vertex 8"))
        lies.in("element vertex 8", {"element vertex -8", "element vertex 4000000000",
                                     "element vertex 99999999999999999999", "element vertex 7"})
            .in("element face 12",
                {"element face -12", "element face 4000000000", "element face 13", "element face 0"})
            .in("property list uchar int", {"property list float int", "property list uchar"});
    if (lies.canSay("facet normal"))
        lies.in("vertex -1", {"vertex nan", "vertex", "vertex 1e308", "vertex -1 5"})
            .in("endfacet", {"", "endloop"});
    if (lies.canSay("//1"))
        lies.in("f 1//1", {"f 99999999999//1", "f 0//1", "f -9//1", "f 9//1"})
            .in("v -1 -1 -1", {"v nan -1 -1", "v -1 -1", "v -1 -1 1e308"});
    if (sample.name == "binary.stl")
        for (const std::uint32_t triangles : {0U, 13U, 4000000000U, 0xffffffffU})
            lies.bytesAt(80, std::to_string(triangles) + " triangles", bytesOf(std::vector{triangles}));
    return lies.all();
}

std::vector<Mutant> sidecarLies(const SampleFile& sample) {
    TextLies lies(sample);
    lies.in("[5, 6, 7]", {"[-5, 6, 7]", "[0, 6, 7]", "[99999999999999999999, 6, 7]", "[1e308, 6, 7]",
                          "[5.5, 6, 7]", "[2147483647, 2147483647, 2147483647]", "[5, 6, 8]", "[5, 6]",
                          "null", "{}", std::string(200000, '[')})
        .in(R"("i16")", {R"("f64")", R"("i17")", "16"})
        .in("[1, 2, 3]", {"[0, 2, 3]", "[1e400, 2, 3]", "[1, NaN, 3]", "[1, null, 3]"})
        .in("[1, 0, 0, 0, 1, 0, 0, 0, 1]",
            {"[1, 0, 0, 1, 0, 0, 0, 0, 1]", "[0, 0, 0, 0, 0, 0, 0, 0, 0]", "[1, 0, 0]"})
        .in("side.raw", {"../secret.raw", "/etc/passwd", "out", "side.json"})
        .in(R"("skip": 0)", {R"("skip": -5)", R"("skip": 1)", R"("skip": 18446744073709551615)"});
    return lies.all();
}

Mutant bomb(const std::string& what, const std::string& name, std::string bytes) {
    return {what, {name, std::move(bytes), 0, {}}, false};
}

/// 120 blocks of 1 MiB, of whose last one half is missing.
Mutant vtiBomb() {
    constexpr std::uint32_t blocks = 120;
    const auto block = zlibbed(std::string(1U << 20, '\0'));
    std::vector<std::uint32_t> lengths{blocks, 1U << 20, 0};
    std::string data;
    for (std::uint32_t i = 0; i < blocks; ++i) {
        const auto part = i + 1 < blocks ? block : block.substr(0, block.size() / 2);
        lengths.push_back(static_cast<std::uint32_t>(part.size()));
        data += part;
    }
    return bomb(
        "cut off at its end", "blocks.vti",
        "<VTKFile type=\"ImageData\" version=\"0.1\" byte_order=\"LittleEndian\" "
        "compressor=\"vtkZLibDataCompressor\">\n<ImageData WholeExtent=\"0 1023 0 1023 0 119\" Origin=\"0 0 "
        "0\" Spacing=\"1 1 1\">\n<Piece Extent=\"0 1023 0 1023 0 119\"><PointData><DataArray "
        "type=\"UInt8\" Name=\"v\" format=\"appended\" offset=\"0\"/></PointData></Piece></ImageData>\n"
        "<AppendedData encoding=\"raw\">\n_" +
            bytesOf(lengths) + data + "\n</AppendedData>\n</VTKFile>\n");
}

} // namespace

std::vector<Mutant> truncations(const SampleFile& sample) {
    std::vector<Mutant> mutants;
    const auto cut = [&](std::size_t length, bool mayBeWhole) {
        Mutant mutant{"cut at " + std::to_string(length), sample, mayBeWhole};
        mutant.file.bytes.resize(length);
        mutants.push_back(std::move(mutant));
    };
    const auto counts = sample.bytes.size() - sample.mayMiss;
    for (std::size_t part = 0; part < kCuts; ++part)
        cut(counts * part / kCuts, true);
    cut(counts - 1, false);
    if (sample.beside.empty()) return mutants;
    const auto& [name, bytes] = sample.beside.front();
    for (std::size_t part = 0; part <= kCuts; ++part) {
        const auto length = std::min(bytes.size() * part / kCuts, bytes.size() - 1);
        Mutant mutant{"its " + name + " cut at " + std::to_string(length), sample, false};
        mutant.file.beside.front().second.resize(length);
        mutants.push_back(std::move(mutant));
    }
    return mutants;
}

std::vector<Mutant> lies(const SampleFile& sample) {
    const auto& name = sample.name;
    if (name == "raw.nrrd" || name == "ascii.nrrd" || name == "gzip.nrrd") return nrrdLies(sample);
    if (name == "one.nhdr") return detachedNrrdLies(sample);
    if (name.ends_with(".mha") || name.ends_with(".mhd")) return metaImageLies(sample);
    if (name.ends_with(".nii") || name == "pair.hdr") return niftiLies(sample);
    if (name == "CHGCAR") return chgcarLies(sample);
    if (name.ends_with(".cube")) return cubeLies(sample);
    if (name.ends_with(".xsf")) return xsfLies(sample);
    if (name.ends_with(".slc")) return slcLies(sample);
    if (name.ends_with(".vtk")) return vtkLies(sample);
    if (name.ends_with(".ply") || name.ends_with(".stl") || name.ends_with(".obj")) return meshLies(sample);
    if (name.ends_with(".json")) return sidecarLies(sample);
    if (name.ends_with(".tif")) return tiffLies(sample);
    return {}; // the same headers, encoded otherwise
}

std::vector<Mutant> bombs() {
    const std::string zeros(1U << 20, '\0');
    const std::string blanks(1U << 20, ' ');
    constexpr std::size_t megabytes = 120;
    const auto nrrd = [](const std::string& sizes, const std::string& encoding) {
        return "NRRD0004\ntype: uint8\ndimension: 3\nsizes: " + sizes + "\nencoding: " + encoding + "\n\n";
    };
    // Noise first: what the file could hold is then more than what it holds.
    const auto noise = bytesOf(ramp<std::uint32_t>(100000));
    const auto gzippedZeros = gzipBomb(noise, zeros, megabytes);
    auto wrongSum = gzipBomb({}, zeros, megabytes);
    wrongSum[wrongSum.size() - 8] = static_cast<char>(wrongSum[wrongSum.size() - 8] ^ 1);
    const auto sizes = "1024 1024 " + std::to_string(megabytes + 1);

    std::vector<Mutant> all;
    all.push_back(bomb("more than said", "more.nrrd", nrrd("64 64 64", "gzip") + gzippedZeros));
    all.push_back(bomb("less than said", "less.nrrd", nrrd(sizes, "gzip") + gzippedZeros));
    all.push_back(bomb("damaged at the end", "sum.nrrd", nrrd("1024 1024 120", "gzip") + wrongSum));
    all.push_back(
        bomb("beyond what it can hold", "beyond.nrrd", nrrd("1024 1024 4000", "gzip") + gzippedZeros));
    std::string bzippedZeros;
    for (int stream = 0; stream < 50; ++stream)
        bzippedZeros += bzipped(zeros);
    all.push_back(bomb("bzip2", "less.bz2.nrrd", nrrd("1000 1000 100", "bzip2") + bzippedZeros));
    all.push_back(bomb("zlib", "less.mha",
                       "NDims = 3\nDimSize = " + sizes +
                           "\nElementType = MET_UCHAR\nCompressedData = True\nElementDataFile = LOCAL\n" +
                           deflated(noise, zeros, megabytes, 15)));
    NiftiBytes nifti(1, false, {1024, 1024, megabytes + 1}, 2);
    all.push_back(bomb("NIfTI", "less.nii.gz", gzipBomb(nifti.with(noise), zeros, megabytes)));

    const std::string chgcar = "x\n1\n1 0 0\n0 1 0\n0 0 1\nH\n1\nDirect\n0 0 0\n\n";
    const std::string xsf =
        "BEGIN_BLOCK_DATAGRID_3D\nx\nBEGIN_DATAGRID_3D\n300 300 300\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n";
    const std::string cube = "x\ny\n0 0 0 0\n250 1 0 0\n250 0 1 0\n250 0 0 1\n";
    std::string ones;
    while (ones.size() < 100000)
        ones += "1 ";
    all.push_back(bomb("blanks", "CHGCAR", gzipBomb(chgcar + "9 9 9\n", blanks, megabytes)));
    all.push_back(bomb("too few values", "LOCPOT.gz", gzipBomb(chgcar + "250 250 250\n", ones, 312)));
    all.push_back(bomb("blanks", "blanks.xsf.gz", gzipBomb(xsf, blanks, megabytes)));
    all.push_back(bomb("comments", "comments.xsf.gz",
                       gzipBomb({}, "# nothing\n" + std::string(50000, '#') + "\n", 2000)));
    all.push_back(
        bomb("an endless line", "line.cube.gz", gzipBomb("x\n", std::string(1U << 20, 'x'), megabytes)));
    all.push_back(bomb("too few values", "few.cube.gz", gzipBomb(cube, ones, 312)));
    all.push_back(bomb("blanks", "blanks.cube.gz", gzipBomb(cube, blanks, megabytes)));
    all.push_back(vtiBomb());
    for (auto&& each : tiffBombs(std::filesystem::temp_directory_path()))
        all.push_back(std::move(each));
    return all;
}

} // namespace voxsheet::import::testing
