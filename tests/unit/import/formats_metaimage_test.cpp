#include "formats_fixture.h"

namespace voxsheet::import::testing {
namespace {

class FormatsMetaImage : public FormatsTest {
protected:
    static std::string header(const std::string& type, const std::string& tags = "",
                              const std::string& dims = "3 4 2", const std::string& count = "3") {
        return "ObjectType = Image\nNDims = " + count + "\nDimSize = " + dims + "\nElementType = " + type +
               "\n" + tags;
    }
    fs::path local(const std::string& head, std::string_view data) const {
        return write("x.mha", head + "ElementDataFile = LOCAL\n" + std::string(data));
    }
    template <typename T>
    void roundTrip(const std::string& type) {
        const auto values = ramp<T>(24);
        for (const bool big : {false, true}) {
            const auto raw = bytesOf(values, big);
            const auto head =
                header(type, std::string("BinaryDataByteOrderMSB = ") + (big ? "True\n" : "False\n"));
            EXPECT_EQ(load(local(head, raw)).template values<T>(), values) << type;
            const auto packed = zlibbed(raw);
            const auto size =
                "CompressedData = True\nCompressedDataSize = " + std::to_string(packed.size()) + "\n";
            EXPECT_EQ(load(local(head + size, packed)).template values<T>(), values) << type;
        }
        std::string text;
        for (const auto value : values)
            text += std::to_string(value) + " ";
        EXPECT_EQ(load(local(header(type, "BinaryData = False\n"), text)).template values<T>(), values)
            << type;
    }
};

TEST_F(FormatsMetaImage, ReadsEveryTypeEncodingAndByteOrder) {
    roundTrip<signed char>("MET_CHAR");
    roundTrip<unsigned char>("MET_UCHAR");
    roundTrip<short>("MET_SHORT");
    roundTrip<unsigned short>("MET_USHORT");
    roundTrip<int>("MET_INT");
    roundTrip<int>("MET_LONG");
    roundTrip<unsigned>("MET_UINT");
    roundTrip<long>("MET_LONG_LONG");
    roundTrip<unsigned long>("MET_ULONG_LONG");
    roundTrip<float>("MET_FLOAT");
    roundTrip<double>("MET_DOUBLE");
}

TEST_F(FormatsMetaImage, ReadsDetachedData) {
    const auto values = ramp<short>(24);
    const auto raw = bytesOf(values);
    write("v.raw", raw);
    write("skip.raw", "HEADER" + raw);
    write("v.zraw", zlibbed(raw));
    for (int slice = 0; slice < 2; ++slice)
        write("s" + std::to_string(slice) + ".raw", raw.substr(static_cast<std::size_t>(slice) * 24, 24));
    const auto read = [&](const std::string& tags) {
        return load(write("a.mhd", header("MET_SHORT", tags))).values<short>();
    };
    EXPECT_EQ(read("ElementDataFile = v.raw\n"), values);
    EXPECT_EQ(read("ElementDataFile = v.raw"), values);
    EXPECT_EQ(read("HeaderSize = 6\nElementDataFile = skip.raw\n"), values);
    EXPECT_EQ(read("HeaderSize = -1\nElementDataFile = skip.raw\n"), values);
    EXPECT_EQ(read("CompressedData = True\nElementDataFile = v.zraw\n"), values);
    EXPECT_EQ(read("ElementDataFile = LIST\ns0.raw\ns1.raw\n"), values);
    EXPECT_EQ(read("ElementDataFile = s%d.raw 0 1 1\n"), values);
    for (int slice = 0; slice < 2; ++slice) // each compressed alone
        write("z" + std::to_string(slice) + ".zraw",
              zlibbed(raw.substr(static_cast<std::size_t>(slice) * 24, 24)));
    EXPECT_EQ(read("CompressedData = True\nElementDataFile = LIST\nz0.zraw\nz1.zraw\n"), values);
    EXPECT_EQ(read("CompressedData = True\nElementDataFile = z%d.zraw 0 1 1\n"), values);
}

TEST_F(FormatsMetaImage, PlacesItInRas) {
    const auto tags = "TransformMatrix = 0 1 0 1 0 0 0 0 -1\nOffset = 10 20 30\nElementSpacing = 2 3 4\n";
    const auto meta = load(local(header("MET_UCHAR", tags), bytesOf(ramp<unsigned char>(24)))).meta();
    const auto& world = meta.grid.worldFromIndex;
    EXPECT_EQ(glm::dvec3(world[0]), glm::dvec3(0, -2, 0)); // first row: i along LPS y
    EXPECT_EQ(glm::dvec3(world[1]), glm::dvec3(-3, 0, 0));
    EXPECT_EQ(glm::dvec3(world[2]), glm::dvec3(0, 0, -4));
    EXPECT_EQ(glm::dvec3(world[3]), glm::dvec3(-10, -20, 30));
    EXPECT_TRUE(meta.anatomical);
    EXPECT_EQ(meta.lengthUnit, "mm");
}

TEST_F(FormatsMetaImage, HasSidesOnlyWhereTheFileSaysThem) {
    const std::string place = "Offset = 10 20 30\nElementSpacing = 2 3 4\n";
    const auto meta = [&](const std::string& tags) {
        return load(local(header("MET_UCHAR", place + tags), bytesOf(ramp<unsigned char>(24)))).meta();
    };
    const std::string identity = " = 1 0 0 0 1 0 0 0 1\n";
    for (const std::string silent : {"", "AnatomicalOrientation = ???\n", "AnatomicalOrientation = RAL\n",
                                     "AnatomicalOrientation = RA\n", "CenterOfRotation = 0 0 0\n"}) {
        const auto unknown = meta(silent);
        EXPECT_FALSE(unknown.anatomical) << silent;
        EXPECT_EQ(unknown.lengthUnit, "mm") << silent;
        EXPECT_EQ(unknown.grid.worldFromIndex,
                  glm::dmat4(2, 0, 0, 0, 0, 3, 0, 0, 0, 0, 4, 0, 10, 20, 30, 1)) // as the file lies
            << silent;
    }
    const glm::dmat4 lps(-2, 0, 0, 0, 0, -3, 0, 0, 0, 0, 4, 0, -10, -20, 30, 1);
    for (const auto& said : {"TransformMatrix" + identity, "Rotation" + identity, "Orientation" + identity,
                             std::string("AnatomicalOrientation = RAI\n"),
                             "TransformMatrix" + identity + "AnatomicalOrientation = ???\n",
                             "TransformMatrix" + identity + "AnatomicalOrientation = PSL\n"}) {
        EXPECT_TRUE(meta(said).anatomical) << said;
        EXPECT_EQ(meta(said).grid.worldFromIndex, lps) << said;
    }
    // From posterior, superior and left: to the front, down and to the right.
    EXPECT_EQ(meta("AnatomicalOrientation = PSL\n").grid.worldFromIndex,
              glm::dmat4(0, 2, 0, 0, 0, 0, -3, 0, 4, 0, 0, 0, -10, -20, 30, 1));
}

TEST_F(FormatsMetaImage, SplitsChannelsAndTime) {
    const auto values = ramp<unsigned char>(24);
    const auto channels =
        load(local(header("MET_UCHAR", "ElementNumberOfChannels = 3\n", "2 2 2"), bytesOf(values)));
    ASSERT_EQ(channels.meta().fields.size(), 3U);
    EXPECT_EQ(channels.values<unsigned char>(2)[5], values[17]);
    const auto time =
        load(local(header("MET_UCHAR", "ElementSpacing = 1 1 1 0.5\nOffset = 0 0 0 2\n", "2 2 2 3", "4"),
                   bytesOf(values)));
    EXPECT_EQ(time.meta().times, (std::vector<double>{2.0, 2.5, 3.0}));
    EXPECT_EQ(time.values<unsigned char>(0, 2)[1], values[17]);
    EXPECT_EQ(load(local(header("MET_UCHAR", "", "6 4", "2"), bytesOf(values))).meta().grid.dims,
              glm::ivec3(6, 4, 1));
}

TEST_F(FormatsMetaImage, RefusesWrongTags) {
    const auto data = bytesOf(ramp<short>(24));
    write("v.raw", data);
    ASSERT_NO_THROW((void)load(local(header("MET_SHORT"), data)));
    for (const std::string tag :
         {"ElementSpacing = 1 nan 1", "ElementSpacing = 1 0 1", "ElementSpacing = 1 -1 1",
          "ElementSpacing = 1 1", "Offset = 1 2", "Offset = inf 0 0", "TransformMatrix = 1 0 0 0 1 0 0 0",
          "TransformMatrix = 1 0 0 1 0 0 0 0 1", "HeaderSize = -2", "HeaderSize = x",
          "ElementNumberOfChannels = 0", "ElementNumberOfChannels = 99999", "BinaryData = maybe",
          "ElementType = MET_SHORT", "word", "CompressedData = True"})
        EXPECT_FALSE(loadError(local(header("MET_SHORT", tag + "\n"), data)).empty()) << tag;
    for (const std::string dims :
         {"3 4", "3 4 2 1", "0 4 2", "-3 4 2", "3 4 x", "4294967299 4 2", "2000000000 2000000000 2000000000"})
        EXPECT_FALSE(loadError(local(header("MET_SHORT", "", dims), data)).empty()) << dims;
    for (const std::string count : {"0", "-3", "4000", "5", "x"})
        EXPECT_FALSE(loadError(local(header("MET_SHORT", "", "3 4 2", count), data)).empty()) << count;
    for (const std::string file : {"/etc/passwd", "../v.raw", "absent.raw", "", "%n%n 1 2 1", "LIST"})
        EXPECT_FALSE(
            loadError(write("a.mhd", header("MET_SHORT", "ElementDataFile = " + file + "\n"))).empty())
            << file;
    EXPECT_FALSE(loadError(local(header("MET_OTHER"), data)).empty());
    expectMentions(
        loadError(write("b.mhd", "ObjectType = Tube\nNDims = 3\nDimSize = 1 1 1\nElementDataFile = LOCAL\n")),
        "Tube");
    expectMentions(loadError(write("c.mhd", header("MET_SHORT"))), "ElementDataFile");
}

TEST_F(FormatsMetaImage, NamesBothSizesOfShortAndLongFiles) {
    const auto data = bytesOf(ramp<short>(24));
    const auto shorter = loadError(local(header("MET_SHORT"), data.substr(2)));
    expectMentions(shorter, "48 bytes");
    expectMentions(shorter, "46 bytes");
    expectMentions(loadError(local(header("MET_SHORT"), data + "1234")), "52 bytes");
    const std::string packedTags = "CompressedData = True\n";
    expectMentions(loadError(local(header("MET_SHORT", packedTags), zlibbed(data.substr(2)))),
                   "only 46 bytes");
    expectMentions(loadError(local(header("MET_SHORT", packedTags), zlibbed(data + "1"))), "holds more");
    expectMentions(
        loadError(local(header("MET_SHORT", packedTags + "CompressedDataSize = 5000\n"), zlibbed(data))),
        "5000 bytes");
}

} // namespace
} // namespace voxsheet::import::testing
