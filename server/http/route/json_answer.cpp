#include "http/route/json_answer.h"

#include "base/errors.h"
#include "http/route/problem.h"
#include "sheet/bounded_json.h"

#include <algorithm>

namespace voxsheet::http {

namespace {

template <typename Json>
Response answer(const Json& body, int status) {
    // Replace: names of files need not be UTF-8.
    return {status, "application/json", body.dump(-1, ' ', false, Json::error_handler_t::replace)};
}

[[noreturn]] void wrongMember(const char* name, const std::string& wanted) {
    throw InvalidInput("member '" + std::string(name) + "'", "it must be " + wanted).withField(name);
}

} // namespace

Response jsonAnswer(const nlohmann::json& body, int status) { return answer(body, status); }
Response jsonAnswer(const nlohmann::ordered_json& body, int status) { return answer(body, status); }

Response noContent() { return {204, {}, {}}; }

nlohmann::json jsonBody(const Request& request) {
    const auto type = request.headers.find("Content-Type");
    if (type) {
        const auto media = lowerCase(trimmed(type->substr(0, type->find(';'))));
        // curl's -d says x-www-form-urlencoded unless told otherwise; what is in the body decides.
        const bool plausible = media == "application/json" || media.ends_with("+json") ||
                               media == "text/plain" || media == "application/x-www-form-urlencoded";
        if (!plausible) throw HttpError(415, "the body must be application/json, not " + media);
    }
    auto body = sheet::parseBoundedJson(request.body, "request body", {std::size_t{16} << 20U, 64});
    if (!body.is_object()) throw InvalidInput("request body", "it is not a JSON object");
    return body;
}

void allowMembers(const nlohmann::json& object, std::initializer_list<const char*> names) {
    for (const auto& item : object.items()) {
        const bool known =
            std::any_of(names.begin(), names.end(), [&](const char* name) { return item.key() == name; });
        if (!known)
            throw InvalidInput("member '" + item.key() + "'", "it is not known here").withField(item.key());
    }
}

std::string requireString(const nlohmann::json& object, const char* name) {
    const auto found = object.find(name);
    if (found == object.end() || !found->is_string()) wrongMember(name, "a text");
    return found->get<std::string>();
}

std::string stringOr(const nlohmann::json& object, const char* name, const std::string& fallback) {
    const auto found = object.find(name);
    if (found == object.end() || found->is_null()) return fallback;
    return requireString(object, name);
}

bool booleanOr(const nlohmann::json& object, const char* name, bool fallback) {
    const auto found = object.find(name);
    if (found == object.end()) return fallback;
    if (!found->is_boolean()) wrongMember(name, "true or false");
    return found->get<bool>();
}

std::int64_t integerIn(const nlohmann::json& object, const char* name, std::int64_t min, std::int64_t max) {
    const auto found = object.find(name);
    const auto wanted = "a whole number from " + std::to_string(min) + " to " + std::to_string(max);
    if (found == object.end() || !found->is_number_integer()) wrongMember(name, wanted);
    // Unsigned numbers above the signed range would wrap.
    if (found->is_number_unsigned() && found->get<std::uint64_t>() > static_cast<std::uint64_t>(INT64_MAX))
        wrongMember(name, wanted);
    const auto value = found->get<std::int64_t>();
    if (value < min || value > max) wrongMember(name, wanted);
    return value;
}

} // namespace voxsheet::http
