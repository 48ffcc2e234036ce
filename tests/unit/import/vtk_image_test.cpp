// VTK XML images (.vti) in every encoding, written here by hand.
#include "process_fixture.h"
#include "vtk_fixture.h"

namespace voxsheet::import::testing {
namespace {

class VtkImage : public FormatsTest {
protected:
    void SetUp() override {
        FormatsTest::SetUp();
        if (ReaderRegistry().descriptions().find(".vti") == std::string::npos)
            GTEST_SKIP() << "this build is without VTK";
    }
};

std::string base64(const std::string& bytes) {
    constexpr const char* digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
        unsigned bits = 0;
        const auto count = std::min<std::size_t>(3, bytes.size() - i);
        for (std::size_t k = 0; k < 3; ++k)
            bits = (bits << 8U) | (k < count ? static_cast<unsigned char>(bytes[i + k]) : 0U);
        for (std::size_t k = 0; k < 4; ++k)
            text += k <= count ? digits[(bits >> (18 - 6 * k)) & 63U] : '=';
    }
    return text;
}

std::string deflated(const std::string& bytes) {
    auto size = ::compressBound(bytes.size());
    std::string out(size, '\0');
    EXPECT_EQ(::compress(reinterpret_cast<Bytef*>(out.data()), &size,
                         reinterpret_cast<const Bytef*>(bytes.data()), bytes.size()),
              Z_OK);
    out.resize(size);
    return out;
}

struct Encoded {
    std::string lengths;
    std::string data;
};

/// With 32-bit lengths; blocks of 16 bytes when compressed.
Encoded encode(const std::string& bytes, bool compressed) {
    if (!compressed) return {littleEndian<unsigned>({static_cast<unsigned>(bytes.size())}), bytes};
    constexpr std::size_t block = 16;
    std::vector<unsigned> lengths{static_cast<unsigned>((bytes.size() + block - 1) / block), block,
                                  static_cast<unsigned>(bytes.size() % block)};
    std::string data;
    for (std::size_t at = 0; at < bytes.size(); at += block) {
        const auto part = deflated(bytes.substr(at, block));
        lengths.push_back(static_cast<unsigned>(part.size()));
        data += part;
    }
    return {littleEndian(lengths), data};
}

std::string base64Of(const Encoded& encoded, bool compressed) {
    return compressed ? base64(encoded.lengths) + base64(encoded.data)
                      : base64(encoded.lengths + encoded.data);
}

enum class Style { Ascii, Inline, AppendedRaw, AppendedBase64 };

std::string vti(Style style, bool compressed, const std::string& bytes, const std::string& type = "Int16",
                const std::string& ascii = {}) {
    const auto encoded = encode(bytes, compressed);
    std::string array;
    std::string appended;
    if (style == Style::Ascii) array = "format=\"ascii\">\n" + ascii + "\n";
    if (style == Style::Inline) array = "format=\"binary\">\n  " + base64Of(encoded, compressed) + "\n";
    if (style == Style::AppendedRaw || style == Style::AppendedBase64) {
        array = "format=\"appended\" offset=\"0\">";
        const bool raw = style == Style::AppendedRaw;
        appended = std::string("<AppendedData encoding=\"") + (raw ? "raw" : "base64") + "\">\n_" +
                   (raw ? encoded.lengths + encoded.data : base64Of(encoded, compressed)) +
                   "\n</AppendedData>\n";
    }
    return "<?xml version=\"1.0\"?>\n<VTKFile type=\"ImageData\" version=\"0.1\" "
           "byte_order=\"LittleEndian\"" +
           std::string(compressed ? " compressor=\"vtkZLibDataCompressor\"" : "") +
           ">\n<ImageData WholeExtent=\"1 3 0 1 0 1\" Origin=\"10 0 0\" Spacing=\"2 1 0.5\">\n"
           "<Piece Extent=\"1 3 0 1 0 1\">\n<PointData Scalars=\"s\">\n<DataArray type=\"" +
           type + "\" Name=\"s\" " + array +
           "</DataArray>\n</PointData>\n<CellData>\n</CellData>\n</Piece>\n</ImageData>\n" + appended +
           "</VTKFile>\n";
}

const std::vector<short> kSamples{-3, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 3000};
const std::string kText = "-3 1 2 3 4 5\n6 7 8 9 10 3000";

std::vector<std::pair<std::string, std::string>> everyEncoding() {
    const auto bytes = littleEndian(kSamples);
    return {{"ascii", vti(Style::Ascii, false, bytes, "Int16", kText)},
            {"inline", vti(Style::Inline, false, bytes)},
            {"inline zlib", vti(Style::Inline, true, bytes)},
            {"raw", vti(Style::AppendedRaw, false, bytes)},
            {"raw zlib", vti(Style::AppendedRaw, true, bytes)},
            {"base64", vti(Style::AppendedBase64, false, bytes)},
            {"base64 zlib", vti(Style::AppendedBase64, true, bytes)}};
}

TEST_F(VtkImage, EveryEncodingGivesTheSameVolume) {
    for (const auto& [name, text] : everyEncoding()) {
        const auto loaded = loadAny(write("a.vti", text));
        EXPECT_EQ(loaded.meta().format, "vti");
        EXPECT_EQ(loaded.meta().sourceType, ScalarType::I16) << name;
        EXPECT_EQ(loaded.meta().grid.dims, glm::ivec3(3, 2, 2)) << name;
        EXPECT_EQ(spacingWorld(loaded.meta().grid), glm::dvec3(2, 1, 0.5)) << name;
        EXPECT_EQ(glm::dvec3(loaded.meta().grid.worldFromIndex[3]), glm::dvec3(12, 0, 0))
            << name << ": extent from 1";
        EXPECT_EQ(loaded.values<short>(), kSamples) << name;
    }
}

TEST_F(VtkImage, TruncatedAnywhereIsAnErrorOrTheWholeVolume) {
    for (const auto& [name, text] : everyEncoding()) {
        for (std::size_t i = 1; i <= 24; ++i) {
            const auto keep = text.size() * i / 25;
            try {
                const auto loaded = loadAny(write("cut.vti", text.substr(0, keep)));
                EXPECT_EQ(loaded.values<short>(), kSamples) << name << " cut to " << keep;
            } catch (const Error& error) {
                EXPECT_NE(error.kind(), ErrorKind::Internal) << name << ": " << error.what();
            }
        }
    }
}

TEST_F(VtkImage, ShortDataInAWholeDocumentAreAnError) {
    const auto bytes = littleEndian(kSamples);
    const auto cut = bytes.substr(0, bytes.size() - 2);
    for (const auto style : {Style::Inline, Style::AppendedRaw, Style::AppendedBase64})
        for (const bool compressed : {false, true})
            (void)sentenceOf(write("short.vti", vti(style, compressed, cut)));
    (void)sentenceOf(write("short.vti", vti(Style::Ascii, false, bytes, "Int16", "1 2 3 4")));
    (void)sentenceOf(write("long.vti", vti(Style::Ascii, false, bytes, "Int16", kText + " 13")));
    (void)sentenceOf(
        write("word.vti", vti(Style::Ascii, false, bytes, "Int16", "-3 1 2 three 4 5 6 7 8 9 10 3000")));
    (void)sentenceOf(write("range.vti", vti(Style::Ascii, false, bytes, "UInt8", kText)));
    (void)sentenceOf(write("type.vti", vti(Style::Inline, false, bytes, "Float64")));
}

TEST_F(VtkImage, LengthsThatLieAreAnError) {
    const auto whole = vti(Style::AppendedRaw, true, littleEndian(kSamples));
    const auto start = whole.find('_') + 1;
    for (std::size_t integer = 0; integer < 5; ++integer)
        for (const unsigned lie : {0U, 1U, 0x7fffffffU, 0xffffffffU}) {
            auto text = whole;
            text.replace(start + 4 * integer, 4, littleEndian<unsigned>({lie}));
            try {
                const auto loaded = loadAny(write("lie.vti", text));
                EXPECT_EQ(loaded.values<short>(), kSamples) << integer << " " << lie;
            } catch (const Error&) {
            }
        }
    auto damaged = whole;
    damaged[start + 4 * 5 + 6] ^= 0x55; // within the first compressed block
    (void)sentenceOf(write("damaged.vti", damaged));
}

TEST_F(VtkImage, HostileDocumentsAreSentences) {
    const auto replaced = [](std::string text, const std::string& from, const std::string& to) {
        const auto at = text.find(from);
        EXPECT_NE(at, std::string::npos) << from;
        return text.replace(at, from.size(), to);
    };
    const auto good = vti(Style::Ascii, false, {}, "Int16", kText);
    for (const auto& [from, to] : std::vector<std::pair<std::string, std::string>>{
             {"WholeExtent=\"1 3 0 1 0 1\"", "WholeExtent=\"0 2147483647 0 2147483647 0 2147483647\""},
             {"WholeExtent=\"1 3 0 1 0 1\"", "WholeExtent=\"3 1 0 1 0 1\""},
             {"WholeExtent=\"1 3 0 1 0 1\"", ""},
             {"Piece Extent=\"1 3 0 1 0 1\"", "Piece Extent=\"1 2 0 1 0 1\""},
             {"Spacing=\"2 1 0.5\"", "Spacing=\"2 0 0.5\""},
             {"Spacing=\"2 1 0.5\"", "Spacing=\"2 nan 0.5\""},
             {"Spacing=\"2 1 0.5\"", "Direction=\"1 0 0 1 0 0 0 0 1\""},
             {"<?xml version=\"1.0\"?>", "<!DOCTYPE x [<!ENTITY a \"b\">]>"},
             {"type=\"Int16\"", "type=\"Int16\" NumberOfComponents=\"-2\""},
             {"type=\"Int16\"", "type=\"Int16\" NumberOfComponents=\"1000000000\""},
             {"format=\"ascii\"", "format=\"appended\" offset=\"0\""},
             {"format=\"ascii\"", "format=\"binary\""},
             {"type=\"ImageData\"", "type=\"RectilinearGrid\""},
             {"type=\"Int16\"", "type=\"String\""},
             {"</Piece>", ""}})
        (void)sentenceOf(write("bad.vti", replaced(good, from, to)));
}

TEST_F(VtkImage, ComponentsCellsAndDirections) {
    const auto file = write(
        "a.vti", R"(<VTKFile type="ImageData" version="1.0" byte_order="LittleEndian" header_type="UInt64">
<ImageData WholeExtent="0 2 0 1 0 1" Origin="1 2 3" Spacing="2 2 2" Direction="0 -1 0 1 0 0 0 0 1">
<Piece Extent="0 2 0 1 0 1"><PointData/><CellData Vectors="v">
<DataArray type="Float32" Name="v" NumberOfComponents="3" format="ascii">1 2 3 4 5 6</DataArray>
<DataArray type="String" Name="words" format="ascii">1</DataArray>
</CellData></Piece></ImageData></VTKFile>)");
    const auto loaded = loadAny(file);
    const auto& grid = loaded.meta().grid;
    EXPECT_EQ(grid.dims, glm::ivec3(2, 1, 1));
    EXPECT_EQ(grid.centring, Centring::Cell);
    // Row-major direction: the first axis of the image runs along +y, the second along -x.
    EXPECT_EQ(glm::dvec3(grid.worldFromIndex[0]), glm::dvec3(0, 2, 0));
    EXPECT_EQ(glm::dvec3(grid.worldFromIndex[1]), glm::dvec3(-2, 0, 0));
    EXPECT_EQ(glm::dvec3(grid.worldFromIndex[3]), glm::dvec3(0, 3, 4));
    ASSERT_EQ(loaded.meta().fields.size(), 3U);
    EXPECT_EQ(loaded.meta().fields[2].name, "v z");
    EXPECT_EQ(loaded.values<float>(2), (std::vector<float>{3, 6}));
    EXPECT_EQ(loaded.meta().notes.size(), 1U);
}

TEST_F(VtkImage, RealFilesAgreeWithTheirTwins) {
    const fs::path data(VOXSHEET_DATA_DIR);
    if (!fs::exists(data)) GTEST_SKIP() << "the real data are not beside the project";
    EXPECT_EQ(loadAny(data / "vol_heart_mayavi/heart.vti").values<float>(),
              loadAny(data / "vol_heart_mayavi/heart.vtk").values<float>());
    EXPECT_EQ(loadAny(data / "vtk_encodings/volume_complex.vti").values<signed char>(),
              loadAny(data / "vtk_encodings/volume_complex.vtk").values<signed char>());
    const auto vase = loadAny(data / "vol_vase/vase.vti");
    EXPECT_EQ(vase.meta().grid.dims, glm::ivec3(115, 101, 75));
    EXPECT_EQ(vase.values<unsigned char>(),
              loadAny(data / "vol_vase/vase_1comp.vti").values<unsigned char>());
    EXPECT_EQ(loadAny(data / "vol_vase/vase_4comp.vti").meta().fields.size(), 4U);
    for (const auto* other : {"box.vtu", "RectilinearGrid.pvtr", "hexahedron_parallel.pvtu"})
        EXPECT_THROW((void)loadAny(data / "vtk_encodings" / other), Unsupported) << other;
    const auto bytes = [&] {
        std::ifstream file(data / "vol_vase/vase.vti", std::ios::binary);
        return std::string(std::istreambuf_iterator<char>(file), {});
    }();
    for (std::size_t i = 1; i < 16; ++i)
        (void)sentenceOf(write("cut.vti", bytes.substr(0, bytes.size() * i / 16)));
}

} // namespace

