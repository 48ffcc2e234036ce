#include "formats_fixture.h"

#include <cmath>

namespace voxsheet::import::testing {
namespace {

class FormatsNrrd : public FormatsTest {
protected:
    /// An attached file of 2x3x4 (or other) samples.
    fs::path attached(const std::string& fields, std::string_view data, const std::string& sizes = "2 3 4",
                      const std::string& dimension = "3") const {
        return write("x.nrrd", "NRRD0005\n# comment\ndimension: " + dimension + "\nsizes: " + sizes + "\n" +
                                   fields + "note:=a key/value pair\n\n" + std::string(data));
    }

    template <typename T>
    void roundTrip(const std::string& type) {
        const auto values = ramp<T>(24);
        for (const bool big : {false, true}) {
            const std::string fields =
                "type: " + type + "\nendian: " + (big ? "big" : "little") + "\nencoding: ";
            const auto raw = bytesOf(values, big);
            EXPECT_EQ(load(attached(fields + "raw\n", raw)).template values<T>(), values) << type;
            EXPECT_EQ(load(attached(fields + "gzip\n", gzipped(raw))).template values<T>(), values) << type;
            EXPECT_EQ(load(attached(fields + "bz2\n", bzipped(raw))).template values<T>(), values) << type;
            EXPECT_EQ(load(attached(fields + "hex\n", hex(raw))).template values<T>(), values) << type;
        }
        std::string text;
        for (const auto value : values)
            text += std::to_string(value) + (text.size() % 7 == 0 ? ",\n" : " ");
        EXPECT_EQ(load(attached("type: " + type + "\nencoding: ascii\n", text)).template values<T>(), values)
            << type;
    }

