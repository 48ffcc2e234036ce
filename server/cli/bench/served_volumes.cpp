#include "cli/bench/served_volumes.h"

#include "cli/bench/bench_volumes.h"
#include "cli/engine_arguments.h"

namespace voxsheet::cli {

namespace {

engine::EngineOptions optionsFor(int device, const std::filesystem::path& scratch) {
    EngineArguments arguments;
    arguments.store = (scratch / "store").string();
    arguments.uploadDir = (scratch / "uploads").string();
    arguments.roots = {scratch.string()};
    arguments.device = device;
    return engineOptions(arguments);
}

} // namespace

ServedVolumes::ServedVolumes(int count, int dim, int device, const std::filesystem::path& scratch)
    : engine_(optionsFor(device, scratch)) {
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
