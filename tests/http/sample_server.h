// A server with a few made-up routes, for tests of the server itself.
#pragma once

#include "http/net/http_server.h"
#include "http/route/router.h"

#include <atomic>
#include <memory>

namespace voxsheet::http_test {

/// Routes: GET /quick; GET /big (4 MiB); GET /block (render pool, until released or cancelled); GET /stream
/// (until the client goes); POST /echo (budget 1 MiB); PUT /upload (streams its body, budget 64 MiB; answers
/// its length); GET /throw; GET /header?value= (puts the value into a header field).
class SampleServer {
public:
    explicit SampleServer(http::ServerOptions options = quickOptions());
    ~SampleServer();
    SampleServer(const SampleServer&) = delete;
    SampleServer& operator=(const SampleServer&) = delete;

    /// Port 0 and deadlines short enough for tests.
    [[nodiscard]] static http::ServerOptions quickOptions();
    [[nodiscard]] int port() const { return server_->port(); }
    [[nodiscard]] http::HttpServer& server() { return *server_; }
    /// Seconds that a new client waits for GET /quick; fails the test if it is not answered.
    [[nodiscard]] double quickLatency() const;

    std::atomic<bool> release{false}; ///< lets /block return
    std::atomic<int> blocked{0};      ///< handlers inside /block
    std::atomic<int> cancelled{0};    ///< /block handlers that saw the client go
    std::atomic<int> streaming{0};    ///< open /stream

private:
    [[nodiscard]] http::Router routes();

    std::unique_ptr<http::Application> application_;
    std::unique_ptr<http::HttpServer> server_;
};

} // namespace voxsheet::http_test
