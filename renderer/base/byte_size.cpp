#include "base/byte_size.h"

#include "base/errors.h"

#include <cctype>
#include <cmath>
#include <cstdio>

namespace voxsheet {

std::uint64_t parseBytes(const std::string& text, const std::string& field) {
    if (text.empty()) return 0;
    std::size_t used = 0;
    double number = 0.0;
    try {
        number = std::stod(text, &used);
    } catch (const std::exception&) {
        used = 0;
    }
    static const std::string units = "KMGT";
    auto suffix = text.substr(used);
    double factor = 1.0;
    if (!suffix.empty()) {
        const auto unit = units.find(static_cast<char>(std::toupper(static_cast<unsigned char>(suffix[0]))));
        const auto rest = suffix.substr(1);
        if (unit == std::string::npos || !(rest.empty() || rest == "B" || rest == "iB")) used = 0;
        factor = std::pow(1024.0, static_cast<double>(unit) + 1.0);
    }
    if (used == 0 || !std::isfinite(number) || number <= 0.0 || number * factor > 0x1p60)
        throw InvalidInput(field, "`" + text + "` is no number of bytes", "write for example 512M or 2G")
            .withField(field);
    return static_cast<std::uint64_t>(number * factor);
}

std::string byteText(std::uint64_t bytes) {
    static const char* const units[] = {"B", "KiB", "MiB", "GiB", "TiB"};
    auto number = static_cast<double>(bytes);
    std::size_t unit = 0;
    for (; number >= 1024.0 && unit < 4; ++unit)
        number /= 1024.0;
    char text[32];
    std::snprintf(text, sizeof text, "%.4g %s", number, units[unit]);
    return text;
}

std::uint64_t parseBudget(const std::string& text, const std::string& flag,
                          std::optional<std::uint64_t> largest) {
    if (text.empty()) return 0;
    const std::string bounds =
        "from " + byteText(kSmallestBudgetBytes) + " to " +
        (largest ? "this machine's memory of " + byteText(*largest) : std::string("the device's memory"));
    const std::string advice = "give a number " + bounds + ", for example 512M or 2GiB";
    std::uint64_t bytes = 0;
    try {
        bytes = parseBytes(text, flag);
    } catch (const InvalidInput&) {
        throw InvalidInput(flag, "`" + text + "` is no number of bytes above 0", advice).withField(flag);
    }
    if (bytes < kSmallestBudgetBytes)
        throw InvalidInput(flag, "`" + text + "` is too small for anything", advice).withField(flag);
    if (largest && bytes > *largest)
        throw InvalidInput(flag, "`" + text + "` is more than this machine has", advice).withField(flag);
    return bytes;
}

} // namespace voxsheet
