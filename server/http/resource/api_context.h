// What the resources stand on, and the list of them.
#pragma once

#include "engine/engine.h"
#include "http/net/http_server.h"
#include "http/route/router.h"
#include "stream/stream_hub.h"
#include "stream/tile_service.h"

#include <cstdint>
#include <functional>
#include <string>

namespace voxsheet::http {

struct ApiSettings {
    std::string version = "0.1.0";
    std::string basePath;                                      ///< normalised
    std::uint64_t uploadLimitBytes = std::uint64_t{64} << 30U; ///< of one upload
    std::function<void()> openDemo; ///< writes the demo and opens its workbook; empty: there is none
};

/// Outlives every route.
struct ApiContext {
    engine::Engine& engine;
    stream::TileService& tiles;
    stream::StreamHub& hub;
    ApiSettings settings;
    std::string cookieName;  ///< for the page; its value is the token
    std::string cookieValue; ///< empty: no cookie is needed
    std::function<ServerCounters()> serverCounters;
    std::function<RouterStatistics()> routerStatistics;
};

// One function per resource; each is in the file of its name.
void addHealthRoutes(Router& router, const ApiContext& context);
void addInfoRoutes(Router& router, const ApiContext& context);
void addFileRoutes(Router& router, const ApiContext& context);
void addDatasetRoutes(Router& router, const ApiContext& context);
void addWorkbookRoutes(Router& router, const ApiContext& context);
void addSheetRoutes(Router& router, const ApiContext& context);
void addStyleRoutes(Router& router, const ApiContext& context);
void addCellRoutes(Router& router, const ApiContext& context);
void addImageRoutes(Router& router, const ApiContext& context);
void addProbeRoutes(Router& router, const ApiContext& context);
void addTimingRoutes(Router& router, const ApiContext& context);
void addStreamRoutes(Router& router, const ApiContext& context);
void addMjpegRoute(Router& router, const ApiContext& context);
void addMetricsRoute(Router& router, const ApiContext& context);
void addPageRoutes(Router& router, const ApiContext& context);

/// All of the above, and the description of all.
[[nodiscard]] Router makeRouter(const ApiContext& context);

} // namespace voxsheet::http
