// The program's own server with volumes to show, for benches that come over loopback.
#pragma once

#include "engine/engine.h"
#include "http/resource/web_server.h"
#include "stream/stream_hub.h"
#include "stream/tile_service.h"

#include <filesystem>
#include <memory>

namespace voxsheet::cli {

/// Serves from construction to destruction, on a free port, without a token.
class ServedVolumes {
public:
    /// `count` volumes of dim^3 samples, written below `scratch`, in a sheet; device as --device. Imports go
    /// on in the background.
    ServedVolumes(int count, int dim, int device, const std::filesystem::path& scratch);
    ~ServedVolumes();
    ServedVolumes(const ServedVolumes&) = delete;
    ServedVolumes& operator=(const ServedVolumes&) = delete;

    [[nodiscard]] const engine::Engine& engine() const { return engine_; }
    [[nodiscard]] int port() const { return server_->port(); }

private:
    engine::Engine engine_;
    stream::TileService tiles_{engine_};
    stream::StreamHub hub_{engine_, tiles_};
    std::unique_ptr<http::WebServer> server_;
};

} // namespace voxsheet::cli
