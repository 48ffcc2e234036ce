// What a person sees who opens the address without the token.
#pragma once

#include "http/message/request_head.h"
#include "http/message/response.h"

namespace voxsheet::http {

/// True for a browser that goes to a page (rather than a script that asks for data).
[[nodiscard]] bool wantsPage(const RequestHead& head);

/// Status 401 with a form that asks for the token and comes back with it. Needs no script and no other file.
[[nodiscard]] Response signInPage();

} // namespace voxsheet::http
