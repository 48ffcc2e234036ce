// What a page posts to its stream.
#pragma once

#include "stream/stream_hub.h"

#include <nlohmann/json.hpp>

namespace voxsheet::http {

/// {"ack": frame, "view": {"id", "moving", "tiles": [{"cell", "width", "height"}], "focus", "style",
/// "cells"}}; either may be missing. Throws InvalidInput (with field).
[[nodiscard]] stream::StreamUpdate streamUpdateFromJson(const nlohmann::json& body,
                                                        const sheet::KeyTable& keys);

/// A view for a client that asked for a stream of so many pixels and has said no more: all cells of the
/// sheet, laid out as its grid, each with an equal share.
[[nodiscard]] stream::ClientView wholeSheetView(const sheet::Sheet& sheet, glm::dvec2 sizePixels);

} // namespace voxsheet::http
