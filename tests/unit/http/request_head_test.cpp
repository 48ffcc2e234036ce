#include "http/message/request_head.h"

#include <gtest/gtest.h>

#include <string>

using namespace voxsheet::http;

namespace {

const HeadLimits kLimits;

RequestHead parsed(const std::string& text) { return parseHead(text, kLimits); }

int refusalOf(const std::string& text) {
    try {
        static_cast<void>(parsed(text));
    } catch (const BadHead& bad) {
        return bad.status;
    }
    return 0;
}

std::string get(const std::string& fields) { return "GET /a HTTP/1.1\r\nHost: h\r\n" + fields + "\r\n"; }

TEST(RequestHead, ReadsLineAndFields) {
    const auto head =
        parsed("PATCH /api/v1?x=1&y=%20#f HTTP/1.1\r\nHost: localhost:8080\r\nX-A:  b c \t\r\n\r\n");
    EXPECT_EQ(head.method, "PATCH");
    EXPECT_EQ(head.path, "/api/v1");
    EXPECT_EQ(head.query, "x=1&y=%20");
    EXPECT_EQ(head.headers.find("x-a"), "b c");
    EXPECT_TRUE(head.keepAlive);
    EXPECT_FALSE(head.hasBody());
}

TEST(RequestHead, FieldValuesAreNotPercentDecoded) {
    const auto head = parsed(get("If-None-Match: \"a%0D%0Ab\"\r\n"));
    EXPECT_EQ(head.headers.find("If-None-Match"), "\"a%0D%0Ab\"");
}

TEST(RequestHead, KeepAliveByVersionAndConnection) {
    EXPECT_FALSE(parsed("GET / HTTP/1.0\r\n\r\n").keepAlive);
    EXPECT_TRUE(parsed("GET / HTTP/1.0\r\nConnection: Keep-Alive\r\n\r\n").keepAlive);
    EXPECT_FALSE(parsed(get("Connection: foo, close\r\n")).keepAlive);
}

TEST(RequestHead, Lengths) {
    EXPECT_EQ(parsed(get("Content-Length: 12\r\n")).contentLength, 12U);
    EXPECT_TRUE(parsed(get("Transfer-Encoding: Chunked\r\n")).chunked);
    EXPECT_EQ(refusalOf(get("Content-Length: -1\r\n")), 400);
    EXPECT_EQ(refusalOf(get("Content-Length: +1\r\n")), 400);
    EXPECT_EQ(refusalOf(get("Content-Length: 0x10\r\n")), 400);
    EXPECT_EQ(refusalOf(get("Content-Length:\r\n")), 400);
    EXPECT_EQ(refusalOf(get("Content-Length: 99999999999999999999999\r\n")), 400);
    EXPECT_EQ(refusalOf(get("Content-Length: 1, 2\r\n")), 400);
    EXPECT_EQ(refusalOf(get("Content-Length: 1\r\nContent-Length: 1\r\n")), 400);
}

TEST(RequestHead, SmugglingIsRefused) {
    EXPECT_EQ(refusalOf(get("Content-Length: 3\r\nTransfer-Encoding: chunked\r\n")), 400);
    EXPECT_EQ(refusalOf(get("Transfer-Encoding: gzip, chunked\r\n")), 501);
    EXPECT_EQ(refusalOf(get("Transfer-Encoding: chunked\r\nTransfer-Encoding: chunked\r\n")), 501);
    EXPECT_EQ(refusalOf(get("X-A : b\r\n")), 400);
    EXPECT_EQ(refusalOf(get(" folded\r\n")), 400);
    EXPECT_EQ(refusalOf(get("X-A: b\nX-B: c\r\n")), 400);
    EXPECT_EQ(refusalOf(get(std::string("X-A: b\0c\r\n", 10))), 400);
    EXPECT_EQ(refusalOf(get("Host: other\r\n")), 400);
    EXPECT_EQ(refusalOf(get("Content-Encoding: gzip\r\n")), 415);
    EXPECT_EQ(refusalOf(get("Expect: the-worst\r\n")), 417);
}

TEST(RequestHead, FirstLine) {
    EXPECT_EQ(refusalOf("GET /\r\n\r\n"), 400);
    EXPECT_EQ(refusalOf("GET / HTTP/2.0\r\n\r\n"), 505);
    EXPECT_EQ(refusalOf("GET http://x/ HTTP/1.1\r\n\r\n"), 400);
    EXPECT_EQ(refusalOf("GET /a b HTTP/1.1\r\n\r\n"), 400);
    EXPECT_EQ(refusalOf("G(T / HTTP/1.1\r\n\r\n"), 400);
    EXPECT_EQ(refusalOf("GET /\xC3\xA9 HTTP/1.1\r\n\r\n"), 400);
    EXPECT_EQ(refusalOf("GET /" + std::string(9000, 'a') + " HTTP/1.1\r\n\r\n"), 414);
}

TEST(RequestHead, LimitsOfSizeAndNumber) {
    std::string many;
    for (int i = 0; i < 101; ++i)
        many += "X: y\r\n";
    EXPECT_EQ(refusalOf(get(many)), 431);
    EXPECT_EQ(refusalOf(get("X: " + std::string(20000, 'a') + "\r\n")), 431);
}

TEST(RequestHead, HeadBytesWaitsForTheEmptyLine) {
    EXPECT_FALSE(headBytes("GET / HTTP/1.1\r\nHost: h\r\n", kLimits));
    EXPECT_EQ(headBytes("GET / HTTP/1.1\r\n\r\nrest", kLimits), 18U);
    EXPECT_THROW(static_cast<void>(headBytes("GET / HTTP/1.1\r\nX: " + std::string(70000, 'a'), kLimits)),
                 BadHead);
    EXPECT_THROW(static_cast<void>(headBytes("GET /" + std::string(9000, 'a'), kLimits)), BadHead);
}

} // namespace
