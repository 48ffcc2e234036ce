// The wire form of one stream message: u32le headerBytes, u32le payloadBytes, header (UTF-8 JSON), payload.
#pragma once

#include <nlohmann/json.hpp>

#include <string>
#include <string_view>

namespace voxsheet::stream {

/// Throws LimitExceeded if header or payload exceeds 2^31 - 1 bytes.
[[nodiscard]] std::string frameMessage(const nlohmann::json& header, std::string_view payload = {});

/// Both parts of the first message in `bytes`, and how many bytes it takes; 0 bytes when it is not whole yet.
/// Throws InvalidInput if the header is not JSON.
struct ParsedMessage {
    nlohmann::json header;
    std::string_view payload;
    std::size_t bytes = 0;
};
[[nodiscard]] ParsedMessage parseMessage(std::string_view bytes);

} // namespace voxsheet::stream
