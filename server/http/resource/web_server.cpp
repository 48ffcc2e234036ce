#include "http/resource/web_server.h"

#include "http/route/problem.h"

namespace voxsheet::http {

namespace {

AccessPolicy policyOf(const WebServerOptions& options) {
    return AccessPolicy({options.token, options.server.host, options.allowedHosts});
}

} // namespace

struct WebServer::Parts {
    Parts(const WebServerOptions& options, engine::Engine& engine, stream::TileService& tiles,
          stream::StreamHub& hub)
        : policy(policyOf(options)), context{engine,
                                             tiles,
                                             hub,
                                             {options.version, normalisedBasePath(options.basePath),
                                              options.uploadLimitBytes, options.openDemo},
                                             policy.cookieName(),
                                             policy.token(),
                                             [this] { return server->counters(); },
                                             [this] { return application.statistics(); }},
          application(makeRouter(context), policy, context.settings.basePath),
          server(std::make_unique<HttpServer>(
              options.server,
              [this](const RequestHead& head, const Peer& peer) { return application.admit(head, peer); },
              [](int status, const std::string& detail) {
                  return Application::finished(problem(status, detail));
              })) {}

    AccessPolicy policy;
    ApiContext context;
    Application application;
    std::unique_ptr<HttpServer> server; ///< last: its threads use the others
};

WebServer::WebServer(const WebServerOptions& options, engine::Engine& engine, stream::TileService& tiles,
                     stream::StreamHub& hub)
    : parts_(std::make_unique<Parts>(options, engine, tiles, hub)) {}

WebServer::~WebServer() { stop(); }

void WebServer::start() { parts_->server->start(); }

bool WebServer::stop(double seconds) {
    parts_->context.hub.stop();
    return parts_->server->stop(seconds);
}

int WebServer::port() const { return parts_->server->port(); }

std::string WebServer::pageUrl() const {
    auto host = parts_->server->host();
    if (host == "0.0.0.0" || host == "::") host = "127.0.0.1";
    if (host.find(':') != std::string::npos) host = "[" + host + "]";
    auto url = "http://" + host + ":" + std::to_string(port()) + parts_->context.settings.basePath + "/";
    if (!parts_->policy.token().empty()) url += "?token=" + parts_->policy.token();
    return url;
}

} // namespace voxsheet::http
