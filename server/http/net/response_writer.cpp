// The only file that includes httplib.h. cpp-httplib frames what goes out; what comes in is read by our own
// strict parser (message/request_head.h), because the packaged version has no limits there.
#include "http/net/response_writer.h"

#include "base/log.h"

#include <array>
#include <ctime>
#include <httplib.h>
#include <string>

// The packaged library is compiled with these; leaving one out changes the layout of its classes.
#if !defined(CPPHTTPLIB_OPENSSL_SUPPORT) || !defined(CPPHTTPLIB_ZLIB_SUPPORT) ||                             \
    !defined(CPPHTTPLIB_BROTLI_SUPPORT)
#error "compile with the flags of: pkg-config --cflags cpp-httplib"
#endif

namespace voxsheet::http {

namespace {

std::string httpDate() {
    const std::time_t now = std::time(nullptr);
    std::tm utc{};
    gmtime_r(&now, &utc);
    std::array<char, 64> text{};
    const auto length = std::strftime(text.data(), text.size(), "%a, %d %b %Y %H:%M:%S GMT", &utc);
    return {text.data(), length};
}

/// Gives httplib a request that we have written ourselves, and takes its answer.
class FramingStream : public httplib::Stream {
public:
    FramingStream(StreamWriter& out, const ResponseFraming& framing) : out_(out) {
        request_ = framing.headOnly ? "HEAD / HTTP/1.1\r\n" : "GET / HTTP/1.1\r\n";
        if (!framing.keepAlive) request_ += "Connection: close\r\n";
        request_ += "\r\n";
    }
    bool is_readable() const override { return read_ < request_.size(); }
    bool is_writable() const override { return out_.open(); }
    ssize_t read(char* data, size_t size) override {
        const auto count = request_.copy(data, size, read_);
        read_ += count;
        return static_cast<ssize_t>(count);
    }
    ssize_t write(const char* data, size_t size) override {
        return out_.write({data, size}) ? static_cast<ssize_t>(size) : -1;
    }
    void get_remote_ip_and_port(std::string& /*ip*/, int& port) const override { port = 0; }
    void get_local_ip_and_port(std::string& /*ip*/, int& port) const override { port = 0; }
    // httplib refuses descriptors from FD_SETSIZE on, since it would select() them; it never sees ours.
    socket_t socket() const override { return 0; }

private:
    StreamWriter& out_;
    std::string request_;
    std::size_t read_ = 0;
};

class SinkWriter : public StreamWriter {
public:
    explicit SinkWriter(httplib::DataSink& sink) : sink_(sink) {}
    bool write(std::string_view bytes) override {
        if (bytes.empty()) return open();
        open_ = open_ && sink_.write(bytes.data(), bytes.size()) && sink_.is_writable();
        return open_;
    }
    [[nodiscard]] bool open() const override { return open_ && sink_.is_writable(); }

private:
    httplib::DataSink& sink_;
    bool open_ = true;
};

class Framer : public httplib::Server {
public:
    Framer() {
        svr_sock_ = 0; // not listening: only says that the server is not shutting down
        set_pre_routing_handler([this](const httplib::Request&, httplib::Response& out) {
            fill(out);
            return HandlerResponse::Handled;
        });
        // Without this handler httplib would send an exception's text in a header field.
        set_exception_handler([](const httplib::Request&, httplib::Response& out, const std::exception_ptr&) {
            out.status = 500;
        });
        set_keep_alive_timeout(60);
        set_keep_alive_max_count(1000);
    }

    bool frame(StreamWriter& out, const ResponseFraming& framing, Response&& response) {
        current_ = &response;
        FramingStream stream(out, framing);
        bool closed = false;
        const bool written = process_request(stream, !framing.keepAlive, closed, nullptr);
        current_ = nullptr;
        return written && !closed && framing.keepAlive && out.open();
    }

private:
    void fill(httplib::Response& out) {
        out.status = current_->status;
        out.set_header("Date", httpDate());
        for (const auto& [name, value] : current_->headers.fields())
            out.set_header(name, value);
        if (current_->stream) {
            out.set_chunked_content_provider(
                current_->contentType, [this](size_t, httplib::DataSink& sink) { return runStream(sink); });
            return;
        }
        if (!current_->contentType.empty()) out.set_header("Content-Type", current_->contentType);
        out.body = std::move(current_->body);
    }

    bool runStream(httplib::DataSink& sink) {
        SinkWriter writer(sink);
        try {
            current_->stream(writer);
        } catch (const std::exception& error) {
            logWarning(std::string("a stream ended early: ") + error.what());
            return false;
        }
        if (!writer.open()) return false;
        sink.done();
        return true;
    }

    Response* current_ = nullptr;
};

} // namespace

bool writeResponse(StreamWriter& out, const ResponseFraming& framing, Response&& response) noexcept {
    try {
        thread_local Framer framer;
        return framer.frame(out, framing, std::move(response));
    } catch (const std::exception& error) {
        logError(std::string("a response could not be written: ") + error.what());
        return false;
    }
}

} // namespace voxsheet::http
