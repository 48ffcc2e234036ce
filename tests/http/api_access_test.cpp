// Who may ask what, over every route that the server describes.
#include "raw_client.h"
#include "served_program.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

using namespace voxsheet::http_test;

namespace {

struct DescribedRoute {
    std::string method;
    std::string path;  ///< placeholders filled in
    bool open = false; ///< needs no token
};

std::string filled(std::string pattern) {
    const std::vector<std::pair<std::string, std::string>> values{
        {"{sheet}", "Sheet1"}, {"{cell}", "A1"}, {"{column}", "A"},   {"{row}", "1"},
        {"{format}", "png"},   {"{name}", "a"},  {"{id}", "nostream"}};
    for (const auto& [name, value] : values)
        if (const auto at = pattern.find(name); at != std::string::npos)
            pattern.replace(at, name.size(), value);
    return pattern;
}

std::vector<DescribedRoute> describedRoutes(const ServedProgram& program) {
    std::vector<DescribedRoute> routes;
    const auto document = program.get("/api/v1/openapi.json").json();
    for (const auto& [pattern, methods] : document.at("paths").items())
        for (const auto& [method, operation] : methods.items()) {
            std::string upper = method;
            std::transform(upper.begin(), upper.end(), upper.begin(),
                           [](char c) { return static_cast<char>(c >= 'a' && c <= 'z' ? c - 32 : c); });
            routes.push_back({upper, filled(pattern), operation.contains("security")});
        }
    return routes;
}

class ApiAccess : public testing::Test {
protected:
    static void SetUpTestSuite() { program_ = new ServedProgram; }
    static void TearDownTestSuite() {
        delete program_;
        program_ = nullptr;
    }
    static ServedProgram* program_;
};

ServedProgram* ApiAccess::program_ = nullptr;

TEST_F(ApiAccess, EveryRouteAsksForTheToken) {
    const auto routes = describedRoutes(*program_);
    ASSERT_GT(routes.size(), 30U);
    for (const auto& route : routes) {
        const int expected = route.open ? 200 : 401;
        const std::string host = "Host: localhost\r\n";
        EXPECT_EQ(program_->askBare(route.method, route.path, host).status, expected)
            << route.method << route.path;
        EXPECT_EQ(
            program_->askBare(route.method, route.path, host + "Authorization: Bearer wrong-token-012345\r\n")
                .status,
            expected)
            << route.method << route.path;
        EXPECT_EQ(program_->askBare(route.method, route.path + "?token=", host).status, expected)
            << route.method << route.path;
    }
}

TEST_F(ApiAccess, EveryRouteChecksHostAndOrigin) {
    const std::string bearer = "Authorization: Bearer " + program_->token() + "\r\n";
    for (const auto& route : describedRoutes(*program_)) {
        EXPECT_EQ(program_->askBare(route.method, route.path, "Host: evil.example\r\n" + bearer).status, 421)
            << route.method << route.path;
        EXPECT_EQ(program_
                      ->askBare(route.method, route.path,
                                "Host: localhost\r\nOrigin: http://evil.example\r\n" + bearer)
                      .status,
                  403)
            << route.method << route.path;
    }
}

TEST_F(ApiAccess, UnknownPathsLookLikeAnyOtherWithoutToken) {
    EXPECT_EQ(program_->askBare("GET", "/api/v1/nothing", "Host: localhost\r\n").status, 401);
    EXPECT_EQ(program_->get("/api/v1/nothing").status, 404);
}

TEST_F(ApiAccess, APersonWithoutTokenGetsAPageToRead) {
    const auto page = program_->askBare("GET", "/", "Host: localhost\r\nAccept: text/html,*/*\r\n");
    EXPECT_EQ(page.status, 401);
    EXPECT_EQ(page.field("Content-Type"), "text/html; charset=utf-8");
    EXPECT_NE(page.body.find("<form"), std::string::npos);
    EXPECT_EQ(page.body.find(program_->token()), std::string::npos);
}

TEST_F(ApiAccess, PageSetsACookieThatOpensTheRest) {
    const auto page = program_->askBare("GET", "/?token=" + program_->token(), "Host: localhost\r\n");
    EXPECT_EQ(page.status, 200);
    EXPECT_NE(page.field("Content-Security-Policy"), "");
    const auto cookie = page.field("Set-Cookie");
    EXPECT_NE(cookie.find("HttpOnly"), std::string::npos);
    EXPECT_NE(cookie.find("SameSite=Strict"), std::string::npos);
    EXPECT_NE(cookie.find("Path=/"), std::string::npos);
    const auto pair = cookie.substr(0, cookie.find(';'));
    EXPECT_EQ(program_->askBare("GET", "/api/v1", "Host: localhost\r\nCookie: " + pair + "\r\n").status, 200);
    // A tunnel on another port: the page's own origin is what Host says.
    EXPECT_EQ(
        program_
            ->askBare("POST", "/api/v1/undo",
                      "Host: localhost:5555\r\nOrigin: http://localhost:5555\r\nCookie: " + pair + "\r\n")
            .status,
        200);
}

TEST_F(ApiAccess, NoPathLeadsOut) {
    const std::vector<std::string> payloads{"/etc",
                                            "/etc/passwd",
                                            program_->folder().string() + "/..",
                                            program_->folder().string() + "/../..",
                                            program_->folder().string() + "/../data/../../",
                                            program_->folder().string() + "ta",
                                            "..",
                                            "../..",
                                            "~",
                                            "/proc/self",
                                            "/proc/self/environ",
                                            "/dev",
                                            "file:///etc/passwd",
                                            program_->folder().string() + "/a.nrrd/..",
                                            "\\..\\..",
                                            ".",
                                            "%2e%2e"};
    for (const auto& payload : payloads) {
        std::string encoded;
        for (const char c : payload)
            encoded += c == '%' ? "%25" : c == '\\' ? "%5C" : std::string(1, c);
        const auto listing = program_->get("/api/v1/files?path=" + encoded);
        EXPECT_EQ(listing.status, 404) << payload << listing.body;
        const auto preview = program_->get("/api/v1/files/preview?path=" + encoded);
        EXPECT_TRUE(preview.status == 400 || preview.status == 404) << payload << preview.body;
        const auto import = program_->ask("POST", "/api/v1/datasets",
                                          nlohmann::json{{"files", {payload}}, {"place", false}}.dump());
        EXPECT_TRUE(import.status == 400 || import.status == 404) << payload << import.body;
    }
    for (const auto* path :
         {"/../../etc/passwd", "/%2e%2e/%2e%2e/etc/passwd", "/..%2f..%2fetc%2fpasswd", "//etc/passwd"})
        EXPECT_EQ(program_->get(path).status, 404) << path;
    const auto save = program_->ask("POST", "/api/v1/workbook/save", R"({"path": "/etc/voxsheet.json"})");
    EXPECT_EQ(save.status, 400);
}

TEST_F(ApiAccess, NothingOfTheAboveBrokeIt) {
    EXPECT_EQ(program_->askBare("GET", "/livez", "Host: localhost\r\n").body, "ok\n");
    EXPECT_EQ(program_->get("/readyz").status, 200);
}

} // namespace
