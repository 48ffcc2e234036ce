// Who may ask: the token, the Host and the Origin of a request.
//
// Host: a page of another site can make its own name point at this machine (DNS rebinding); then the browser
// sends that name as Host, which is refused. Origin: a page of another site can make a browser send us
// requests; they carry its name as Origin, which is compared with Host, so that an SSH tunnel on any local
// port works with no setting.
#pragma once

#include "http/message/query.h"
#include "http/message/request_head.h"
#include "http/net/admission.h"

#include <optional>
#include <string>
#include <vector>

namespace voxsheet::http {

struct AccessOptions {
    std::string token;                   ///< empty: none is asked for
    std::string boundHost = "127.0.0.1"; ///< as given to --host
    std::vector<std::string>
        allowedHosts; ///< more names by which clients may call this server, with or without port
};

struct AccessVerdict {
    int status = 0; ///< 0: welcome; 401, 403 or 421
    std::string detail;
    bool byQueryToken = false;
};

class AccessPolicy {
public:
    /// Throws InvalidInput if there is no token and the host is not a loopback one, or if the token is
    /// malformed.
    explicit AccessPolicy(AccessOptions options);

    /// \param needsToken  false for health checks
    [[nodiscard]] AccessVerdict judge(const RequestHead& head, const Query& query, const Peer& peer,
                                      bool needsToken) const;
    [[nodiscard]] const std::string& cookieName() const { return cookieName_; }
    [[nodiscard]] const std::string& token() const { return options_.token; }

private:
    [[nodiscard]] bool hostIsOurs(std::string_view authority, const Peer& peer) const;
    [[nodiscard]] bool originIsOurs(const RequestHead& head) const;
    [[nodiscard]] bool listed(std::string_view authority) const;

    AccessOptions options_;
    std::string cookieName_;
    std::string machineName_; ///< of this machine; empty when only loopback is bound
};

/// True for "localhost", its subdomains, 127.0.0.0/8 and ::1.
[[nodiscard]] bool isLoopbackName(std::string_view name);

} // namespace voxsheet::http
