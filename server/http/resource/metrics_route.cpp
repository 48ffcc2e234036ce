#include "http/resource/api_context.h"

#include <map>
#include <sstream>

namespace voxsheet::http {

namespace {

/// Prometheus text exposition format 0.0.4.
class MetricsText {
public:
    MetricsText& family(const char* name, const char* type, const char* help) {
        name_ = name;
        out_ << "# HELP " << name << ' ' << help << "\n# TYPE " << name << ' ' << type << '\n';
        return *this;
    }
    template <typename Number>
    MetricsText& value(Number number, const std::string& labels = {}) {
        out_ << name_ << labels << ' ' << number << '\n';
        return *this;
    }
    [[nodiscard]] std::string text() const { return out_.str(); }

private:
    std::ostringstream out_;
    const char* name_ = "";
};

const char* stateWord(engine::DatasetState state) {
    switch (state) {
    case engine::DatasetState::Queued:
        return "queued";
    case engine::DatasetState::Importing:
        return "importing";
    case engine::DatasetState::Ready:
        return "ready";
    case engine::DatasetState::Failed:
        break;
    }
    return "failed";
}

void addServer(MetricsText& out, const ApiContext& context) {
    const auto server = context.serverCounters();
    out.family("voxsheet_http_connections", "gauge", "Open connections").value(server.connections);
    out.family("voxsheet_http_accepted_total", "counter", "Connections accepted").value(server.accepted);
    out.family("voxsheet_http_refused_total", "counter", "Requests and connections refused by a limit")
        .value(server.refused);
    out.family("voxsheet_http_sent_bytes_total", "counter", "Bytes sent").value(server.sentBytes);
    out.family("voxsheet_http_requests_total", "counter", "Requests answered, by status");
    for (const auto& [status, count] : context.routerStatistics().byStatus)
        out.value(count, "{status=\"" + std::to_string(status) + "\"}");
}

void addEngine(MetricsText& out, const ApiContext& context) {
    std::map<std::string, int> states{{"queued", 0}, {"importing", 0}, {"ready", 0}, {"failed", 0}};
    for (const auto& dataset : context.engine.datasets())
        ++states[stateWord(dataset.state)];
    out.family("voxsheet_datasets", "gauge", "Datasets, by state of their import");
    for (const auto& [state, count] : states)
        out.value(count, "{state=\"" + state + "\"}");
    out.family("voxsheet_workbook_version", "gauge", "Version of the workbook")
        .value(context.engine.version());
}

void addTextures(MetricsText& out, const ResidencyState& state) {
    out.family("voxsheet_texture_bytes", "gauge", "Bytes of textures on the device")
        .value(state.residentBytes);
    out.family("voxsheet_texture_kind_bytes", "gauge", "Bytes of textures on the device, by what they hold")
        .value(state.sampleBytes, "{kind=\"samples\"}")
        .value(state.gradientBytes, "{kind=\"gradients\"}")
        .value(state.clipObjectBytes, "{kind=\"clip_objects\"}");
    out.family("voxsheet_texture_budget_bytes", "gauge", "Budget of textures").value(state.budgetBytes);
    out.family("voxsheet_texture_pinned_bytes", "gauge", "Bytes of textures that are being drawn from")
        .value(state.pinnedBytes);
    out.family("voxsheet_texture_visible_bytes", "gauge", "Bytes of textures that some page shows")
        .value(state.visibleBytes);
    out.family("voxsheet_textures", "gauge", "Textures on the device").value(state.textures);
    out.family("voxsheet_texture_uploads_total", "counter", "Volumes uploaded").value(state.uploads);
    out.family("voxsheet_texture_uploaded_bytes_total", "counter", "Bytes uploaded")
        .value(state.uploadedBytes);
    out.family("voxsheet_texture_upload_seconds_total", "counter",
               "Time spent on converting and uploading volumes and on building gradients")
        .value(state.uploadMs / 1000.0);
    out.family("voxsheet_texture_read_seconds_total", "counter",
               "Time that uploads waited for samples, from host memory or disk")
        .value(state.readMs / 1000.0);
    out.family("voxsheet_texture_evictions_total", "counter", "Textures evicted").value(state.evictions);
    out.family("voxsheet_texture_queue", "gauge", "Textures waiting to be brought in")
        .value(state.queuedUploads);
    out.family("voxsheet_texture_queue_bytes", "gauge", "Bytes still to be filled in them")
        .value(state.queuedBytes);
}

void addHostMemory(MetricsText& out, const HostCacheState& state) {
    out.family("voxsheet_host_cache_bytes", "gauge", "Bytes of samples kept in host memory")
        .value(state.bytes);
    out.family("voxsheet_host_cache_budget_bytes", "gauge", "Budget of samples in host memory")
        .value(state.budgetBytes);
    out.family("voxsheet_host_cache_hits_total", "counter", "Blocks of samples found in host memory")
        .value(state.hits);
    out.family("voxsheet_host_cache_misses_total", "counter", "Blocks of samples that had to be read")
        .value(state.misses);
    out.family("voxsheet_host_cache_evictions_total", "counter", "Blocks of samples given up")
        .value(state.evictions);
    out.family("voxsheet_store_read_bytes_total", "counter", "Bytes of samples read from the volume store")
        .value(state.diskBytes);
    out.family("voxsheet_store_read_seconds_total", "counter", "Time spent on reading them")
        .value(state.diskMs / 1000.0);
}

void addStreams(MetricsText& out, const ApiContext& context) {
    const auto streams = context.hub.statistics();
    out.family("voxsheet_streams", "gauge", "Open streams").value(streams.streams);
    out.family("voxsheet_stream_frames_total", "counter", "Frames sent over streams").value(streams.frames);
    out.family("voxsheet_stream_tiles_total", "counter", "Tiles sent over streams").value(streams.tiles);
    out.family("voxsheet_stream_bytes_total", "counter", "Bytes sent over streams").value(streams.bytes);
    const auto cache = context.tiles.cacheState();
    out.family("voxsheet_tile_cache_bytes", "gauge", "Encoded pictures kept").value(cache.bytes);
    out.family("voxsheet_tile_cache_hits_total", "counter", "Pictures found in the cache").value(cache.hits);
    out.family("voxsheet_tile_cache_misses_total", "counter", "Pictures that had to be drawn")
        .value(cache.misses);
}

} // namespace

void addMetricsRoute(Router& router, const ApiContext& context) {
    router.add({.method = "GET",
                .pattern = "/metrics",
                .handler =
                    [&context](Request&) {
                        MetricsText out;
                        addServer(out, context);
                        addEngine(out, context);
                        addTextures(out, context.engine.residency());
                        addHostMemory(out, context.engine.hostCache());
                        addStreams(out, context);
                        return Response{200, "text/plain; version=0.0.4; charset=utf-8", out.text()};
                    },
                .summary = "Counters for Prometheus",
                .answerType = "text/plain"});
}

} // namespace voxsheet::http
