#include "http/route/router.h"

#include "base/errors.h"
#include "http/route/problem.h"
#include "http/route/sign_in_page.h"

#include <algorithm>
#include <mutex>

namespace voxsheet::http {

namespace {

std::vector<std::string_view> segmentsOf(std::string_view path) {
    std::vector<std::string_view> segments;
    path.remove_prefix(1); // the leading '/'
    for (;;) {
        const auto slash = path.find('/');
        segments.push_back(path.substr(0, slash));
        if (slash == std::string_view::npos) return segments;
        path.remove_prefix(slash + 1);
    }
}

/// How well one segment fits: 0 not at all, 1 placeholder, 2 literal with placeholder, 3 literal.
int fit(std::string_view pattern, const std::string& segment, std::map<std::string, std::string>& params) {
    const auto brace = pattern.find('{');
    if (brace == std::string_view::npos) return pattern == segment ? 3 : 0;
    const auto prefix = pattern.substr(0, brace);
    if (segment.size() <= prefix.size() || !segment.starts_with(prefix)) return 0;
    params[std::string(pattern.substr(brace + 1, pattern.size() - brace - 2))] =
        segment.substr(prefix.size());
    return prefix.empty() ? 1 : 2;
}

struct Candidate {
    const Route* route = nullptr;
    std::vector<int> fits; ///< per segment
    std::map<std::string, std::string> params;
};

std::optional<Candidate> tryRoute(const Route& route, const std::vector<std::string>& segments) {
    const auto patterns = segmentsOf(route.pattern);
    if (patterns.size() != segments.size()) return std::nullopt;
    Candidate candidate{&route, {}, {}};
    for (std::size_t i = 0; i < segments.size(); ++i) {
        const int quality = fit(patterns[i], segments[i], candidate.params);
        if (quality == 0) return std::nullopt;
        candidate.fits.push_back(quality);
    }
    return candidate;
}

bool isValidPathCharacter(char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
           std::string_view("-._~/%").find(c) != std::string_view::npos;
}

} // namespace

void Router::add(Route route) { routes_.push_back(std::move(route)); }

RouteMatch Router::match(std::string_view method, std::string_view encodedPath) const {
    std::vector<std::string> segments;
    for (const auto segment : segmentsOf(encodedPath)) {
        auto decoded = percentDecoded(segment, false);
        if (!decoded)
            throw InvalidInput("URL", "a percent escape is malformed", "write %25 for a percent sign");
        segments.push_back(*std::move(decoded));
    }
    RouteMatch match;
    std::vector<int> best;
    for (const auto& route : routes_) {
        auto candidate = tryRoute(route, segments);
        if (!candidate) continue;
        match.allowedMethods.push_back(route.method);
        if (route.method == "GET") match.allowedMethods.emplace_back("HEAD");
        const bool fits = route.method == method || (method == "HEAD" && route.method == "GET");
        if (!fits || candidate->fits <= best) continue;
        best = candidate->fits;
        match.route = &route;
        match.params = std::move(candidate->params);
    }
    return match;
}

struct Application::Counters {
    std::mutex mutex;
    std::map<int, std::uint64_t> byStatus;
    void count(int status) {
        const std::lock_guard lock(mutex);
        ++byStatus[status];
    }
};

std::string normalisedBasePath(const std::string& text) {
    std::string path = text;
    while (path.ends_with('/'))
        path.pop_back();
    if (path.empty()) return {};
    if (path.front() != '/') path.insert(path.begin(), '/');
    const auto segments = segmentsOf(path);
    const bool walks = std::any_of(segments.begin(), segments.end(), [](std::string_view segment) {
        return segment.empty() || segment == "." || segment == ".."; // browsers and proxies rewrite these
    });
    if (walks || !std::all_of(path.begin(), path.end(), isValidPathCharacter) || !percentDecoded(path, false))
        throw InvalidInput(
            "base path '" + text + "'",
            "it is not a path of letters, digits, -._~ and percent escapes without '.' and '..'",
            "give the prefix that the proxy adds, e.g. /user/me/voxsheet")
            .withField("base-path");
    return path;
}

Application::Application(Router router, AccessPolicy policy, std::string basePath)
    : router_(std::move(router)), policy_(std::move(policy)), basePath_(normalisedBasePath(basePath)),
      counters_(std::make_shared<Counters>()) {}

RouterStatistics Application::statistics() const {
    const std::lock_guard lock(counters_->mutex);
    return {counters_->byStatus};
}

Response Application::finished(Response response) {
    auto& headers = response.headers;
    const auto setDefault = [&](const char* name, const char* value) {
        if (!headers.find(name)) headers.add(name, value);
    };
    setDefault("Cache-Control", "no-store");
    setDefault("X-Content-Type-Options", "nosniff");
    // URLs may hold the token.
    setDefault("Referrer-Policy", "no-referrer");
    setDefault("Cross-Origin-Resource-Policy", "same-origin");
    return response;
}

Admission Application::admit(const RequestHead& head, const Peer& peer) const {
    Admission admission;
    try {
        admission = admitOrThrow(head, peer);
    } catch (...) {
        admission.refusal = currentProblem();
    }
    if (admission.refusal) {
        counters_->count(admission.refusal->status);
        admission.refusal = finished(*std::move(admission.refusal));
    }
    return admission;
}

Admission Application::admitOrThrow(const RequestHead& head, const Peer& peer) const {
    Admission admission;
    std::string_view path = head.path;
    if (!basePath_.empty() && path.starts_with(basePath_)) {
        if (path.size() == basePath_.size()) { // relative URLs of the page need the '/' at the end
            admission.refusal = Response{308, {}, {}};
            admission.refusal->headers.add("Location",
                                           basePath_ + "/" + (head.query.empty() ? "" : "?" + head.query));
            return admission;
        }
        if (path[basePath_.size()] == '/') path.remove_prefix(basePath_.size());
    }
    Query query(head.query);
    auto match = router_.match(head.method, path);
    // Whoever may not come in learns nothing about which paths exist.
    const auto verdict = policy_.judge(head, query, peer, match.route == nullptr || match.route->needsToken);
    if (verdict.status != 0) {
        const bool signIn = verdict.status == 401 && wantsPage(head);
        admission.refusal = signIn ? signInPage() : problem(verdict.status, verdict.detail);
        return admission;
    }
    query.remove("token");
    if (match.route == nullptr) {
        if (match.allowedMethods.empty()) throw HttpError(404, "there is nothing at '" + head.path + "'");
        std::string allow;
        for (const auto& method : match.allowedMethods)
            allow += (allow.empty() ? "" : ", ") + method;
        admission.refusal = problem(405, "this path takes " + allow);
        admission.refusal->headers.add("Allow", allow);
        return admission;
    }
    const Route& route = *match.route;
    if (head.method == "HEAD" && route.pool == Pool::Stream) throw HttpError(405, "a stream has no HEAD");
    for (const auto& [key, value] : query.pairs()) {
        const bool known = std::any_of(route.query.begin(), route.query.end(),
                                       [&](const ParamDoc& param) { return param.name == key; });
        if (!known && !route.anyStyleKey)
            throw InvalidInput("query key '" + key + "'", "this route does not know it").withField(key);
    }
    if (head.hasBody() && route.bodyBudgetBytes == 0) throw HttpError(413, "this route takes no body");
    admission.request.method = route.method;
    admission.request.params = std::move(match.params);
    admission.request.query = std::move(query);
    admission.request.headers = head.headers;
    admission.request.byQueryToken = verdict.byQueryToken;
    admission.pool = route.pool;
    admission.bodyBudgetBytes = route.bodyBudgetBytes;
    admission.streamsBody = route.streamsBody;
    admission.handle = [this, &route](Request& request) { return run(route, request); };
    return admission;
}

Response Application::run(const Route& route, Request& request) const noexcept {
    Response response;
    try {
        response = route.handler(request);
    } catch (...) {
        response = currentProblem();
    }
    counters_->count(response.status);
    return finished(std::move(response));
}

} // namespace voxsheet::http
