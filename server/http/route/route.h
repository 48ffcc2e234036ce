// One line of the route table: what is answered, by whom, and how it is described.
#pragma once

#include "http/message/request.h"
#include "http/message/response.h"
#include "http/net/server_options.h"

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace voxsheet::http {

/// One parameter of the path or the query, for the checks and for the OpenAPI description.
struct ParamDoc {
    std::string name = {};
    std::string type = {}; ///< of JSON Schema: "string", "number", "integer", "boolean"
    std::string doc = {};
    bool required = false;
};

using Handler = std::function<Response(Request&)>;

struct Route {
    std::string method = {}; ///< GET answers HEAD too
    /// Segments are literal, `{name}`, or a literal with one `{name}` at its end (`image.{format}`).
    std::string pattern = {};
    Handler handler = {}; ///< may throw
    std::string summary = {};
    std::vector<ParamDoc> query = {}; ///< a key that is not named here is refused …
    bool anyStyleKey = false;         ///< … unless the route takes style keys
    std::string bodyType = {};        ///< media type accepted; empty: no body
    std::string bodyDoc = {};
    std::uint64_t bodyBudgetBytes = 0;
    bool streamsBody = false;
    Pool pool = Pool::Control;
    bool needsToken = true;
    int successStatus = 200; ///< for the description
    std::string answerType = "application/json";
    std::string answerDoc = {};
};

} // namespace voxsheet::http
