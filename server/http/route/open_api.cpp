#include "http/route/open_api.h"

#include "http/message/header_list.h"

#include <algorithm>

namespace voxsheet::http {

namespace {

using Json = nlohmann::ordered_json;

std::vector<std::string> placeholders(const std::string& pattern) {
    std::vector<std::string> names;
    for (auto open = pattern.find('{'); open != std::string::npos; open = pattern.find('{', open + 1))
        names.push_back(pattern.substr(open + 1, pattern.find('}', open) - open - 1));
    return names;
}

Json parameters(const Route& route) {
    Json list = Json::array();
    for (const auto& name : placeholders(route.pattern))
        list.push_back(
            {{"name", name}, {"in", "path"}, {"required", true}, {"schema", {{"type", "string"}}}});
    for (const auto& param : route.query)
        list.push_back({{"name", param.name},
                        {"in", "query"},
                        {"required", param.required},
                        {"description", param.doc},
                        {"schema", {{"type", param.type}}}});
    if (route.anyStyleKey)
        list.push_back(
            {{"name", "style"},
             {"in", "query"},
             {"required", false},
             {"style", "form"},
             {"explode", true},
             {"description", "any style key as KEY=VALUE, e.g. camera.azimuth=30 (GET api/v1/keys)"},
             {"schema", {{"type", "object"}, {"additionalProperties", {{"type", "string"}}}}}});
    return list;
}

std::string operationId(const Route& route) {
    std::string id = lowerCase(route.method);
    bool upper = true;
    for (const char c : route.pattern) {
        const bool letter = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9');
        if (letter) id.push_back(upper && c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c);
        upper = !letter;
    }
    return id;
}

Json operation(const Route& route) {
    Json out{{"operationId", operationId(route)}, {"summary", route.summary}};
    if (auto list = parameters(route); !list.empty()) out["parameters"] = std::move(list);
    if (!route.bodyType.empty())
        out["requestBody"] = {{"description", route.bodyDoc},
                              {"required", true},
                              {"content", {{route.bodyType, {{"schema", Json::object()}}}}}};
    Json success{{"description", route.answerDoc.empty() ? route.summary : route.answerDoc}};
    if (route.successStatus != 204) success["content"] = {{route.answerType, {{"schema", Json::object()}}}};
    out["responses"] = {{std::to_string(route.successStatus), std::move(success)},
                        {"default", {{"$ref", "#/components/responses/Problem"}}}};
    if (!route.needsToken) out["security"] = Json::array();
    return out;
}

Json components() {
    const Json text{{"type", "string"}};
    Json problemSchema{
        {"type", "object"},
        {"required", {"title", "status", "detail"}},
        {"properties",
         {{"title", text}, {"status", {{"type", "integer"}}}, {"detail", text}, {"field", text}}}};
    return {
        {"schemas", {{"Problem", std::move(problemSchema)}}},
        {"responses",
         {{"Problem",
           {{"description", "A problem (RFC 9457)"},
            {"content",
             {{"application/problem+json", {{"schema", {{"$ref", "#/components/schemas/Problem"}}}}}}}}}}},
        {"securitySchemes",
         {{"bearer", {{"type", "http"}, {"scheme", "bearer"}}},
          {"query", {{"type", "apiKey"}, {"in", "query"}, {"name", "token"}}}}}};
}

} // namespace

nlohmann::ordered_json describeRoutes(const std::vector<Route>& routes, const std::string& version,
                                      const std::string& basePath) {
    Json paths = Json::object();
    for (const auto& route : routes)
        paths[route.pattern][lowerCase(route.method)] = operation(route);
    return {{"openapi", "3.1.0"},
            {"info",
             {{"title", "Voxsheet"},
              {"version", version},
              {"description",
               "A spreadsheet whose cells are volumes, over HTTP. Errors are RFC 9457 problems."}}},
            {"servers", Json::array({{{"url", basePath.empty() ? "/" : basePath}}})},
            {"security", Json::array({{{"bearer", Json::array()}}, {{"query", Json::array()}}})},
            {"paths", std::move(paths)},
            {"components", components()}};
}

} // namespace voxsheet::http
