// The route table, the checks that every request passes, and the answer to what fails.
#pragma once

#include "http/guard/access_policy.h"
#include "http/net/admission.h"
#include "http/route/route.h"

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace voxsheet::http {

struct RouteMatch {
    const Route* route = nullptr; ///< nullptr: no such path, or not with this method
    std::map<std::string, std::string> params;
    std::vector<std::string> allowedMethods; ///< of the path, when only the method does not fit
};

class Router {
public:
    void add(Route route);
    [[nodiscard]] const std::vector<Route>& routes() const { return routes_; }
    /// Literal segments win over placeholders. Throws InvalidInput for a malformed escape.
    /// \param encodedPath  percent-encoded: an encoded '/' belongs to its segment
    [[nodiscard]] RouteMatch match(std::string_view method, std::string_view encodedPath) const;

private:
    std::vector<Route> routes_;
};

struct RouterStatistics {
    std::map<int, std::uint64_t> byStatus;
};

/// Router, access policy and base path as what HttpServer asks for. Thread-safe once built.
class Application {
public:
    /// \param basePath  "" or "/name…" with no '/' at the end; requests may come with or without it, as
    /// proxies differ
    Application(Router router, AccessPolicy policy, std::string basePath);

    [[nodiscard]] Admission admit(const RequestHead& head, const Peer& peer) const;
    [[nodiscard]] const Router& router() const { return router_; }
    [[nodiscard]] const AccessPolicy& policy() const { return policy_; }
    [[nodiscard]] RouterStatistics statistics() const;

    /// Adds what every response carries, whoever wrote it.
    [[nodiscard]] static Response finished(Response response);

private:
    [[nodiscard]] Admission admitOrThrow(const RequestHead& head, const Peer& peer) const;
    [[nodiscard]] Response run(const Route& route, Request& request) const noexcept;

    Router router_;
    AccessPolicy policy_;
    std::string basePath_;
    struct Counters;
    std::shared_ptr<Counters> counters_;
};

/// "" or "/name…". Throws InvalidInput for characters that a URL path cannot hold.
[[nodiscard]] std::string normalisedBasePath(const std::string& text);

} // namespace voxsheet::http
