#include "http/guard/token.h"

#include "base/errors.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdint>
#include <cstring>
#include <sys/random.h>

namespace voxsheet::http {

namespace {

constexpr std::string_view kDigits = "0123456789abcdef";

bool isTokenCharacter(char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '-' ||
           c == '.' || c == '_' || c == '~';
}

} // namespace

std::string randomToken() {
    std::array<unsigned char, 16> bytes{};
    if (::getrandom(bytes.data(), bytes.size(), 0) != static_cast<ssize_t>(bytes.size()))
        throw IoError("random numbers", std::strerror(errno));
    std::string token;
    for (const unsigned byte : bytes) {
        token.push_back(kDigits[byte >> 4U]);
        token.push_back(kDigits[byte & 15U]);
    }
    return token;
}

void validateToken(std::string_view token) {
    if (token.size() < 8 || token.size() > 256 || !std::all_of(token.begin(), token.end(), isTokenCharacter))
        throw InvalidInput("token", "it must be 8 to 256 letters, digits and -._~",
                           "leave it out to get a random one")
            .withField("token");
}

bool equalInConstantTime(std::string_view a, std::string_view b) {
    if (a.size() != b.size()) return false;
    unsigned difference = 0;
    for (std::size_t i = 0; i < a.size(); ++i)
        difference |=
            static_cast<unsigned>(static_cast<unsigned char>(a[i]) ^ static_cast<unsigned char>(b[i]));
    return difference == 0;
}

std::string cookieNameFor(std::string_view token) {
    // FNV-1a, 32 bits kept: tells servers apart and gives nothing of a 128-bit token away that helps to guess
    // it.
    std::uint64_t hash = 0xCBF29CE484222325U;
    for (const char c : token)
        hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001B3U;
    std::string name = "voxsheet_";
    for (int shift = 28; shift >= 0; shift -= 4)
        name.push_back(kDigits[(hash >> static_cast<unsigned>(shift)) & 15U]);
    return name;
}

} // namespace voxsheet::http
