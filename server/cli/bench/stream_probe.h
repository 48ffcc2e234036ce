// A page without a browser: opens a stream, posts views, decodes every tile, acknowledges frames.
#pragma once

#include <glm/glm.hpp>
#include <nlohmann/json.hpp>

#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <set>
#include <string>
#include <thread>
#include <vector>

namespace voxsheet::cli {

struct ProbedFrame {
    std::uint64_t view = 0;
    double latencyMs = 0.0; ///< from posting the view to its last decoded pixel
    std::size_t bytes = 0;
    double scale = 1.0; ///< coarsest of its tiles
    bool final = true;  ///< all its tiles
    std::chrono::steady_clock::time_point when;
};

/// From sending an edit to the last decoded pixel.
struct ProbedEdit {
    double firstMs = 0.0; ///< of each cell's first picture, whatever its quality
    double scale = 1.0;   ///< coarsest of these
    double finalMs = 0.0; ///< of each cell's final picture
};

class StreamProbe {
public:
    /// Opens the stream and waits for its greeting. Throws IoError.
    StreamProbe(int port, std::string sheet);
    ~StreamProbe();
    StreamProbe(const StreamProbe&) = delete;
    StreamProbe& operator=(const StreamProbe&) = delete;

    /// Posts a view with a new id (returned) and whatever is to be acknowledged.
    std::uint64_t post(nlohmann::json view);
    /// Blocks until a final frame has ended in which every one of `cells` has a final picture; false after
    /// the deadline.
    bool waitFinal(std::size_t cells, double seconds);
    /// Blocks until the server has nothing more to draw; false after the deadline.
    bool waitRest(double seconds);
    /// Sends a PATCH while the server is at rest, and waits for pictures of all `cells` and for rest. Throws
    /// IoError if it is refused or something does not come in time.
    [[nodiscard]] ProbedEdit edit(const std::string& path, const nlohmann::json& body,
                                  const std::set<std::string>& cells, double seconds);
    [[nodiscard]] std::vector<ProbedFrame> takeFrames();

private:
    using Clock = std::chrono::steady_clock;
    void receive(int port, const std::string& sheet);
    void take(const nlohmann::json& header, std::string_view payload);
    /// What is said of one picture; with the lock held.
    void take(const nlohmann::json& tile);
    void send(const nlohmann::json& body);

    int port_;
    std::mutex mutex_;
    std::condition_variable changed_;
    std::string id_;
    std::string failure_;
    bool closing_ = false;
    std::uint64_t nextView_ = 1;
    std::map<std::uint64_t, Clock::time_point> posted_;
    std::map<std::string, bool> finalCells_;
    ProbedFrame current_;
    std::vector<ProbedFrame> frames_;
    bool resting_ = false;
    std::set<std::string> unseen_; ///< cells of the last edit that have no picture since
    double unseenScale_ = 1.0;     ///< coarsest of those that got one
    Clock::time_point seenAt_;     ///< when the last of them got it
    Clock::time_point finalAt_;    ///< when any got its final one last
    class Connection;
    std::unique_ptr<Connection> control_; ///< of post()
    std::unique_ptr<Connection> acks_;    ///< of the receiving thread
    std::thread receiver_;
};

} // namespace voxsheet::cli
