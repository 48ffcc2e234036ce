// Style values and views as they come over HTTP.
#pragma once

#include "engine/engine.h"
#include "http/message/request.h"

#include <nlohmann/json.hpp>

#include <initializer_list>

namespace voxsheet::http {

/// The style keys of a query: all keys but `others`. Throws InvalidInput (with field).
[[nodiscard]] sheet::StyleMap styleFromQuery(const Query& query, const sheet::KeyTable& keys,
                                             std::initializer_list<const char*> others);

/// {"style": {KEY: VALUE}, "cells": {"A1": {KEY: VALUE}}}; both may be missing, other members are not looked
/// at. Throws InvalidInput (with field).
[[nodiscard]] engine::View viewFromJson(const nlohmann::json& object, const sheet::KeyTable& keys);

} // namespace voxsheet::http
