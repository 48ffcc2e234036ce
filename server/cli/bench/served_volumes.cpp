#include "cli/bench/served_volumes.h"

#include "cli/bench/bench_volumes.h"
#include "cli/engine_arguments.h"

namespace voxsheet::cli {

ServedVolumes::ServedVolumes(int count, int dim, int device, const std::filesystem::path& scratch)
    : engine_(benchEngineOptions(scratch, device)) {
    EngineArguments arguments;
    arguments.sources = writeBenchVolumes(scratch, count, dim);
    openSources(engine_, arguments);
    http::WebServerOptions web;
    web.server.port = 0;
    server_ = std::make_unique<http::WebServer>(web, engine_, tiles_, hub_);
    server_->start();
}

ServedVolumes::~ServedVolumes() { server_->stop(); }

} // namespace voxsheet::cli