    static std::string hex(const std::string& raw) {
        std::string text;
        for (const char byte : raw) {
            static constexpr const char* digits = "0123456789abcdEF";
            text += digits[static_cast<unsigned char>(byte) >> 4];
            text += digits[static_cast<unsigned char>(byte) & 15];
            if (text.size() % 31 == 0) text += '\n';
        }
        return text;
    }
};

TEST_F(FormatsNrrd, ReadsEveryTypeEncodingAndByteOrder) {
    roundTrip<signed char>("int8");
    roundTrip<unsigned char>("uchar");
    roundTrip<short>("signed short int");
    roundTrip<unsigned short>("ushort");
    roundTrip<int>("int");
    roundTrip<unsigned>("uint32_t");
    roundTrip<long>("long long int");
    roundTrip<unsigned long>("unsigned long long");
    roundTrip<float>("float");
    roundTrip<double>("double");
}

TEST_F(FormatsNrrd, ReadsDetachedData) {
    const auto values = ramp<short>(24);
    const auto raw = bytesOf(values);
    const std::string fields = "NRRD0004\ntype: short\ndimension: 3\nsizes: 2 3 4\nendian: little\n";
    write("v.raw", raw);
    EXPECT_EQ(load(write("a.nhdr", fields + "encoding: raw\ndata file: v.raw\n")).values<short>(), values);
    EXPECT_EQ(load(write("b.nhdr", fields + "encoding: raw\ndatafile: ./v.raw")).values<short>(), values);

    write("skip.raw", "two\nlines\nAB" + raw);
    EXPECT_EQ(
        load(write("c.nhdr", fields + "encoding: raw\nline skip: 2\nbyte skip: 2\ndata file: skip.raw\n"))
            .values<short>(),
        values);
    EXPECT_EQ(
        load(write("d.nhdr", fields + "encoding: raw\nbyteskip: -1\ndata file: skip.raw\n")).values<short>(),
        values);

    write("skip.gz", "two\nlines\n" + gzipped("ABC" + raw));
    EXPECT_EQ(load(write("e.nhdr", fields + "encoding: gz\nlineskip: 2\nbyte skip: 3\ndata file: skip.gz\n"))
                  .values<short>(),
              values);
    EXPECT_EQ(
        load(write("f.nhdr", fields + "encoding: gz\nline skip: 2\nbyte skip: -1\ndata file: skip.gz\n"))
            .values<short>(),
        values);
}

TEST_F(FormatsNrrd, ReadsListsAndPatternsOfFiles) {
    const auto values = ramp<short>(24);
    const auto raw = bytesOf(values);
    for (int slice = 0; slice < 4; ++slice)
        write("s" + std::to_string(slice + 8) + ".raw", raw.substr(static_cast<std::size_t>(slice) * 12, 12));
    const std::string fields =
        "NRRD0004\ntype: short\ndimension: 3\nsizes: 2 3 4\nendian: little\nencoding: raw\n";
    const auto pattern = load(write("p.nhdr", fields + "data file: s%d.raw 8 11 1\n"));
    EXPECT_EQ(pattern.values<short>(), values);
    EXPECT_EQ(pattern.header.files.size(), 5U);
    EXPECT_EQ(load(write("l.nhdr", fields + "data file: LIST 2\ns8.raw\ns9.raw\ns10.raw\ns11.raw\n"))
                  .values<short>(),
              values);
    expectMentions(loadError(write("m.nhdr", fields + "data file: s%d.raw 8 12 1\n")), "missing");
    expectMentions(loadError(write("n.nhdr", fields + "data file: LIST\ns8.raw\ns9.raw\ns10.raw\n")),
                   "holds only 12 bytes");
    EXPECT_FALSE(loadError(write("o.nhdr", fields + "data file: LIST\n")).empty());
}

TEST_F(FormatsNrrd, PlacesSpacesInRas) {
    const std::string fields = "type: uchar\nencoding: raw\nspace directions: (2,0,0) (0,0,3) (0,4,0)\nspace "
                               "origin: (10,20,30)\nspace: ";
    const auto data = bytesOf(ramp<unsigned char>(24));
    const auto origin = [&](const std::string& space) {
        return glm::dvec3(load(attached(fields + space + "\n", data)).meta().grid.worldFromIndex[3]);
    };
    EXPECT_EQ(origin("right-anterior-superior"), glm::dvec3(10, 20, 30));
    EXPECT_EQ(origin("RAS"), glm::dvec3(10, 20, 30));
    EXPECT_EQ(origin("left-posterior-superior"), glm::dvec3(-10, -20, 30));
    EXPECT_EQ(origin("LAS"), glm::dvec3(-10, 20, 30));
    EXPECT_EQ(origin("3D-left-handed"), glm::dvec3(10, 20, -30));
    EXPECT_EQ(origin("3D-right-handed"), glm::dvec3(10, 20, 30));
    EXPECT_EQ(origin("scanner-xyz"), glm::dvec3(10, 20, 30));

    const auto lps = load(attached(fields + "LPS\nspace units: \"mm\" \"mm\" \"mm\"\n", data)).meta();
    EXPECT_TRUE(lps.anatomical);
    EXPECT_EQ(lps.lengthUnit, "mm");
    EXPECT_EQ(glm::dvec3(lps.grid.worldFromIndex[0]), glm::dvec3(-2, 0, 0));
    EXPECT_EQ(glm::dvec3(lps.grid.worldFromIndex[1]), glm::dvec3(0, 0, 3));
    EXPECT_EQ(glm::dvec3(lps.grid.worldFromIndex[2]), glm::dvec3(0, -4, 0));
    EXPECT_FALSE(load(attached(fields + "scanner-xyz\n", data)).meta().anatomical);
}

/// Without directions the axes of the file are those of its space, so a left-handed one is mirrored, too.
TEST_F(FormatsNrrd, MirrorsLeftHandedSpacesWithoutDirections) {
    const auto data = bytesOf(ramp<unsigned char>(24));
    const auto grid = [&](const std::string& fields) {
        return load(attached("type: uchar\nencoding: raw\n" + fields + "\n", data)).meta();
    };
    const auto left = grid("spacings: 2 3 4\naxis mins: 5 6 7\nspace: 3D-left-handed");
    EXPECT_EQ(glm::dvec3(left.grid.worldFromIndex[0]), glm::dvec3(2, 0, 0));
    EXPECT_EQ(glm::dvec3(left.grid.worldFromIndex[1]), glm::dvec3(0, 3, 0));
    EXPECT_EQ(glm::dvec3(left.grid.worldFromIndex[2]), glm::dvec3(0, 0, -4));
    EXPECT_EQ(glm::dvec3(left.grid.worldFromIndex[3]), glm::dvec3(5, 6, -7));
    EXPECT_FALSE(left.anatomical);
    ASSERT_EQ(left.notes.size(), 2U);
    expectMentions(left.notes[1], "left-handed");
    EXPECT_EQ(glm::dvec3(grid("spacings: 2 3 4\nspace: 3D-right-handed").grid.worldFromIndex[2]),
              glm::dvec3(0, 0, 4));
}

/// Spaces with time: vectors of four numbers, of which the last is time.
TEST_F(FormatsNrrd, ReadsSpacesWithTime) {
    const auto values = ramp<unsigned char>(48);
    const auto text = [&](const std::string& fields) {
        return "NRRD0004\ntype: uchar\nencoding: raw\ndimension: 4\nsizes: 2 3 4 2\n" + fields + "\n\n" +
               bytesOf(values);
    };
    const std::string vectors = "space directions: (2,0,0,0) (0,3,0,0) (0,0,4,0) (0,0,0,0.5)\n"
                                "space origin: (10,20,30,1.5)\n"
                                "space units: \"mm\" \"mm\" \"mm\" \"s\"";
    for (const auto& [space, mirror] :
         {std::pair{"LPST", glm::dvec3(-1, -1, 1)}, std::pair{"right-anterior-superior-time", glm::dvec3(1)},
          std::pair{"left-anterior-superior-time", glm::dvec3(-1, 1, 1)},
          std::pair{"scanner-xyz-time", glm::dvec3(1)}, std::pair{"3D-right-handed-time", glm::dvec3(1)},
          std::pair{"3D-left-handed-time", glm::dvec3(1, 1, -1)}}) {
        const auto loaded = load(write("t.nrrd", text("space: " + std::string(space) + "\n" + vectors)));
        const auto& meta = loaded.meta();
        EXPECT_EQ(meta.grid.dims, glm::ivec3(2, 3, 4)) << space;
        EXPECT_EQ(glm::dvec3(meta.grid.worldFromIndex[3]), mirror * glm::dvec3(10, 20, 30)) << space;
        for (int axis = 0; axis < 3; ++axis)
            EXPECT_EQ(meta.grid.worldFromIndex[axis][axis], mirror[axis] * (axis + 2.0)) << space;
        EXPECT_EQ(meta.times, (std::vector<double>{1.5, 2.0})) << space;
        EXPECT_EQ(meta.lengthUnit, "mm") << space;
        EXPECT_EQ(loaded.values<unsigned char>(0, 1),
                  std::vector<unsigned char>(values.begin() + 24, values.end()))
            << space;
    }
    const auto refused = [&](const std::string& fields) {
        return loadError(write("r.nrrd", text("space: LPST\n" + fields)));
    };
    expectMentions(refused("space directions: (2,0,0) (0,3,0) (0,0,4) none"), "space directions");
    expectMentions(refused("space directions: (2,0,0,0) (0,3,0,0) (0,0,4,1) (0,0,0,1)"),
                   "space and time at once");
    expectMentions(refused("space directions: (2,0,0,0) (0,3,0,0) (0,0,4,0) (0,0,0,nan)"),
                   "space directions");
    expectMentions(loadError(write("u.nrrd", text("space: sideways-time"))), "sideways-time");
    expectMentions(loadError(write("u.nrrd", text("space: -time"))), "-time");
}

TEST_F(FormatsNrrd, PlacesSpacingsMinimaAndCentring) {
    const auto data = bytesOf(ramp<unsigned char>(24));
    const std::string fields = "type: uchar\nencoding: raw\n";
    const auto spaced =
        load(attached(fields + "spacings: 2 3 4\naxis mins: 5 6 nan\nunits: \"um\" \"um\" \"um\"\n", data))
            .meta();
    EXPECT_EQ(spacingWorld(spaced.grid), glm::dvec3(2, 3, 4));
    EXPECT_EQ(glm::dvec3(spaced.grid.worldFromIndex[3]), glm::dvec3(5, 6, 0));
    EXPECT_EQ(spaced.lengthUnit, "um");
    EXPECT_EQ(spaced.grid.centring, Centring::Point);
    const auto ranged =
        load(attached(fields + "axis mins: 0 0 0\naxis maxs: 4 6 12\ncenterings: cell cell cell\n", data))
            .meta();
    EXPECT_EQ(spacingWorld(ranged.grid), glm::dvec3(2, 2, 3));
    EXPECT_EQ(glm::dvec3(ranged.grid.worldFromIndex[3]), glm::dvec3(1, 1, 1.5));
    EXPECT_EQ(ranged.grid.centring, Centring::Cell);
}

TEST_F(FormatsNrrd, SplitsComponentsListsAndTime) {
    const std::string fields = "type: uchar\nencoding: raw\n";
    const auto values = ramp<unsigned char>(3 * 8);
    const auto rgb =
        load(attached(fields + "kinds: RGB-color domain domain domain\n", bytesOf(values), "3 2 2 2", "4"));
    EXPECT_EQ(rgb.meta().fields.size(), 3U);
    EXPECT_EQ(rgb.meta().fields[1].name, "green");
    for (std::size_t voxel = 0; voxel < 8; ++voxel)
        EXPECT_EQ(rgb.values<unsigned char>(1)[voxel], values[voxel * 3 + 1]);

    const auto list =
        load(attached(fields + "kinds: domain domain domain list\n", bytesOf(values), "2 2 2 3", "4"));
    EXPECT_EQ(list.meta().fields.size(), 3U);
    EXPECT_EQ(list.values<unsigned char>(2)[1], values[17]);

    const auto time = load(attached(fields + "kinds: domain domain domain time\nspacings: 1 1 1 0.5\n",
                                    bytesOf(values), "2 2 2 3", "4"));
    EXPECT_EQ(time.meta().times, (std::vector<double>{0.0, 0.5, 1.0}));
    EXPECT_EQ(time.values<unsigned char>(0, 2)[1], values[17]);

    const auto both = ramp<unsigned char>(8 * 6);
    const auto timeFirst =
        load(attached(fields + "kinds: domain domain domain time list\n", bytesOf(both), "2 2 2 3 2", "5"));
    EXPECT_EQ(timeFirst.values<unsigned char>(1, 2)[0], both[8 * 5]);
    EXPECT_EQ(timeFirst.values<unsigned char>(0, 2)[0], both[8 * 2]);
    const auto listFirst =
        load(attached(fields + "kinds: domain domain domain list time\n", bytesOf(both), "2 2 2 3 2", "5"));
    EXPECT_EQ(listFirst.values<unsigned char>(2, 1)[0], both[8 * 5]);
    EXPECT_EQ(listFirst.values<unsigned char>(2, 0)[0], both[8 * 2]);

    // An axis of three samples alone does not make colours.
    const auto plain = load(attached(fields, bytesOf(values), "3 2 4"));
    EXPECT_EQ(plain.meta().grid.dims, glm::ivec3(3, 2, 4));
    EXPECT_EQ(plain.meta().fields.size(), 1U);
}

TEST_F(FormatsNrrd, RefusesWrongFields) {
    const auto data = bytesOf(ramp<short>(24));
    const std::string good = "type: short\nencoding: raw\nendian: little\n";
    ASSERT_NO_THROW((void)load(attached(good, data)));
    for (const std::string field : {"spacings: 1 nan 1",
                                    "spacings: 1 0 1",
                                    "spacings: inf 1 1",
                                    "spacings: 1 1",
                                    "spacings: 1 1 x",
                                    "byte skip: -5",
                                    "byte skip: 99999999999999999999",
                                    "line skip: -1",
                                    "line skip: 5000",
                                    "space: nowhere",
                                    "space directions: (1,0,0) (0,1,0)",
                                    "space directions: (1,0,0) (0,1,0) (0,0,nan)",
                                    "space directions: (1,0,0) (1,0,0) (0,0,1)",
                                    "space directions: none none none",
                                    "space directions: (0,0,0) (0,1,0) (0,0,1)",
                                    "space origin: (1,2",
                                    "kinds: domain domain",
                                    "data file: /etc/passwd",
                                    "data file: ../x",
                                    "data file: %s%s%n 1 2 1",
                                    "encoding: raw",
                                    "sizes: 2 3 4",
                                    "no field at all"})
        EXPECT_FALSE(loadError(attached(good + field + "\n", data)).empty()) << field;
    for (const std::string fields :
         {"type: block\nencoding: raw\n", "type: shorty\nencoding: raw\nendian: little\n",
          "type: short\nencoding: raw\n", "type: short\nencoding: zrl\nendian: little\n",
          "encoding: raw\nendian: little\n", "type: short\nendian: little\n"})
        EXPECT_FALSE(loadError(attached(fields, data)).empty()) << fields;
    for (const std::string sizes :
         {"2 3", "2 3 4 5", "0 3 4", "-2 3 4", "2 3 x", "4294967297 3 4", "2147483647 2147483647 2147483647"})
        EXPECT_FALSE(loadError(attached(good, data, sizes)).empty()) << sizes;
    for (const std::string dimension : {"0", "-1", "17", "x", "99999999999"})
        EXPECT_FALSE(loadError(attached(good, data, "2 3 4", dimension)).empty()) << dimension;
    EXPECT_FALSE(loadError(write("magic.nrrd", "NRRD0009\ntype: short\n\n")).empty());
    EXPECT_FALSE(loadError(write("long.nrrd", "NRRD0004\n" + std::string(2 << 20, '#'))).empty());
}

TEST_F(FormatsNrrd, NamesBothSizesOfShortAndLongFiles) {
    const auto data = bytesOf(ramp<short>(24));
    const std::string raw = "type: short\nencoding: raw\nendian: little\n";
    const auto shorter = loadError(attached(raw, data.substr(1)));
    expectMentions(shorter, "48 bytes");
    expectMentions(shorter, "47 bytes");
    expectMentions(loadError(attached(raw, data + "abc")), "51 bytes");
    EXPECT_EQ(load(attached(raw, data + "\n")).values<short>(),
              ramp<short>(24)); // some writers end with a line end
    const std::string gzip = "type: short\nencoding: gzip\nendian: little\n";
    expectMentions(loadError(attached(gzip, gzipped(data.substr(1)))), "only 47 bytes");
    expectMentions(loadError(attached(gzip, gzipped(data + "x"))), "holds more");
    expectMentions(loadError(attached("type: short\nencoding: ascii\n",
                                      "1 2 3 4 5 6 7 8 9 10 11 12 13 14 15 16 17 18 19 20 21 22 23")),
                   "only 46 bytes");
    expectMentions(loadError(attached("type: uchar\nencoding: ascii\n",
                                      "256 2 3 4 5 6 7 8 9 10 11 12 13 14 15 16 17 18 19 20 21 22 23 24")),
                   "'256'");
}

TEST_F(FormatsNrrd, RefusesABombWithoutAllocating) {
    // 48 bytes promised, 20 MB inside; and 4 GiB promised by a few bytes.
    const std::string gzip = "type: short\nencoding: gzip\nendian: little\n";
    const auto bomb = gzipped(std::string(20'000'000, '\0'));
    expectMentions(loadError(attached(gzip, bomb)), "holds more");
    expectMentions(loadError(attached(gzip, gzipped("abc"), "2048 2048 512")), "cannot decompress");
    ImportLimits small;
    small.maxBytes = 1000;
    EXPECT_THROW((void)load(attached(gzip, bomb, "100 100 100"), {}, small), LimitExceeded);
}

} // namespace
} // namespace voxsheet::import::testing
