#include "http/resource/api_context.h"
#include "http/route/problem.h"

#include "embedded/web_files.h"

#include <array>
#include <cstdint>
#include <string_view>
#include <utility>

namespace voxsheet::http {

namespace {

// Styles may be inline (a page without the web build has one); scripts may not.
constexpr const char* kContentPolicy =
    "default-src 'none'; script-src 'self'; style-src 'self' 'unsafe-inline'; img-src 'self' blob: data:; "
    "font-src 'self'; connect-src 'self'; worker-src 'self' blob:; manifest-src 'self'; base-uri 'none'; "
    "form-action 'none'; frame-ancestors 'self'";

constexpr std::array<std::pair<std::string_view, const char*>, 10> kTypes{{
    {".html", "text/html; charset=utf-8"},
    {".js", "text/javascript; charset=utf-8"},
    {".mjs", "text/javascript; charset=utf-8"},
    {".css", "text/css; charset=utf-8"},
    {".svg", "image/svg+xml"},
    {".png", "image/png"},
    {".ico", "image/x-icon"},
    {".json", "application/json"},
    {".webmanifest", "application/manifest+json"},
    {".woff2", "font/woff2"},
}};

const char* typeOf(std::string_view path) {
    for (const auto& [ending, type] : kTypes)
        if (path.ends_with(ending)) return type;
    return "application/octet-stream";
}

/// FNV-1a over the bytes: tells one build's file from another's.
std::string tagOf(std::string_view bytes) {
    std::uint64_t hash = 0xCBF29CE484222325U;
    for (const char c : bytes)
        hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001B3U;
    constexpr std::string_view digits = "0123456789abcdef";
    std::string text = "\"";
    for (int shift = 60; shift >= 0; shift -= 4)
        text.push_back(digits[(hash >> static_cast<unsigned>(shift)) & 15U]);
    return text + '"';
}

struct Asset {
    std::string path;
    std::string_view bytes;
    std::string tag;
};

Response serveAsset(const Asset& asset, const ApiContext& context, const Request& request) {
    const auto known = request.headers.find("If-None-Match");
    const bool same = known && known->find(asset.tag) != std::string_view::npos;
    Response response =
        same ? Response{304, {}, {}} : Response{200, typeOf(asset.path), std::string(asset.bytes)};
    auto& headers = response.headers;
    headers.add("ETag", asset.tag);
    headers.add("Cache-Control", "private, no-cache"); // the names are the same in every build
    if (!asset.path.ends_with(".html")) return response;
    headers.add("Content-Security-Policy", kContentPolicy);
    // What the page loads and asks for from here on carries the token by itself.
    if (request.byQueryToken && !context.cookieValue.empty())
        headers.add("Set-Cookie",
                    context.cookieName + "=" + context.cookieValue + "; Path=" +
                        (context.settings.basePath.empty() ? "/" : context.settings.basePath + "/") +
                        "; HttpOnly; SameSite=Strict");
    return response;
}

} // namespace

void addPageRoutes(Router& router, const ApiContext& context) {
    for (std::size_t i = 0; i < webFilesCount; ++i) {
        const Asset asset{webFiles[i].path, webFiles[i].bytes(), tagOf(webFiles[i].bytes())};
        const bool index = asset.path == "index.html";
        router.add(
            {.method = "GET",
             .pattern = index ? "/" : "/" + asset.path,
             .handler = [&context, asset](Request& request) { return serveAsset(asset, context, request); },
             .summary = index ? "The page" : "A file of the page",
             .answerType = typeOf(asset.path)});
    }
}

} // namespace voxsheet::http
