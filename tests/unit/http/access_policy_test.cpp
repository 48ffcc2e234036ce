#include "base/errors.h"
#include "http/guard/access_policy.h"
#include "http/guard/token.h"

#include <gtest/gtest.h>

using namespace voxsheet;
using namespace voxsheet::http;

namespace {

const std::string kToken = "0123456789abcdef";
const Peer kPeer{"127.0.0.1", "127.0.0.1"};

RequestHead head(const std::string& method,
                 std::initializer_list<std::pair<std::string, std::string>> fields) {
    RequestHead out;
    out.method = method;
    out.path = "/";
    for (const auto& [name, value] : fields)
        out.headers.add(name, value);
    return out;
}

int judge(const AccessPolicy& policy, const RequestHead& request, const std::string& query = {},
          bool needsToken = true, const Peer& peer = kPeer) {
    return policy.judge(request, Query(query), peer, needsToken).status;
}

TEST(AccessPolicy, TokenByHeaderQueryAndCookie) {
    const AccessPolicy policy({kToken, "127.0.0.1", {}});
    EXPECT_EQ(judge(policy, head("GET", {{"Host", "localhost"}})), 401);
    EXPECT_EQ(judge(policy, head("GET", {{"Host", "localhost"}}), {}, false), 0);
    EXPECT_EQ(judge(policy, head("GET", {{"Host", "localhost"}, {"Authorization", "Bearer " + kToken}})), 0);
    EXPECT_EQ(
        judge(policy, head("GET", {{"Host", "localhost"}, {"Authorization", "Bearer " + kToken + "x"}})),
        401);
    EXPECT_EQ(judge(policy, head("GET", {{"Host", "localhost"}, {"Authorization", "Basic " + kToken}})), 401);
    EXPECT_EQ(judge(policy, head("GET", {{"Host", "localhost"}}), "token=" + kToken), 0);
    EXPECT_EQ(judge(policy, head("GET", {{"Host", "localhost"}}), "token=0123456789abcdeF"), 401);
    const auto cookie = "a=b; " + policy.cookieName() + "=" + kToken + "; c=d";
    EXPECT_EQ(judge(policy, head("GET", {{"Host", "localhost"}, {"Cookie", cookie}})), 0);
    EXPECT_EQ(judge(policy, head("GET", {{"Host", "localhost"}, {"Cookie", "voxsheet=" + kToken}})), 401);
    EXPECT_EQ(judge(policy, head("GET", {{"Host", "localhost"}, {"Cookie", policy.cookieName() + "="}})),
              401);
}

TEST(AccessPolicy, CookieNamesDifferBetweenTokens) {
    EXPECT_NE(cookieNameFor("aaaaaaaa"), cookieNameFor("aaaaaaab"));
    EXPECT_EQ(cookieNameFor("aaaaaaaa"), cookieNameFor("aaaaaaaa"));
}

TEST(AccessPolicy, HostsOfLoopback) {
    const AccessPolicy policy({"", "127.0.0.1", {"hub.example.org", "box:9000"}});
    for (const auto* host : {"localhost", "LOCALHOST:1234", "127.0.0.1:80", "127.8.9.1", "[::1]:8080",
                             "x.localhost", "hub.example.org", "hub.example.org:443", "box:9000"})
        EXPECT_EQ(judge(policy, head("GET", {{"Host", host}})), 0) << host;
    for (const auto* host : {"evil.example", "127.0.0.1.evil.example", "localhost.evil.example", "10.0.0.1",
                             "", "[::2]", "box", "box:9001", "hub.example.org.evil", "[::1", "128.0.0.1"})
        EXPECT_EQ(judge(policy, head("GET", {{"Host", host}})), 421) << host;
    EXPECT_EQ(judge(policy, head("GET", {})), 421);
}

TEST(AccessPolicy, TheAddressReachedIsAHost) {
    const AccessPolicy policy({kToken, "0.0.0.0", {}});
    const Peer peer{"10.1.1.9", "10.1.1.2"};
    EXPECT_EQ(judge(policy, head("GET", {{"Host", "10.1.1.2:8080"}}), "token=" + kToken, true, peer), 0);
    EXPECT_EQ(judge(policy, head("GET", {{"Host", "10.1.1.3:8080"}}), "token=" + kToken, true, peer), 421);
}

TEST(AccessPolicy, OriginMustBeTheHost) {
    const AccessPolicy policy({"", "127.0.0.1", {"hub.example.org"}});
    const auto origin = [&](const std::string& host, const std::string& from) {
        return judge(policy, head("POST", {{"Host", host}, {"Origin", from}}));
    };
    EXPECT_EQ(origin("localhost:8080", "http://localhost:8080"), 0);
    EXPECT_EQ(origin("localhost:5555", "http://LOCALHOST:5555"), 0); // an SSH tunnel on another port
    EXPECT_EQ(origin("localhost", "http://localhost:80"), 0);
    EXPECT_EQ(origin("localhost:8080", "https://hub.example.org"), 0);
    for (const auto* from : {"http://localhost:8081", "http://evil.example", "null", "http://127.0.0.1:8080",
                             "file://", "", "chrome-extension://localhost:8080"})
        EXPECT_EQ(origin("localhost:8080", from), 403) << from;
    EXPECT_EQ(judge(policy, head("GET", {{"Host", "localhost"}, {"Origin", "http://evil.example"}})), 403);
    EXPECT_EQ(judge(policy, head("POST", {{"Host", "localhost"}, {"Sec-Fetch-Site", "cross-site"}})), 403);
    EXPECT_EQ(judge(policy, head("POST", {{"Host", "localhost"}, {"Sec-Fetch-Site", "same-origin"}})), 0);
    EXPECT_EQ(judge(policy, head("POST", {{"Host", "localhost"}})), 0); // not a browser
}

TEST(AccessPolicy, NoTokenOnlyOnLoopback) {
    EXPECT_THROW(AccessPolicy({"", "0.0.0.0", {}}), InvalidInput);
    EXPECT_THROW(AccessPolicy({"", "192.168.1.5", {}}), InvalidInput);
    EXPECT_NO_THROW(AccessPolicy({"", "::1", {}}));
    EXPECT_THROW(AccessPolicy({"short", "127.0.0.1", {}}), InvalidInput);
    EXPECT_THROW(AccessPolicy({"has space;semicolon", "127.0.0.1", {}}), InvalidInput);
}

TEST(Token, IsRandomAndLong) {
    const auto token = randomToken();
    EXPECT_EQ(token.size(), 32U);
    EXPECT_NE(token, randomToken());
    EXPECT_NO_THROW(validateToken(token));
    EXPECT_TRUE(equalInConstantTime(token, token));
    EXPECT_FALSE(equalInConstantTime(token, token.substr(1)));
}

} // namespace
