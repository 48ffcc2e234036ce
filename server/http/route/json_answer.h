// JSON in and out of handlers, typed early.
#pragma once

#include "http/message/request.h"
#include "http/message/response.h"

#include <nlohmann/json.hpp>

#include <initializer_list>
#include <string>

namespace voxsheet::http {

[[nodiscard]] Response jsonAnswer(const nlohmann::json& body, int status = 200);
[[nodiscard]] Response jsonAnswer(const nlohmann::ordered_json& body, int status = 200);
[[nodiscard]] Response noContent();

/// The body as a JSON object. Throws HttpError 415 if it says to be something else than JSON, InvalidInput if
/// it is not a JSON object or nests deeper than 64.
[[nodiscard]] nlohmann::json jsonBody(const Request& request);

/// Throws InvalidInput (with field) for a member that is not in the list.
void allowMembers(const nlohmann::json& object, std::initializer_list<const char*> names);

/// Typed members; they throw InvalidInput with the member as field.
[[nodiscard]] std::string requireString(const nlohmann::json& object, const char* name);
[[nodiscard]] std::string stringOr(const nlohmann::json& object, const char* name,
                                   const std::string& fallback);
[[nodiscard]] bool booleanOr(const nlohmann::json& object, const char* name, bool fallback);
[[nodiscard]] std::int64_t integerIn(const nlohmann::json& object, const char* name, std::int64_t min,
                                     std::int64_t max);

} // namespace voxsheet::http
