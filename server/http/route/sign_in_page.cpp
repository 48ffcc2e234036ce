#include "http/route/sign_in_page.h"

namespace voxsheet::http {

namespace {

constexpr const char* kPage = R"(<!doctype html>
<html lang="en">
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<title>Voxsheet: token needed</title>
<style>
:root { color-scheme: dark light; font: 15px/1.5 system-ui, sans-serif; }
body { max-width: 34rem; margin: 15vh auto; padding: 0 1rem; }
input, button { font: inherit; padding: .4rem .6rem; min-height: 2rem; }
input { width: 20rem; max-width: 100%; }
code { font-family: ui-monospace, monospace; }
</style>
<h1>This sheet is locked</h1>
<p>Open the address that <code>voxsheet serve</code> printed when it started (the line that begins with
<code>ready</code>), or paste the token from it:</p>
<form method="get">
<label>Token <input name="token" type="password" autocomplete="current-password" required autofocus></label>
<button>Open</button>
</form>
</html>
)";

} // namespace

bool wantsPage(const RequestHead& head) {
    const auto accept = head.headers.find("Accept");
    return head.method == "GET" && accept && accept->find("text/html") != std::string_view::npos;
}

Response signInPage() {
    Response response{401, "text/html; charset=utf-8", kPage};
    response.headers.add("Content-Security-Policy",
                         "default-src 'none'; style-src 'unsafe-inline'; "
                         "form-action 'self'; base-uri 'none'; frame-ancestors 'self'");
    response.headers.add("WWW-Authenticate", "Bearer realm=\"voxsheet\"");
    return response;
}

} // namespace voxsheet::http
