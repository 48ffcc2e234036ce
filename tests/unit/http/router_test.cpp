#include "base/errors.h"
#include "http/route/json_answer.h"
#include "http/route/open_api.h"
#include "http/route/problem.h"
#include "http/route/router.h"

#include <gtest/gtest.h>

#include <stdexcept>

using namespace voxsheet;
using namespace voxsheet::http;

namespace {

const Peer kPeer{"127.0.0.1", "127.0.0.1"};

Router sampleRouter() {
    Router router;
    const auto echo = [](Request& request) {
        nlohmann::json answer = nlohmann::json::object();
        for (const auto& [name, value] : request.params)
            answer[name] = value;
        return jsonAnswer(answer);
    };
    router.add({.method = "GET", .pattern = "/sheets/{sheet}/cells/{cell}", .handler = echo});
    router.add({.method = "PATCH",
                .pattern = "/sheets/{sheet}/cells/{cell}",
                .handler = echo,
                .bodyBudgetBytes = 100});
    router.add({.method = "GET", .pattern = "/sheets/{sheet}/image.{format}", .handler = echo});
    router.add({.method = "GET", .pattern = "/sheets/{sheet}/stream", .handler = echo, .pool = Pool::Stream});
    router.add({.method = "GET", .pattern = "/sheets/{sheet}/stream.mjpeg", .handler = echo});
    router.add({.method = "GET", .pattern = "/asked", .handler = echo, .query = {{"known", "string", ""}}});
    router.add({.method = "GET", .pattern = "/fails", .handler = [](Request&) -> Response {
                    throw std::runtime_error("secret of the house");
                }});
    return router;
}

Application application(const std::string& basePath = {}) {
    return {sampleRouter(), AccessPolicy({"", "127.0.0.1", {}}), basePath};
}

RequestHead head(const std::string& method, const std::string& path, const std::string& query = {}) {
    RequestHead out;
    out.method = method;
    out.path = path;
    out.query = query;
    out.headers.add("Host", "localhost");
    return out;
}

Response ask(const Application& app, const RequestHead& request) {
    auto admission = app.admit(request, kPeer);
    if (admission.refusal) return *admission.refusal;
    return admission.handle(admission.request);
}

TEST(Router, MatchesMostLiteralFirst) {
    const auto router = sampleRouter();
    EXPECT_EQ(router.match("GET", "/sheets/S%2F1/cells/A1").params.at("sheet"), "S/1");
    EXPECT_EQ(router.match("GET", "/sheets/S/image.png").params.at("format"), "png");
    EXPECT_EQ(router.match("GET", "/sheets/S/stream").route->pattern, "/sheets/{sheet}/stream");
    EXPECT_EQ(router.match("GET", "/sheets/S/stream.mjpeg").route->pattern, "/sheets/{sheet}/stream.mjpeg");
    EXPECT_EQ(router.match("GET", "/sheets//cells/A1").route, nullptr); // a placeholder is never empty
    EXPECT_EQ(router.match("GET", "/sheets/S/cells").route, nullptr);
    EXPECT_EQ(router.match("GET", "/sheets/S/cells/A1/").route, nullptr);
    EXPECT_EQ(router.match("HEAD", "/sheets/S/image.png").route->method, "GET");
    EXPECT_THROW(static_cast<void>(router.match("GET", "/sheets/%zz/cells/A1")), InvalidInput);
    EXPECT_THROW(static_cast<void>(router.match("GET", "/sheets/a%00b/cells/A1")), InvalidInput);
}

TEST(Application, Refusals) {
    const auto app = application();
    EXPECT_EQ(ask(app, head("GET", "/nothing")).status, 404);
    const auto wrongMethod = ask(app, head("DELETE", "/sheets/S/cells/A1"));
    EXPECT_EQ(wrongMethod.status, 405);
    EXPECT_EQ(wrongMethod.headers.find("Allow"), "GET, HEAD, PATCH");
    EXPECT_EQ(ask(app, head("HEAD", "/sheets/S/stream")).status, 405);
    const auto unknownKey = ask(app, head("GET", "/asked", "known=1&other=2"));
    EXPECT_EQ(unknownKey.status, 400);
    EXPECT_EQ(nlohmann::json::parse(unknownKey.body).at("field"), "other");
    auto withBody = head("GET", "/asked");
    withBody.contentLength = 1;
    EXPECT_EQ(ask(app, withBody).status, 413);
}

TEST(Application, EveryAnswerCarriesTheGuards) {
    const auto app = application();
    for (const auto* path : {"/asked", "/nothing", "/fails"}) {
        const auto response = ask(app, head("GET", path));
        EXPECT_EQ(response.headers.find("X-Content-Type-Options"), "nosniff") << path;
        EXPECT_EQ(response.headers.find("Referrer-Policy"), "no-referrer") << path;
        EXPECT_EQ(response.headers.find("Cache-Control"), "no-store") << path;
    }
}

TEST(Application, ForeignExceptionsKeepTheirTextToTheLog) {
    const auto response = ask(application(), head("GET", "/fails"));
    EXPECT_EQ(response.status, 500);
    EXPECT_EQ(response.contentType, "application/problem+json");
    EXPECT_EQ(response.body.find("secret"), std::string::npos);
}

TEST(Application, BasePathWithAndWithoutPrefix) {
    const auto app = application("user/me/");
    EXPECT_EQ(ask(app, head("GET", "/user/me/asked")).status, 200);
    EXPECT_EQ(ask(app, head("GET", "/asked")).status, 200);
    EXPECT_EQ(ask(app, head("GET", "/user/mean/asked")).status, 404);
    const auto redirect = ask(app, head("GET", "/user/me"));
    EXPECT_EQ(redirect.status, 308);
    EXPECT_EQ(redirect.headers.find("Location"), "/user/me/");
    EXPECT_THROW(static_cast<void>(normalisedBasePath("/a b")), InvalidInput);
    EXPECT_EQ(normalisedBasePath("a%20b/"), "/a%20b");
    for (const char* bad : {"//evil.example", "/a//b", "/a/../b", "/.", "..", "/a?b", "/a#b", "/a%2",
                            "/\xC3\xA9", "http://host/a", "/a;b", "/a\\b"})
        EXPECT_THROW(static_cast<void>(normalisedBasePath(bad)), InvalidInput) << bad;
}

TEST(Problem, EveryKindHasAStatus) {
    EXPECT_EQ(statusOf(ErrorKind::InvalidInput), 400);
    EXPECT_EQ(statusOf(ErrorKind::NotFound), 404);
    EXPECT_EQ(statusOf(ErrorKind::Conflict), 409);
    EXPECT_EQ(statusOf(ErrorKind::LimitExceeded), 413);
    EXPECT_EQ(statusOf(ErrorKind::Unsupported), 501);
    EXPECT_EQ(statusOf(ErrorKind::GpuError), 503);
    EXPECT_EQ(statusOf(ErrorKind::IoError), 500);
    const auto response = problem(404, "no \xFF such thing", "name");
    const auto body = nlohmann::json::parse(response.body);
    EXPECT_EQ(body.at("title"), "Not Found");
    EXPECT_EQ(body.at("status"), 404);
    EXPECT_EQ(body.at("field"), "name");
}

TEST(JsonBody, DepthTypeAndMediaType) {
    Request request;
    request.body = R"({"a": 1})";
    EXPECT_EQ(jsonBody(request).at("a"), 1);
    request.headers.add("Content-Type", "image/png");
    EXPECT_THROW(static_cast<void>(jsonBody(request)), HttpError);
    request.headers.set("Content-Type", "application/json; charset=utf-8");
    EXPECT_NO_THROW(static_cast<void>(jsonBody(request)));
    request.body = "[1]";
    EXPECT_THROW(static_cast<void>(jsonBody(request)), InvalidInput);
    request.body = R"({"a":)" + std::string(1'000'000, '[');
    EXPECT_THROW(static_cast<void>(jsonBody(request)), InvalidInput);
    request.body = "{\"a\":\"\xFF\"}";
    EXPECT_THROW(static_cast<void>(jsonBody(request)), InvalidInput);
}

TEST(JsonBody, TypedMembers) {
    const auto object =
        nlohmann::json::parse(R"({"n": 5, "big": 18446744073709551615, "f": 1.5, "t": "x", "b": true})");
    EXPECT_EQ(integerIn(object, "n", 0, 10), 5);
    for (const auto* name : {"big", "f", "t", "b", "absent"})
        EXPECT_THROW(static_cast<void>(integerIn(object, name, 0, 10)), InvalidInput) << name;
    EXPECT_THROW(static_cast<void>(requireString(object, "n")), InvalidInput);
    EXPECT_EQ(stringOr(object, "absent", "y"), "y");
    EXPECT_THROW(allowMembers(object, {"n", "big", "f", "t"}), InvalidInput);
}

TEST(OpenApi, DescribesEveryRoute) {
    const auto router = sampleRouter();
    const auto document = describeRoutes(router.routes(), "1.2.3", "/base");
    EXPECT_EQ(document.at("openapi"), "3.1.0");
    EXPECT_EQ(document.at("servers").at(0).at("url"), "/base");
    for (const auto& route : router.routes())
        EXPECT_TRUE(document.at("paths").at(route.pattern).contains(lowerCase(route.method)))
            << route.pattern;
    const auto& parameters =
        document.at("paths").at("/sheets/{sheet}/image.{format}").at("get").at("parameters");
    EXPECT_EQ(parameters.at(0).at("name"), "sheet");
    EXPECT_EQ(parameters.at(1).at("name"), "format");
}

} // namespace
