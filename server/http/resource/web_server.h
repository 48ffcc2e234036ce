// The whole HTTP side: address, access, routes. What `voxsheet serve` starts.
#pragma once

#include "http/guard/access_policy.h"
#include "http/net/server_options.h"
#include "http/resource/api_context.h"

#include <functional>
#include <memory>
#include <string>

namespace voxsheet::http {

struct WebServerOptions {
    ServerOptions server;
    std::string token; ///< empty: none is asked for (loopback only)
    std::vector<std::string> allowedHosts;
    std::string basePath; ///< "" or "/name…"
    std::string version;
    std::uint64_t uploadLimitBytes = std::uint64_t{64} << 30U;
    std::function<void()> openDemo; ///< what the page's "look at the demo" does; empty: it offers none
};

class WebServer {
public:
    /// Binds; serves from start() on. The engine, the tiles and the hub must outlive it.
    /// Throws InvalidInput (token, host, base path), Conflict (port in use), IoError.
    WebServer(const WebServerOptions& options, engine::Engine& engine, stream::TileService& tiles,
              stream::StreamHub& hub);
    ~WebServer();
    WebServer(const WebServer&) = delete;
    WebServer& operator=(const WebServer&) = delete;

    void start();
    /// Ends streams (the hub stops for good) and requests. False: a handler still ran after `seconds`; then
    /// end the program by std::_Exit, since its thread still uses the engine.
    bool stop(double seconds = 1.5);
    [[nodiscard]] int port() const;
    /// "http://HOST:PORT/BASE/?token=…": what the page opens with. A wildcard address is given as 127.0.0.1.
    [[nodiscard]] std::string pageUrl() const;

private:
    struct Parts;
    std::unique_ptr<Parts> parts_;
};

} // namespace voxsheet::http
