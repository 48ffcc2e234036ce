#include "vtk_fixture.h"

namespace voxsheet::import::testing {
namespace {

using VtkLegacy = FormatsTest;

const std::string kTop = "# vtk DataFile Version 3.0\na title\n";
const std::string kImage = "DATASET STRUCTURED_POINTS\nDIMENSIONS 3 2 2\nSPACING 1 0.5 2\nORIGIN -1 0 4\n";

TEST_F(VtkLegacy, AsciiScalars) {
    const auto file = write("a.vtk", kTop + "ASCII\n" + kImage +
                                         "POINT_DATA 12\nSCALARS density float 1\nLOOKUP_TABLE default\n"
                                         "0 1 2\n3 4 5 6 7 8 9\n10 1.1e1\n");
    const auto loaded = loadAny(file);
    EXPECT_EQ(loaded.meta().format, "vtk");
    EXPECT_EQ(loaded.meta().fields[0].name, "density");
    EXPECT_EQ(loaded.meta().grid.dims, glm::ivec3(3, 2, 2));
    EXPECT_EQ(spacingWorld(loaded.meta().grid), glm::dvec3(1, 0.5, 2));
    EXPECT_EQ(glm::dvec3(loaded.meta().grid.worldFromIndex[3]), glm::dvec3(-1, 0, 4));
    EXPECT_EQ(loaded.meta().grid.centring, Centring::Point);
    EXPECT_EQ(loaded.values<float>(), (std::vector<float>{0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11}));
}

template <typename T>
std::vector<T> counted(std::size_t n, T first) {
    std::vector<T> values(n);
    for (std::size_t i = 0; i < n; ++i)
        values[i] = static_cast<T>(first + static_cast<T>(i));
    return values;
}

template <typename T>
void binaryRoundTrip(const fs::path& file, ScalarType type, T first) {
    const auto loaded = loadAny(file);
    EXPECT_EQ(loaded.meta().sourceType, type);
    EXPECT_EQ(loaded.values<T>(), counted<T>(12, first));
}

TEST_F(VtkLegacy, EveryBinaryType) {
    const auto make = [&](const std::string& type, const std::string& bytes) {
        return write(type + ".vtk", kTop + "BINARY\n" + kImage + "POINT_DATA 12\nSCALARS s " + type +
                                        "\nLOOKUP_TABLE default\n" + bytes + "\n");
    };
    binaryRoundTrip<unsigned char>(make("unsigned_char", bigEndian(counted<unsigned char>(12, 240))),
                                   ScalarType::U8, 240);
    binaryRoundTrip<signed char>(make("char", bigEndian(counted<signed char>(12, -5))), ScalarType::I8, -5);
    binaryRoundTrip<unsigned short>(make("unsigned_short", bigEndian(counted<unsigned short>(12, 65000))),
                                    ScalarType::U16, 65000);
    binaryRoundTrip<short>(make("short", bigEndian(counted<short>(12, -300))), ScalarType::I16, -300);
    binaryRoundTrip<unsigned int>(make("unsigned_int", bigEndian(counted<unsigned int>(12, 4000000000U))),
                                  ScalarType::U32, 4000000000U);
    binaryRoundTrip<int>(make("int", bigEndian(counted<int>(12, -70000))), ScalarType::I32, -70000);
    binaryRoundTrip<long>(make("long", bigEndian(counted<long>(12, -1L << 40))), ScalarType::I64, -1L << 40);
    binaryRoundTrip<int>(make("vtkIdType", bigEndian(counted<int>(12, 3))), ScalarType::I32, 3);
    binaryRoundTrip<float>(make("float", bigEndian(counted<float>(12, 0.5F))), ScalarType::F32, 0.5F);
    binaryRoundTrip<double>(make("double", bigEndian(counted<double>(12, -0.25))), ScalarType::F64, -0.25);
}

TEST_F(VtkLegacy, ManyArraysBecomeFields) {
    const auto file = write(
        "a.vtk",
        kTop + "BINARY\n" + kImage + "FIELD FieldData 1\nTIME 1 1 double\n" + bigEndian<double>({3.5}) +
            "\nPOINT_DATA 12\nSCALARS a%20b unsigned_char 2\nLOOKUP_TABLE t\n" +
            bigEndian(counted<unsigned char>(24, 0)) + "\nLOOKUP_TABLE t 2\n" + std::string(8, '\7') +
            "\nVECTORS velocity float\n" + bigEndian(counted<float>(36, 100)) +
            "\nMETADATA\nINFORMATION 0\n\nFIELD more 2\nx 1 12 short\n" + bigEndian(counted<short>(12, 7)) +
            "\nMETADATA\nINFORMATION 0\n\nx 1 12 short\n" + bigEndian(counted<short>(12, 8)) + "\n");
    const auto loaded = loadAny(file);
    std::vector<std::string> names;
    for (const auto& field : loaded.meta().fields)
        names.push_back(field.name);
    EXPECT_EQ(names, (std::vector<std::string>{"a b 1", "a b 2", "velocity x", "velocity y", "velocity z",
                                               "x", "x (2)"}));
    EXPECT_EQ(loaded.values<unsigned char>(1)[3], 7);
    EXPECT_EQ(loaded.values<float>(4)[2], 108.0F);
    EXPECT_EQ(loaded.values<short>(6)[0], 8);
}

TEST_F(VtkLegacy, CellDataSitHalfAVoxelIn) {
    const auto file = write("a.vtk", kTop + "ASCII\n" + kImage +
                                         "CELL_DATA 2\nSCALARS c int 1\nLOOKUP_TABLE default\n5 6\n");
    const auto loaded = loadAny(file);
    EXPECT_EQ(loaded.meta().grid.dims, glm::ivec3(2, 1, 1));
    EXPECT_EQ(loaded.meta().grid.centring, Centring::Cell);
    EXPECT_EQ(glm::dvec3(loaded.meta().grid.worldFromIndex[3]), glm::dvec3(-0.5, 0.25, 5));
    EXPECT_EQ(loaded.values<int>(), (std::vector<int>{5, 6}));
}

TEST_F(VtkLegacy, PointDataWinOverCellData) {
    const auto file = write(
        "a.vtk", kTop + "ASCII\n" + kImage +
                     "CELL_DATA 2\nSCALARS c int 1\nLOOKUP_TABLE default\n5 6\n"
                     "POINT_DATA 12\nSCALARS p int 1\nLOOKUP_TABLE default\n1 2 3 4 5 6 7 8 9 10 11 12\n");
    const auto loaded = loadAny(file);
    ASSERT_EQ(loaded.meta().fields.size(), 1U);
    EXPECT_EQ(loaded.meta().fields[0].name, "p");
    EXPECT_EQ(loaded.meta().notes.size(), 1U);
}

TEST_F(VtkLegacy, LiesAreNamed) {
    const std::string scalars = "SCALARS s int 1\nLOOKUP_TABLE default\n1 2 3 4 5 6 7 8 9 10 11 12\n";
    const auto bad = [&](const std::string& rest) { return sentenceOf(write("bad.vtk", kTop + rest)); };
    EXPECT_NE(bad("ASCII\n" + kImage + "POINT_DATA 13\n" + scalars).find("12"), std::string::npos);
    (void)bad("TEXT\n" + kImage + "POINT_DATA 12\n" + scalars);
    (void)bad("ASCII\nDATASET STRUCTURED_POINTS\nDIMENSIONS 3 2 -2\n");
    (void)bad("ASCII\nDATASET STRUCTURED_POINTS\nDIMENSIONS 3 2\n");
    (void)bad("ASCII\nDATASET STRUCTURED_POINTS\nDIMENSIONS 99999999999 1 1\n");
    (void)bad("ASCII\nDATASET STRUCTURED_POINTS\nDIMENSIONS 16000000 16000000 16000000\nPOINT_DATA 0\n");
    (void)bad("ASCII\nDATASET STRUCTURED_POINTS\nDIMENSIONS 3 2 2\nSPACING 0 1 1\nPOINT_DATA 12\n" + scalars);
    (void)bad("ASCII\nDATASET STRUCTURED_POINTS\nDIMENSIONS 3 2 2\nSPACING nan 1 1\nPOINT_DATA 12\n" +
              scalars);
    (void)bad("ASCII\n" + kImage + "POINT_DATA 12\nSCALARS s complex 1\nLOOKUP_TABLE default\n");
    (void)bad("ASCII\n" + kImage +
              "POINT_DATA 12\nSCALARS s int 1\nLOOKUP_TABLE default\n1 2 3 x 5 6 7 8 9 10 11 12\n");
    (void)bad("ASCII\n" + kImage + "POINT_DATA 12\nFIELD f 1\na 1 999999999999999 float\n1 2 3\n");
    (void)bad("ASCII\n" + kImage + "POINT_DATA 12\nwhatever\n");
    (void)bad("ASCII\n" + kImage);
    (void)bad("ASCII\n" + std::string(100000, 'x'));
    EXPECT_NE(bad("ASCII\nDATASET STRUCTURED_GRID\nDIMENSIONS 3 2 2\n").find("structured_grid"),
              std::string::npos);
    EXPECT_NE(bad("ASCII\nDATASET RECTILINEAR_GRID\nDIMENSIONS 3 2 2\n").find("coordinates"),
              std::string::npos);
}

TEST_F(VtkLegacy, TruncatedAnywhereIsAnError) {
    for (const bool binary : {false, true}) {
        std::string whole = kTop + (binary ? "BINARY\n" : "ASCII\n") + kImage +
                            "POINT_DATA 12\nSCALARS s short 1\nLOOKUP_TABLE default\n";
        whole += binary ? bigEndian(counted<short>(12, 1000)) : "11 12 13 14 15 16 17 18 19 20 21 22";
        (void)loadAny(write("whole.vtk", whole));
        // One byte less may leave "2" of "22": a whole word. From two bytes less on the file is short.
        for (std::size_t keep = 30; keep + 2 <= whole.size(); keep += 3)
            (void)sentenceOf(write("cut.vtk", whole.substr(0, keep)));
        (void)sentenceOf(write("cut.vtk", whole.substr(0, whole.size() - 2)));
    }
}

TEST_F(VtkLegacy, MutationsAreErrorsOrWholeVolumes) {
    std::mt19937 random(42);
    const std::string whole = kTop + "BINARY\n" + kImage +
                              "POINT_DATA 12\nSCALARS s short 1\nLOOKUP_TABLE default\n" +
                              bigEndian(counted<short>(12, 1000)) + "\nFIELD f 1\nb 2 12 float\n" +
                              bigEndian(counted<float>(24, 0)) + "\n";
    for (int round = 0; round < 600; ++round) {
        auto text = whole;
        for (auto changes = 1 + random() % 4; changes > 0; --changes) {
            const auto at = random() % text.size();
            if (random() % 3 == 0)
                text.erase(at, 1 + random() % 5);
            else
                text[at] = static_cast<char>(random() % 3 == 0 ? random() : '0' + random() % 10);
            if (text.empty()) text = "x";
        }
        try {
            (void)loadAny(write("mutant.vtk", text));
        } catch (const Error& error) {
            EXPECT_NE(error.kind(), ErrorKind::Internal) << error.what();
        }
    }
}

TEST_F(VtkLegacy, RealFiles) {
    const fs::path data(VOXSHEET_DATA_DIR);
    if (!fs::exists(data)) GTEST_SKIP() << "the real data are not beside the project";
    const auto iron = loadAny(data / "vol_ironprot/ironProt.vtk");
    EXPECT_EQ(iron.meta().grid.dims, glm::ivec3(68));
    const auto heart = loadAny(data / "vol_heart_mayavi/heart.vtk");
    EXPECT_EQ(heart.meta().grid.dims, glm::ivec3(32, 32, 12));
    EXPECT_EQ(heart.values<float>()[1], 15.0F);
    EXPECT_EQ(loadAny(data / "vtk_encodings/volume_complex.vtk").values<signed char>()[13], 5);
    for (const auto* other : {"cube.vtk", "structured_grid.vtk", "tet_test_binary.vtk"})
        EXPECT_THROW((void)loadAny(data / "vtk_encodings" / other), Unsupported) << other;
}

} // namespace
} // namespace voxsheet::import::testing
