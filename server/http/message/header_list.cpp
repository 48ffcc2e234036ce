#include "http/message/header_list.h"

#include <algorithm>

namespace voxsheet::http {

namespace {
char lower(char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; }
} // namespace

bool equalIgnoringCase(std::string_view a, std::string_view b) {
    return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                      [](char x, char y) { return lower(x) == lower(y); });
}

std::string lowerCase(std::string_view text) {
    std::string out(text);
    std::transform(out.begin(), out.end(), out.begin(), lower);
    return out;
}

std::string_view trimmed(std::string_view text) {
    const auto first = text.find_first_not_of(" \t");
    if (first == std::string_view::npos) return {};
    return text.substr(first, text.find_last_not_of(" \t") - first + 1);
}

void HeaderList::set(const std::string& name, std::string value) {
    std::erase_if(fields_, [&](const auto& field) { return equalIgnoringCase(field.first, name); });
    add(name, std::move(value));
}

std::optional<std::string_view> HeaderList::find(std::string_view name) const {
    for (const auto& [key, value] : fields_)
        if (equalIgnoringCase(key, name)) return value;
    return std::nullopt;
}

std::size_t HeaderList::count(std::string_view name) const {
    return static_cast<std::size_t>(std::count_if(fields_.begin(), fields_.end(), [&](const auto& field) {
        return equalIgnoringCase(field.first, name);
    }));
}

} // namespace voxsheet::http
