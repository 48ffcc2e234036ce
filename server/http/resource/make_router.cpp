#include "http/resource/api_context.h"
#include "http/route/json_answer.h"
#include "http/route/open_api.h"

#include <memory>

namespace voxsheet::http {

Router makeRouter(const ApiContext& context) {
    Router router;
    addHealthRoutes(router, context);
    addInfoRoutes(router, context);
    // Filled in below, when all routes are known, its own included.
    auto description = std::make_shared<std::string>();
    router.add({.method = "GET",
                .pattern = "/api/v1/openapi.json",
                .handler =
                    [description](Request&) {
                        return Response{200, "application/json", *description};
                    },
                .summary = "This description (OpenAPI 3.1)"});
    addFileRoutes(router, context);
    addDatasetRoutes(router, context);
    addWorkbookRoutes(router, context);
    addSheetRoutes(router, context);
    addStyleRoutes(router, context);
    addCellRoutes(router, context);
    addImageRoutes(router, context);
    addProbeRoutes(router, context);
    addTimingRoutes(router, context);
    addStreamRoutes(router, context);
    addMjpegRoute(router, context);
    addMetricsRoute(router, context);
    addPageRoutes(router, context);
    *description =
        describeRoutes(router.routes(), context.settings.version, context.settings.basePath).dump(1);
    return router;
}

} // namespace voxsheet::http
