#include "base/errors.h"
#include "http/message/chunked_decoder.h"

#include <gtest/gtest.h>

#include <string>

using namespace voxsheet::http;

namespace {

TEST(ChunkedDecoder, DecodesWholeAndByteByByte) {
    const std::string wire = "4;name=value\r\nWiki\r\nA\r\npedia in c\r\n0\r\nTrailer: x\r\n\r\nNEXT";
    std::string whole;
    ChunkedDecoder decoder;
    EXPECT_EQ(decoder.feed(wire, whole), wire.size() - 4);
    EXPECT_TRUE(decoder.done());
    EXPECT_EQ(whole, "Wikipedia in c");
    EXPECT_EQ(decoder.announcedBytes(), 14U);

    std::string pieces;
    ChunkedDecoder slow;
    std::size_t used = 0;
    for (const char c : wire)
        used += slow.feed({&c, 1}, pieces);
    EXPECT_TRUE(slow.done());
    EXPECT_EQ(used, wire.size() - 4);
    EXPECT_EQ(pieces, whole);
}

TEST(ChunkedDecoder, AnnouncesBeforeTheBytesArrive) {
    ChunkedDecoder decoder;
    std::string out;
    decoder.feed("FFFFFFFFF\r\n", out);
    EXPECT_EQ(decoder.announcedBytes(), 0xFFFFFFFFFU);
    EXPECT_TRUE(out.empty());
}

class MalformedChunks : public testing::TestWithParam<const char*> {};

TEST_P(MalformedChunks, AreRefused) {
    ChunkedDecoder decoder;
    std::string out;
    EXPECT_THROW(decoder.feed(GetParam(), out), voxsheet::InvalidInput);
}

INSTANTIATE_TEST_SUITE_P(All, MalformedChunks,
                         testing::Values("-1\r\n", "\r\n", "g\r\n", "0x5\r\n", "5\nabcde", "5\r\nabcdeX",
                                         "FFFFFFFFFFFFFFFFF\r\n", "5\rX", "0\r\n\n"));

TEST(ChunkedDecoder, ExtensionsHaveALimit) {
    ChunkedDecoder decoder;
    std::string out;
    EXPECT_THROW(decoder.feed("5;" + std::string(10000, 'a'), out), voxsheet::InvalidInput);
}

} // namespace
