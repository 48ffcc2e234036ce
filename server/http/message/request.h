// What a handler is given.
#pragma once

#include "http/message/header_list.h"
#include "http/message/query.h"

#include <atomic>
#include <map>
#include <memory>
#include <string>

namespace voxsheet::http {

/// A body that is read as it arrives (uploads), within the route's budget and a lowest rate.
class BodyReader {
public:
    virtual ~BodyReader() = default;
    /// Appends some bytes to `out`; false at the end of the body. Throws LimitExceeded over the budget,
    /// Cancelled when the client is gone or too slow, InvalidInput if the body is malformed.
    virtual bool read(std::string& out) = 0;
};

struct Request {
    std::string method;                        ///< GET for HEAD
    std::map<std::string, std::string> params; ///< of the path, decoded: "{sheet}" -> params["sheet"]
    Query query;                               ///< without the token
    HeaderList headers;
    std::string body;                 ///< whole, unless `bodyReader` is set
    BodyReader* bodyReader = nullptr; ///< of routes that stream their body; lives as long as the call
    std::string remoteAddress;
    bool byQueryToken = false; ///< authorised by ?token=
    /// Becomes true when the client has gone or the server stops: long work should end.
    std::shared_ptr<const std::atomic<bool>> gone = std::make_shared<const std::atomic<bool>>(false);

    [[nodiscard]] bool cancelled() const { return gone->load(std::memory_order_relaxed); }
    [[nodiscard]] const std::string& param(const std::string& name) const { return params.at(name); }
};

} // namespace voxsheet::http
