// What a hostile or broken client may try, against the server's own limits.
#include "fields/patience.h"
#include "http/net/listen_socket.h"
#include "raw_client.h"
#include "sample_server.h"

#include <gtest/gtest.h>

#include <chrono>
#include <list>
#include <map>
#include <string>
#include <thread>
#include <vector>

using namespace voxsheet::http_test;

namespace {

constexpr double kSoon = 3.0; ///< s; a client that had to wait for the abuse to end would wait longer

std::string post(const std::string& fields, const std::string& body = {}) {
    return "POST /echo HTTP/1.1\r\nHost: localhost\r\n" + fields + "\r\n" + body;
}

TEST(ServerAbuse, SlowHeadsCostNoThreadAndEnd) {
    SampleServer server;
    std::list<RawClient> slow;
    for (int i = 0; i < 300; ++i) {
        slow.emplace_back(server.port());
        slow.back().send("GET /quick HTTP/1.1\r\nHost: localhost\r\nX-");
    }
    EXPECT_LT(server.quickLatency(), kSoon * voxsheet::fields::patience());
    // A byte now and then does not extend the deadline, which counts from the first byte.
    for (int round = 0; round < 8; ++round) {
        for (auto& client : slow)
            client.send("a", 0.01);
        std::this_thread::sleep_for(std::chrono::milliseconds(150));
    }
    for (auto& client : slow)
        EXPECT_TRUE(client.closedWithin(3.0));
}

TEST(ServerAbuse, SlowBodiesCostNoThread) {
    SampleServer server;
    std::list<RawClient> slow;
    for (int i = 0; i < 200; ++i) {
        slow.emplace_back(server.port());
        slow.back().send(post("Content-Length: 1000\r\n", "x"));
    }
    EXPECT_LT(server.quickLatency(), kSoon * voxsheet::fields::patience());
    for (auto& client : slow)
        EXPECT_TRUE(client.closedWithin(5.0));
}

TEST(ServerAbuse, ReadersThatStallCostNoThread) {
    SampleServer server;
    std::list<RawClient> stalled;
    for (int i = 0; i < 40; ++i) {
        stalled.emplace_back(server.port());
        stalled.back().send(getRequest("/big"));
    }
    EXPECT_LT(server.quickLatency(), kSoon * voxsheet::fields::patience());
}

TEST(ServerAbuse, ChunkedBombIsCut) {
    SampleServer server;
    RawClient client(server.port());
    client.send(post("Transfer-Encoding: chunked\r\n"));
    const std::string chunk = "10000\r\n" + std::string(0x10000, 'x') + "\r\n";
    std::size_t sent = 0;
    while (sent < (std::size_t{256} << 20U) && client.send(chunk, 0.5))
        sent += chunk.size();
    EXPECT_LT(sent, std::size_t{16} << 20U);
    EXPECT_LT(server.quickLatency(), kSoon * voxsheet::fields::patience());
}

TEST(ServerAbuse, ChunkedBodyOverBudgetIs413) {
    SampleServer server;
    EXPECT_EQ(
        statusOfResponse(exchange(server.port(), post("Transfer-Encoding: chunked\r\n", "FFFFFFFFFF\r\n"))),
        413);
    EXPECT_EQ(
        statusOfResponse(exchange(server.port(), post("Transfer-Encoding: chunked\r\n", "-5\r\nhello\r\n"))),
        400);
    EXPECT_EQ(statusOfResponse(exchange(server.port(),
                                        post("Transfer-Encoding: chunked\r\n", "FFFFFFFFFFFFFFFFFFFF\r\n"))),
              400);
    EXPECT_EQ(statusOfResponse(exchange(server.port(), post("Content-Length: 1048577\r\n"))), 413);
    EXPECT_EQ(statusOfResponse(exchange(server.port(), post("Content-Length: 999999999999999999\r\n"))), 413);
}

TEST(ServerAbuse, HeadBombs) {
    SampleServer server;
    EXPECT_EQ(statusOfResponse(exchange(server.port(), getRequest("/" + std::string(100000, 'a')))), 414);
    EXPECT_EQ(statusOfResponse(
                  exchange(server.port(), getRequest("/quick", "X: " + std::string(30000, 'a') + "\r\n"))),
              431);
    std::string many;
    for (int i = 0; i < 5000; ++i)
        many += "X: y\r\n";
    EXPECT_EQ(statusOfResponse(exchange(server.port(), getRequest("/quick", many))), 431);
    RawClient endless(server.port());
    std::size_t sent = 0;
    const std::string part(65536, 'a');
    endless.send("GET /quick HTTP/1.1\r\nX: ");
    while (sent < (std::size_t{64} << 20U) && endless.send(part, 0.5))
        sent += part.size();
    EXPECT_LT(sent, std::size_t{16} << 20U);
}

struct BadRequest {
    const char* what;
    std::string bytes;
    int status;
};

TEST(ServerAbuse, AmbiguousAndMalformedRequests) {
    SampleServer server;
    const std::vector<BadRequest> cases{
        {"CL and TE", post("Content-Length: 5\r\nTransfer-Encoding: chunked\r\n", "0\r\n\r\n"), 400},
        {"two lengths", post("Content-Length: 5\r\nContent-Length: 6\r\n", "hello"), 400},
        {"negative length", post("Content-Length: -1\r\n"), 400},
        {"unknown coding", post("Transfer-Encoding: gzip\r\n"), 501},
        {"compressed body", post("Content-Encoding: gzip\r\nContent-Length: 5\r\n", "hello"), 415},
        {"unknown expectation", post("Expect: tea\r\nContent-Length: 5\r\n"), 417},
        {"no host", "GET /quick HTTP/1.1\r\n\r\n", 421},
        {"HTTP/2 preface", "PRI * HTTP/2.0\r\n\r\nSM\r\n\r\n", 400},
        {"TLS hello", std::string("\x16\x03\x01\x02\x00\x01\x00\x01\xfc\x03\x03\r\n\r\n", 15), 400},
        {"bare line feeds", "GET /quick HTTP/1.1\nHost: localhost\n\n\r\n\r\n", 400},
        {"NUL in path", getRequest("/quick%00"), 400},
        {"bad escape", getRequest("/%"), 400},
        {"method unknown", "BREW /quick HTTP/1.1\r\nHost: localhost\r\nConnection: close\r\n\r\n", 405},
    };
    for (const auto& bad : cases) {
        RawClient client(server.port());
        client.send(bad.bytes);
        EXPECT_EQ(statusOfResponse(client.readResponse()), bad.status) << bad.what;
    }
}

TEST(ServerAbuse, TwoThousandConnectsAtOnce) {
    constexpr int kClients = 2000;
    if (voxsheet::http::raiseOpenFileLimit(2 * kClients + 500) < 2 * kClients + 400)
        GTEST_SKIP() << "the limit of open files is too low here";
    auto options = SampleServer::quickOptions();
    options.headSeconds = 30.0;     // the first client sends after the last one has connected
    options.queueLength = kClients; // else those that a busy machine lets wait are refused, rightly
    SampleServer server(options);
    std::list<RawClient> clients;
    for (int i = 0; i < kClients; ++i)
        clients.emplace_back(server.port(), 20.0);
    for (auto& client : clients)
        client.send(getRequest("/quick"));
    std::map<int, int> answers; // by status; 0: none
    for (auto& client : clients)
        ++answers[statusOfResponse(client.readAll(20.0))];
    EXPECT_EQ(answers, (std::map<int, int>{{200, kClients}}));
}

TEST(ServerAbuse, IdleConnectionsStarveNobody) {
    SampleServer server;
    std::list<RawClient> idle;
    for (int i = 0; i < 500; ++i) {
        idle.emplace_back(server.port());
        idle.back().send("GET /quick HTTP/1.1\r\nHost: localhost\r\n\r\n");
    }
    for (auto& client : idle)
        EXPECT_EQ(statusOfResponse(client.readResponse()), 200);
    EXPECT_LT(server.quickLatency(), kSoon * voxsheet::fields::patience());
    // And they are still there.
    for (auto& client : idle)
        client.send("GET /quick HTTP/1.1\r\nHost: localhost\r\n\r\n");
    for (auto& client : idle)
        EXPECT_EQ(statusOfResponse(client.readResponse()), 200);
}

TEST(ServerAbuse, ConnectionLimitMakesRoomForTheNew) {
    auto options = SampleServer::quickOptions();
    options.maxConnections = 20;
    SampleServer server(options);
    std::list<RawClient> idle;
    for (int i = 0; i < 60; ++i) {
        idle.emplace_back(server.port());
        idle.back().send("GET /quick HTTP/1.1\r\nHost: localhost\r\n\r\n");
        EXPECT_EQ(statusOfResponse(idle.back().readResponse()), 200) << i;
    }
}

TEST(ServerAbuse, OneAddressCannotTakeEverything) {
    auto options = SampleServer::quickOptions();
    options.maxConnectionsPerAddress = 10;
    SampleServer server(options);
    std::list<RawClient> clients;
    int refused = 0;
    for (int i = 0; i < 15; ++i)
        clients.emplace_back(server.port());
    // Quicker than the ten that stay are ended for saying nothing.
    for (auto& client : clients)
        refused += client.closedWithin(0.03) ? 1 : 0;
    EXPECT_EQ(refused, 5);
}

TEST(ServerAbuse, RangesAreIgnored) {
    SampleServer server;
    std::string ranges = "Range: bytes=0-1";
    for (int i = 0; i < 500; ++i)
        ranges += ",0-";
    const auto response = exchange(server.port(), getRequest("/quick", ranges + "\r\n"));
    EXPECT_EQ(statusOfResponse(response), 200);
    EXPECT_EQ(bodyOfResponse(response), "ok");
}

TEST(ServerAbuse, NoTextOfExceptionsAndNoInjectedFields) {
    SampleServer server;
    const auto failed = exchange(server.port(), getRequest("/throw"));
    EXPECT_EQ(statusOfResponse(failed), 500);
    EXPECT_EQ(failed.find("secret"), std::string::npos);
    EXPECT_FALSE(fieldOfResponse(failed, "EXCEPTION_WHAT"));
    const auto injected = exchange(server.port(), getRequest("/header?value=a%0D%0ASet-Cookie:%20b=c"));
    EXPECT_FALSE(fieldOfResponse(injected, "Set-Cookie"));
}

} // namespace
