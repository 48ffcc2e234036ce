#include "sheet/dataset_names.h"

#include "sheet/utf8.h"

#include <algorithm>
#include <cstddef>
#include <map>

namespace voxsheet::sheet {

namespace {

bool isDigit(char c) { return c >= '0' && c <= '9'; }

/// The digits at the start of the text, taken off it.
std::string_view takeDigits(std::string_view& text) {
    std::size_t length = 0;
    while (length < text.size() && isDigit(text[length]))
        ++length;
    const std::string_view digits = text.substr(0, length);
    text.remove_prefix(length);
    return digits;
}

std::string_view withoutZeros(std::string_view digits) {
    const std::size_t first = digits.find_first_not_of('0');
    return first == std::string_view::npos ? std::string_view{} : digits.substr(first);
}

/// < 0, 0, > 0 as numbers; numbers have any length.
int compareDigits(std::string_view a, std::string_view b) {
    a = withoutZeros(a);
    b = withoutZeros(b);
    if (a.size() != b.size()) return a.size() < b.size() ? -1 : 1;
    return a.compare(b);
}

unsigned char foldedByte(char c) {
    return static_cast<unsigned char>(c >= 'A' && c <= 'Z' ? c - 'A' + 'a' : c);
}

int compareNaturally(std::string_view a, std::string_view b) {
    while (!a.empty() && !b.empty()) {
        if (isDigit(a.front()) && isDigit(b.front())) {
            if (const int order = compareDigits(takeDigits(a), takeDigits(b)); order != 0) return order;
            continue;
        }
        const unsigned char left = foldedByte(a.front());
        const unsigned char right = foldedByte(b.front());
        if (left != right) return left < right ? -1 : 1;
        a.remove_prefix(1);
        b.remove_prefix(1);
    }
    if (a.empty() && b.empty()) return 0;
    return a.empty() ? -1 : 1;
}

std::vector<std::string> components(std::string_view path) {
    std::vector<std::string> parts;
    while (!path.empty()) {
        const std::size_t slash = path.find('/');
        const std::string_view part = path.substr(0, slash);
        if (!part.empty() && part != ".") parts.emplace_back(part);
        path.remove_prefix(slash == std::string_view::npos ? path.size() : slash + 1);
    }
    return parts;
}

std::string tail(const std::vector<std::string>& parts, std::size_t count) {
    std::string text;
    for (std::size_t i = parts.size() - std::min(count, parts.size()); i < parts.size(); ++i)
        text += (text.empty() ? "" : "/") + parts[i];
    return text;
}

/// As validateDatasetName wants it.
std::string allowedName(std::string_view text) {
    std::string name = replaceInvalidUtf8(text);
    for (char& c : name)
        if (static_cast<unsigned char>(c) < 0x20 || c == 0x7F) c = '_';
    if (!name.empty() && (name.front() == '=' || name.front() == ' ')) name.front() = '_';
    if (!name.empty() && name.back() == ' ') name.back() = '_';
    constexpr std::size_t longest = 180; // leaves room for " (2)"
    while (name.size() > longest) {      // keeps the end, which tells names apart, and whole characters
        std::size_t cut = name.size() - longest;
        while (cut < name.size() && (static_cast<unsigned char>(name[cut]) & 0xC0U) == 0x80U)
            ++cut;
        name.erase(0, cut);
        if (name.front() == '=' || name.front() == ' ') name.front() = '_';
    }
    return name.empty() ? "dataset" : name;
}

} // namespace

bool naturalLess(std::string_view a, std::string_view b) {
    const int order = compareNaturally(a, b);
    return order != 0 ? order < 0 : a < b;
}

void sortNaturally(std::vector<std::string>& paths) { std::sort(paths.begin(), paths.end(), naturalLess); }

std::vector<std::string> distinguishingNames(const std::vector<std::string>& paths,
                                             const std::set<std::string>& taken) {
    std::vector<std::vector<std::string>> parts;
    std::map<std::string, std::size_t> uses; // of every tail of every path
    for (const std::string& path : paths) {
        parts.push_back(components(path));
        for (std::size_t count = 1; count <= parts.back().size(); ++count)
            ++uses[tail(parts.back(), count)];
    }
    std::set<std::string> given = taken;
    std::vector<std::string> names;
    for (const std::vector<std::string>& path : parts) {
        std::size_t count = 1;
        const auto isAmbiguous = [&] {
            return uses[tail(path, count)] > 1 || given.contains(allowedName(tail(path, count)));
        };
        while (count < path.size() && isAmbiguous())
            ++count;
        // A path given twice, or a name taken by something else: then the short name with a number reads
        // best.
        if (!path.empty() && isAmbiguous()) {
            count = 1;
            while (count < path.size() && uses[tail(path, count)] > uses[tail(path, path.size())])
                ++count;
        }
        const std::string base = allowedName(tail(path, count));
        std::string name = base;
        for (int copy = 2; given.contains(name); ++copy)
            name = base + " (" + std::to_string(copy) + ")";
        given.insert(name);
        names.push_back(std::move(name));
    }
    return names;
}

} // namespace voxsheet::sheet
