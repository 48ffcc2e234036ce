// What a well-behaved client may rely on.
#include "base/errors.h"
#include "fields/patience.h"
#include "raw_client.h"
#include "sample_server.h"

#include <gtest/gtest.h>

#include <chrono>
#include <list>
#include <string>
#include <thread>

using namespace voxsheet::http_test;

namespace {

using namespace std::chrono_literals;
using Clock = std::chrono::steady_clock;

const std::string kGet = "GET /quick HTTP/1.1\r\nHost: localhost\r\n\r\n";

double secondsSince(Clock::time_point start) {
    return std::chrono::duration<double>(Clock::now() - start).count();
}

template <typename Condition>
bool eventually(Condition condition, double seconds = 30.0) {
    const auto start = Clock::now();
    while (secondsSince(start) < seconds) {
        if (condition()) return true;
        std::this_thread::sleep_for(5ms);
    }
    return condition();
}

TEST(ServerBehaviour, KeepsConnectionsAndOrder) {
    SampleServer server;
    RawClient client(server.port());
    for (int i = 0; i < 50; ++i) {
        const auto body = std::to_string(i);
        client.send("POST /echo HTTP/1.1\r\nHost: localhost\r\nContent-Length: " +
                    std::to_string(body.size()) + "\r\n\r\n" + body);
        EXPECT_EQ(bodyOfResponse(client.readResponse()), body);
    }
}

TEST(ServerBehaviour, PipelinedRequestsAreAnsweredInTurn) {
    SampleServer server;
    RawClient client(server.port());
    std::string all;
    for (int i = 0; i < 1000; ++i)
        all += i % 2 == 0 ? kGet : "GET /nothing HTTP/1.1\r\nHost: localhost\r\n\r\n";
    client.send(all);
    for (int i = 0; i < 1000; ++i)
        ASSERT_EQ(statusOfResponse(client.readResponse(10.0)), i % 2 == 0 ? 200 : 404) << i;
}

TEST(ServerBehaviour, ChunkedBodiesAndContinue) {
    SampleServer server;
    RawClient client(server.port());
    client.send("POST /echo HTTP/1.1\r\nHost: localhost\r\nTransfer-Encoding: chunked\r\n\r\n5\r\nhello\r\n");
    std::this_thread::sleep_for(20ms);
    client.send("6\r\n world\r\n0\r\n\r\n");
    EXPECT_EQ(bodyOfResponse(client.readResponse()), "hello world");
    client.send(
        "POST /echo HTTP/1.1\r\nHost: localhost\r\nContent-Length: 2\r\nExpect: 100-continue\r\n\r\n");
    EXPECT_EQ(statusOfResponse(client.readResponse()), 100);
    client.send("ab");
    EXPECT_EQ(bodyOfResponse(client.readResponse()), "ab");
}

TEST(ServerBehaviour, RefusedBodyStillGetsItsAnswer) {
    SampleServer server;
    RawClient client(server.port());
    client.send("POST /echo HTTP/1.1\r\nHost: localhost\r\nContent-Length: 3000000\r\n\r\n" +
                std::string(3000000, 'x'));
    EXPECT_EQ(statusOfResponse(client.readAll()), 413);
}

TEST(ServerBehaviour, HeadHasLengthAndNoBody) {
    SampleServer server;
    const auto response =
        exchange(server.port(), "HEAD /quick HTTP/1.1\r\nHost: localhost\r\nConnection: close\r\n\r\n");
    EXPECT_EQ(statusOfResponse(response), 200);
    EXPECT_EQ(fieldOfResponse(response, "Content-Length"), "2");
    EXPECT_TRUE(fieldOfResponse(response, "Date"));
    EXPECT_EQ(bodyOfResponse(response), "");
}

TEST(ServerBehaviour, ClosesWhenAsked) {
    SampleServer server;
    RawClient old(server.port());
    old.send("GET /quick HTTP/1.0\r\nHost: localhost\r\n\r\n");
    EXPECT_EQ(bodyOfResponse(old.readAll()), "ok");
    RawClient half(server.port()); // printf … | nc
    half.send(kGet);
    half.closeSendingHalf();
    EXPECT_EQ(bodyOfResponse(half.readAll()), "ok");
}

TEST(ServerBehaviour, LargeAnswersArriveWhole) {
    SampleServer server;
    EXPECT_EQ(bodyOfResponse(exchange(server.port(), getRequest("/big"), 20.0)).size(),
              std::size_t{4} << 20U);
}

TEST(ServerBehaviour, UploadsStreamWithinTheirBudget) {
    SampleServer server;
    const std::string megabyte(1U << 20U, 'x');
    RawClient client(server.port());
    client.send("PUT /upload HTTP/1.1\r\nHost: localhost\r\nContent-Length: 8388608\r\n\r\n");
    for (int i = 0; i < 8; ++i)
        client.send(megabyte);
    EXPECT_EQ(bodyOfResponse(client.readResponse(10.0)), "8388608");
    client.send("PUT /upload HTTP/1.1\r\nHost: localhost\r\nTransfer-Encoding: chunked\r\n\r\n100000\r\n" +
                megabyte + "\r\n0\r\n\r\n");
    EXPECT_EQ(bodyOfResponse(client.readResponse(10.0)), "1048576");
    EXPECT_EQ(
        statusOfResponse(exchange(
            server.port(),
            "PUT /upload HTTP/1.1\r\nHost: localhost\r\nTransfer-Encoding: chunked\r\n\r\nFFFFFFFF\r\n")),
        413);
}

TEST(ServerBehaviour, UploadThatStallsEnds) {
    SampleServer server;
    RawClient client(server.port());
    client.send("PUT /upload HTTP/1.1\r\nHost: localhost\r\nContent-Length: 1000000\r\n\r\nabc");
    EXPECT_EQ(statusOfResponse(client.readAll(6.0)), 503);
}

TEST(ServerBehaviour, BusyRenderPoolIs503AndControlGoesOn) {
    auto options = SampleServer::quickOptions();
    options.renderThreads = 2;
    options.queueLength = 3;
    SampleServer server(options);
    std::list<RawClient> waiting;
    for (int i = 0; i < 5; ++i) {
        waiting.emplace_back(server.port());
        waiting.back().send(getRequest("/block"));
    }
    ASSERT_TRUE(eventually([&] { return server.blocked == 2; }));
    std::this_thread::sleep_for(50ms);
    const auto refused = exchange(server.port(), getRequest("/block"));
    EXPECT_EQ(statusOfResponse(refused), 503);
    EXPECT_TRUE(fieldOfResponse(refused, "Retry-After"));
    EXPECT_LT(server.quickLatency(), 3.0 * voxsheet::fields::patience());
    server.release = true;
    for (auto& client : waiting)
        EXPECT_EQ(statusOfResponse(client.readAll()), 200);
}

TEST(ServerBehaviour, HandlersLearnThatTheClientHasGone) {
    SampleServer server;
    RawClient client(server.port());
    client.send(getRequest("/block"));
    ASSERT_TRUE(eventually([&] { return server.blocked == 1; }));
    const auto start = Clock::now();
    client.abort();
    EXPECT_TRUE(eventually([&] { return server.cancelled == 1; }));
    EXPECT_LT(secondsSince(start), 0.5 * voxsheet::fields::patience());
}

TEST(ServerBehaviour, StreamsEndWithTheirClient) {
    SampleServer server;
    RawClient client(server.port());
    client.send("GET /stream HTTP/1.1\r\nHost: localhost\r\n\r\n");
    ASSERT_TRUE(eventually([&] { return server.streaming == 1; }));
    client.abort();
    EXPECT_TRUE(eventually([&] { return server.streaming == 0; }));
}

TEST(ServerBehaviour, StreamReaderThatStallsIsDropped) {
    SampleServer server; // stallSeconds = 1
    RawClient client(server.port());
    client.send("GET /stream HTTP/1.1\r\nHost: localhost\r\n\r\n");
    ASSERT_TRUE(eventually([&] { return server.streaming == 1; }));
    EXPECT_LT(server.quickLatency(), 3.0 * voxsheet::fields::patience());
}

TEST(ServerBehaviour, StopsWithinTwoSecondsWithOpenStreams) {
    SampleServer server;
    std::list<RawClient> clients;
    for (int i = 0; i < 64; ++i) {
        clients.emplace_back(server.port());
        clients.back().send("GET /stream HTTP/1.1\r\nHost: localhost\r\n\r\n");
    }
    for (int i = 0; i < 50; ++i) { // and idle ones
        clients.emplace_back(server.port());
        clients.back().send(kGet);
    }
    clients.emplace_back(server.port()); // and a handler that waits
    clients.back().send(getRequest("/block"));
    ASSERT_TRUE(eventually([&] { return server.streaming == 64 && server.blocked == 1; }));
    const auto start = Clock::now();
    EXPECT_TRUE(server.server().stop());
    EXPECT_LT(secondsSince(start), 2.0 * voxsheet::fields::patience());
    EXPECT_EQ(server.streaming, 0);
    EXPECT_THROW(RawClient(server.port()), std::runtime_error);
}

TEST(ServerBehaviour, ThePortIsItsOwn) {
    SampleServer first;
    auto options = SampleServer::quickOptions();
    options.port = first.port();
    EXPECT_THROW(SampleServer second(options), voxsheet::Conflict);
    options.nextFreePort = true;
    SampleServer third(options);
    EXPECT_GT(third.port(), first.port());
    options.port = 70000;
    EXPECT_THROW(SampleServer fourth(options), voxsheet::InvalidInput);
    options.port = 0;
    options.host = "192.0.2.1"; // documentation address: not of this machine
    EXPECT_THROW(SampleServer fifth(options), voxsheet::InvalidInput);
}

TEST(ServerBehaviour, CountsWhatItDoes) {
    SampleServer server;
    static_cast<void>(server.quickLatency());
    static_cast<void>(exchange(server.port(), "BAD\r\n\r\n"));
    const auto counters = server.server().counters();
    EXPECT_EQ(counters.accepted, 2U);
    EXPECT_EQ(counters.requests, 1U);
    EXPECT_EQ(counters.refused, 1U);
    EXPECT_GT(counters.sentBytes, 100U);
}

} // namespace
