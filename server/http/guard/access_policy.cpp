#include "http/guard/access_policy.h"

#include "base/errors.h"
#include "http/guard/token.h"

#include <algorithm>
#include <arpa/inet.h>
#include <array>
#include <unistd.h>

namespace voxsheet::http {

namespace {

/// Host and port of "name", "name:80", "[::1]:80"; brackets are taken off.
std::pair<std::string, std::string> splitAuthority(std::string_view authority) {
    if (authority.starts_with('[')) {
        const auto end = authority.find(']');
        if (end == std::string_view::npos) return {};
        const auto rest = authority.substr(end + 1);
        if (!rest.empty() && rest.front() != ':') return {};
        return {lowerCase(authority.substr(1, end - 1)), std::string(rest.empty() ? rest : rest.substr(1))};
    }
    const auto colon = authority.find(':');
    if (colon == std::string_view::npos) return {lowerCase(authority), {}};
    return {lowerCase(authority.substr(0, colon)), std::string(authority.substr(colon + 1))};
}

std::string machineName() {
    std::array<char, 256> name{};
    return ::gethostname(name.data(), name.size() - 1) == 0 ? lowerCase(name.data()) : std::string{};
}

std::optional<std::string_view> bearerToken(const RequestHead& head) {
    const auto text = head.headers.find("Authorization");
    constexpr std::string_view scheme = "bearer ";
    if (!text || text->size() < scheme.size() || !equalIgnoringCase(text->substr(0, scheme.size()), scheme))
        return std::nullopt;
    return trimmed(text->substr(scheme.size()));
}

std::optional<std::string_view> cookie(const RequestHead& head, std::string_view name) {
    for (const auto& [field, value] : head.headers.fields()) {
        if (!equalIgnoringCase(field, "Cookie")) continue;
        std::string_view rest = value;
        while (!rest.empty()) {
            const auto end = rest.find(';');
            const auto pair = trimmed(rest.substr(0, end));
            const auto equals = pair.find('=');
            if (equals != std::string_view::npos && pair.substr(0, equals) == name)
                return pair.substr(equals + 1);
            if (end == std::string_view::npos) break;
            rest.remove_prefix(end + 1);
        }
    }
    return std::nullopt;
}

} // namespace

bool isLoopbackName(std::string_view name) {
    const auto lower = lowerCase(name);
    if (lower == "localhost" || lower.ends_with(".localhost") || lower == "::1") return true;
    in_addr address{};
    return ::inet_pton(AF_INET, lower.c_str(), &address) == 1 && (ntohl(address.s_addr) >> 24U) == 127;
}

AccessPolicy::AccessPolicy(AccessOptions options) : options_(std::move(options)) {
    if (options_.token.empty()) {
        if (!isLoopbackName(options_.boundHost))
            throw InvalidInput("--no-token",
                               "'" + options_.boundHost + "' can be reached from other machines",
                               "use a token, or --host 127.0.0.1")
                .withField("no-token");
    } else {
        validateToken(options_.token);
    }
    cookieName_ = cookieNameFor(options_.token);
    if (!isLoopbackName(options_.boundHost)) machineName_ = machineName();
}

bool AccessPolicy::listed(std::string_view authority) const {
    const auto [name, port] = splitAuthority(authority);
    return std::any_of(
        options_.allowedHosts.begin(), options_.allowedHosts.end(), [&](const std::string& allowed) {
            const auto [allowedName, allowedPort] = splitAuthority(allowed);
            return !name.empty() && allowedName == name && (allowedPort.empty() || allowedPort == port);
        });
}

bool AccessPolicy::hostIsOurs(std::string_view authority, const Peer& peer) const {
    const auto [name, port] = splitAuthority(authority);
    if (name.empty()) return false;
    if (isLoopbackName(name) || listed(authority)) return true;
    // An address cannot be rebound as a name can: the one that the client really reached is ours.
    if (!peer.localAddress.empty() && name == lowerCase(peer.localAddress)) return true;
    if (name == lowerCase(options_.boundHost)) return true;
    return !machineName_.empty() && (name == machineName_ || name.starts_with(machineName_ + "."));
}

bool AccessPolicy::originIsOurs(const RequestHead& head) const {
    const auto origin = head.headers.find("Origin");
    if (!origin) {
        // Browsers that send no Origin with a request may still say where it comes from.
        const auto site = head.headers.find("Sec-Fetch-Site");
        const bool safe = head.method == "GET" || head.method == "HEAD";
        return safe || !site || *site == "same-origin" || *site == "none";
    }
    const auto separator = origin->find("://");
    if (separator == std::string_view::npos) return false; // "null" too
    const auto scheme = lowerCase(origin->substr(0, separator));
    if (scheme != "http" && scheme != "https") return false;
    const auto authority = origin->substr(separator + 3);
    if (listed(authority)) return true;
    const auto defaultPort = scheme == "https" ? "443" : "80";
    auto own = splitAuthority(head.headers.find("Host").value_or(""));
    auto theirs = splitAuthority(authority);
    if (own.second.empty()) own.second = defaultPort;
    if (theirs.second.empty()) theirs.second = defaultPort;
    return !own.first.empty() && own == theirs;
}

AccessVerdict AccessPolicy::judge(const RequestHead& head, const Query& query, const Peer& peer,
                                  bool needsToken) const {
    const auto host = head.headers.find("Host");
    if (!host || !hostIsOurs(*host, peer))
        return {
            421,
            "this server does not answer to the host name of this request; start it with --allow-host NAME "
            "to call it by that name"};
    if (!originIsOurs(head)) return {403, "requests from pages of another site are refused"};
    if (!needsToken || options_.token.empty()) return {};
    if (const auto given = bearerToken(head); given && equalInConstantTime(*given, options_.token)) return {};
    if (const auto given = query.text("token"); given && equalInConstantTime(*given, options_.token))
        return {0, {}, true};
    if (const auto given = cookie(head, cookieName_); given && equalInConstantTime(*given, options_.token))
        return {};
    return {401,
            "the token is missing or wrong; open the URL that the server printed when it started, or send "
            "'Authorization: Bearer TOKEN'"};
}

} // namespace voxsheet::http
