#include "stream/message.h"

#include "base/errors.h"

#include <cstdint>

namespace voxsheet::stream {

namespace {

void appendU32(std::string& out, std::size_t value) {
    for (unsigned shift = 0; shift < 32; shift += 8)
        out.push_back(static_cast<char>((value >> shift) & 0xFFU));
}

std::size_t readU32(std::string_view bytes, std::size_t at) {
    std::size_t value = 0;
    for (unsigned i = 0; i < 4; ++i)
        value |= static_cast<std::size_t>(static_cast<unsigned char>(bytes[at + i])) << (8 * i);
    return value;
}

} // namespace

std::string frameMessage(const nlohmann::json& header, std::string_view payload) {
    const std::string text = header.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
    if (text.size() > INT32_MAX || payload.size() > INT32_MAX)
        throw LimitExceeded("stream message", "more than 2 GiB");
    std::string message;
    message.reserve(8 + text.size() + payload.size());
    appendU32(message, text.size());
    appendU32(message, payload.size());
    message += text;
    message += payload;
    return message;
}

ParsedMessage parseMessage(std::string_view bytes) {
    if (bytes.size() < 8) return {};
    const std::size_t headerBytes = readU32(bytes, 0);
    const std::size_t payloadBytes = readU32(bytes, 4);
    if (bytes.size() < 8 + headerBytes + payloadBytes) return {};
    ParsedMessage message;
    message.header = nlohmann::json::parse(bytes.substr(8, headerBytes), nullptr, false);
    if (message.header.is_discarded()) throw InvalidInput("stream message", "its header is not JSON");
    message.payload = bytes.substr(8 + headerBytes, payloadBytes);
    message.bytes = 8 + headerBytes + payloadBytes;
    return message;
}

} // namespace voxsheet::stream
