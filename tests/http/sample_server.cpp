#include "sample_server.h"

#include "fields/patience.h"
#include "http/route/problem.h"
#include "raw_client.h"

#include <gtest/gtest.h>

#include <chrono>
#include <stdexcept>
#include <string>
#include <thread>

namespace voxsheet::http_test {

using http::Pool;
using http::Request;
using http::Response;

namespace {

Response text(std::string body) { return {200, "text/plain", std::move(body)}; }

} // namespace

http::ServerOptions SampleServer::quickOptions() {
    http::ServerOptions options;
    options.port = 0;
    const double patience = fields::patience(); // honest clients of a busy machine are slow too
    options.headSeconds = 1.0 * patience;
    options.idleSeconds = 20.0 * patience;
    options.stallSeconds = 1.0 * patience;
    return options;
}

http::Router SampleServer::routes() {
    http::Router router;
    router.add({.method = "GET", .pattern = "/quick", .handler = [](Request&) { return text("ok"); }});
    router.add({.method = "GET", .pattern = "/big", .handler = [](Request&) {
                    return text(std::string(4U << 20U, 'x'));
                }});
    router.add({.method = "GET",
                .pattern = "/block",
                .handler =
                    [this](Request& request) {
                        ++blocked;
                        while (!release && !request.cancelled())
                            std::this_thread::sleep_for(std::chrono::milliseconds(5));
                        if (request.cancelled()) ++cancelled;
                        --blocked;
                        return text("released");
                    },
                .pool = Pool::Render});
    router.add({.method = "GET",
                .pattern = "/stream",
                .handler =
                    [this](Request&) {
                        Response response{200, "application/octet-stream", {}};
                        response.stream = [this](http::StreamWriter& writer) {
                            ++streaming;
                            while (writer.write("tick\n"))
                                std::this_thread::sleep_for(std::chrono::milliseconds(20));
                            --streaming;
                        };
                        return response;
                    },
                .pool = Pool::Stream});
    router.add({.method = "POST",
                .pattern = "/echo",
                .handler = [](Request& request) { return text(request.body); },
                .bodyBudgetBytes = 1U << 20U});
    router.add({.method = "PUT",
                .pattern = "/upload",
                .handler =
                    [](Request& request) {
                        std::size_t total = 0;
                        for (std::string piece; request.bodyReader->read(piece); piece.clear())
                            total += piece.size();
                        return text(std::to_string(total));
                    },
                .bodyBudgetBytes = 64U << 20U,
                .streamsBody = true,
                .pool = Pool::Stream});
    router.add({.method = "GET", .pattern = "/throw", .handler = [](Request&) -> Response {
                    throw std::runtime_error("secret of the house");
                }});
    router.add({.method = "GET",
                .pattern = "/header",
                .handler =
                    [](Request& request) {
                        auto response = text("ok");
                        response.headers.add("X-Echo", request.query.requireText("value"));
                        return response;
                    },
                .query = {{"value", "string", ""}}});
    return router;
}

SampleServer::SampleServer(http::ServerOptions options) {
    application_ = std::make_unique<http::Application>(routes(), http::AccessPolicy({"", "127.0.0.1", {}}),
                                                       std::string{});
    server_ = std::make_unique<http::HttpServer>(
        options,
        [this](const http::RequestHead& head, const http::Peer& peer) {
            return application_->admit(head, peer);
        },
        [](int status, const std::string& detail) { return http::problem(status, detail); });
    server_->start();
}

SampleServer::~SampleServer() {
    release = true;
    server_->stop();
}

double SampleServer::quickLatency() const {
    const auto start = std::chrono::steady_clock::now();
    EXPECT_EQ(statusOfResponse(exchange(port(), getRequest("/quick"), 10.0)), 200);
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

} // namespace voxsheet::http_test
