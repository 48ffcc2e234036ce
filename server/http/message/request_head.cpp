#include "http/message/request_head.h"

#include <algorithm>
#include <charconv>

namespace voxsheet::http {

namespace {

constexpr std::string_view kTokenMarks = "!#$%&'*+-.^_`|~"; // RFC 9110, 5.6.2

bool isTokenCharacter(char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
           kTokenMarks.find(c) != std::string_view::npos;
}

bool isToken(std::string_view text) {
    return !text.empty() && std::all_of(text.begin(), text.end(), isTokenCharacter);
}

/// Field values: visible bytes, space, tab; bytes above 127 are opaque.
bool isFieldValue(std::string_view text) {
    return std::all_of(text.begin(), text.end(), [](char c) {
        const auto byte = static_cast<unsigned char>(c);
        return byte == '\t' || (byte >= 0x20 && byte != 0x7F);
    });
}

bool isVisibleAscii(std::string_view text) {
    return std::all_of(text.begin(), text.end(), [](char c) { return c > 0x20 && c < 0x7F; });
}

void parseFirstLine(std::string_view line, const HeadLimits& limits, RequestHead& out) {
    const auto firstSpace = line.find(' ');
    const auto lastSpace = line.rfind(' ');
    if (firstSpace == std::string_view::npos || lastSpace == firstSpace)
        throw BadHead{400, "the first line is not 'METHOD TARGET HTTP/1.1'"};
    const auto method = line.substr(0, firstSpace);
    const auto target = line.substr(firstSpace + 1, lastSpace - firstSpace - 1);
    const auto version = line.substr(lastSpace + 1);
    if (!isToken(method) || method.size() > 32) throw BadHead{400, "the method is malformed"};
    if (target.size() > limits.targetBytes)
        throw BadHead{414, "the URL is longer than " + std::to_string(limits.targetBytes) + " bytes"};
    if (target.empty() || target.front() != '/' || !isVisibleAscii(target))
        throw BadHead{400, "the URL must be a path that begins with '/', percent-encoded"};
    if (version != "HTTP/1.1" && version != "HTTP/1.0") {
        if (version.substr(0, 5) == "HTTP/") throw BadHead{505, "only HTTP/1.1 and HTTP/1.0 are spoken here"};
        throw BadHead{400, "the first line does not end in 'HTTP/1.1'"};
    }
    out.keepAlive = version == "HTTP/1.1";
    out.method = method;
    const auto noFragment = target.substr(0, target.find('#'));
    const auto question = noFragment.find('?');
    out.path = noFragment.substr(0, question);
    if (question != std::string_view::npos) out.query = noFragment.substr(question + 1);
}

void parseField(std::string_view line, RequestHead& out) {
    const auto colon = line.find(':');
    // A space before the colon or a folded line is how two parsers come to differ: refused (RFC 9112, 5.1
    // and 5.2).
    if (colon == std::string_view::npos || !isToken(line.substr(0, colon)))
        throw BadHead{400, "a header field is malformed"};
    const auto value = trimmed(line.substr(colon + 1));
    if (!isFieldValue(value)) throw BadHead{400, "a header field holds a control character"};
    out.headers.add(std::string(line.substr(0, colon)), std::string(value));
}

void readLength(RequestHead& out) {
    const auto text = out.headers.find("Content-Length");
    if (!text) return;
    if (out.headers.count("Content-Length") > 1) throw BadHead{400, "Content-Length comes twice"};
    std::uint64_t length = 0;
    const auto* end = text->data() + text->size();
    const auto result = std::from_chars(text->data(), end, length);
    if (text->empty() || text->front() == '-' || result.ec != std::errc{} || result.ptr != end)
        throw BadHead{400, "Content-Length is not a number of bytes"};
    out.contentLength = length;
}

void readTransfer(RequestHead& out) {
    const auto text = out.headers.find("Transfer-Encoding");
    if (!text) return;
    if (out.contentLength) throw BadHead{400, "Content-Length and Transfer-Encoding exclude each other"};
    if (out.headers.count("Transfer-Encoding") > 1 || !equalIgnoringCase(*text, "chunked"))
        throw BadHead{501, "the only Transfer-Encoding understood is 'chunked'"};
    out.chunked = true;
}

bool listHolds(std::string_view list, std::string_view word) {
    while (!list.empty()) {
        const auto comma = list.find(',');
        if (equalIgnoringCase(trimmed(list.substr(0, comma)), word)) return true;
        if (comma == std::string_view::npos) return false;
        list.remove_prefix(comma + 1);
    }
    return false;
}

void readConnection(RequestHead& out) {
    for (const auto& [name, value] : out.headers.fields()) {
        if (!equalIgnoringCase(name, "Connection")) continue;
        if (listHolds(value, "close"))
            out.keepAlive = false;
        else if (listHolds(value, "keep-alive"))
            out.keepAlive = true;
    }
}

void readExpectation(RequestHead& out) {
    const auto text = out.headers.find("Expect");
    if (!text) return;
    if (!equalIgnoringCase(*text, "100-continue"))
        throw BadHead{417, "the only Expect understood is '100-continue'"};
    out.expectContinue = true;
}

void refuseEncodedBody(const RequestHead& head) {
    const auto text = head.headers.find("Content-Encoding");
    // A compressed body of a few kilobytes can unpack to gigabytes.
    if (text && !equalIgnoringCase(*text, "identity"))
        throw BadHead{415, "compressed request bodies are not accepted; send it without Content-Encoding"};
}

} // namespace

std::optional<std::size_t> headBytes(std::string_view received, const HeadLimits& limits) {
    const auto end = received.find("\r\n\r\n");
    const auto known = end == std::string_view::npos ? received : received.substr(0, end + 4);
    const auto firstLine = std::min(known.find("\r\n"), known.size());
    if (firstLine > limits.targetBytes + 64) // method and version take the rest
        throw BadHead{414, "the URL is longer than " + std::to_string(limits.targetBytes) + " bytes"};
    if (known.size() > limits.bytes)
        throw BadHead{431, "the header is longer than " + std::to_string(limits.bytes) + " bytes"};
    if (end == std::string_view::npos) return std::nullopt;
    return end + 4;
}

RequestHead parseHead(std::string_view head, const HeadLimits& limits) {
    RequestHead out;
    head.remove_suffix(2); // the empty line
    const auto firstEnd = head.find("\r\n");
    parseFirstLine(head.substr(0, firstEnd), limits, out);
    head.remove_prefix(firstEnd + 2);
    while (!head.empty()) {
        const auto end = head.find("\r\n");
        const auto line = head.substr(0, end);
        if (line.size() > limits.lineBytes)
            throw BadHead{431,
                          "a header field is longer than " + std::to_string(limits.lineBytes) + " bytes"};
        if (out.headers.fields().size() >= limits.fields)
            throw BadHead{431, "there are more than " + std::to_string(limits.fields) + " header fields"};
        parseField(line, out);
        head.remove_prefix(end + 2);
    }
    if (out.headers.count("Host") > 1) throw BadHead{400, "Host comes twice"};
    readLength(out);
    readTransfer(out);
    readConnection(out);
    readExpectation(out);
    refuseEncodedBody(out);
    return out;
}

} // namespace voxsheet::http
