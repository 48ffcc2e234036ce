// An HTTP/1.1 server that no single client can stop.
//
// One thread owns every socket: it collects heads and small bodies and sends finished responses without ever
// blocking, so that slow or silent clients cost a buffer and no thread. Handlers run in pools
// (ServerOptions). Streams and uploads use their socket themselves, on a thread of their own, with a lowest
// rate.
#pragma once

#include "http/net/admission.h"
#include "http/net/server_options.h"

#include <cstdint>
#include <memory>
#include <string>

namespace voxsheet::http {

struct ServerCounters {
    std::uint64_t accepted = 0;
    std::uint64_t requests = 0;
    std::uint64_t refused = 0; ///< malformed, too long, too slow, or over a limit
    std::uint64_t sentBytes = 0;
    int connections = 0; ///< open now
};

class HttpServer {
public:
    /// Binds, so that the port is known; serves from start() on. Throws as listenOn.
    HttpServer(const ServerOptions& options, Admit admit, Refuse refuse);
    ~HttpServer();
    HttpServer(const HttpServer&) = delete;
    HttpServer& operator=(const HttpServer&) = delete;

    [[nodiscard]] int port() const;
    [[nodiscard]] const std::string& host() const; ///< numeric address
    void start();
    /// Stops accepting, tells handlers to end (Request::gone), closes streams. False: a handler still ran
    /// after `seconds`; its thread must not be allowed to outlive what it uses, so the program should end by
    /// std::_Exit.
    bool stop(double seconds = 1.5);
    [[nodiscard]] ServerCounters counters() const;

private:
    class Loop;
    std::shared_ptr<Loop> loop_;
};

} // namespace voxsheet::http
