#include "bench/json_text.h"

#include <cmath>
#include <cstdio>

namespace voxsheet::bench {

std::string jsonString(const std::string& text) {
    std::string result = "\"";
    for (const char c : text) {
        if (c == '"' || c == '\\') result += '\\';
        if (static_cast<unsigned char>(c) < 0x20U) {
            char escape[8];
            std::snprintf(escape, sizeof escape, "\\u%04x", static_cast<unsigned>(c));
            result += escape;
        } else {
            result += c;
        }
    }
    return result + "\"";
}

std::string jsonNumber(std::optional<double> number) {
    if (!number || !std::isfinite(*number)) return "null";
    char text[32];
    std::snprintf(text, sizeof text, "%.6g", *number);
    return text;
}

std::string jsonObject(const std::vector<std::pair<std::string, std::string>>& members) {
    std::string result = "{";
    for (const auto& [name, value] : members)
        result += (result.size() > 1 ? "," : "") + jsonString(name) + ":" + value;
    return result + "}";
}

std::string jsonArray(const std::vector<std::string>& values) {
    std::string result = "[";
    for (const auto& value : values)
        result += (result.size() > 1 ? "," : "") + value;
    return result + "]";
}

} // namespace voxsheet::bench