/// Mutants go through the child: what VTK does to its heap is its own business.
class VtkImageMutants : public ProcessTest {};

TEST_F(VtkImageMutants, AreOneFailedImportEachOrWholeVolumes) {
    if (ReaderRegistry().descriptions().find(".vti") == std::string::npos)
        GTEST_SKIP() << "this build is without VTK";
    std::mt19937 random(7);
    const auto encodings = testing::everyEncoding();
    for (int round = 0; round < 84; ++round) {
        auto text = encodings[static_cast<std::size_t>(round) % encodings.size()].second;
        for (auto changes = 1 + random() % 3; changes > 0; --changes) {
            const auto at = text.size() / 4 + random() % (text.size() * 3 / 4);
            if (random() % 4 == 0)
                text.erase(at, 1 + random() % 7);
            else
                text[std::min(at, text.size() - 1)] =
                    static_cast<char>(random() % 2 ? random() : '0' + random() % 10);
        }
        const auto start = std::chrono::steady_clock::now();
        try {
            const auto key = import(write("mutant" + std::to_string(round) + ".vti", text));
            EXPECT_NE(store::VolumeStore(settings_.storeFolder).open(key), nullptr);
        } catch (const Error& error) {
            EXPECT_NE(error.kind(), ErrorKind::Internal) << error.what();
        }
        EXPECT_LT(std::chrono::steady_clock::now() - start,
                  std::chrono::duration<double>(5.0 * fields::patience()));
    }
}

} // namespace voxsheet::import::testing
