#include "http/resource/api_context.h"

namespace voxsheet::http {

void addHealthRoutes(Router& router, const ApiContext& /*context*/) {
    // The engine is whole before the server starts and outlives it: who answers is ready.
    for (const auto* pattern : {"/livez", "/readyz"})
        router.add({.method = "GET",
                    .pattern = pattern,
                    .handler =
                        [](Request&) {
                            return Response{200, "text/plain; charset=utf-8", "ok\n"};
                        },
                    .summary = std::string(pattern) == "/livez" ? "Is the process alive?" : "Can it serve?",
                    .needsToken = false,
                    .answerType = "text/plain",
                    .answerDoc = "\"ok\""});
}

} // namespace voxsheet::http
