// The route table as an OpenAPI 3.1 document.
#pragma once

#include "http/route/route.h"

#include <nlohmann/json.hpp>

#include <string>
#include <vector>

namespace voxsheet::http {

[[nodiscard]] nlohmann::ordered_json describeRoutes(const std::vector<Route>& routes,
                                                    const std::string& version, const std::string& basePath);

} // namespace voxsheet::http
